# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How the program of a node begins: whoever stops it while it still loads need not wait.

This file is read before anything that takes time to import.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
import os
import signal


def start(module: str, args: Sequence[str] | None = None) -> int:
    """
    Import a module and run its `main`, which takes the signals over; return the exit code.

    Parameters
    ----------
    module : str
        With all that the node needs.
    args : sequence of str, optional
        Command line; that of the process by default.

    """
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _leave)
    return int(import_module(module).main(args))


def _leave(*_: object) -> None:
    """End at once: nothing is open yet, and an exception could come out anywhere in an import."""
    os._exit(0)
