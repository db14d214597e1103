# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far are plots off the line of the two before? The noise of all three shows in it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.rows import concatenate, take
from tracking_core.space import Space

_EVEN = 1.5  # times as long as the other one, a step may be
REMEMBERED = 300  # bends
_FEWEST, _FEWEST_TRACKS = 100, 3  # bends, and tracks that they are of, which tell what is usual
_MEDIAN = 0.6745  # of |x|, x a standard Gaussian
BELIEVED = 1.5  # times as far as told, noise is as told: contacts turn, and few bends tell little
_MOST = 30.0


@dataclass(frozen=True)
class Followed:
    """Plots that are surely of tracks, and others."""

    id: Ints  # (N,) of the track; below 0: of a chain, 0: of nobody known
    time: Floats  # (N,) [s]
    position: Floats  # (N, d)
    covariance: Floats  # (N, d, d)
    sensor: Floats  # (N, 3) place of the sensor [m]

    @staticmethod
    def none(d: int) -> Followed:
        """Return no plots, with d coordinates."""
        none = np.zeros(0)
        ids = none.astype(np.int64)
        return Followed(ids, none, np.zeros((0, d)), np.zeros((0, d, d)), np.zeros((0, 3)))


@dataclass(frozen=True)
class Bends:
    """How far plots were off the lines of the two before."""

    track: Ints  # (K,) id, below 0: of chains
    size: Floats  # (K, d) in sds of that by the noise that the three tell; along, to the left, up

    def and_then(self, found: Bends) -> Bends:
        """Return both, of many only the last ones, and of these only some."""
        own = _last(self.some(self.track > 0), found.some(found.track > 0))
        loose = _last(self.some(self.track < 0), found.some(found.track < 0))
        return own if own.is_of_tracks else concatenate(loose, own)

    def some(self, rows: Bools) -> Bends:
        """Return these of them."""
        return Bends(self.track[rows], self.size[rows])

    @cached_property
    def is_of_tracks(self) -> bool:
        """Whether there are enough of tracks."""
        return self._tell(self.track > 0)

    @cached_property
    def are_enough(self) -> bool:
        """Whether they tell anything."""
        return self.is_of_tracks or self._tell(self.track < 0)

    @cached_property
    def ratio(self) -> Floats:
        """
        Return how large the noise is over what is told, by axis (d,); NaN where not known yet.

        Along the line of sight, across to the left and, if there is height, up.
        """
        some = self.track > 0 if self.is_of_tracks else self.track < 0
        if not self._tell(some):
            return np.full(self.size.shape[1], np.nan)
        return np.asarray(np.median(np.abs(self.size[some]), axis=0) / _MEDIAN)

    def _tell(self, some: Bools) -> bool:
        track = self.track[some]
        return len(track) >= _FEWEST and len(np.unique(track)) >= _FEWEST_TRACKS

    @cached_property
    def raised(self) -> tuple[float, float, float]:
        """By what told sds are to be multiplied on each axis: never less than 1."""
        factor = np.where(self.ratio > BELIEVED, np.minimum(self.ratio, _MOST), 1.0)
        along, left, up = [*factor.tolist(), 1.0, 1.0][:3]
        return along, left, up


def _last(known: Bends, found: Bends) -> Bends:
    some = take(found, slice(None, None, 1 + len(found.track) // REMEMBERED))
    return take(concatenate(known, some), slice(-REMEMBERED, None))


def bends_of(plots: Followed, since: float, raised: Floats, space: Space) -> Bends:
    """Return how far plots since then [s], in even steps with two others, are off their line."""
    plots = take(plots, np.lexsort((plots.time, plots.id)))
    steps = np.diff(plots.time)
    first, second = steps[:-1], steps[1:]
    even = (first > 0.0) & (second < _EVEN * first) & (first < _EVEN * second)
    k = np.flatnonzero(even & (plots.id[2:] == plots.id[:-2]) & (plots.time[2:] > since))
    z, R, stretch = plots.position, plots.covariance, (second[k] / first[k])[:, None]
    off = space.shortest(z[k + 2] - z[k + 1]) - stretch * space.shortest(z[k + 1] - z[k])
    share = stretch[:, None] ** 2, (1.0 + stretch[:, None]) ** 2
    noise = share[0] * R[k] + share[1] * R[k + 1] + R[k + 2]
    axes = _axes(z[k + 1], plots.sensor[k + 2])
    variance = np.einsum('kad,kde,kae->ka', axes, noise, axes)
    size = np.einsum('kad,kd->ka', axes, off) / np.sqrt(variance)
    return Bends(plots.id[k], size * raised[: size.shape[1]])


def _axes(position: Floats, sensor: Floats) -> Floats:
    """Return unit vectors (K, a, d) along the line of sight, to its left and up; 1 of angles."""
    K, d = position.shape
    axes = np.ones((K, d, d))
    if d == 1:
        return axes
    line = position - sensor[:, :d]
    ground = np.maximum(np.hypot(line[:, 0], line[:, 1]), np.finfo(float).tiny)
    cos, sin = line[:, 0] / ground, line[:, 1] / ground
    height = line[:, 2] if d == 3 else np.zeros(K)
    distance = np.hypot(ground, height)
    ce, se = ground / distance, height / distance
    along = np.stack([ce * cos, ce * sin, se], axis=1)
    left = np.stack([-sin, cos, np.zeros(K)], axis=1)
    up = np.stack([-se * cos, -se * sin, ce], axis=1)
    return np.stack([along, left, up], axis=1)[:, :d, :d]
