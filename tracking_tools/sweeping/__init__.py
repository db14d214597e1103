# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Many runs of many settings: which parameters are better, and how sure is that?

Read ``tasks`` (what is to be done), ``work`` (one run), ``store`` (what is done), ``crew`` (who
does it: this process, all cores, or a Dask cluster) and ``table`` (what came out) in this order.
"""
