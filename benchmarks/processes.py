# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How much memory and processor time has a process taken? From Linux's /proc and glibc."""

from __future__ import annotations

import ctypes
import os
from pathlib import Path

_TICKS = os.sysconf('SC_CLK_TCK')
_PAGE = os.sysconf('SC_PAGE_SIZE')
_USER, _SYSTEM = 11, 12  # fields of /proc/PID/stat after the name


class _Mallinfo(ctypes.Structure):
    _fields_ = [
        (name, ctypes.c_size_t)
        for name in (
            'arena', 'ordblks', 'smblks', 'hblks', 'hblkhd', 'usmblks', 'fsmblks', 'uordblks',
            'fordblks', 'keepcost',
        )
    ]  # fmt: skip


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


def own_allocations() -> float:
    """
    Return what this process has got from malloc and not given back [MB].

    With PYTHONMALLOC=malloc that is all that it holds. Resident memory is more by what lies unused
    between: after messages of all sizes that rises for long although nothing is held.
    """
    libc = ctypes.CDLL(None)
    libc.mallinfo2.restype = _Mallinfo
    told = libc.mallinfo2()
    return round((told.uordblks + told.hblkhd) / 1e6, 3)
