# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How long do the steps of a program take? Measured from outside, without a line in it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, ExitStack
from functools import wraps
import importlib
from time import process_time
from typing import Any
from unittest.mock import patch


@contextmanager
def stopwatches(steps: dict[str, tuple[str, str]]) -> Iterator[dict[str, float]]:
    """Add up the CPU time [s] that each step takes, measured from outside."""
    spent = dict.fromkeys(steps, 0.0)
    with ExitStack() as stack:
        for name, (module, path) in steps.items():
            owner: Any = importlib.import_module(module)
            *outer, function = path.split('.')
            for part in outer:
                owner = getattr(owner, part)
            timed = _timed(getattr(owner, function), name, spent)
            stack.enter_context(patch.object(owner, function, timed))
        yield spent


def _timed(function: Callable[..., Any], name: str, spent: dict[str, float]) -> Any:
    @wraps(function)
    def timed(*arguments: Any, **named: Any) -> Any:
        begin = process_time()
        try:
            return function(*arguments, **named)
        finally:
            spent[name] += process_time() - begin

    return timed
