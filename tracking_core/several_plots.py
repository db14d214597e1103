# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which plots of a look are of one contact, where a contact gives several?

The echoes of a long ship, or of a car near by, are resolved. Tracking knows one plot a contact and
look; what a contact gives beyond would start tracks of its own. So plots that are within the size
of a contact are made one before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import math

import numpy as np

from tracking_core.association.clusters import renumber
from tracking_core.batches import Floats, Ints, Scan
from tracking_core.linalg import sum_by_track
from tracking_core.rows import change, concatenate, take
from tracking_core.space import Space

_RATE_SIGMAS = 3.0  # by how much of their noise range rates of one contact may differ
_ABSENT = 1e300  # in the place of NaN, which is not the same as NaN
_GOLDEN, _SILVER = 0.5 * (math.sqrt(5.0) - 1.0), math.sqrt(2.0) - 1.0  # parts that share nothing


@dataclass(frozen=True)
class Extent:
    """How large contacts are, and what their plots have in common."""

    size: float  # [m]; 0: a contact gives one plot
    speed_max: float  # of a contact [m/s]

    def gather(self, held: Scan | None, scan: Scan, interval: float, space: Space) -> Scan:
        """
        Return the plots of a scan with those that waited for it, one plot a contact.

        Parameters
        ----------
        held : Scan or None
            Plots of earlier scans whose antenna pass was not over.
        scan : Scan
            M plots.
        interval : float
            Between two looks [s]; plots of one look are less than half of it apart.
        space : Space
            Where the plots are.

        """
        if held is not None:
            scan = concatenate(held, scan)
        if self.size == 0.0 or len(scan) < 2:
            return scan
        first, same = _distinct(scan)
        contact = self._contacts(take(scan, first), 0.5 * interval, space)[same]
        return scan if len(contact) == contact.max() + 1 else _one_each(scan, contact)

    def _contacts(self, scan: Scan, longest: float, space: Space) -> Ints:
        """
        Return the contact 0, 1, ... of each plot (M,).

        Those two that are nearest to each other are one, then groups of them, as long as the box
        about all plots of a group is no larger than a contact.
        """
        M, d = scan.position.shape
        low = np.column_stack([scan.position, scan.time, scan.range_rate])
        high, contact = low.copy(), np.arange(M)
        one, other = space.find_pairs(scan.position, np.full((M, d), self.size), scan.position)
        one, other = one[one < other], other[one < other]
        while True:
            shift = _unfolding(low, high, one, other, scan.range_rate_interval)
            span = np.fmax(high[one], high[other] + shift) - np.fmin(low[one], low[other] + shift)
            span = np.nan_to_num(span)  # what is not measured keeps nobody apart
            extent = np.sqrt((span[:, :d] ** 2).sum(axis=1))
            fits = (extent <= self.size) & (span[:, d] < longest)
            fits &= span[:, d + 1] <= self._spread_of_rates(scan, one, extent)
            one, other, extent = one[fits], other[fits], extent[fits]
            if len(one) == 0:
                return renumber(contact, M)[1]
            first, second = _nearest_of_each_other(one, other, extent, M)
            shift = _unfolding(low, high, first, second, scan.range_rate_interval)
            low[first] = np.fmin(low[first], low[second] + shift)
            high[first] = np.fmax(high[first], high[second] + shift)
            into = np.arange(M)
            into[second] = first
            contact = into[contact]
            one, other = _different(into[one], into[other], M)

    def _spread_of_rates(self, scan: Scan, one: Ints, extent: Floats) -> Floats:
        """Return how much range rates of one contact (P,) differ at most: it is seen askew."""
        here = scan.position[one, :2] - scan.sensor_position[one, :2]
        speed = self.speed_max + np.hypot(*scan.sensor_velocity[one, :2].T)
        noise = _RATE_SIGMAS * np.sqrt(2.0 * scan.range_rate_variance[one])
        return np.asarray(noise + speed * extent / np.maximum(np.hypot(*here.T), 1.0))


ONE_PLOT = Extent(size=0.0, speed_max=0.0)


def _distinct(scan: Scan) -> tuple[Ints, Ints]:
    """Return the first (K,) of plots that are the same, and which of them each (M,) is."""
    rows = np.column_stack([scan.position, scan.time, scan.range_rate])
    rows = np.nan_to_num(rows, nan=_ABSENT)
    _, first, same = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    order = first.argsort()
    return first[order], order.argsort()[same.reshape(-1)]


def _unfolding(low: Floats, high: Floats, one: Ints, other: Ints, interval: float) -> Floats:
    """Return what brings ambiguous range rates, the last column, near those of `one`."""
    shift = np.zeros((len(one), low.shape[1]))
    if interval:
        middle = 0.5 * (low[:, -1] + high[:, -1])
        turns = np.rint((middle[one] - middle[other]) / interval)
        shift[:, -1] = interval * np.nan_to_num(turns)  # where one is not measured, none
    return shift


def _nearest_of_each_other(
    one: Ints, other: Ints, extent: Floats, plots: int
) -> tuple[Ints, Ints]:
    """
    Return the pairs of which each is the nearest of the other; none is in two of them.

    Pairs equally near are in no order of their rows: of a row of plots only the first two would
    be a pair of these.
    """
    order = np.lexsort(((one * _GOLDEN + other * _SILVER) % 1.0, extent))
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    best = np.full(plots, len(order))
    np.minimum.at(best, one, rank)
    np.minimum.at(best, other, rank)
    chosen = (best[one] == rank) & (best[other] == rank)
    return one[chosen], other[chosen]


def _different(one: Ints, other: Ints, plots: int) -> tuple[Ints, Ints]:
    """Return the pairs without those of one and the same, each once, the lower first."""
    low, high = np.minimum(one, other), np.maximum(one, other)
    both = np.unique((low * plots + high)[low < high])
    return both // plots, both % plots


def _one_each(scan: Scan, contact: Ints) -> Scan:
    """Return the mean of the plots of each contact, no surer than one of them."""
    count = int(contact.max()) + 1

    def mean(values: Floats) -> Floats:
        known = np.isfinite(values)
        total = sum_by_track(np.where(known, values, 0.0), contact, count)
        number = sum_by_track(known.astype(np.float64), contact, count)
        return np.where(number > 0.0, total / np.maximum(number, 1.0), np.nan)

    has_height = np.isfinite(scan.position).all(axis=1)
    space = mean(np.where(has_height, scan.clutter_volume, np.nan))  # without: of other units
    names = (
        'time', 'position', 'covariance', 'range_rate_variance', 'snr', 'sensor_position',
        'sensor_velocity',
    )  # fmt: skip
    return change(
        scan,
        range_rate=_mean_rate(scan, mean),
        clutter_volume=np.where(np.isfinite(space), space, mean(scan.clutter_volume)),
        **{name: mean(getattr(scan, name)) for name in names},
    )


def _mean_rate(scan: Scan, mean: Callable[[Floats], Floats]) -> Floats:
    """Return the mean range rates; ambiguous ones lie on a circle."""
    if not scan.range_rate_interval:
        return mean(scan.range_rate)
    radius = scan.range_rate_interval / (2.0 * np.pi)
    angle = scan.range_rate / radius
    return radius * np.arctan2(mean(np.sin(angle)), mean(np.cos(angle)))
