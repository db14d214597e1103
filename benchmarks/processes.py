# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How much memory and processor time has a process taken? From Linux's /proc and glibc."""

from __future__ import annotations

from array import array
import ctypes
import os
from pathlib import Path

import numpy as np

_TICKS = os.sysconf('SC_CLK_TCK')
TENTHS = 10
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


class Memory:
    """What this process held and how large it was, look by look; told in tenths of them."""

    def __init__(self) -> None:
        # Lists of floats would be what grows.
        self._held, self._resident = array('d'), array('d')

    def look(self) -> None:
        """Take note of both."""
        self._held.append(own_allocations())
        self._resident.append(own_memory())

    @property
    def held(self) -> list[float]:
        """Medians of what malloc has given and not got back [MB]."""
        return _tenths(self._held)

    @property
    def resident(self) -> list[float]:
        """Medians of the resident memory [MB]."""
        return _tenths(self._resident)


def _tenths(looks: array[float]) -> list[float]:
    parts = np.array_split(np.array(looks), TENTHS)
    return [round(float(np.median(part)), 2) for part in parts if len(part)]
