# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Why does a scan not wait for memory? What the last scan freed was kept for it."""

from __future__ import annotations

from functools import cache

import numpy as np

_BLOCK = 2**23  # bytes


@cache
def keep_freed_memory() -> None:
    """
    Let the C library keep up to 16 MB that were freed at the end of the heap.

    glibc gives them back beyond twice the largest block that was mapped and freed so far, and the
    next scan asks for the same pages again: in dense clutter a fifth of its time. One large block
    that is never touched raises that limit, if the environment (``MALLOC_TRIM_THRESHOLD_``) does
    not set it. Other C libraries do not mind.
    """
    np.empty(_BLOCK, np.uint8)
