# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What Ctrl-C, SIGTERM or a pipe that is closed does to a command.

No traceback, nothing half done is left behind, and the exit code is the usual one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
import os
import signal
import sys
from threading import current_thread, main_thread

STOPPED = 130  # by SIGINT, as shells count
TERMINATED = 143  # ... by SIGTERM
UNREAD = 141  # ... by SIGPIPE: nobody reads on, as behind a pipe to head
Main = Callable[..., int]


def stoppable(name: str) -> Callable[[Main], Main]:
    """Return what lets the `main` of the command `name` end without a traceback."""

    def decorate(main: Main) -> Main:
        @wraps(main)
        def stoppable_main(*args: object) -> int:
            try:
                with _leaving_when_terminated():
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


@contextmanager
def _leaving_when_terminated() -> Iterator[None]:
    """Let SIGTERM leave all that is open the usual way, unless the command has its own one."""
    if current_thread() is not main_thread():  # where no handler can be set
        yield
        return
    before = signal.signal(signal.SIGTERM, _leave)
    try:
        yield
    finally:
        if signal.getsignal(signal.SIGTERM) is _leave:
            signal.signal(signal.SIGTERM, before)


def _leave(*_: object) -> None:
    raise SystemExit(TERMINATED)
