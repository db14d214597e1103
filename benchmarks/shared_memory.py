# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What a process that is killed leaves in shared memory.

``fastdds shm clean`` is not for us: it may take the files of a process that begins just then, of
whoever runs it; that process sees its publishers and never gets a message.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
import re

_LOCK = re.compile(r'/dev/shm/(fastrtps_[0-9a-f]{16})_el')


def shared_memory(process_id: int) -> list[Path]:
    """Return the files that only this process writes: its segments and their locks."""
    files = []
    for opened in Path('/proc', str(process_id), 'fd').iterdir():
        with suppress(FileNotFoundError):  # closed meanwhile
            lock = opened.readlink()
            if segment := _LOCK.fullmatch(str(lock)):
                files += [lock, lock.with_name(segment[1])]
    return files
