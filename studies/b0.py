# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do interacting alpha-beta filters of [BAKULEV] do on scenario B-0? Runs and figures.

An aircraft at 100 m/s, 10 km away, turns by 90 degrees in 36 s; 101 contacts 6 s apart.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from studies.figures import Figures, rms
from studies.passes import measure, Measured, run
from tracking_core.batches import Floats, Ints, Mixture
from tracking_core.composition import Plane
from tracking_core.estimators import AdaptiveAlphaBeta, Estimator, ImmAlphaBeta

PERIOD = 6.0  # [s]
CONTACTS = 101
SD = np.array([100.0, np.deg2rad(0.25)])  # [m], [rad]
SEED = 20100601
ALPHA = (0.3, 0.7)
TURN = (50, 55)  # first and last step that accelerates
ONSET = TURN[0]  # last contact before the turn shows
_K = np.arange(CONTACTS)
SPANS = {
    'manoeuvre': (_K >= 51) & (_K <= 60),
    'quiet': (_K >= 15) & ((_K < 51) | (_K > 70)),
    'all': _K >= 1,
}
FILTERS: dict[str, Callable[[], Estimator]] = {
    'recursion': lambda: ImmAlphaBeta(ALPHA, 2, 'recursion'),
    'steady_state': lambda: ImmAlphaBeta(ALPHA, 2, 'steady_state'),
    'locked': lambda: AdaptiveAlphaBeta(ALPHA, 2, 'recursion'),
    'restartable': lambda: AdaptiveAlphaBeta(ALPHA, 2, 'recursion', restartable=True),
}


@dataclass(frozen=True)
class Record:
    """Errors of one filter: K contacts, T runs."""

    position: Floats  # (K, T) distance [m]
    velocity: Floats  # (K, T) [m/s]
    raised: Floats  # (K, T) probability of the second mode


def truth() -> Floats:
    """Return x, vx, y, vy (K, 4) of the aircraft."""
    state, states = np.array([-10_000.0, 100.0, 5_000.0, 0.0]), []
    F = np.kron(np.eye(2), [[1.0, PERIOD], [0.0, 1.0]])
    B = np.array([0.5 * PERIOD**2, PERIOD, 0.5 * PERIOD**2, PERIOD])
    for k in range(CONTACTS):
        states.append(state)
        state = F @ state - B * 2.775 * (TURN[0] <= k <= TURN[1])
    return np.array(states)


def scene(runs: int) -> tuple[Measured, Floats, Floats]:
    """Return plots with diagonal R, start means (T, 4) and their covariances (T, 4, 4)."""
    rng, path = np.random.default_rng(SEED), truth()
    measured = measure(path[:, 0::2], SD, rng.standard_normal((runs, CONTACTS, 2)))
    variance = np.einsum('ktdd->ktd', measured.covariance)  # the paper gives no covariance
    measured = Measured(measured.position, variance[..., None] * np.eye(2))
    spread = np.zeros((runs, 4))
    spread[:, 0::2], spread[:, 1::2] = variance[0], 2.0 * variance[0] / PERIOD**2
    mean = path[0] + np.sqrt(spread) * rng.standard_normal((runs, 4))
    return measured, mean, spread[..., None] * np.eye(4)


def play(estimator: Estimator, runs: int, quiet: bool = True) -> Record:
    """Run one filter over B-0, all runs as one batch."""
    measured, mean, covariance = scene(runs)
    start = estimator.start(mean, covariance)
    steps = run([Plane(estimator, (0, 1))], measured, PERIOD, quiet, [start])[0]
    states = [start, *(step.updated for step in steps)]
    error = np.stack([m.moments()[0] for m in states]) - truth()[:, None]
    return Record(
        position=np.hypot(error[..., 0], error[..., 2]),
        velocity=np.hypot(error[..., 1], error[..., 3]),
        raised=np.stack([_raised(m) for m in states]),
    )


def figures(records: dict[str, Record], runs: Ints) -> Figures:
    """Return all figures, by name, from these runs."""
    result: dict[str, float] = {}
    for name, record in records.items():
        for span, rows in SPANS.items():
            result[f'{name} {span} position'] = rms(record.position[rows][:, runs])
            result[f'{name} {span} velocity'] = rms(record.velocity[rows][:, runs])
        result[f'{name} onset'] = _onset(record.raised[:, runs])
    for name in records:
        for span in SPANS:
            own, base = (result[f'{x} {span} position'] for x in (name, 'locked'))
            result[f'{name} {span} ratio'] = own / base
    return result


def plot_error(runs: int) -> float:
    """Return the error of the plots themselves in the manoeuvre [m]."""
    measured, _, _ = scene(runs)
    error = measured.position - truth()[:, None, 0::2]
    return rms(np.hypot(error[..., 0], error[..., 1])[SPANS['manoeuvre']])


def _raised(mixture: Mixture) -> Floats:
    return mixture.mode_probability[:, 1]


def _onset(raised: Floats) -> float:
    """Return contacts from the last quiet one to the decision, mean over runs (K, T)."""
    after = raised[ONSET + 1 :] > 0.5
    late = np.argmax(after, axis=0) + 1.0
    return float(np.nanmean(np.where(after.any(axis=0), late, np.nan)))
