# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How well is the range known on scenario V-0 of [VORONINA19]? Runs and figures.

Own ship and both objects as in Table 1, marks of 0.05 deg without misses; the own ship turns, or
an object does, or neither.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sonar_tracker.ranging import Ranging
from sonar_tracker.ranging_config import RangingConfig
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.linalg import wrap_angle

DEGREE, KNOT = np.pi / 180.0, 1852.0 / 3600.0  # [rad], [m/s]
PERIOD, DURATION, SD = 2.0, 1850.0, 0.05 * DEGREE  # [s], [s], [rad]
TURN_TIME, BEND = 900.0, 1300.0  # of the own ship, of an object [s]
OBJECTS = {'1': (117.0, 5000.0), '2': (109.0, 6000.0)}  # bearing [deg], range [m] at the start
OWN_SPEED, SPEED = 5.0 * KNOT, 10.0 * KNOT
FIT_EVERY = 25  # cycles
AFTER = (50.0, 100.0, 200.0, 500.0)  # the turn of an object [s]
WRONG = 0.2  # of the range
SEED = 20190301


@dataclass(frozen=True)
class Case:
    """What turns, and by how much, clockwise."""

    turn: float = 60.0  # own ship [deg]
    bend: float = 0.0  # both objects [deg]


@dataclass(frozen=True)
class Record:
    """C fits of N objects in R runs."""

    time: Floats  # (C,) [s]
    observable: Bools  # (C, N, R)
    error: Floats  # (C, N, R) of the range [m], NaN: not told
    sd: Floats  # (C, N, R) of the range, as told [m]
    nees: Floats  # (C, N, R)
    bound: Floats  # (C, N) Cramer and Rao [m]
    distance: Floats  # (C, N) [m]
    marks: int


def path(start: Floats, speed: float, time: Floats, turn_time: float, turn: float) -> Floats:
    """Return x, y, vx, vy (K, 4) of a ship that goes north and turns once, clockwise."""
    course = np.where(time < turn_time, 0.0, turn * DEGREE)
    velocity = speed * np.stack([np.sin(course), np.cos(course)], axis=1)
    before = np.minimum(time, turn_time)[:, None] * speed * np.array([0.0, 1.0])
    after = np.maximum(time - turn_time, 0.0)[:, None] * velocity
    return np.concatenate([start + before + after, velocity], axis=1)


def scene(case: Case) -> tuple[Floats, Floats, Floats]:
    """Return time (K,), own ship (K, 4) and objects (N, K, 4) as x, y, vx, vy."""
    time = np.arange(0.0, DURATION + 0.5 * PERIOD, PERIOD)
    own = path(np.zeros(2), OWN_SPEED, time, TURN_TIME, case.turn)
    objects = [
        path(distance * np.array([np.sin(b * DEGREE), np.cos(b * DEGREE)]),
             SPEED, time, BEND, case.bend)
        for b, distance in OBJECTS.values()
    ]  # fmt: skip
    return time, own, np.stack(objects)


def range_bound(time: Floats, line: Floats, sd: float = SD) -> float:
    """Return the bound of the range sd at the last time; line (K, 2) from own ship [m]."""
    square = (line**2).sum(axis=1, keepdims=True)
    across = np.stack([-line[:, 1], line[:, 0]], axis=1) / square
    slope = np.concatenate([across, across * (time - time[-1])[:, None]], axis=1) / sd
    covariance = np.linalg.pinv(slope.T @ slope, rcond=1e-14, hermitian=True)
    along = line[-1] / np.sqrt(square[-1])
    return float(np.sqrt(along @ covariance[:2, :2] @ along))


def play(case: Case, runs: int, config: RangingConfig | None = None) -> Record:
    """Return what is told in all runs, every `FIT_EVERY` cycles."""
    time, own, objects = scene(case)
    line = objects[..., :2] - own[:, :2]
    bearing = np.repeat(np.arctan2(line[..., 1], line[..., 0]), runs, axis=0)  # (N R, K)
    tracks, rng = len(bearing), np.random.default_rng(SEED)
    ids, weight = np.arange(tracks), np.full(tracks, SD**-2)
    ranging, told, at = Ranging(config or RangingConfig()), [], []
    for k in range(len(time)):
        marks = wrap_angle(bearing[:, k] + SD * rng.standard_normal(tracks))
        now, here = np.full(tracks, time[k]), np.tile(own[k, :2], (tracks, 1))
        ranging.hear(ids, now, marks, weight, here)
        if k % FIT_EVERY == 0 and k:
            ranging.fit_rows(ids)
            told.append(ranging.at(ids, now, here))
            at.append(k)
    shape = (len(at), len(objects), runs)
    distance = np.hypot(line[:, at, 0], line[:, at, 1]).T
    off = np.stack([each.state for each in told]).reshape(*shape, 4)
    off = off - objects[:, at].transpose(1, 0, 2)[:, :, None]
    P = np.stack([each.covariance for each in told]).reshape(*shape, 4, 4)
    return Record(
        time=time[at],
        observable=np.stack([each.observable for each in told]).reshape(shape),
        error=np.stack([each.range for each in told]).reshape(shape) - distance[..., None],
        sd=np.stack([each.range_sd for each in told]).reshape(shape),
        nees=np.einsum('cnra,cnra->cnr', off, np.linalg.solve(P, off[..., None])[..., 0]),
        bound=np.array([[range_bound(time[: k + 1], one[: k + 1]) for one in line] for k in at]),
        distance=distance,
        marks=len(time),
    )


def end_figures(record: Record, rows: Ints) -> dict[str, float]:
    """Return the figures at the end, by name, from these runs."""
    result = {'observable': float(record.observable[-1][:, rows].mean())}
    error, sd, nees = record.error[-1][:, rows], record.sd[-1][:, rows], record.nees[-1][:, rows]
    for n, name in enumerate(OBJECTS):
        known = np.isfinite(error[n])
        rms = float(np.sqrt(np.mean(error[n][known] ** 2))) if known.any() else np.nan
        bound = float(record.bound[-1, n])
        result |= {f'{name} bound': bound, f'{name} rms': rms, f'{name} ratio': rms / bound}
        result[f'{name} told'] = float(sd[n][known].mean()) if known.any() else np.nan
    known = np.isfinite(nees)
    result['nees'] = float(nees[known].mean()) if known.any() else np.nan
    return result


def sudden_figures(record: Record) -> tuple[list[float], list[float]]:
    """Return shares of runs that tell a range and that tell a wrong one, `AFTER` a bend."""
    at = [int(np.argmin(np.abs(record.time - BEND - after))) for after in AFTER]
    limit = WRONG * record.distance[..., None]
    wrong = np.abs(np.nan_to_num(record.error)) > limit
    return [float(record.observable[k].mean()) for k in at], [float(wrong[k].mean()) for k in at]
