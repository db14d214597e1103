# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do the filters of [KHACH02] do on scenario K-0? Runs and figures.

One coordinate; a contact accelerates by a g over ten looks, 5 s apart.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from tqdm import tqdm

from studies.cv_ca import cv_ca
from studies.figures import Figures, rms
from tracking_core.batches import Association, Floats, Ints, Measurement
from tracking_core.estimators import AlphaBeta, Estimator, FuzzyAlphaBeta, ImmAlphaBeta, TwoPoint

PERIOD, STEPS, SD, ALPHA = 5.0, 36, 100.0, 0.6  # [s], looks, [m]
ACCELERATIONS = (0.3, 0.5, 1.0, 1.5)  # [g]
GRAVITY = 9.80665  # [m/s^2]
BEGIN, END = 10, 20  # steps
SPANS = {'manoeuvre': slice(12, 21), 'after': slice(22, 30)}
STATIONARY = slice(20, 36)  # of a path without manoeuvre
SEED = 20020101
GAINS = (ALPHA, 0.7)
FILTERS: dict[str, Callable[[], Estimator]] = {
    'fuzzy': lambda: FuzzyAlphaBeta(GAINS, 1),
    'two_point': lambda: TwoPoint(GAINS, 1),
    'alpha_beta': lambda: AlphaBeta(ALPHA, 1),
    'imm_alpha_beta': lambda: ImmAlphaBeta((0.3, 0.7), 1),
    'kalman': cv_ca,
}
Errors = dict[tuple[str, float], Floats]  # filter, a: (steps, T) in plot sd


def truth(a: float) -> Floats:
    """Return the position (K,) [m] of a contact that accelerates by a g."""
    since = PERIOD * (np.arange(STEPS) - BEGIN)
    span = PERIOD * (END - BEGIN)
    pushed, after = np.clip(since, 0.0, span), np.maximum(since - span, 0.0)
    return np.asarray(a * GRAVITY * (0.5 * pushed**2 + span * after))


def play(runs: int, quiet: bool = True) -> tuple[Errors, Floats]:
    """Return errors of all filters and accelerations (0 too), and quiet innovations (K, T)."""
    noise = np.random.default_rng(SEED).standard_normal((STEPS, runs))
    cases = [(name, a) for name in FILTERS for a in (0.0, *ACCELERATIONS)]
    errors, innovations = {}, np.zeros(0)
    for name, a in tqdm(cases, desc='filters', disable=quiet, leave=False):
        path = truth(a)[:, None]
        position, innovation = follow(FILTERS[name](), path + SD * noise)
        errors[name, a] = (position - path) / SD
        if name == 'alpha_beta' and a == 0.0:
            innovations = innovation / SD
    return errors, innovations


def follow(estimator: Estimator, plots: Floats) -> tuple[Floats, Floats]:
    """Return smoothed positions and innovations (K, T) of plots (K, T), two-point start."""
    K, T = plots.shape
    velocity = (plots[1] - plots[0]) / PERIOD
    P = SD**2 * np.array([[1.0, 1.0 / PERIOD], [1.0 / PERIOD, 2.0 / PERIOD**2]])
    now = estimator.start(np.stack([plots[1], velocity], axis=1), np.tile(P, (T, 1, 1)))
    n, track, R = now.mean.shape[2], np.arange(T), np.full((T, 1, 1), SD**2)
    H = np.broadcast_to(np.eye(n)[:1], (T, 1, n))
    sure = Association(np.ones(T), np.zeros(T), np.zeros(T, bool))
    positions, innovations = [plots[0], plots[1]], [np.full(T, np.nan)] * 2
    for k in range(2, K):
        now = estimator.predict(now, np.full(T, PERIOD))
        plot = Measurement(plots[k][:, None], H, R, np.zeros(T, np.int64))
        seen = estimator.innovate(now, track, plot)
        now = estimator.update(now, track, seen, sure)
        positions.append(now.moments()[0][:, 0])
        innovations.append(seen.innovation[:, 0, 0])
    return np.stack(positions), np.stack(innovations)


def tenths(a: float) -> str:
    """Return an acceleration in tenths of g: names of figures have no dots."""
    return f'{10.0 * a:.0f}'


def figures(errors: Errors, innovations: Floats, runs: Ints) -> Figures:
    """Return all figures, by name, from these runs."""
    result = {
        'stationary error': rms(errors['alpha_beta', 0.0][STATIONARY][:, runs]),
        'stationary innovation': rms(innovations[STATIONARY][:, runs]),
    }
    for (name, a), error in errors.items():
        for span, rows in SPANS.items():
            result[f'{name} {tenths(a)} {span}'] = rms(error[rows][:, runs])
    for a in ACCELERATIONS:
        for span in SPANS:
            g = tenths(a)
            base = result[f'two_point {g} {span}']
            for name in ('fuzzy', 'kalman'):
                result[f'{name} gain {g} {span}'] = 1.0 - result[f'{name} {g} {span}'] / base
    return result
