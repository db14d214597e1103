# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which plots may belong to several tracks in common, and what do they say of each?

A common plot is near the mean of its tracks by level, with the plot's noise and a part of their
spread: then it is one more measurement of each of them, of its share of the mean, with what the
others add as noise. Or one of them has drowned the others: then it is a plot of that one only,
but the others were not missed.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tracking_core import measurement
from tracking_core.batches import Floats, Measurement, Pairs, Scan
from tracking_core.composition import Plane, Setup
from tracking_core.kalman import mixture_log_likelihood
from tracking_core.pairing import Gated, plots_beside
from tracking_core.prediction import Predicted
from tracking_core.rows import concatenate, put, take
from tracking_core.unresolved.grouping import group_tracks, Groups, Links
from tracking_core.unresolved.laws import as_common, candidates, compare, Laws
from tracking_core.unresolved.resolution import interference, near_pairs, Places
from tracking_core.unresolved.sets import as_one, Common, places_of


def add_common(
    passed: Predicted, gated: Gated, scan: Scan, setup: Setup
) -> tuple[Gated, Common | None]:
    """
    Add the common plots to the pairs of T tracks.

    Parameters
    ----------
    passed : Predicted
        The tracks.
    gated : Gated
        Pairs so far.
    scan : Scan
        M plots.
    setup : Setup
        Planes, sensor and its resolution.

    Returns
    -------
    gated : Gated
        With pairs for the tracks of every common plot, `common` their row in ...
    common : Common or None
        None if no two tracks are near enough, or if the sensor resolves everything.

    """
    resolution, space = setup.resolution, setup.sensor.space
    if resolution is None or len(passed.time) < 2:
        return gated, None
    places = places_of(setup.planes, passed.planes, setup.sensor.dimensions)
    first, second, chance = near_pairs(places, scan.coverage, resolution)
    # Only what is sure and in sight can hide something else: a doubtful track near a contact
    # would live on its plots.
    can_hide = passed.tracks.confirmed & (passed.detection > 0.0)
    likely = can_hide[first] & can_hide[second]
    if not likely.any():
        return gated, None
    links = Links(first[likely], second[likely], chance[likely])
    groups = group_tracks(links, passed.tracks.existence_probability)
    sets = as_one(places, groups, passed.tracks.level, space)
    found = candidates(places, sets, groups, passed, scan, setup, resolution)
    laws = compare(places, sets, groups, scan, setup, resolution, found)
    blur = interference(places, links, scan.coverage, resolution)
    gated = _blur_own(gated, blur, passed, scan, setup)
    rows = _measure(places, groups, laws, blur, passed, scan, setup)
    both = concatenate(gated, rows)
    order = np.lexsort((both.common, both.pairs.plot, both.pairs.track))
    return take(both, order), as_common(laws, sets, groups)


def _blur_own(gated: Gated, blur: Floats, passed: Predicted, scan: Scan, setup: Setup) -> Gated:
    """Return the pairs with more noise where another contact pulls at the plot."""
    pulled = np.flatnonzero((blur[gated.pairs.track] > 0.0).any(axis=(1, 2)))
    if len(pulled) == 0:
        return gated
    pairs = take(gated.pairs, pulled)
    R = scan.covariance[pairs.plot] + blur[pairs.track]
    position = plots_beside(pairs, passed.gates, scan, setup.sensor.space)
    part = _compare_again(pairs, position, np.ones(len(pulled)), R, passed, scan, setup)
    return put(gated, pulled, replace(part, common=gated.common[pulled]))


def _measure(
    places: Places,
    groups: Groups,
    laws: Laws,
    blur: Floats,
    passed: Predicted,
    scan: Scan,
    setup: Setup,
) -> Gated:
    """Return what each law says of its track; `common` is the row of the laws."""
    used = np.flatnonzero(laws.part > 0.0)
    plot, track = laws.plot[laws.pair[used]], groups.member[laws.member[used]]
    lag, share = scan.time[plot] - passed.time[track], laws.share[used]
    z = setup.sensor.space.beside(scan.position[plot], laws.expected, used)
    own = places.mean[track] + places.velocity[track] * lag[:, None]
    value = z - laws.expected[used] + share[:, None] * own
    R = scan.covariance[plot] + laws.noise[used] + laws.alone[used, None, None] * blur[track]
    rows = _compare_again(
        Pairs(track, plot, lag), value, share, R, passed, scan, setup, is_own=False
    )
    return replace(rows, common=used)


def _compare_again(
    pairs: Pairs, value: Floats, share: Floats, R: Floats, passed: Predicted, scan: Scan,
    setup: Setup, is_own: bool = True,
) -> Gated:  # fmt: skip
    """Compare plots (P, d), their own or in common, with a share of the tracks, noise R."""
    innovations = tuple(
        plane.estimator.innovate(
            mixture, pairs.track,
            _measured(plane, pairs, value, share, R, passed, scan, is_own),
        )
        for plane, mixture in zip(setup.planes, passed.planes, strict=True)
    )  # fmt: skip
    distance = np.sum([item.distance.min(axis=1) for item in innovations], axis=0)
    likelihood = np.sum(
        [
            mixture_log_likelihood(mixture.mode_probability[pairs.track], item)
            for mixture, item in zip(passed.planes, innovations, strict=True)
        ],
        axis=0,
    )
    return Gated(pairs, innovations, distance, likelihood, np.full(len(pairs), -1))


def _measured(
    plane: Plane, pairs: Pairs, value: Floats, share: Floats, R: Floats, passed: Predicted,
    scan: Scan, is_own: bool,
) -> Measurement:  # fmt: skip
    """Return what the pairs measure of a plane; the range rate of a common plot is nobody's."""
    at = np.array(plane.coordinates)
    matrix = share[:, None, None] * measurement.after(pairs.lag, len(at))
    part = measurement.without_absent(value[:, at], matrix, R[:, at[:, None], at])
    if 0 not in plane.coordinates or not np.isfinite(scan.range_rate).any():
        return part
    if not is_own:
        return measurement.with_unknown(part)
    gates = take(passed.gates, pairs.track)
    place = np.where(np.isnan(value), gates.centre, value)
    return measurement.with_range_rate(
        part, plane.coordinates, pairs, scan, place, gates.velocity, gates.velocity_covariance
    )
