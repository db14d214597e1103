# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far are course, speed and closest approach from the truth, and what is allowed?"""

from __future__ import annotations

import numpy as np
from scipy.stats import binom

from radar_tracker.build import build_planes
from radar_tracker.config import RadarTrackerConfig
from studies.marine_scenes import DEGREE, Encounter, KNOT, MILE, Paths, PERIOD, watch, Watched
from studies.passes import run
from tracking_core.batches import Floats
from tracking_core.linalg import wrap_angle

MINUTE = 24  # scans
QUANTITIES = (
    'relative course [deg]', 'relative speed [kn]', 'CPA [nmi]', 'TCPA [min]',
    'true course [deg]', 'true speed [kn]',
)  # fmt: skip
_NONE = float('nan')
# 95 % of the errors are to be below, after 1 and 3 minutes. Quoted from memory, not verified.
A823_LIMITS = {
    ('1', 1): (11.0, 2.8, 1.6, _NONE, _NONE, _NONE),
    ('2', 1): (7.0, 0.6, _NONE, _NONE, _NONE, _NONE),
    ('3', 1): (14.0, 2.2, 1.8, _NONE, _NONE, _NONE),
    ('4', 1): (15.0, 1.5, 2.0, _NONE, _NONE, _NONE),
    ('1', 3): (3.0, 0.8, 0.5, 1.0, 7.4, 1.2),
    ('2', 3): (2.3, 0.3, _NONE, _NONE, 2.8, 0.8),
    ('3', 3): (4.4, 0.9, 0.7, 1.0, 3.3, 1.0),
    ('4', 3): (4.6, 0.8, 0.7, 1.0, 2.6, 1.2),
}
_MSC192 = {
    1: (11.0, 1.5, 1.0, _NONE, _NONE, _NONE),
    3: (3.0, 0.8, 0.3, 0.5, 5.0, 0.5),
}
_SHARES = {1: 0.10, 3: 0.01}  # of the speed, where that is more


def msc192_limits(encounter: Encounter, minutes: int) -> Floats:
    """Return the limits (6,) of the later standard for the speeds of an encounter."""
    limits, share = np.array(_MSC192[minutes]), _SHARES[minutes]
    true = float(np.linalg.norm(encounter.paths(1).velocity[0])) / KNOT
    limits[1] = max(limits[1], share * encounter.relative_speed)
    limits[5] = np.maximum(limits[5], share * true)
    return limits


def follow(
    encounter: Encounter,
    scans: int,
    runs: int,
    config: RadarTrackerConfig,
    seed: int,
    rolling: bool = False,
) -> Floats:
    """Return the errors (K - 2, 6, T) of all runs from the third scan on."""
    watched = watch(encounter, scans, runs, config.sensor, np.random.default_rng(seed), rolling)
    (steps,) = run(build_planes(config, 2), watched.plots, PERIOD)
    paths = encounter.paths(scans)
    return np.stack([
        _errors(step.updated.moments()[0], watched, paths, k) for k, step in enumerate(steps, 2)
    ])  # fmt: skip


def _errors(state: Floats, watched: Watched, paths: Paths, k: int) -> Floats:
    """Return the errors (6, T) at scan k; own ship's velocity is that of the last minute."""
    since = max(k - MINUTE, 0)
    own_velocity = (watched.own[k] - watched.own[since]) / (PERIOD * (k - since))
    position, velocity = state[:, 0::2], state[:, 1::2]
    motion, distance, time = _encounter(position - watched.own[k], velocity - own_velocity)
    true = paths.velocity[k] - paths.own_velocity
    truth, nearest, instant = _encounter(paths.other[k] - paths.own[k], true)
    absolute, ground = _motion(velocity), _motion(paths.velocity[k])
    errors = [
        wrap_angle(motion[0] - truth[0]) / DEGREE, (motion[1] - truth[1]) / KNOT,
        (distance - nearest) / MILE, (time - instant) / 60.0,
        wrap_angle(absolute[0] - ground[0]) / DEGREE, (absolute[1] - ground[1]) / KNOT,
    ]  # fmt: skip
    return np.abs(errors)


def _motion(velocity: Floats) -> tuple[Floats, Floats]:
    """Return course [rad] and speed [m/s] of velocities (..., 2)."""
    course = np.arctan2(velocity[..., 0], velocity[..., 1])
    return course, np.asarray(np.linalg.norm(velocity, axis=-1))


def _encounter(position: Floats, velocity: Floats) -> tuple[tuple[Floats, Floats], Floats, Floats]:
    """Return relative motion, distance [m] and time to go [s] at the closest point of approach."""
    time = -(position * velocity).sum(axis=-1) / (velocity**2).sum(axis=-1)
    nearest = np.linalg.norm(position + time[..., None] * velocity, axis=-1)
    return _motion(velocity), np.asarray(nearest), time


def quantile(errors: Floats, share: float = 0.95) -> tuple[Floats, Floats, Floats]:
    """
    Return a quantile over the last axis with its 95 % interval.

    The interval is between order statistics, whatever the distribution of the errors.
    """
    ordered = np.sort(errors, axis=-1)
    n = errors.shape[-1]
    low, high = binom.ppf([0.025, 0.975], n, share).astype(np.int64)
    ends = ordered[..., max(low - 1, 0)], ordered[..., min(high, n - 1)]
    return np.quantile(errors, share, axis=-1), *ends
