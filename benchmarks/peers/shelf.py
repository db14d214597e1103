# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The results of scenes that are done, kept from one command to the next."""

from __future__ import annotations

from dataclasses import asdict
import json
from pathlib import Path

from benchmarks.peers.menu import MENU
from benchmarks.peers.race import Memory
from benchmarks.peers.report import Result
from benchmarks.peers.summary import Figure, Row


def keep(folder: Path, name: str, result: Result) -> None:
    """Write the result of a scene."""
    folder.mkdir(parents=True, exist_ok=True)
    beside = folder / f'.{name}'
    beside.write_text(json.dumps(asdict(result), indent=1), encoding='utf-8')
    beside.replace(folder / f'{name}.json')


def kept(folder: Path) -> dict[str, Result]:
    """Return the results that are there, in the order of the menu."""
    files = {name: folder / f'{name}.json' for name in MENU}
    return {
        name: _result(json.loads(file.read_text(encoding='utf-8')))
        for name, file in files.items()
        if file.exists()
    }


def _result(found: dict) -> Result:
    rows = {}
    for name, row in found['rows'].items():
        figures = {key: Figure(**value) for key, value in row['figures'].items()}
        memory = row['memory'] and Memory(**row['memory'])
        rows[name] = Row(**{**row, 'figures': figures, 'memory': memory})
    return Result(**{**found, 'rows': rows})
