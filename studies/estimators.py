# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which estimator is best where? One table of all of them on all courses of one contact.

Run ``python -m studies.estimators``; it writes docs/results/estimators.md. The real aircraft of
the shared data are in it when they are there. Read ``courses.py`` for the courses.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from tqdm import tqdm

from benchmarks.real_data import judge, preset
from benchmarks.real_data import run as track
from benchmarks.recordings import air_scene, air_tracks, data_folder, Recording
from studies.command import write_report
from studies.comparison import follow, JOINT, PAPER_GAINS, Row, ROWS
from studies.courses import Course, courses
from studies.figures import template

TURNS = 150  # of each real aircraft
HALF_HOUR = 180  # turns


def table(course: Course, rows: dict[str, Row]) -> str:
    """Return the Markdown table of one course."""
    lines = [
        f'### {course.name}',
        '',
        '| estimator | position: straight | turning | after | velocity: straight | turning '
        '| after '
        '| onset [contacts] (found) | NEES straight | turning | cost [us] |',
        '|---' * 11 + '|',
    ]
    for name, r in rows.items():
        onset = 'none' if np.isnan(r.found) else f'{r.onset:.2f} ({r.found:.0%})'
        cells = [
            *(f'{r.position[p]:.3f}' for p in r.position),
            *(f'{r.velocity[p]:.1f}' for p in r.velocity),
            onset, *(f'{r.nees[p]:.2f}' for p in ('straight', 'turning')), f'{r.cost:.1f}',
        ]  # fmt: skip
        lines.append(f'| {name} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines)


def real(quiet: bool) -> str:
    """Return the table of the shared recordings, through the whole tracker with its clutter."""
    if not data_folder().is_dir():
        return 'The shared recordings were not there.'
    scenes = {
        f'11 manoeuvring aircraft, first {TURNS} turns of 4 s': [
            r.part(0, TURNS) for r in air_tracks(data_folder())
        ],
        'en-route traffic, 30 min, turns of 10 s': [air_scene(data_folder()).part(0, HALF_HOUR)],
    }
    parts = [
        'The whole tracker with the shipped parameter file, other estimators by `estimator` alone '
        "(gains 0.3 and 0.7). Means over scenes; errors of position in units of the plots' error."
    ]
    for title, recordings in scenes.items():
        lines = [
            f'### {title}',
            '',
            '| estimator | held | switches | ghosts | straight | turning | velocity [m/s] '
            '| NEES position | NEES state | ms per scan |',
            '|---' * 10 + '|',
        ]
        names = [name for name in ROWS if name != JOINT]
        for name in tqdm(names, desc=title[:20], disable=quiet, leave=False):
            lines.append(_real_row(name, recordings))
        parts.append('\n'.join(lines))
    return '\n\n'.join(parts)


def _real_row(name: str, recordings: list[Recording]) -> str:
    values = []
    for recording in recordings:
        rows, cost = track(recording, preset(recording.preset, **ROWS[name]))
        r = judge(recording, rows)
        c, t, p = r.continuity, r.tracks, r.plots
        values.append(
            (c.held, c.switches, c.ghosts, t.rmse_straight / p.rmse_straight,
             t.rmse_turning / p.rmse_turning, t.velocity_rmse, t.nees_position, t.nees_state, cost)
        )  # fmt: skip
    held, switches, ghosts, *mean = (np.array(column) for column in zip(*values, strict=True))
    cells = [f'{held.mean():.3f}', f'{switches.sum()}', f'{ghosts.sum()}']
    cells += [f'{np.nanmean(column):.2f}' for column in mean]
    return f'| {name} | ' + ' | '.join(cells) + ' |'


def describe(runs: int, quiet: bool = True, with_real: bool = True) -> str:
    """Run the comparison and return its report as Markdown."""
    results: dict[str, dict[str, Row]] = {}
    tables, every = [], courses(runs)
    for course in tqdm(every, desc='courses', disable=quiet, leave=False):
        results[course.name] = {
            name: follow(name, course)
            for name in ROWS
            if name != JOINT or course.position.shape[1] == 3
        }
        tables.append(table(course, results[course.name]))
    return template('estimators').format(
        runs=runs, tables='\n\n'.join(tables), real=real(quiet) if with_real else '',
        count=len(every), wins=_wins(results), **_extremes(results),
        gains=', '.join(f'`{name}` {values}' for name, values in PAPER_GAINS.items()),
    )  # fmt: skip


def _wins(results: dict[str, dict[str, Row]]) -> int:
    """Return on how many courses markov_jump is within 3 % of the best."""
    count = 0
    for rows in results.values():
        mean = {
            n: np.hypot(r.position['straight'], r.position['turning']) for n, r in rows.items()
        }
        count += mean['markov_jump'] <= 1.03 * min(mean.values())
    return int(count)


def _extremes(results: dict[str, dict[str, Row]]) -> dict[str, Any]:
    """Return the figures that the text names."""

    def nees(*names: str) -> float:
        return max(rows[name].nees['turning'] for rows in results.values() for name in names)

    best = [min(row.position['turning'] for row in rows.values()) for rows in results.values()]
    lagging = [rows[n] for rows in results.values() for n in ('alpha_beta', 'adaptive_alpha_beta')]
    return {
        'worst_nees': nees(*PAPER_GAINS),
        'worst_recursion': nees('imm_alpha_beta, recursion'),
        'worst_markov': nees('markov_jump'),
        'worst_turn': max(row.position['turning'] for row in lagging),
        'best_turns': f'{min(best):.2f} to {max(best):.2f}',
    }


def main() -> None:
    """Print and write the report."""
    write_report(
        'All estimators on all courses.',
        'estimators',
        300,
        lambda runs, _: describe(runs, quiet=False),
    )


if __name__ == '__main__':
    main()
