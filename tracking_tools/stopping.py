# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What Ctrl-C or a pipe that is closed does to a command: no traceback, the usual exit code."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
import os
import sys

STOPPED = 130  # by SIGINT, as shells count
UNREAD = 141  # ... by SIGPIPE: nobody reads on, as behind a pipe to head
Main = Callable[..., int]


def stoppable(name: str) -> Callable[[Main], Main]:
    """Return what lets the `main` of the command `name` end without a traceback."""

    def decorate(main: Main) -> Main:
        @wraps(main)
        def stoppable_main(*args: object) -> int:
            try:
                code = main(*args)
                sys.stdout.flush()  # here, where it can still be said that nobody reads
            except KeyboardInterrupt:
                print(f'{name}: stopped', file=sys.stderr)
                return STOPPED
            except BrokenPipeError:
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the rest
                return UNREAD
            return code

        return stoppable_main

    return decorate
