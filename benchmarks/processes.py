# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How much memory and processor time has another process taken? Read from Linux's /proc."""

from __future__ import annotations

import os
from pathlib import Path

_TICKS = os.sysconf('SC_CLK_TCK')
_PAGE = os.sysconf('SC_PAGE_SIZE')
_USER, _SYSTEM = 11, 12  # fields of /proc/PID/stat after the name


def resident(pid: int) -> int:
    """Return the resident memory of a process [bytes]."""
    return int(Path(f'/proc/{pid}/statm').read_text().split()[1]) * _PAGE


def cpu_time(pid: int) -> float:
    """Return the processor time that a process has taken, all its threads [s]."""
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[_USER]) + int(fields[_SYSTEM])) / _TICKS


def own_memory() -> float:
    """Return the memory that this process holds [MB]."""
    return round(resident(os.getpid()) / 1e6, 1)
