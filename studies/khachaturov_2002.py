# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does fuzzy control of the gains do what [KHACH02] says? The table of scenario K-0.

Run ``python -m studies.khachaturov_2002``; it writes docs/results/khachaturov_2002.md with its
figures. Read ``k0.py`` for what the figures are.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from studies import pictures
from studies.command import write_report
from studies.figures import about, at_most, Claim, intervals, table, template
from studies.k0 import (
    ACCELERATIONS,
    BEGIN,
    END,
    Errors,
    figures,
    FILTERS,
    play,
    SEED,
    SPANS,
    STEPS,
    tenths,
)
from tracking_core.batches import Floats
from tracking_core.fuzzy import KHACHATUROV

FEW = 100  # runs of the paper
_BETTER = 'fuzzy better'

CLAIMS = (
    about('stationary error', 0.711, 0.005, 'alpha-beta, straight path, smoothing error [sd]'),
    about('stationary innovation', 1.382, 0.01, 'its innovation sd [sd]'),
    Claim(
        'fuzzy gain 3 manoeuvre', 0.05, 0.10, 'fuzzy below two-point, manoeuvre, 0.3 g', _BETTER
    ),
    *(
        about(f'fuzzy gain {tenths(a)} manoeuvre', 0.0, 0.04, f'the same, {a:g} g', _BETTER)
        for a in ACCELERATIONS[1:]
    ),
    *(
        Claim(
            f'fuzzy gain {tenths(a)} after',
            0.05,
            0.075,
            f'the same, after the end, {a:g} g',
            _BETTER,
        )
        for a in ACCELERATIONS[1:]
    ),
    *(
        Claim(
            f'kalman gain {tenths(a)} manoeuvre', 0.12, np.inf, f'Kalman below two-point, {a:g} g'
        )
        for a in ACCELERATIONS
    ),
    *(
        at_most(
            f'kalman {tenths(a)} manoeuvre', 1.0, f'Kalman, error in the manoeuvre, {a:g} g [sd]'
        )
        for a in ACCELERATIONS
    ),
)


def all_filters(values: dict[str, float]) -> str:
    """Return a Markdown table of every filter at every acceleration."""
    columns = [(a, span) for span in SPANS for a in (0.0, *ACCELERATIONS)]
    head = '| filter | ' + ' | '.join(f'{span}, {a:g} g' for a, span in columns) + ' |'
    rows = [
        f'| {name} | '
        + ' | '.join(f'{values[f"{name} {tenths(a)} {s}"]:.3f}' for a, s in columns)
        + ' |'
        for name in FILTERS
    ]
    return '\n'.join([head, '|---' * (len(columns) + 1) + '|', *rows])


def draw_errors(errors: Errors, path: Path) -> str:
    """Draw the error over the steps, one panel for each acceleration."""
    figure, axes = pictures.panels(2, 2, width=9.0)
    for panel, a in zip(axes.flat, ACCELERATIONS, strict=True):
        curves = {name: pictures.rms(errors[name, a]) for name in FILTERS if name != 'alpha_beta'}
        pictures.shade(panel, {'': (BEGIN, END)})
        pictures.lines(panel, np.arange(STEPS), curves, 'step of 5 s', 'RMS error [plot sd]',
                       f'{a:g} g')  # fmt: skip
        panel.set_ylim(0.4, 2.2)
    return pictures.save(figure, path)


def draw_surface(path: Path) -> str:
    """Draw how far the rules raise the gain, over the innovations before and now."""
    grid: Floats = np.linspace(0.0, 8.0, 81)
    before, now = np.meshgrid(grid, grid, indexing='ij')
    omega = KHACHATUROV.infer(before.ravel(), now.ravel()).reshape(before.shape)
    figure, axes = pictures.panels(1, 1, width=6.0, height=4.2)
    filled = pictures.surface(axes[0, 0], grid, grid, omega)
    figure.colorbar(filled, ax=axes[0, 0], label='raise of the gain omega [1]')
    axes[0, 0].set_xlabel('normalised innovation now [1]')
    axes[0, 0].set_ylabel('normalised innovation before [1]')
    return pictures.save(figure, path)


def few_runs(errors: Errors, rng: np.random.Generator) -> dict[str, float]:
    """Return 95 % intervals of the gain from few runs, with plots of their own or the same."""
    runs, rows = errors['fuzzy', 0.0].shape[1], SPANS['manoeuvre']
    result = {}
    for name, a, same in (('few', 0.3, False), ('apart', 0.5, False), ('paired', 0.3, True)):
        fuzzy, base = errors['fuzzy', a][rows], errors['two_point', a][rows]
        gains = []
        for _ in range(400):
            one, other = rng.integers(0, runs, (2, FEW))
            other = one if same else other
            own, its = pictures.rms(fuzzy[:, one], None), pictures.rms(base[:, other], None)
            gains.append(1.0 - own / its)
        result[f'{name} low'], result[f'{name} high'] = np.quantile(gains, [0.025, 0.975])
    return result


def describe(runs: int, folder: Path, quiet: bool = True) -> str:
    """Run the study, write its figures into the folder and return the report as Markdown."""
    errors, innovations = play(runs, quiet)
    values = dict(figures(errors, innovations, np.arange(runs)))
    rng = np.random.default_rng(SEED)
    bounds = intervals(lambda rows: figures(errors, innovations, rows), runs, rng)
    against = [
        1.0 - values[f'kalman {tenths(a)} manoeuvre'] / values[f'fuzzy {tenths(a)} manoeuvre']
        for a in ACCELERATIONS
    ]
    fuzzy = [values[f'fuzzy {tenths(a)} manoeuvre'] for a in ACCELERATIONS]
    return template('khachaturov_2002').format_map(
        {
            **values, 'runs': runs, 'seed': SEED, 'begin': BEGIN, 'end': END, 'few': FEW,
            'least': min(against), 'most': max(against),
            'worst': max(values[f'kalman {tenths(a)} manoeuvre'] for a in ACCELERATIONS),
            'fuzzy low': min(fuzzy), 'fuzzy high': max(fuzzy),
            **few_runs(errors, rng),
            'table': table(CLAIMS, values, bounds), 'all': all_filters(values),
            'errors': draw_errors(errors, folder / 'khachaturov_2002_errors.png'),
            'surface': draw_surface(folder / 'khachaturov_2002_surface.png'),
        }
    )  # fmt: skip


def main() -> None:
    """Print and write the report."""
    write_report(
        'Table of [KHACH02] on scenario K-0.',
        'khachaturov_2002',
        2000,
        partial(describe, quiet=False),
    )


if __name__ == '__main__':
    main()
