# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What Ctrl-C, SIGTERM, a closed terminal or pipe, or a full disk does to a command.

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
HUNG_UP = 129  # ... by SIGHUP: the terminal is closed
UNREAD = 141  # ... by SIGPIPE: nobody reads on, as behind a pipe to head
CODES = {signal.SIGTERM: TERMINATED, signal.SIGHUP: HUNG_UP}
Main = Callable[..., int]


def stoppable(name: str) -> Callable[[Main], Main]:
    """Return what lets the `main` of the command `name` end without a traceback."""

    def decorate(main: Main) -> Main:
        @wraps(main)
        def stoppable_main(*args: object) -> int:
            try:
                with _leaving_when_told():
                    code = main(*args)
                    sys.stdout.flush()  # here, where it can still be said that nobody reads
            except KeyboardInterrupt:
                print(f'{name}: stopped', file=sys.stderr)
                return STOPPED
            except BrokenPipeError:
                _write_no_more()
                return UNREAD
            except OSError as error:  # of what is printed, as where a disk is full
                _write_no_more()
                print(f'{name}: {error}', file=sys.stderr)
                return 1
            return code

        return stoppable_main

    return decorate


def _write_no_more() -> None:
    """Let Python end in peace, which would write the rest."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def _leaving_when_told() -> Iterator[None]:
    """Let SIGTERM and SIGHUP leave all that is open the usual way; under nohup SIGTERM alone."""
    if current_thread() is not main_thread():  # where no handler can be set
        yield
        return
    before = {number: signal.getsignal(number) for number in CODES}
    ours = [number for number in CODES if before[number] is not signal.SIG_IGN]
    for number in ours:
        signal.signal(number, _leave)
    try:
        yield
    finally:
        for number in ours:
            if signal.getsignal(number) is _leave:  # the command may have its own one
                signal.signal(number, before[number])


def _leave(number: int, _: object) -> None:
    for each in CODES:
        signal.signal(each, signal.SIG_IGN)  # a terminal's shell repeats it; we are on our way
    raise SystemExit(CODES[signal.Signals(number)])
