# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is worth a closer look: the track that manoeuvres most, and the closest meeting."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter1d
from scipy.spatial import cKDTree

from msg_adapters.table import Columns
from tracking_core.batches import Bools, Floats
from tracking_tools.scene import choose, of_id, Scene, turn_rate

TURNING = float(np.radians(0.8))  # a turn that one sees on a map [rad/s]
SMOOTHING = 3  # looks over which a turn rate is averaged
FEWEST = 20  # looks that make a path worth looking at
HOLDING = 480.0  # what is shown of a holding [s]
MEETING = 70.0  # ... before and after a meeting [s]
NEAR = 3_000.0  # farther apart is no meeting [m]
FREE = 6_000.0  # around a label [m]
NAMED = 60  # tracks with a label at most
MANY = 20_000  # looks that labels are kept away from
NIGH = 10.0  # looks before and after a track in which its contact is looked for
PARALLEL = 0.35  # courses that differ less run side by side [rad]


@dataclass(frozen=True)
class Window:
    """A piece of plan and of time."""

    centre: tuple[float, float]  # [m]
    half: tuple[float, float]  # half widths [m]
    start: float  # [s]
    end: float  # [s]

    def shows(self, rows: Columns) -> Bools:
        """Return which rows are inside."""
        inside = np.abs(rows['x'] - self.centre[0]) <= self.half[0]
        inside &= np.abs(rows['y'] - self.centre[1]) <= self.half[1]
        return np.asarray(inside & (rows['time'] >= self.start) & (rows['time'] <= self.end))


def smooth_turn_rate(path: Columns) -> Floats:
    """Return the turn rate (M,) of a path averaged over a few looks [rad/s]."""
    return np.asarray(uniform_filter1d(turn_rate(path), SMOOTHING))


def find_turning(scene: Scene) -> int | None:
    """Return the track with most of both, turns and straight flight; None without tracks."""
    ids, looks = np.unique(scene.tracks.get('id', np.zeros(0)), return_counts=True)
    worth = ids[looks >= FEWEST]
    if not len(worth):
        return None
    scores = []
    for number in worth:
        path = true_path(scene, int(number))
        turning = np.abs(smooth_turn_rate(path)) > TURNING
        share = float(turning.mean())
        scores.append(min(share, 1.0 - share) * float(np.ptp(path['time'])))
    return int(worth[int(np.argmax(scores))])


def true_path(scene: Scene, number: int) -> Columns:
    """Return the path of the contact that a track was mostly on, its own without a truth."""
    own = of_id(scene.tracks, number)
    if not scene.has_truth or not len(own['time']):
        return own
    period = float(np.median(np.diff(own['time']))) or 1.0
    first, last = own['time'][0] - NIGH * period, own['time'][-1] + NIGH * period
    meanwhile = (scene.truth['time'] >= first) & (scene.truth['time'] <= last)
    truth = choose(scene.truth, meanwhile) if meanwhile.any() else scene.truth
    scale = np.array([NEAR, NEAR, period])
    _, nearest = cKDTree(_points(truth) / scale).query(_points(own) / scale)
    contacts, votes = np.unique(truth['id'][nearest], return_counts=True)
    return of_id(scene.truth, int(contacts[np.argmax(votes)]))


def holding_window(scene: Scene, number: int, shape: float) -> Window:
    """Return where a track turned most within some minutes; `shape` is width over height."""
    own = of_id(scene.tracks, number)
    path = true_path(scene, number)
    time, turned = path['time'], np.cumsum(np.abs(smooth_turn_rate(path)))
    last = np.searchsorted(time, time + HOLDING) - 1
    first = int(np.argmax(turned[last] - turned))
    start, end = float(time[first]), float(time[last[first]])
    part = choose(own, (own['time'] >= start) & (own['time'] <= end))
    return _around(part if len(part['time']) else own, start, end, shape)


def find_meeting(scene: Scene, shape: float, but: Window) -> Window | None:
    """Return where two tracks met closest on courses that cross, outside another window."""
    rows = choose(scene.tracks, ~but.shows(scene.tracks))
    if len(rows['time']) < FEWEST:
        return None
    period = float(np.median(np.diff(of_id(rows, int(rows['id'][0]))['time'])))
    places = _points(rows) / np.array([NEAR, NEAR, 0.6 * period])
    pairs = cKDTree(places).query_pairs(1.0, output_type='ndarray')
    one, other = choose(rows, pairs[:, 0]), choose(rows, pairs[:, 1])
    between = np.abs(np.angle(np.exp(1j * (one['course'] - other['course']))))
    crossing = (one['id'] != other['id']) & (between > PARALLEL)
    if not crossing.any():
        return None
    apart = np.hypot(one['x'] - other['x'], one['y'] - other['y'])
    best = int(np.argmin(np.where(crossing, apart, np.inf)))
    ids, time = (one['id'][best], other['id'][best]), float(one['time'][best])
    start, end = time - MEETING, time + MEETING
    near = np.isin(scene.tracks['id'], ids) & (np.abs(scene.tracks['time'] - time) <= MEETING)
    return _around(choose(scene.tracks, near), start, end, shape)


def place_labels(tracks: Columns) -> dict[int, tuple[float, float]]:
    """Return places on the longest tracks (x, y) [m], away from other tracks and labels."""
    places: dict[int, tuple[float, float]] = {}
    ids, looks = np.unique(tracks.get('id', np.zeros(0)), return_counts=True)
    sparse = choose(tracks, slice(None, None, max(1, len(tracks.get('id', ())) // MANY)))
    for number in np.sort(ids[np.argsort(-looks, kind='stable')[:NAMED]]):
        others = choose(sparse, sparse['id'] != number)
        path = _flat(of_id(tracks, int(number)))[:: max(1, SMOOTHING)]
        taken = np.array([*places.values()]).reshape(-1, 2)
        room = _room(path, _flat(others), FREE) + _room(path, taken, 3.0 * FREE)
        x, y = path[int(np.argmax(room))]
        places[int(number)] = (float(x), float(y))
    return places


def _room(path: Floats, others: Floats, most: float) -> Floats:
    """Return how far the others are from each point, as far as it matters."""
    if not len(others):
        return np.full(len(path), most)
    apart: Floats = cKDTree(others).query(path)[0]
    return np.minimum(apart, most)


def _flat(rows: Columns) -> Floats:
    return np.stack([rows['x'], rows['y']], axis=1).astype(np.float64)


def _points(rows: Columns) -> Floats:
    return np.stack([rows['x'], rows['y'], rows['time']], axis=1)


def _around(rows: Columns, start: float, end: float, shape: float) -> Window:
    low = np.array([rows['x'].min(), rows['y'].min()], np.float64)
    high = np.array([rows['x'].max(), rows['y'].max()], np.float64)
    beside = min(500.0, 0.1 * float((high - low).max()) + 1.0)
    centre, half = (low + high) / 2.0, (high - low) / 2.0 * 1.12 + beside
    tall = max(half[1], half[0] / shape)
    return Window((float(centre[0]), float(centre[1])), (tall * shape, tall), start, end)
