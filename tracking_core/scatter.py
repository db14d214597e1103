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

from tracking_core.batches import Floats, Ints, Scan, Tracks
from tracking_core.rows import concatenate, take
from tracking_core.space import Space

_EVEN = 1.5  # times as long as the other one, a step may be
_MOST_TRACKS = 100  # are followed a look
_REMEMBERED = 300  # bends
_BURST = 50  # bends that are learnt at a time, once so many are known
_REST, _LONGEST = 3.0, 300.0  # times as long as that took nothing is learnt, at most so long [s]
_FEWEST, _FEWEST_TRACKS = 100, 3  # bends, and tracks that they are of, which tell what is usual
_MEDIAN = 0.6745  # of |x|, x a standard Gaussian
BELIEVED = 1.5  # times as far as told, noise is as told: contacts turn, and few bends tell little
_MOST = 30.0


@dataclass(frozen=True)
class Followed:
    """The last two plots of tracks, the older one first."""

    id: Ints  # (N,) of the track
    time: Floats  # (N, 2) [s], NaN: no plot yet
    position: Floats  # (N, d, 2)
    covariance: Floats  # (N, d, d, 2)

    @staticmethod
    def none(d: int) -> Followed:
        """Return no tracks, of plots with d coordinates."""
        none = np.zeros(0, np.int64)
        return Followed(none, np.zeros((0, 2)), np.zeros((0, d, 2)), np.zeros((0, d, d, 2)))


@dataclass(frozen=True)
class Bends:
    """How far plots were off the lines of the two before."""

    track: Ints  # (K,) id
    size: Floats  # (K, d) in sds of that by the noise that the three tell; along, to the left, up


@dataclass(frozen=True)
class Scatter:
    """What has been learnt of the noise of plots."""

    followed: Followed
    bends: Bends
    new: int = 0  # bends since it rested
    began: float = -np.inf  # to follow tracks [s]
    until: float = -np.inf  # it rests, since learning costs a tenth of a scan [s]

    @staticmethod
    def none(d: int) -> Scatter:
        """Return what is known of plots with d coordinates before any came."""
        return Scatter(Followed.none(d), Bends(np.zeros(0, np.int64), np.zeros((0, d))))

    def learn(self, owner: Ints, scan: Scan, living: Tracks, space: Space) -> Scatter:
        """
        Return what is known after one more scan.

        Parameters
        ----------
        owner : (M,) array
            Id of the track that a plot is surely of, 0: of none.
        scan : Scan
            M plots.
        living : Tracks
            Those that are followed on.
        space : Space
            Where plots are.

        """
        end = scan.coverage.end_time
        if end < self.until:
            return self
        told = np.isfinite(scan.position).all(axis=1)
        ids, plot = np.unique(np.where(told, owner, 0), return_index=True)
        ids, plot = ids[ids > 0][:_MOST_TRACKS], plot[ids > 0][:_MOST_TRACKS]
        if len(ids) == 0:
            return self
        old = take(self.followed, np.isin(self.followed.id, living.id))
        began = self.began if len(old.id) else end
        _, before, now = np.intersect1d(old.id, ids, assume_unique=True, return_indices=True)
        three = _with_third(take(old, before), plot[now], scan)
        found = _bends(three, scan.sensor_position[plot[now]], np.array(scan.raised), space)
        bends = take(concatenate(self.bends, found), slice(-_REMEMBERED, None))
        new = self.new + len(found.track)
        if new >= _BURST and len(bends.track) == _REMEMBERED:
            rest = min(_REST * (end - began), _LONGEST)
            return Scatter(Followed.none(scan.position.shape[1]), bends, until=end + rest)
        return Scatter(_follow_on(old, before, ids, plot, scan), bends, new, began)

    @cached_property
    def ratio(self) -> Floats:
        """
        Return how large the noise is over what is told, by axis (d,); NaN where not known yet.

        Along the line of sight, across to the left and, if there is height, up.
        """
        size = np.abs(self.bends.size)
        if len(size) < _FEWEST or len(np.unique(self.bends.track)) < _FEWEST_TRACKS:
            return np.full(size.shape[1], np.nan)
        return np.asarray(np.median(size, axis=0) / _MEDIAN)

    def raised(self, is_round: bool = False) -> tuple[float, float, float]:
        """
        Return by what told sds are to be multiplied on each axis: never less than 1.

        A filter that is surer of plots than they are loses contacts, starts second tracks on them
        and takes noise for turns; one that is less sure is only slower. What is told of noise that
        lasts, as of long ships, three plots do not show. `is_round`: the same on all axes.
        """
        ratio = self.ratio
        factor = np.where(ratio > BELIEVED, np.minimum(ratio, _MOST), 1.0)
        along, left, up = [factor.max()] * 3 if is_round else [*factor, 1.0, 1.0][:3]
        return float(along), float(left), float(up)


def _with_third(known: Followed, plot: Ints, scan: Scan) -> Followed:
    """Return three plots of tracks (N,), with these rows of the scan as the last ones."""
    return Followed(
        known.id,
        np.concatenate([known.time, scan.time[plot, None]], axis=1),
        np.concatenate([known.position, scan.position[plot, :, None]], axis=2),
        np.concatenate([known.covariance, scan.covariance[plot, :, :, None]], axis=3),
    )


def _follow_on(old: Followed, before: Ints, ids: Ints, plot: Ints, scan: Scan) -> Followed:
    """Return the last two plots, these of tracks (N,) included, whose rows were `before`."""
    rest = np.ones(len(old.id), bool)
    rest[before] = False
    time, position = np.full((len(ids), 2), np.nan), np.zeros((len(ids), *old.position.shape[1:]))
    covariance = np.zeros((len(ids), *old.covariance.shape[1:]))
    known = np.isin(ids, old.id)
    time[known, 0], position[known, :, 0] = old.time[before, 1], old.position[before, :, 1]
    covariance[known, :, :, 0] = old.covariance[before, :, :, 1]
    time[:, 1], position[:, :, 1] = scan.time[plot], scan.position[plot]
    covariance[:, :, :, 1] = scan.covariance[plot]
    return concatenate(take(old, rest), Followed(ids, time, position, covariance))


def _bends(three: Followed, sensor: Floats, raised: Floats, space: Space) -> Bends:
    """Return how far the last of three plots, in even steps, are off the lines of the others."""
    first, second = np.diff(three.time, axis=1).T
    even = (first > 0.0) & (second < _EVEN * first) & (first < _EVEN * second)
    three, stretch = take(three, even), second[even] / first[even]
    z, R = three.position, three.covariance
    way = space.shortest(z[:, :, 2] - z[:, :, 1])
    off = way - stretch[:, None] * space.shortest(z[:, :, 1] - z[:, :, 0])
    share = np.stack([stretch, -1.0 - stretch, np.ones_like(stretch)], axis=1)
    axes = _axes(z[:, :, 1], sensor[even])
    noise = np.einsum('kt,kdet->kde', share**2, R)
    variance = np.einsum('kad,kde,kae->ka', axes, noise, axes)
    size = np.einsum('kad,kd->ka', axes, off) / np.sqrt(variance)
    return Bends(three.id, size * raised[: size.shape[1]])


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
