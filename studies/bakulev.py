# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Do interacting alpha-beta filters do what [BAKULEV] says? The tables of scenario B-0.

Run ``python -m studies.bakulev``; it writes docs/results/bakulev.md with its figures. Read
``b0.py`` for what the figures are.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from tqdm import tqdm

from studies import pictures
from studies.b0 import (
    CONTACTS,
    figures,
    FILTERS,
    PERIOD,
    play,
    plot_error,
    Record,
    SEED,
    SPANS,
    TURN,
)
from studies.command import write_report
from studies.figures import about, at_least, Claim, intervals, table, template
from tracking_core.batches import Floats
from tracking_core.estimators import ImmAlphaBeta

QUIET_GAINS = (0.20, 0.25, 0.30, 0.35, 0.40, 0.45)
BUSY_GAINS = (0.60, 0.65, 0.70, 0.75, 0.80, 0.85, 0.90, 0.95)

CLAIMS = (
    about('recursion manoeuvre position', 179.1, 7.2, 'recursion, manoeuvre, position [m]'),
    about('recursion manoeuvre velocity', 31.06, 0.93, 'the same, velocity [m/s]'),
    about('steady_state manoeuvre position', 138.8, 4.2, 'steady state, manoeuvre, position [m]'),
    about('steady_state manoeuvre velocity', 27.08, 0.81, 'the same, velocity [m/s]'),
    about('recursion quiet position', 76.0, 2.3, 'recursion, quiet, position [m]'),
    about('steady_state quiet position', 76.0, 2.3, 'steady state, quiet, position [m]'),
    about('recursion manoeuvre ratio', 0.75, 0.03, 'recursion over locked, manoeuvre', 'better'),
    about('steady_state manoeuvre ratio', 0.58, 0.03, 'steady state over locked', 'better'),
    about('recursion onset', 2.62, 0.15, 'recursion, onset delay [contacts]'),
    about('steady_state onset', 2.39, 0.15, 'steady state, onset delay [contacts]'),
    about('recursion quiet ratio', 1.15, 0.03, 'recursion over locked, quiet, position'),
    about('steady_state quiet ratio', 1.15, 0.03, 'steady state over locked, quiet, position'),
)
GRID_CLAIMS = (
    about('least', 87.9, 2.64, 'recursion, least error of all contacts on the grid [m]'),
    Claim('quiet gain', 0.30, 0.35, 'there alpha1 is'),
    Claim('busy gain', 0.80, 0.90, 'there alpha2 is'),
    at_least('gap', 0.0, 'all contacts, recursion over steady state at the same gains [m]'),
)


def grid(runs: int, quiet: bool = True) -> dict[str, Floats]:
    """Return the all-contact error (alpha1, alpha2) of both readings [m]."""
    cells = [
        (reading, i, j)
        for reading in ('recursion', 'steady_state')
        for i in range(len(QUIET_GAINS))
        for j in range(len(BUSY_GAINS))
    ]
    result = {name: np.zeros((len(QUIET_GAINS), len(BUSY_GAINS))) for name, *_ in cells}
    for reading, i, j in tqdm(cells, desc='gains', disable=quiet, leave=False):
        record = play(ImmAlphaBeta((QUIET_GAINS[i], BUSY_GAINS[j]), 2, reading), runs)
        result[reading][i, j] = pictures.rms(record.position[SPANS['all']], None)
    return result


def best(values: dict[str, Floats]) -> dict[str, float]:
    """Return the least error of `recursion`, its gains, and how far the other reading is below."""
    i, j = np.unravel_index(np.argmin(values['recursion']), values['recursion'].shape)
    return {
        'least': float(values['recursion'].min()),
        'quiet gain': QUIET_GAINS[i],
        'busy gain': BUSY_GAINS[j],
        'gap': float(np.median(values['recursion'] - values['steady_state'])),
    }


def draw_errors(records: dict[str, Record], path: Path) -> str:
    """Draw errors and the probability of the second mode over the contacts."""
    figure, axes = pictures.panels(3, 1, width=8.0, height=2.5)
    time = PERIOD * np.arange(CONTACTS)
    for panel in axes.flat:
        pictures.shade(panel, {'turn': (TURN[0] * PERIOD, (TURN[1] + 1) * PERIOD)})
    position = {name: pictures.rms(r.position) for name, r in records.items()}
    velocity = {name: pictures.rms(r.velocity) for name, r in records.items()}
    raised = {name: r.raised.mean(axis=1) for name, r in records.items()}
    pictures.lines(axes[0, 0], time, position, 'time [s]', 'position, RMS [m]')
    pictures.lines(axes[1, 0], time, velocity, 'time [s]', 'velocity, RMS [m/s]')
    pictures.lines(axes[2, 0], time, raised, 'time [s]', 'second mode, or raise of gain [1]')
    return pictures.save(figure, path)


def draw_grid(values: dict[str, Floats], path: Path) -> str:
    """Draw the error over both gains for both readings."""
    figure, axes = pictures.panels(1, 2, width=8.5, height=3.2)
    for panel, (name, z) in zip(axes.flat, values.items(), strict=True):
        filled = pictures.surface(panel, np.array(BUSY_GAINS), np.array(QUIET_GAINS), z)
        figure.colorbar(filled, ax=panel, label='position, RMS [m]')
        panel.set_xlabel('alpha2 [1]')
        panel.set_ylabel('alpha1 [1]')
        panel.set_title(name, fontsize=10, loc='left')
    return pictures.save(figure, path)


def all_filters(values: dict[str, float]) -> str:
    """Return rows of a Markdown table."""
    rows = []
    for name in FILTERS:
        cells = [
            f'{values[f"{name} {span} {kind}"]:.{digits}f}'
            for kind, digits in (('position', 1), ('velocity', 2))
            for span in SPANS
        ]
        rows.append('| ' + ' | '.join([name, *cells, f'{values[f"{name} onset"]:.2f}']) + ' |')
    return '\n'.join(rows)


def describe(runs: int, folder: Path, quiet: bool = True) -> str:
    """Run the study, write its figures into the folder and return the report as Markdown."""
    records = {name: play(make(), runs, quiet) for name, make in FILTERS.items()}
    values = dict(figures(records, np.arange(runs)))
    rng = np.random.default_rng(SEED)
    bounds = intervals(lambda rows: figures(records, rows), runs, rng)
    cells = grid(runs, quiet)
    least = best(cells)
    return template('bakulev').format_map(
        {
            **values, **least, 'runs': runs, 'seed': SEED,
            'price': values['recursion quiet velocity'] / values['locked quiet velocity'],
            'plots': float(plot_error(runs)),
            'table': table(CLAIMS, values, bounds),
            'grid_table': table(GRID_CLAIMS, least, {}),
            'all': all_filters(values),
            'errors': draw_errors(records, folder / 'bakulev_errors.png'),
            'grid': draw_grid(cells, folder / 'bakulev_gains.png'),
        }
    )  # fmt: skip


def main() -> None:
    """Print and write the report."""
    write_report(
        'Tables of [BAKULEV] on scenario B-0.', 'bakulev', 500, partial(describe, quiet=False)
    )


if __name__ == '__main__':
    main()
