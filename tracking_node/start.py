# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How the program of a node begins and ends: whoever stops it need not wait for ever.

While it still loads it leaves at once. The middleware may never come back from its own end: in
Fast DDS 2.14, `DomainParticipant::set_listener` waits for a callback of the discovery that waits
for it, where another node comes or goes just then. No Python runs there, nor its signal handlers.

This file is read before anything that takes time to import.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
import os
import signal
import sys

USAGE = """usage: {} [--help] [--ros-args [-r FROM:=TO] [-p NAME:=VALUE] [--params-file FILE] ...]

{}

docs/parameters.md explains every parameter; config/ has files to begin with."""
LONGEST_END = 10  # of the middleware, until the process is ended [s]


def start(module: str, about: str, args: Sequence[str] | None = None) -> int:
    """
    Import a module and run its `main`, which takes the signals over; return the exit code.

    Parameters
    ----------
    module : str
        With all that the node needs.
    about : str
        What the node is, for who asks with ``--help``.
    args : sequence of str, optional
        Command line; that of the process by default.

    """
    if {'-h', '--help'} & set(sys.argv[1:] if args is None else args):
        print(USAGE.format(module.partition('.')[0], about.strip()))
        return 0
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _leave)
    code = int(import_module(module).main(args))
    limit_end()
    return code


def limit_end() -> None:
    """End the process after `LONGEST_END`, whatever hangs; ``signal.alarm(0)`` calls it off."""
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.alarm(LONGEST_END)


def _leave(*_: object) -> None:
    """End at once: nothing is open yet, and an exception could come out anywhere in an import."""
    os._exit(0)
