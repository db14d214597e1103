# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The noise of plots is learnt from how far three of them are from a line."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.batches import Coverage, Scan
from tracking_core.scatter import Scatter
from tracking_core.space import ANGLES, POINTS

SENSOR = np.array([300.0, -200.0, 50.0])  # [m]
SD = np.array([20.0, 0.001, 0.001])  # of range [m], azimuth and elevation [rad]


def scan_of(time, position, covariance):
    """Return a scan of plots (M, d) with these covariances."""
    M = len(time)
    return Scan(
        time, position, covariance, np.full(M, np.nan), np.ones(M), np.full(M, np.nan), np.ones(M),
        np.tile(SENSOR, (M, 1)), np.zeros((M, 3)), Coverage(time[0], time[0]), 1.0,
    )  # fmt: skip


def axes_at(place):
    """Return unit vectors (3, 3) along the line of sight, to its left and up."""
    along = (place - SENSOR) / np.linalg.norm(place - SENSOR)
    left = np.cross([0.0, 0.0, 1.0], along)
    left /= np.linalg.norm(left)
    return np.stack([along, left, np.cross(along, left)])


def learnt(times, contacts=5, looks=60, seed=1):
    """Return what is learnt of straight contacts with noise so many times as large as told."""
    rng = np.random.default_rng(seed)
    start, velocity = rng.uniform(5e3, 2e4, (contacts, 3)), rng.normal(0.0, 100.0, (contacts, 3))
    ids, scatter = np.arange(1, contacts + 1), Scatter.none(3)
    for look in range(looks):
        place = start + 4.0 * look * velocity
        axes = np.array([axes_at(p) for p in place])
        far = np.linalg.norm(place - SENSOR, axis=1)
        across = np.linalg.norm((place - SENSOR)[:, :2], axis=1)
        sd = np.stack([np.full(contacts, SD[0]), across * SD[1], far * SD[2]], axis=1)
        covariance = np.einsum('ka,kad,kae->kde', sd**2, axes, axes)
        noise = np.einsum('ka,kad->kd', sd * times * rng.normal(size=sd.shape), axes)
        scan = scan_of(np.full(contacts, 4.0 * look), place + noise, covariance)
        scatter = scatter.learn(ids, scan, 4.0, POINTS, 300.0)
    return scatter


def test_every_plot_is_off_the_line_of_two_others_once():
    """Five looks are learnt from at a time, with those before."""
    scatter = learnt(np.ones(3), contacts=1, looks=31)
    assert scatter.followed.id.tolist() == 5 * [1]
    assert len(scatter.bends.track) == 31 - 2


def bends_of(time, position, noise, space=POINTS, raised=(1.0, 1.0, 1.0)):
    """Return how far plots of one contact, one a scan, are off the lines of the two before."""
    scatter, seven = Scatter.none(len(position[0])), np.array([7])
    for t, place in zip(time, position, strict=True):
        scan = replace(scan_of(np.array([t]), place[None], noise), raised=raised)
        scatter = scatter.learn(seven, scan, 100.0, space, 300.0)
    later = scan_of(np.array([1000.0]), place[None], noise)
    return scatter.learn(
        np.zeros(1, int), replace(later, raised=raised), 1.0, space, 300.0
    ).bends.size


def test_ratio_is_that_of_the_noise_on_each_axis():
    """Of range, azimuth and elevation apart; the median of 290 bends is good to a tenth."""
    assert_allclose(learnt(np.array([0.2, 5.0, 1.0])).ratio, [0.2, 5.0, 1.0], rtol=0.2)


def test_noise_as_told_or_less_is_left_as_told():
    """Only what is told far too small is raised, and on its own axis."""
    assert learnt(np.array([0.1, 1.0, 1.2])).raised() == (1.0, 1.0, 1.0)
    raised = learnt(np.array([0.1, 4.0, 1.0])).raised()
    assert raised[0] == raised[2] == 1.0
    assert raised[1] == pytest.approx(4.0, rel=0.2)
    assert learnt(np.array([0.1, 4.0, 1.0])).raised(is_round=True) == (raised[1],) * 3


def test_two_contacts_tell_nothing():
    """They may turn all the time."""
    scatter = learnt(np.array([5.0, 5.0, 5.0]), contacts=2)
    assert np.isnan(scatter.ratio).all()
    assert scatter.raised() == (1.0, 1.0, 1.0)


def test_bend_is_the_way_from_the_line_of_the_two_plots_before():
    """In steps of 4 and 5 s: z2 - z1 - 5/4 (z1 - z0), over its sd, along and across the sight."""
    place = np.array([[1000.0, 0.0], [1010.0, 3.0], [1030.0, -4.0]]) + SENSOR[:2]
    noise, time = np.diag([9.0, 16.0])[None], (0.0, 4.0, 9.0)
    line = (place[1] - SENSOR[:2]) / np.linalg.norm(place[1] - SENSOR[:2])
    axes = np.array([line, [-line[1], line[0]]])
    off = place[2] - place[1] - 1.25 * (place[1] - place[0])
    variance = (1.25**2 + 2.25**2 + 1.0) * np.einsum('ad,d,ad->a', axes, [9.0, 16.0], axes)
    assert_allclose(bends_of(time, place, noise), [axes @ off / np.sqrt(variance)])
    raised = bends_of(time, place, noise, raised=(2.0, 3.0, 1.0))
    assert_allclose(raised, [axes @ off / np.sqrt(variance) * [2.0, 3.0]])


def test_a_miss_between_two_plots_makes_no_bend():
    """A step of two looks after one of one is no even step."""
    place = np.array([[5e3, 0.0], [5001.0, 0.0], [5003.0, 0.0]])
    assert len(bends_of((0.0, 1.0, 3.0), place, np.eye(2)[None])) == 0
    assert len(bends_of((0.0, 1.0, 2.0), place, np.eye(2)[None])) == 1


def test_plots_of_two_tracks_make_no_bend():
    """Whoever comes first."""
    scatter = Scatter.none(2)
    for time, owner in enumerate((3, 5, 3, 5)):
        scan = scan_of(np.array([float(time)]), np.array([[5e3, 0.0]]), np.eye(2)[None])
        scatter = scatter.learn(np.array([owner]), scan, 0.3, POINTS, 300.0)
    assert scatter.began > 0.0  # it has learnt meanwhile
    assert len(scatter.bends.track) == 0


def test_bearings_go_on_over_the_cut():
    """From just below pi to just above -pi is a short way."""
    bearing = np.array([[3.12], [3.14], [-3.1231853]])
    size = bends_of((0.0, 1.0, 2.0), bearing, np.array([[[1e-4]]]), ANGLES)
    assert_allclose(size, [[0.0]], atol=1e-4)


def test_it_rests_once_it_knows_enough_and_goes_on_to_learn():
    """Three looks in four cost nothing; what it knows of the noise stays meanwhile."""
    scatter = learnt(np.ones(3), looks=80)
    assert scatter.until > -np.inf
    one = np.ones(1, int)
    assert (
        scatter.learn(one, scan_of(*nowhere(scatter.until - 1.0)), 4.0, POINTS, 300.0) is scatter
    )
    later = scatter.learn(one, scan_of(*nowhere(scatter.until + 1.0)), 4.0, POINTS, 300.0)
    assert later.followed.id.tolist() == [1]
    assert later.bends is scatter.bends


def nowhere(time):
    """Return time, place and covariance of a plot."""
    return np.array([time]), np.array([[1e4, 0.0, 100.0]]), np.eye(3)[None]
