# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What happened in a recording? One page to open in any browser, without a network.

Read ``material`` (what is shown), ``plan``, ``columns`` (how it gets into the page), ``stage``,
``panels`` (its figures), ``page`` (all together) and ``page.js`` (what moves) in this order.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any


def load_page() -> Any:
    """
    Return the module that writes pages.

    Raises
    ------
    ModuleNotFoundError
        Where bokeh is missing, with the way to get it.

    """
    try:
        return import_module('tracking_tools.report.page')
    except ModuleNotFoundError as error:
        if error.name != 'bokeh':
            raise
        raise ModuleNotFoundError('a page needs bokeh: pip install bokeh') from error
