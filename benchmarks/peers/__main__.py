# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Run all trackers on all scenes and write the tables: ``python -m benchmarks.peers``."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from datetime import datetime, timezone
import math
import os
from pathlib import Path
import platform
import sys

import numpy as np
import scipy
from tqdm import tqdm

from benchmarks.peers.entrants import Entrant, ENTRANTS
from benchmarks.peers.menu import Entry, MENU
from benchmarks.peers.race import memory, race
from benchmarks.peers.report import Result, sections
from benchmarks.peers.shelf import keep, kept
from benchmarks.peers.summary import compare

MEMORY_SCANS, MEMORY_LIMIT = 8, 30.0  # [s]
TEMPLATE = Path(__file__).with_name('results.md')


def run(entry: Entry, entrants: Mapping[str, Entrant], limit: float, bar: tqdm) -> Result:
    """Return what all runs of one scene say."""
    scenes = [entry.make(entry.scans, seed) for seed in range(1, entry.runs + 1)]
    laps = []
    for scene in scenes:
        bar.set_description(scene.name)
        laps.append(race(scene, entrants, limit, lambda _: bar.update()))
    rows = {}
    for name, entrant in entrants.items():
        bar.set_description(f'{scenes[0].name}: memory')
        held = memory(scenes[0].first(MEMORY_SCANS), entrant, min(limit, MEMORY_LIMIT))
        mine, ours = [lap[name] for lap in laps], [lap['ours'] for lap in laps]
        rows[name] = compare(entrant.title, scenes, mine, ours, held)
    is_angle = scenes[0].knowledge.axes == 1
    return Result(
        scenes[0].name, scenes[0].contacts, float(np.mean([len(p) for p in scenes[0].plots])),
        'deg' if is_angle else 'm', math.degrees(1.0) if is_angle else 1.0, rows,
    )  # fmt: skip


def machine(entrants: Mapping[str, Entrant]) -> str:
    """Return when, on what and with what this ran."""
    versions = {'numpy': np.__version__, 'scipy': scipy.__version__}
    for entrant in entrants.values():
        versions |= entrant.versions
    names = ', '.join(f'{name} {value}' for name, value in versions.items())
    return (
        f'{datetime.now(timezone.utc):%Y-%m-%d}, {_processor()}, {os.cpu_count()} cores, Python '
        f'{platform.python_version()}; {names}.'
    )


def _processor() -> str:
    try:
        lines = Path('/proc/cpuinfo').read_text(encoding='utf-8').splitlines()
    except OSError:
        return platform.machine()
    models = [line.split(':', 1)[1].strip() for line in lines if line.startswith('model name')]
    return models[0] if models else platform.machine()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    chosen = _parser().parse_args(arguments)
    entrants = {name: one for name, one in ENTRANTS.items() if name in (chosen.peers or ENTRANTS)}
    entrants = {'ours': ENTRANTS['ours'], **entrants}
    absent = [one.title for one in entrants.values() if not one.is_installed]
    if absent:
        print(f"not installed, left out: {'; '.join(absent)}; pip install -e '.[peers]'",
              file=sys.stderr)  # fmt: skip
    entrants = {name: one for name, one in entrants.items() if one.is_installed}
    entries = {
        name: Entry(one.make, min(one.scans, chosen.scans), min(one.runs, chosen.runs))
        for name, one in MENU.items()
        if name in (chosen.only or MENU)
    }
    total = sum(one.scans * one.runs for one in entries.values()) * len(entrants)
    results = {}
    with tqdm(total=total, unit='scan', disable=None) as bar:
        for name, one in entries.items():
            results[name] = run(one, entrants, chosen.limit, bar)
            if chosen.keep is not None:
                keep(chosen.keep, name, results[name])
    if chosen.keep is not None:
        results = kept(chosen.keep)
    tables = '\n\n'.join(f'## {title}\n\n{text}' for title, text in sections(results))
    page = TEMPLATE.read_text(encoding='utf-8')
    page = page.replace('{machine}', machine(entrants)).replace('{tables}', tables)
    if chosen.output is None:
        print(page)
    else:
        chosen.output.write_text(page, encoding='utf-8')
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='peers', description=__doc__)
    add = parser.add_argument
    add('--only', nargs='*', choices=MENU, metavar='SCENE', help=f'of {", ".join(MENU)}')
    add('--peers', nargs='*', choices=ENTRANTS, metavar='NAME', help=f'of {", ".join(ENTRANTS)}')
    add('--scans', type=int, default=10_000, help='at most, of each run')
    add('--runs', type=int, default=10_000, help='at most, of each scene')
    add('--limit', type=float, default=300.0, metavar='S',
        help='CPU after which a tracker gets no more scans of a run (default 300)')  # fmt: skip
    add('--keep', type=Path, metavar='DIR', help='keep results here; the page has all of them')
    add('--output', type=Path, metavar='FILE', help='Markdown; default: standard output')
    return parser


if __name__ == '__main__':
    sys.exit(main())
