# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How far are plots of contacts scattered, beside what they tell?

Three plots of a contact in even steps lie on a line but for their noise, whatever the filter
thinks of them: how far the third is off the line of the first two is the noise itself. Contacts
that turn are off it, too, so it is the usual that counts, of several contacts.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.batches import Floats, Ints, Scan
from tracking_core.rows import change, concatenate, take
from tracking_core.space import Space

_LOOKS = 5  # are learnt from at a time
_BEFORE = 4.5  # looks before these, from which their lines may begin
_EVEN = 1.5  # times as long as the other one, a step may be
_MOST_TRACKS = 100  # are followed a message, the oldest ones
_MOST_PLOTS = 3000  # of them all
_REMEMBERED = 300  # bends
_REST, _LONGEST = 3.0, 300.0  # times as long as it learnt it rests, at most so long [s]
_FEWEST, _FEWEST_TRACKS = 100, 3  # bends, and tracks that they are of, which tell what is usual
_MEDIAN = 0.6745  # of |x|, x a standard Gaussian
BELIEVED = 1.5  # times as far as told, noise is as told: contacts turn, and few bends tell little
_MOST = 30.0


@dataclass(frozen=True)
class Followed:
    """Plots that are surely of tracks."""

    id: Ints  # (N,) of the track
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

    track: Ints  # (K,) id
    size: Floats  # (K, d) in sds of that by the noise that the three tell; along, to the left, up

    def and_then(self, found: Bends) -> Bends:
        """Return both, of many only the last ones, and of these only some."""
        some = take(found, slice(None, None, 1 + len(found.track) // _REMEMBERED))
        return take(concatenate(self, some), slice(-_REMEMBERED, None))

    @cached_property
    def ratio(self) -> Floats:
        """
        Return how large the noise is over what is told, by axis (d,); NaN where not known yet.

        Along the line of sight, across to the left and, if there is height, up.
        """
        size = np.abs(self.size)
        if len(size) < _FEWEST or len(np.unique(self.track)) < _FEWEST_TRACKS:
            return np.full(size.shape[1], np.nan)
        return np.asarray(np.median(size, axis=0) / _MEDIAN)

    @cached_property
    def raised(self) -> tuple[float, float, float]:
        """By what told sds are to be multiplied on each axis: never less than 1."""
        factor = np.where(self.ratio > BELIEVED, np.minimum(self.ratio, _MOST), 1.0)
        along, left, up = [*factor.tolist(), 1.0, 1.0][:3]
        return along, left, up


@dataclass(frozen=True)
class Scatter:
    """What has been learnt of the noise of plots."""

    followed: Followed
    bends: Bends
    began: float = -np.inf  # to follow tracks [s]
    until: float = -np.inf  # it rests: noise seldom changes [s]

    @staticmethod
    def none(d: int) -> Scatter:
        """Return what is known of plots with d coordinates before any came."""
        return Scatter(Followed.none(d), Bends(np.zeros(0, np.int64), np.zeros((0, d))))

    def learn(self, owner: Ints, scan: Scan, interval: float, space: Space) -> Scatter:
        """
        Return what is known after one more scan.

        Parameters
        ----------
        owner : (M,) array
            Id of the track that a plot is surely of, 0: of none.
        scan : Scan
            M plots.
        interval : float
            From one look at a track to the next [s].
        space : Space
            Where plots are.

        """
        end = scan.coverage.end_time
        if end < self.until:
            return self
        (plot,) = ((owner > 0) & np.isfinite(scan.position).all(axis=1)).nonzero()
        if len(plot) > _MOST_TRACKS:
            plot = plot[np.argsort(owner[plot])[:_MOST_TRACKS]]
        fresh = Followed(
            owner[plot], scan.time[plot], scan.position[plot], scan.covariance[plot],
            scan.sensor_position[plot],
        )  # fmt: skip
        began = self.began if len(self.followed.id) else end
        followed = concatenate(self.followed, fresh)
        if end < began + _LOOKS * interval and len(followed.id) < _MOST_PLOTS:
            return change(self, followed=followed, began=began)
        bends = self.bends.and_then(_bends(followed, began, np.array(scan.raised), space))
        nobody = Followed.none(scan.position.shape[1])
        if bends.raised != self.bends.raised:  # what is told of the plots so far is another noise
            return Scatter(nobody, bends)
        if len(bends.track) == _REMEMBERED:
            return Scatter(nobody, bends, until=end + min(_REST * (end - began), _LONGEST))
        return Scatter(take(followed, followed.time > end - _BEFORE * interval), bends, end)

    @property
    def ratio(self) -> Floats:
        """How large the noise is over what is told (d,), see `Bends.ratio`."""
        return self.bends.ratio

    def raised(self, is_round: bool = False) -> tuple[float, float, float]:
        """
        Return by what told sds are to be multiplied on each axis: never less than 1.

        A filter that is surer of plots than they are loses contacts, starts second tracks on them
        and takes noise for turns; one that is less sure is only slower. What is told of noise that
        lasts, as of long ships, three plots do not show. `is_round`: the same on all axes.
        """
        raised = self.bends.raised
        most = max(raised)
        return (most, most, most) if is_round else raised


def _bends(plots: Followed, since: float, raised: Floats, space: Space) -> Bends:
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
