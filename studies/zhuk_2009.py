# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does the mixed-Markov filter do what [ZHUK09] says? The table of scenario Z-0.

Run ``python -m studies.zhuk_2009``; it writes docs/results/zhuk_2009.md with its figures. Read
``z0.py`` for what the figures are, ``z_scenes.py`` for the joint filter.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from studies import pictures
from studies.command import write_report
from studies.figures import about, at_least, at_most, Figures, intervals, table, template
from studies.z0 import CONTACTS, figures, PERIOD, PLANES, play, Record, SEED, SETTLED
from studies.z_scenes import joint_figures, position_errors, Z_0, Z_NEAR
from tracking_core.batches import Floats, Ints

CLAIMS = (
    at_least('horizontal onset found', 0.98, 'horizontal onset found within 3 contacts'),
    about('horizontal onset delay', 1.60, 0.10, 'its mean delay [contacts]'),
    at_least('horizontal release found', 0.96, 'horizontal release found within 3 contacts'),
    about('horizontal release delay', 2.25, 0.12, 'its mean delay [contacts]'),
    at_least('vertical onset found', 0.96, 'vertical onset found within 3 contacts'),
    about('vertical onset delay', 1.73, 0.15, 'its mean delay [contacts]'),
    about('vertical release found', 0.765, 0.06, 'vertical release found within 3 contacts'),
    at_most('horizontal false decisions', 0.003, 'false horizontal decisions per quiet contact'),
    at_most('vertical false decisions', 0.010, 'false vertical decisions per quiet contact'),
    about('map growth x', 3.97, 0.15, 'growth of forecast sd, winning mode, x', '3 to 4'),
    about('map growth y', 3.97, 0.15, 'the same, y', '3 to 4'),
    about('map growth z', 2.63, 0.20, 'the same, z', '3 to 4'),
    about('mmse growth x', 2.14, 0.12, 'growth of forecast sd, mixture, x'),
    about('mmse growth y', 2.20, 0.12, 'the same, y'),
    about('mmse growth z', 1.47, 0.12, 'the same, z'),
    about('map error manoeuvre', 0.944, 0.02, '3-D RMSE over plot RMSE, MAP, manoeuvre'),
    about('map error quiet', 0.821, 0.02, 'the same, MAP, quiet'),
    about('mmse error manoeuvre', 0.938, 0.02, 'the same, MMSE, manoeuvre'),
    about('mmse error quiet', 0.831, 0.02, 'the same, MMSE, quiet'),
    about('map first contact x', 1.14, 0.08, 'RMSE over plot RMSE, first contact of a turn, x'),
    about('map first contact y', 1.14, 0.08, 'the same, y'),
    about('map first contact z', 1.23, 0.08, 'the same, first contact of a climb, z'),
    at_least('gate manoeuvre x', 0.91, 'plots in the causal 3-sigma gate, manoeuvre, x'),
    at_least('gate manoeuvre y', 0.97, 'the same, y'),
    at_least('gate manoeuvre z', 0.98, 'the same, z'),
    at_least('gate all', 0.985, 'the same, all contacts, worst axis'),
)

JOINT_CLAIMS = (
    about('far joint manoeuvre', 1.0, 0.003, 'joint over decomposed RMSE, Z-0, manoeuvre'),
    about('far joint quiet', 1.0, 0.003, 'the same, quiet'),
    about('near joint manoeuvre', 0.926, 0.02, 'the same, Z-near, manoeuvre'),
    about('near joint quiet', 0.947, 0.02, 'the same, quiet'),
)


def joint(near: dict[str, Floats], far: dict[str, Floats], runs: Ints) -> Figures:
    """Return what the joint filter gains on both scenes, from these runs."""
    return {
        f'{place} {name}': value
        for place, errors, scene in (('near', near, Z_NEAR), ('far', far, Z_0))
        for name, value in joint_figures(errors, scene, runs).items()
    }


def draw_probability(record: Record, path: Path) -> str:
    """Draw the mean probability of the manoeuvre mode over time, manoeuvres shaded."""
    figure, axes = pictures.panels(2, 1, height=2.2)
    time = PERIOD * np.arange(CONTACTS)
    for panel, (plane, spans) in zip(axes.flat, PLANES.items(), strict=True):
        pictures.shade(panel, {str(span): span for span in spans})
        probability = record.manoeuvre_probability[plane]
        curves = {'mean of all runs': probability.mean(axis=1), 'run 0': probability[:, 0]}
        pictures.lines(panel, time, curves, 'time [s]', 'manoeuvre mode [1]', plane)
    return pictures.save(figure, path)


def draw_forecast(record: Record, path: Path) -> str:
    """Draw the sd of the forecast and the errors over time."""
    figure, axes = pictures.panels(3, 1, height=2.2)
    time = PERIOD * np.arange(CONTACTS)
    for axis, panel in enumerate(axes.flat):
        curves = {
            'forecast sd, winning mode': pictures.rms(record.predicted_sd['map'][..., axis]),
            'forecast sd, mixture': pictures.rms(record.predicted_sd['mmse'][..., axis]),
            'error, plots': pictures.rms(record.error['plot'][..., axis]),
            'error, mixture': pictures.rms(record.error['mmse'][..., axis]),
        }
        pictures.lines(panel, time, curves, 'time [s]', f'{"xyz"[axis]}, RMS [m]')
    return pictures.save(figure, path)


def describe(runs: int, folder: Path, quiet: bool = True) -> str:
    """Run the study, write its figures into the folder and return the report as Markdown."""
    record = play(runs, quiet)
    both = position_errors(Z_NEAR, runs, quiet), position_errors(Z_0, runs, quiet)

    def all_figures(rows: Ints) -> Figures:
        return {**figures(record, rows), **joint(*both, rows)}

    values = all_figures(np.arange(runs))
    bounds = intervals(all_figures, runs, np.random.default_rng(SEED))
    return template('zhuk_2009').format_map(
        {
            **values,
            'runs': runs,
            'seed': SEED,
            'settled': SETTLED,
            'saving': 1.0 - values['mmse error manoeuvre'],
            'table': table(CLAIMS + JOINT_CLAIMS, values, bounds),
            'probability': draw_probability(record, folder / 'zhuk_2009_modes.png'),
            'forecast': draw_forecast(record, folder / 'zhuk_2009_forecast.png'),
        }
    )


def main() -> None:
    """Print and write the report."""
    write_report(
        'Table of [ZHUK09] on scenario Z-0.', 'zhuk_2009', 500, partial(describe, quiet=False)
    )


if __name__ == '__main__':
    main()
