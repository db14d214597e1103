# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Does the whole marine tracker keep ships that are seldom seen, and ships that pass closely?"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from tqdm import tqdm

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from studies.marine_scenes import DEGREE, GYRO, KNOT, MILE, PERIOD, radar_errors
from tracking_core.batches import Bools, Floats, Ints, Plots

TWO_PI = 2.0 * np.pi
WINDOW, HITS = 10, 5  # scans, and how many of them show a ship
SETTLED, WATCHED = 24, 240  # scans with every ship seen, scans by the pattern
CELL = np.array([40.0, 1.0 * DEGREE])  # m and rad: nearer ships give one plot
ALONE = np.zeros(2)
NEAR = 150.0  # m between a track and the ship that it is of
PAIRS, DISTANCE = 12, 4.0 * MILE  # that pass in one scene, where
BEFORE, AFTER = 96, 96  # scans before and after the closest approach
PASSINGS = {  # courses [deg] and speeds [kn] of two ships
    'opposite': ((0.0, 180.0), (10.0, 10.0)),
    'crossing': ((0.0, 90.0), (10.0, 10.0)),
    'overtaking': ((0.0, 0.0), (10.0, 12.0)),
}


@dataclass(frozen=True)
class Ships:
    """K ships that hold their courses, seen by a radar that stands at the origin."""

    position: Floats  # (K, 2) at time 0 [m]
    velocity: Floats  # (K, 2) [m/s]

    def at(self, time: Floats | float) -> Floats:
        """Return the positions (K, 2) at a time, or at one for each ship [s]."""
        return self.position + self.velocity * np.reshape(time, (-1, 1))


def turn_of(ships: Ships, scan: int, seen: Bools, cell: Floats, rng: np.random.Generator) -> Plots:
    """
    Return the plots of one antenna turn, each when the antenna points there.

    Neighbouring rows are pairs; nearer to each other than the cell [m, rad] they give one plot.
    """
    start = time = scan * PERIOD
    for _ in range(2):
        x, y = ships.at(time).T
        time = start + (np.arctan2(y, x) % TWO_PI) / TWO_PI * PERIOD
    noise = radar_errors(len(x), rng)
    distance = np.hypot(x, y) + noise[0]
    azimuth = np.arctan2(y, x) + noise[1] + rng.normal(0.0, GYRO, len(x))
    distance, azimuth, hidden = _merge(distance, azimuth, seen, cell)
    rows = np.flatnonzero(seen & ~hidden)
    rows = rows[np.argsort(time[rows])]
    return replace(Plots.polar(time[rows], distance[rows], azimuth[rows]), stamp=start)


def _merge(
    distance: Floats, azimuth: Floats, seen: Bools, cell: Floats
) -> tuple[Floats, Floats, Bools]:
    """Return range and azimuth with one plot midway for pairs in one cell, and whom it hides."""
    polar = np.stack([distance, azimuth], axis=1).reshape(-1, 2, 2)  # (pair, ship, coordinate)
    near = (np.abs(polar[:, 1] - polar[:, 0]) < cell).all(axis=1)
    one = near & seen.reshape(-1, 2).all(axis=1)
    polar[one] = polar[one].mean(axis=1, keepdims=True)
    hidden = np.stack([np.zeros_like(one), one], axis=1).ravel()
    return polar[..., 0].ravel(), polar[..., 1].ravel(), hidden


def ids_of(tracker: RadarTracker, ships: Ships) -> Ints:
    """Return the id of the nearest confirmed track (K,) of each ship, 0 if none is near."""
    tracks = tracker.tracks
    rows = np.flatnonzero(tracks.confirmed)
    if len(rows) == 0:
        return np.zeros(len(ships.position), np.int64)
    state = tracks.planes[0].moments()[0][rows]
    where = np.stack([ships.at(time) for time in tracks.time[rows]])  # (R, K, 2)
    distance = np.linalg.norm(where - state[:, None, 0::2], axis=2)
    nearest = np.argmin(distance, axis=0)
    return np.where(distance.min(axis=0) < NEAR, tracks.id[rows][nearest], 0)


def seldom_seen(config: RadarTrackerConfig, twice: int = 2, quiet: bool = True) -> Floats:
    """
    Return for every pattern of 5 looks in 10, again and again, whether its ships kept their ids.

    Returns
    -------
    (252, twice) array
        1: kept. All ships are in one scene; in any ten looks in a row each is seen five times.

    """
    rng = np.random.default_rng(7)
    patterns = np.zeros((252, WINDOW), bool)
    for row, looks in enumerate(combinations(range(WINDOW), HITS)):
        patterns[row, list(looks)] = True
    patterns = np.repeat(patterns, twice, axis=0)
    K = len(patterns)
    spiral = np.arange(K) + 0.5
    radius = 12.0 * MILE * np.sqrt(0.02 + 0.98 * spiral / K)
    angle = spiral * np.pi * (3.0 - np.sqrt(5.0))  # sunflower: everywhere as far apart
    places = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    ships = Ships(places, np.tile([0.0, 10.0 * KNOT], (K, 1)))
    tracker, before = RadarTracker(config), np.zeros(K, np.int64)
    for scan in tqdm(range(SETTLED + WATCHED), desc='5 of 10', disable=quiet, leave=False):
        seen = patterns[:, scan % WINDOW] | (scan < SETTLED)
        tracker.track(turn_of(ships, scan, seen, ALONE, rng))
        if scan == SETTLED:
            before = ids_of(tracker, ships)
    kept = (ids_of(tracker, ships) == before) & (before > 0)
    return kept.reshape(-1, twice).astype(np.float64)


def passing(
    config: RadarTrackerConfig,
    kind: str,
    apart: float,
    scenes: int,
    coarseness: float = 1.0,
    seed: int = 11,
) -> dict[str, float]:
    """
    Return the shares of pairs that swapped ids, that lost one, and how many pairs passed.

    Parameters
    ----------
    config : RadarTrackerConfig
        Of the tracker.
    kind : str
        One of `PASSINGS`.
    apart : float
        Distance at the closest approach [m].
    scenes : int
        Of `PAIRS` pairs each, all around the radar and each turned at random.
    coarseness : float
        Size of the cell in which ships give one plot, in units of `CELL`.
    seed : int
        Of the random numbers.

    """
    rng, swapped, lost = np.random.default_rng(seed), 0, 0
    courses, speeds = PASSINGS[kind]
    for _ in range(scenes):
        ships = _pairs(np.array(courses) * DEGREE, np.array(speeds) * KNOT, apart, rng)
        tracker, before = RadarTracker(config), np.zeros(2 * PAIRS, np.int64)
        for scan in range(BEFORE + AFTER):
            seen = rng.random(2 * PAIRS) < config.sensor.detection_probability
            tracker.track(turn_of(ships, scan, seen, coarseness * CELL, rng))
            if scan == BEFORE // 2:
                before = ids_of(tracker, ships)
        pairs, after = before.reshape(-1, 2), ids_of(tracker, ships).reshape(-1, 2)
        swap = ((after == pairs[:, ::-1]) & (pairs > 0)).any(axis=1)
        swapped += int(swap.sum())
        lost += int(((after != pairs).any(axis=1) & ~swap).sum())
    total = scenes * PAIRS
    return {'swapped': swapped / total, 'lost': lost / total, 'pairs': float(total)}


def _pairs(courses: Floats, speeds: Floats, apart: float, rng: np.random.Generator) -> Ships:
    """Return pairs that are `apart` [m] at their closest, each its own way turned, all around."""
    velocity = speeds[:, None] * np.stack([np.sin(courses), np.cos(courses)], axis=1)
    across = velocity[1] - velocity[0]
    across = np.array([-across[1], across[0]]) / np.hypot(*across)
    offset = 0.5 * apart * np.stack([-across, across])
    start = offset - velocity * BEFORE * PERIOD
    angle = TWO_PI * (np.arange(PAIRS) + rng.random()) / PAIRS
    places = DISTANCE * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    turn = rng.uniform(0.0, TWO_PI, PAIRS)
    c, s = np.cos(turn), np.sin(turn)
    matrix = np.stack([np.stack([c, -s], 1), np.stack([s, c], 1)], 1)  # (PAIRS, 2, 2)
    position = places[:, None] + start @ np.swapaxes(matrix, 1, 2)
    moving = np.broadcast_to(velocity, (PAIRS, 2, 2)) @ np.swapaxes(matrix, 1, 2)
    return Ships(position.reshape(-1, 2), moving.reshape(-1, 2))
