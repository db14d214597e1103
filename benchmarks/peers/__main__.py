# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Run all trackers on all scenes and write the tables: ``python -m benchmarks.peers``."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
import sys
from time import monotonic

from tqdm import tqdm

from benchmarks.machine import machine
from benchmarks.peers.entrants import Entrant, ENTRANTS
from benchmarks.peers.menu import Entry, MENU
from benchmarks.peers.picture import draw
from benchmarks.peers.report import origin_text, Result, Results, sections
from benchmarks.peers.rounds import play, sum_up
from benchmarks.peers.shelf import keep, kept
from tracking_tools.arguments import count

TEMPLATE = Path(__file__).with_name('results.md')
MINUTE = 60.0  # [s]


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
        name: Entry(one.make, min(one.scans, chosen.scans), chosen.runs or one.runs)
        for name, one in MENU.items()
        if name in chosen.only or not (chosen.only or one.when_asked)
    }
    results: Results = _results(entries, entrants, chosen)
    if chosen.keep is not None:
        results = kept(chosen.keep)
    write(results, chosen.output)
    return 0


def write(results: Results, path: Path | None) -> None:
    """Write the page and the picture beside it, or print the page."""
    page = TEMPLATE.read_text(encoding='utf-8').replace('{made}', origin_text(results))
    page = page.replace('{tables}', '\n\n'.join(f'## {t}\n\n{x}' for t, x in sections(results)))
    if path is None:
        print(page.replace('{picture}', ''))
    else:
        shown = draw(results, path.with_suffix('.png'))
        path.write_text(page.replace('{picture}', shown), encoding='utf-8')


def _results(
    entries: Mapping[str, Entry], entrants: Mapping[str, Entrant], chosen: argparse.Namespace
) -> dict[str, Result]:
    versions = {name: is_ for one in entrants.values() for name, is_ in one.versions.items()}
    origin, end = machine(versions), monotonic() + MINUTE * chosen.budget
    total = 2 * sum(one.scans * one.runs for one in entries.values()) * len(entrants)
    results = {}
    with tqdm(total=total, unit='scan', disable=None) as bar:

        def tick(title: str) -> None:
            bar.set_description(title, refresh=False)
            bar.update()

        for name, races in play(entries, entrants, chosen.limit, end, tick).items():
            bar.set_description(f'{races[0][0].name}: memory')
            results[name] = sum_up(races, entrants, chosen.limit, entries[name].runs, origin)
            if chosen.keep is not None:
                keep(chosen.keep, name, results[name])
    return results


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='peers', description=__doc__)
    add = parser.add_argument
    add(
        '--only',
        nargs='*',
        default=[],
        choices=MENU,
        metavar='SCENE',
        help=f'of {", ".join(MENU)}',
    )
    add('--peers', nargs='*', choices=ENTRANTS, metavar='NAME', help=f'of {", ".join(ENTRANTS)}')
    add('--scans', type=int, default=10_000, help='at most, of each run')
    add('--runs', type=count, help='of each scene, instead of its own number')
    add('--limit', type=float, default=120.0, metavar='S',
        help='CPU after which a tracker gets no more scans of a run (default 120)')  # fmt: skip
    add('--budget', type=float, default=12.0, metavar='MIN',
        help='after which no second or later run of a scene begins (default 12)')  # fmt: skip
    add('--keep', type=Path, metavar='DIR', help='keep results here; the page has all of them')
    add('--output', type=Path, metavar='FILE', help='Markdown, with a picture beside it')
    return parser


if __name__ == '__main__':
    sys.exit(main())
