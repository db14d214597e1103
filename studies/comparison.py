# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does one estimator follow the runs of a course: errors, onset, NEES, cost?"""

from __future__ import annotations

from dataclasses import dataclass, replace
from time import process_time
from typing import Any

import numpy as np

from radar_tracker.build import build_planes
from radar_tracker.config import RadarTrackerConfig
from studies.courses import Course
from studies.figures import rms
from studies.passes import run, Step
from tracking_core.batches import Bools, Floats
from tracking_core.composition import Plane
from tracking_core.config import with_values
from tracking_core.estimators import ESTIMATORS

# Every estimator has the gains of its paper.
PAPER_GAINS = {
    'imm_alpha_beta': [0.3, 0.7], 'adaptive_alpha_beta': [0.3, 0.7],
    'fuzzy_alpha_beta': [0.6, 0.7], 'two_point': [0.6, 0.7], 'alpha_beta': [0.6],
}  # fmt: skip
VARIANTS: dict[str, dict[str, Any]] = {
    'imm_alpha_beta, recursion': {
        'estimator': 'imm_alpha_beta', 'alpha_beta.covariance': 'recursion',
    },
    'adaptive_alpha_beta, restartable': {
        'estimator': 'adaptive_alpha_beta', 'alpha_beta.adaptive.restartable': True,
    },
}  # fmt: skip
ROWS = {**{name: {'estimator': name} for name in ESTIMATORS}, **VARIANTS}
JOINT = 'markov_jump_joint'


@dataclass(frozen=True)
class Row:
    """What one estimator did on one course."""

    position: dict[str, float]  # by phase, in plot errors
    velocity: dict[str, float]  # by phase [m/s]
    nees: dict[str, float]  # by phase, per component
    onset: float  # contacts
    found: float  # share
    cost: float  # of a track and look [us]


def planes_of(name: str, course: Course) -> tuple[Plane, ...]:
    """Return the filters of a course as the radar tracker would build them."""
    choice = ROWS[name]
    gains = PAPER_GAINS.get(choice['estimator'])
    given = {'alpha_beta.alpha': gains} if gains else {}
    config = with_values(RadarTrackerConfig(), {**course.parameters, **given, **choice})
    d = course.position.shape[1]
    if d > 1:
        return build_planes(config, d)
    vertical = build_planes(config, 3)[-1]
    return (replace(vertical, coordinates=(0,)),)


def follow(name: str, course: Course) -> Row:
    """Run one estimator over one course."""
    planes = planes_of(name, course)
    begin = process_time()
    steps = run(planes, course.measured, course.period)
    spent = process_time() - begin
    errors = _errors(planes, steps, course)
    plot = course.measured.position - course.position[:, None]
    phases = {'straight': course.straight, 'turning': course.turning, 'after': course.after}
    onset, found = _onset(steps[0], course)
    K, T = plot.shape[:2]
    return Row(
        {p: rms(errors.position[r[2:]]) / rms(plot[r]) for p, r in phases.items()},
        {p: rms(errors.velocity[r[2:]]) for p, r in phases.items()},
        {p: float(errors.nees[r[2:]].mean()) for p, r in phases.items()},
        onset, found, 1e6 * spent / (K * T),
    )  # fmt: skip


@dataclass(frozen=True)
class _Errors:
    position: Floats  # (K - 2, T, d)
    velocity: Floats
    nees: Floats  # (K - 2, T)


def _errors(planes: tuple[Plane, ...], steps: list[list[Step]], course: Course) -> _Errors:
    d = course.position.shape[1]
    K, T = len(steps[0]), course.measured.position.shape[1]
    position, velocity, nees = np.empty((K, T, d)), np.empty((K, T, d)), np.zeros((K, T))
    for plane, series in zip(planes, steps, strict=True):
        at = list(plane.coordinates)
        truth = np.stack([course.position[2:, at], course.velocity[2:, at]], axis=2)
        for k, step in enumerate(series):
            mean, P = step.updated.moments()
            error = mean - truth[k].ravel()
            position[k][:, at], velocity[k][:, at] = error[:, 0::2], error[:, 1::2]
            nees[k] += (error * np.linalg.solve(P, error[..., None])[..., 0]).sum(axis=1)
    return _Errors(position, velocity, nees / (2.0 * d))


def _onset(steps: list[Step], course: Course, patience: int = 8) -> tuple[float, float]:
    """Return mean contacts until the first plane decides for its second mode; share found."""
    probability = np.stack([step.updated.mode_probability for step in steps])
    if probability.shape[2] == 1:
        return float('nan'), float('nan')
    quiet = probability.shape[2] // 2  # pairs of modes: the first half has the quiet first mode
    busy: Bools = probability[..., quiet:].sum(axis=2) > 0.5
    delays = []
    for time in course.onsets:
        first = round(time / course.period) + 1 - 2
        window = busy[first : first + patience]
        delays.append(np.where(window.any(axis=0), np.argmax(window, axis=0) + 1.0, np.nan))
    late = np.concatenate(delays)
    found = float(np.isfinite(late).mean())
    return (float(np.nanmean(late)) if found else float('nan')), found
