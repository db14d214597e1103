# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which tracks does a scan give birth to, and which of its plots may do so later?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.association.clusters import renumber
from tracking_core.batches import Bools, Coverage, Floats, Scan, Seeds, Tracks
from tracking_core.chances import MORE_LIKELY_THAN_NOT
from tracking_core.composition import Setup
from tracking_core.density import Density
from tracking_core.initiation import one_point, plane_start, Starts, two_point
from tracking_core.interval import interval_of_looks, time_of_looks
from tracking_core.lifecycle_config import InitiationConfig
from tracking_core.linalg import inverse, sum_by_track, symmetrise
from tracking_core.new_contacts import velocity_covariance
from tracking_core.rows import change, concatenate, take
from tracking_core.state import State
from tracking_core.unresolved.resolution import Resolution, within_limit
from tracking_core.unresolved.sets import places_of
from tracking_core.update import Look

_SURE = 1.0 - 1e-9  # no start is surer: the others of a plot may still be the right one


@dataclass(frozen=True)
class Born:
    """What a scan of M plots gave birth to."""

    tracks: Tracks  # the likeliest first
    seeds: Seeds  # plots that may start a track with a later one
    used: Floats  # (M,) chance of each plot that a new track explains it
    leniency: float  # tentative tracks may be so much less likely than usual


def start_tracks(
    scan: Scan, seen: Look, density: Density, steps: Floats, setup: Setup, state: State
) -> Born:
    """
    Start tracks from the plots that no track claims.

    Parameters
    ----------
    scan : Scan
        M plots.
    seen : Look
        What became of them.
    density : Density
        Of false plots and of new contacts.
    steps : (N,) array
        From scan to scan, this one included [s].
    setup, state
        Of the tracker.

    """
    unclaimed = seen.claimed < MORE_LIKELY_THAN_NOT
    free = ~seen.waiting & unclaimed & np.isfinite(scan.position).all(axis=1)
    if setup.resolution is not None:
        free &= ~_hidden(scan, seen, setup, setup.resolution)
    plots = Seeds(
        scan.time, scan.position, scan.covariance, 1.0 - seen.claimed, scan.clutter_volume,
        np.ones(len(scan)) * density.at_plots,
    )  # fmt: skip
    fresh = take(plots, free)
    if setup.initiation.method == 'one_point':
        starts = one_point(fresh, density.existence(fresh.relief), setup.initiation)
    else:
        starts = two_point(
            state.seeds, fresh, density, scan.coverage, interval_of_looks(steps, scan.coverage),
            setup.sensor.detection_probability, setup.least_existence, setup.initiation,
            setup.sensor.space,
        )  # fmt: skip
        starts = with_velocity_prior(starts, setup.initiation)
        starts = one_a_plot(starts, len(fresh))
    used = np.zeros(len(scan))
    used[free] = np.bincount(starts.plot, starts.existence_probability, len(fresh)).clip(max=1.0)
    oldest = time_of_looks(int(setup.initiation.memory), steps, scan.coverage)
    young = take(state.seeds, scan.coverage.end_time - state.seeds.time < oldest)
    left = change(fresh, free=fresh.free * (1.0 - used[free]))
    if len(starts.plot):
        born = new_tracks(starts, fresh.time, setup, state.next_id, scan.coverage)
        if setup.lifecycle.counts:
            existence = born.existence_probability
            born = change(born, confirmed=setup.lifecycle.judge(born, existence)[0])
    else:
        born = take(seen.tracks, slice(0))
    return Born(born, concatenate(young, left), used, starts.leniency)


def _hidden(scan: Scan, seen: Look, setup: Setup, resolution: Resolution) -> Bools:
    """Return which plots (M,) a contact near a known one, which has its own plot, cannot make."""
    known = take(seen.tracks, seen.passed & seen.tracks.confirmed & (seen.tracks.coasted == 0))
    places = places_of(setup.planes, known.planes, setup.sensor.dimensions)
    return within_limit(places.mean, scan.position, scan.coverage, resolution)


def with_velocity_prior(starts: Starts, config: InitiationConfig) -> Starts:
    """Return the starts, given how fast contacts are: two noisy plots alone may say anything."""
    if len(starts.plot) == 0:
        return starts
    K, d, _ = starts.mean.shape
    P = starts.covariance.reshape(K, 2 * d, 2 * d)
    cross = P[:, :, 1::2]
    gain = cross @ inverse(P[:, 1::2, 1::2] + velocity_covariance(d, config))[0]
    mean = starts.mean - (gain @ starts.mean[:, :, 1:]).reshape(K, d, 2)
    covariance = symmetrise(P - gain @ np.swapaxes(cross, 1, 2))
    return change(starts, mean=mean, covariance=covariance.reshape(K, d, 2, d, 2))


def one_a_plot(starts: Starts, plots: int) -> Starts:
    """
    Return one start for each of the plots (M,) that starts end in: the mixture of these.

    Of contacts side by side each plot may follow several. That is one contact whose velocity is
    not sure yet, not several contacts of which none is sure to exist.
    """
    ends, row = renumber(starts.plot, plots)
    if len(ends) == len(row):
        return starts
    chance, L = np.minimum(starts.existence_probability, _SURE), len(ends)
    share = (chance / np.bincount(row, chance)[row])[:, None, None]
    mean = sum_by_track(share * starts.mean, row, L)
    apart = (starts.mean - mean[row]).reshape(len(row), -1)
    P = starts.covariance.reshape(*apart.shape, -1) + apart[:, :, None] * apart[:, None, :]
    P = sum_by_track(share * P, row, L).reshape(L, *starts.covariance.shape[1:])
    none_is_right = np.exp(np.bincount(row, np.log1p(-chance)))
    return Starts(mean, P, 1.0 - none_is_right, ends, starts.hits, starts.leniency)


def new_tracks(
    starts: Starts, plot_time: Floats, setup: Setup, first_id: int, coverage: Coverage
) -> Tracks:
    """Return tentative tracks from K starts, the likeliest first; `plot_time` (M,) [s]."""
    starts = take(starts, np.argsort(-starts.existence_probability, kind='stable'))
    K, d = len(starts.plot), setup.sensor.dimensions
    time, zero = plot_time[starts.plot], np.zeros(K, np.int64)
    sensor = coverage.sensor_at(time)
    return Tracks(
        id=first_id + np.arange(K),
        time=time,
        birth_time=time,
        planes=tuple(
            plane.start(*plane_start(starts, plane.coordinates), sensor) for plane in setup.planes
        ),
        existence_probability=starts.existence_probability,
        confirmed=np.zeros(K, bool),
        hits=zero + starts.hits,
        misses=zero,
        outside=zero,
        history=zero + ((1 << starts.hits) - 1),
        gate_size=np.full((K, d), np.nan),
        gate_volume=np.full(K, np.nan),
        nis=np.full(K, np.nan),
        doubled=zero,
        level=np.full(K, np.nan),
    )
