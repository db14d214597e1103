# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is done: one file for each run, whole or not there."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from tracking_tools.arguments import make_folder
from tracking_tools.sweeping.tasks import Task

Figures = dict[str, Any]


class Store:
    """
    The folder of a sweep; it can be left at any moment and gone on with later.

    Raises
    ------
    ValueError
        If the folder is a recording.

    """

    def __init__(self, folder: Path) -> None:
        if (folder / 'metadata.yaml').exists():
            raise ValueError(f'--output {folder} is a recording; give a folder of its own')
        self.folder = folder
        self._runs = folder / 'runs'
        make_folder(self._runs)

    def path(self, task: Task) -> Path:
        """Return where the result of a task is, or will be."""
        return self._runs / f'{task.key}.json'

    def write(self, task: Task, text: str) -> None:
        """Keep the result of a task."""
        write_whole(self.path(task), text)

    def read(self, task: Task) -> Figures | None:
        """Return the figures of a task; None if there are none that can be believed."""
        try:
            found = json.loads(self.path(task).read_text(encoding='utf-8'))
            figures = found['figures'] if found['task'] == task.identity else None
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return figures if isinstance(figures, dict) else None


def write_whole(path: Path, text: str) -> None:
    """Write a file so that at every moment it is as before or as wanted, never half."""
    beside = path.with_name(f'.{path.name}.{os.getpid()}')
    try:
        with beside.open('w', encoding='utf-8') as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)
