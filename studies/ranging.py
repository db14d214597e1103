# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does the range from bearings reach the Cramer-Rao bound, and is it silent when it knows nothing?

Scenario V-0 of [VORONINA19]. Run ``python -m studies.ranging``; it writes
docs/results/ranging.md. Read ``v0_ranging.py`` for the runs.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from studies import pictures
from studies.figures import about, at_least, at_most, Claim, intervals, table
from studies.v0_ranging import (
    BEND,
    Case,
    end_figures,
    OBJECTS,
    play,
    Record,
    SEED,
    sudden_figures,
    TURN_TIME,
)
from tracking_core.batches import Ints

RESULT = Path(__file__).parent.parent / 'docs' / 'results' / 'ranging.md'
TURNS = (10.0, 20.0, 30.0, 60.0, 90.0)  # [deg]
ALMOST_ALL = 0.99
BENDS = (5.0, 15.0, 30.0, 60.0)  # [deg]

CLAIMS = (
    about('1 bound', 8.5, 0.1, 'object 1, bound of the range sd at the end [m]'),
    about('2 bound', 13.9, 0.1, 'object 2, the same [m]'),
    Claim('1 ratio', 0.85, 1.25, 'object 1, real error over bound'),
    Claim('2 ratio', 0.85, 1.25, 'object 2, real error over bound'),
    about('1 told', 8.5, 0.5, 'object 1, range sd that is told [m]'),
    about('2 told', 13.9, 0.8, 'object 2, the same [m]'),
    about('nees', 4.0, 0.5, 'squared error of x, y, vx, vy in its covariance'),
    at_least('observable', 1.0, 'runs and objects that are observable at the end'),
    at_most('silent', 0.0, 'ranges told in any run at any time without a manoeuvre'),
)

REPORT = """# Range from bearings, scenario V-0

`python -m studies.ranging --runs {runs}`: {runs} runs as one batch, seed {seed}; bearing sd
0.05 deg, a mark every 2 s, 1850 s; own ship 5 kn turns by 60 deg at 900 s. 95 % intervals are
bootstrapped over runs. The real error is the root mean square over runs, the bound is Cramer's
and Rao's from all {marks} marks; the fit keeps 128 averages of them.

## What to know

- **Without a manoeuvre nothing is told**: {silent:.0f} ranges in {runs} runs of both objects.
- {first:.0f} s after the turn 99 % of the ranges are observable. A straight course would tell
  earlier and after smaller turns; a range must also stand a small drift of the contact's velocity
  (`ranging.velocity_noise`) and a heading that is wrong for a while (`ranging.heading_noise`).
- **The sd that is told is that of a contact that strays as far as its marks allow**: where they
  are sure of a straight course, as here, it is the bound. A contact that turns in the same minutes
  as the own ship can look like a nearer or farther one on a straight course; no residual shows it.
  `ranging.velocity_noise` says how much of this a verdict must stand, and how likely it is.
- A contact that turns later is noticed, but not at once (last table). There all contacts turn at
  once, which is taken for a wrong heading as long as that explains the marks; one that turns among
  others is noticed sooner.

## Figures

{table}

{picture}

## By the turn of the own ship

| turn [deg] | observable at the end | bound 1 [m] | error 1 [m] | bound 2 [m] | error 2 [m] |
|---|---|---|---|---|---|
{turns}

Errors are of the runs that are observable; `nan`: none.

## Contacts that turn, {bend:.0f} s after the start

Share of runs of both objects that tell a range, and the share of runs that tell one more than
20 % wrong, by the time after the contact's turn.

| turn [deg] | told after 50 s | 100 s | 200 s | 500 s | wrong after 50 s | 100 s | 200 s | 500 s |
|---|---|---|---|---|---|---|---|---|
{bends}
"""


def by_turn(runs: int) -> str:
    """Return rows of a Markdown table: what a smaller or larger turn is worth."""
    rows = []
    for turn in TURNS:
        values = end_figures(play(Case(turn=turn), runs), np.arange(runs))
        cells = [
            f'{values[f"{name} {kind}"]:.1f}' for name in OBJECTS for kind in ('bound', 'rms')
        ]
        rows.append(f'| {turn:.0f} | {values["observable"]:.1%} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(rows)


def by_bend(runs: int) -> str:
    """Return rows of a Markdown table: what becomes of contacts that turn."""
    rows = []
    for bend in BENDS:
        told, wrong = sudden_figures(play(Case(bend=bend), runs))
        cells = [f'{share:.0%}' for share in (*told, *wrong)]
        rows.append(f'| {bend:.0f} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(rows)


def draw(record: Record, path: Path) -> str:
    """Draw error, told sd and bound over time."""
    figure, axes = pictures.panels(1, 2, width=8.5, height=3.2)
    later = record.time > TURN_TIME + 100.0
    for column, name in enumerate(OBJECTS):
        error = np.sqrt(np.nanmean(record.error[later][:, column] ** 2, axis=1))
        curves = {
            'real error': error,
            'told': np.nanmean(record.sd[later][:, column], axis=1),
            'bound': record.bound[later][:, column],
        }
        panel = axes.flat[column]
        pictures.lines(panel, record.time[later], curves, 'time [s]', 'range [m]')
        panel.set_title(f'object {name}', fontsize=10, loc='left')
        panel.set_ylim(bottom=0.0)
    return pictures.save(figure, path)


def describe(runs: int, folder: Path) -> str:
    """Run the study, write its picture into the folder and return the report as Markdown."""
    turned, straight = play(Case(), runs), play(Case(turn=0.0), runs)

    def figures(rows: Ints) -> dict[str, float]:
        silent = float(straight.observable[:, :, rows].sum())
        return {**end_figures(turned, rows), 'silent': silent}

    values = figures(np.arange(runs))
    bounds = intervals(figures, runs, np.random.default_rng(SEED))
    share = turned.observable.reshape(len(turned.time), -1).mean(axis=1)
    first = turned.time[np.argmax(share > ALMOST_ALL)] - TURN_TIME
    return REPORT.format_map(
        {
            **values, 'runs': runs, 'seed': SEED, 'marks': turned.marks, 'first': first,
            'bend': BEND, 'table': table(CLAIMS, values, bounds),
            'picture': draw(turned, folder / 'ranging_errors.png'),
            'turns': by_turn(runs), 'bends': by_bend(runs),
        }
    )  # fmt: skip


def main() -> None:
    """Print and write the report."""
    parser = argparse.ArgumentParser(description='Range from bearings on scenario V-0.')
    parser.add_argument('--runs', type=int, default=200)
    parser.add_argument('--output', type=Path, default=RESULT)
    arguments = parser.parse_args()
    report = describe(arguments.runs, arguments.output.parent)
    arguments.output.write_text(report)
    print(report)


if __name__ == '__main__':
    main()
