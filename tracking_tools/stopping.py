# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What Ctrl-C does to a command: one line, and the exit code of a program that was interrupted."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
import sys

STOPPED = 130
Main = Callable[..., int]


def stoppable(name: str) -> Callable[[Main], Main]:
    """Return what lets the `main` of the command `name` end with a line instead of a traceback."""

    def decorate(main: Main) -> Main:
        @wraps(main)
        def stoppable_main(*args: object) -> int:
            try:
                return main(*args)
            except KeyboardInterrupt:
                print(f'{name}: stopped', file=sys.stderr)
                return STOPPED

        return stoppable_main

    return decorate
