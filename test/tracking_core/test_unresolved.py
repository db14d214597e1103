# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Marks that several contacts have in common: chances, the law of the mark, what it teaches."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from sonar_tracker.build import build_setup
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.sensor import Sonar
from sonar_tracker.sensor_config import SensorConfig
from tracking_core.batches import Bearings, Coverage, Mixture, Scan, Tracks
from tracking_core.config import with_values
from tracking_core.density import Density
from tracking_core.platform import pose_at
from tracking_core.space import ANGLES, POINTS, Space
from tracking_core.unresolved.grouping import group_tracks, Links
from tracking_core.unresolved.resolution import near_pairs, Places, Resolution, within_limit
from tracking_core.unresolved.sets import as_one
from tracking_core.update import look

LIMIT = 0.04
HERE = Coverage(0.0, 0.0)
OMNI = Sonar(SensorConfig(bearing_resolution=LIMIT))
CONFIG = with_values(SonarTrackerConfig(), {
    'estimator': 'kalman',
    'sensor.bearing_resolution': LIMIT, 'sensor.bearing_sd': 2e-3, 'clutter_density': 0.05,
    'gate.probability': 0.999, 'unresolved.spread': 0.3, 'unresolved.capture': 1e-6,
    'unresolved.interference': 0.0, 'lifecycle': 'm_of_n',
    'motion.bearing_noise': [0.0], 'motion.rate_noise': [1e-9],
})  # fmt: skip


def places(*bearings, sd=1e-3) -> Places:
    """Tracks at bearings [rad]."""
    T = len(bearings)
    return Places(np.array(bearings)[:, None], np.full((T, 1, 1), sd**2), np.zeros((T, 1)))


def chances(sonar: Sonar, *bearings, sd=1e-3, coverage=HERE, least=1e-3) -> dict:
    """Return the chance of each pair of tracks to be one."""
    resolution = Resolution(sonar, 0.1, 0.5, 0.05, 0.3, least)
    first, second, chance = near_pairs(places(*bearings, sd=sd), coverage, resolution)
    return {(int(a), int(b)): float(c) for a, b, c in zip(first, second, chance, strict=True)}


def test_near_pairs_are_those_within_the_limit() -> None:
    """Half a limit apart nearly surely, at the limit evenly, across the wrap too."""
    found = chances(OMNI, 3.13, 3.13 + 0.5 * LIMIT - 2.0 * np.pi, 3.13 + LIMIT, 1.0)
    assert found.pop((0, 1)) > 0.99
    assert found.pop((0, 2)) == pytest.approx(0.5, abs=0.01)
    assert found.pop((1, 2)) > 0.99
    assert not found


def test_near_pairs_of_vague_tracks_are_less_sure() -> None:
    """What is not known to be near is not known to be one."""
    assert chances(OMNI, 0.0, 0.5 * LIMIT, sd=LIMIT)[0, 1] < 0.6


def test_linear_array_blurs_towards_its_axis() -> None:
    """The limit grows as 1 / sin(bearing from the axis), which turns with the own ship."""
    linear = Sonar(SensorConfig(array='linear', bearing_resolution=LIMIT))
    turned = Coverage(0.0, 0.0, sector_centre=1.0)
    for angle in (90.0, 30.0, 15.0):
        bearing = 1.0 + np.radians(angle)
        apart = LIMIT / np.sin(np.radians(angle))
        chance = chances(linear, bearing - 0.5 * apart, bearing + 0.5 * apart, coverage=turned)
        assert chance[0, 1] == pytest.approx(0.5, abs=0.02)


@dataclass(frozen=True)
class Cells:
    """A radar with resolution cells in range and azimuth."""

    depth: float = 100.0
    width: float = 0.02
    space: Space = POINTS

    def separation(self, first, second, coverage):
        """Return range and azimuth apart, in cells."""
        ranges = [np.hypot(*p.T) for p in (first, second)]
        azimuths = [np.arctan2(p[:, 1], p[:, 0]) for p in (first, second)]
        return np.stack([np.diff(ranges, axis=0)[0] / self.depth,
                         np.diff(azimuths, axis=0)[0] / self.width], axis=1)  # fmt: skip

    def reach(self, position, coverage):
        """Return the larger side of a cell."""
        side = np.maximum(self.depth, self.width * np.hypot(*position.T))
        return np.repeat(side[:, None], 2, axis=1)


def test_near_pairs_of_a_radar_need_both_range_and_azimuth() -> None:
    """The same rule in two coordinates: one cell deep and one wide."""
    mean = np.array([[10_000.0, 0.0], [10_050.0, 100.0], [10_050.0, 300.0], [10_300.0, 0.0]])
    P = np.tile(25.0 * np.eye(2), (4, 1, 1))
    rule = Resolution(Cells(), 0.1, 0.5, 0.05, 0.3, 0.1)
    first, second, chance = near_pairs(Places(mean, P, np.zeros((4, 2))), HERE, rule)
    assert list(zip(first, second, strict=True)) == [(0, 1), (1, 2)]
    assert chance[0] > 0.95
    assert chance[1] == pytest.approx(0.5, abs=0.05)


def test_within_limit_marks_plots_beside_contacts() -> None:
    """Nearer than the limit to a contact, across the wrap too."""
    plots = np.array([[3.14], [-3.13], [3.05], [0.0]])
    rule = Resolution(OMNI, 0.1, 0.5, 0.05, 0.3, 0.1)
    near = within_limit(np.array([[3.13]]), plots, HERE, rule)
    assert_array_equal(near, [True, True, False, False])


def test_as_one_averages_by_level() -> None:
    """A contact 10 dB louder has ten parts of eleven; unknown levels are as the known one."""
    links = Links(np.array([0, 2]), np.array([1, 3]), np.array([0.5, 0.5]))
    groups = group_tracks(links, np.ones(4))
    level = np.array([20.0, 10.0, np.nan, np.nan])
    sets = as_one(places(3.13, 3.15 - 2.0 * np.pi, 0.0, 0.02), groups, level, ANGLES)
    assert_allclose(sets.share, [10 / 11, 1 / 11, 0.5, 0.5])
    assert_allclose(sets.mean[:, 0], [3.13 + 0.02 / 11, 0.01], rtol=1e-12)
    assert_allclose(sets.spread[1, 0, 0], 1e-4, rtol=1e-9)
    assert_allclose(sets.covariance[:, 0, 0], [101 / 121 * 1e-6, 0.5e-6], rtol=1e-12)


def tracks_at(*bearings, level=(20.0, 20.0), sd=4e-3) -> Tracks:
    """Make confirmed tracks at rest."""
    T = len(bearings)
    mean = np.stack([bearings, np.zeros(T)], axis=1)[:, None]
    P = np.tile(np.diag([sd**2, 1e-14]), (T, 1, 1, 1))
    zero, one = np.zeros(T), np.ones(T, np.int64)
    return Tracks(
        id=np.arange(T), time=zero, birth_time=zero,
        planes=(Mixture(mean, P, np.ones((T, 1)), np.zeros((T, 0))),),
        existence_probability=np.ones(T), confirmed=one > 0, hits=10 * one, misses=0 * one,
        outside=0 * one, history=one, gate_size=np.zeros((T, 1)), gate_volume=zero, nis=zero,
        doubled=0 * one, level=np.array(level),
    )  # fmt: skip


def heard(*marks, snr=20.0) -> Scan:
    """One cycle, at once."""
    z, t = np.array(marks, float), np.zeros(len(marks))
    bearings = Bearings.of(t, z, snr=np.full(len(marks), snr))
    return Sonar(CONFIG.sensor).measure(bearings, pose_at(None, t), HERE)


def after(tracks: Tracks, scan: Scan, **values):
    """Look once."""
    config = with_values(CONFIG, {k.replace('__', '.'): v for k, v in values.items()})
    setup = build_setup(config, Sonar(config.sensor))
    return look(tracks, scan, setup, Density(0.05, 1e-6))


def test_common_mark_moves_both_as_one_joint_filter_would() -> None:
    """Means and variances are those of a Kalman filter over both, the first time."""
    tracks, z, spread = tracks_at(0.0, 0.01, level=(20.0, 17.0)), 0.006, 0.3
    seen = after(tracks, heard(z), sensor__detection_probability=0.999)
    w = 10.0 ** np.array([2.0, 1.7])
    w /= w.sum()
    P = 16e-6 * np.eye(2)
    b = np.array([0.0, 0.01])
    R = 4e-6 + spread * w[0] * w[1] * 1e-4
    S = w @ P @ w + R
    K = P @ w / S
    expected = b + K * (z - w @ b)
    mean, covariance = seen.tracks.planes[0].moments()
    assert_allclose(mean[:, 0], expected, atol=2e-5)
    assert_allclose(covariance[:, 0, 0], np.diag(P - np.outer(K, K) * S), rtol=0.02)
    assert seen.claimed[0] == pytest.approx(1.0, abs=1e-3)
    assert_array_equal(seen.tracks.misses, [0, 0])


def test_common_mark_without_the_rule_is_one_tracks_only() -> None:
    """With bearing_resolution 0 one of the two is missed."""
    seen = after(tracks_at(0.0, 0.01), heard(0.005), sensor__bearing_resolution=0.0)
    assert seen.tracks.existence_probability.sum() < 2.1
    found = (seen.tracks.misses == 0).sum()
    assert found <= 1


def test_two_marks_are_one_for_each() -> None:
    """Contacts near the limit that are resolved after all each get their own."""
    seen = after(tracks_at(0.0, 0.8 * LIMIT), heard(0.002, 0.8 * LIMIT + 0.002))
    mean = seen.tracks.planes[0].moments()[0][:, 0]
    assert_allclose(mean, [0.0016, 0.8 * LIMIT + 0.0016], atol=3e-4)


def test_common_mark_across_the_wrap_is_like_any_other() -> None:
    """Turning everything turns the answer."""
    here = after(tracks_at(0.0, 0.01), heard(0.006)).tracks.planes[0]
    there = after(tracks_at(np.pi, 0.01 - np.pi), heard(0.006 - np.pi)).tracks.planes[0]
    turned = there.moments()[0][:, 0] - np.array([np.pi, -np.pi])
    assert_allclose(turned, here.moments()[0][:, 0], atol=1e-12)
    assert_allclose(there.covariance, here.covariance, rtol=1e-9)


def test_order_of_tracks_and_marks_does_not_matter() -> None:
    """Three near each other and a stranger, three marks: any order gives the same."""
    rng, at = np.random.default_rng(5), np.array([0.0, 0.02, 0.05, 0.5])
    marks, level = np.array([0.01, 0.052, 0.498]), np.array([20.0, 23.0, 18.0, np.nan])
    first = after(tracks_at(*at, level=level), heard(*marks)).tracks.planes[0].moments()
    for _ in range(3):
        order, other = rng.permutation(4), rng.permutation(3)
        tracks = tracks_at(*at[order], level=level[order])
        mean, P = after(tracks, heard(*marks[other])).tracks.planes[0].moments()
        assert_allclose(mean, first[0][order], atol=1e-12)
        assert_allclose(P, first[1][order], rtol=1e-9)


def test_far_contacts_are_untouched_by_the_rule() -> None:
    """Well apart, the answer is that of the ordinary association, to the last bit nearly."""
    scan = heard(0.001, 1.001, 2.0)
    tracks = tracks_at(0.0, 1.0, level=(20.0, 20.0))
    on, off = after(tracks, scan), after(tracks, scan, sensor__bearing_resolution=0.0)
    assert_allclose(on.tracks.planes[0].mean, off.tracks.planes[0].mean, rtol=1e-12)


def test_level_follows_own_marks_only() -> None:
    """A mark of its own moves the usual level, one in common does not."""
    own = after(tracks_at(0.0, 1.0), heard(0.0, 1.0, snr=10.0)).tracks.level
    assert (own < 19.6).all()
    common = after(tracks_at(0.0, 0.005), heard(0.0025, snr=10.0)).tracks.level
    assert (common > 19.9).all()


def test_near_contacts_may_both_be_missed() -> None:
    """A cycle without marks near them counts as a miss of both."""
    for scan in (heard(), heard(1.0)):
        seen = after(tracks_at(0.0, 0.01), scan)
        assert_array_equal(seen.tracks.misses, [1, 1])


def test_drowned_contact_is_neither_moved_nor_missed() -> None:
    """One mark just on the louder of two at the limit: the other keeps its place and its hits."""
    tracks = tracks_at(0.0, 0.9 * LIMIT, level=(20.0, 10.0), sd=1e-3)
    seen = after(tracks, heard(0.0005), unresolved__capture=0.3)
    assert_array_equal(seen.tracks.misses, [0, 0])
    mean = seen.tracks.planes[0].moments()[0][:, 0]
    assert 0.0 < mean[0] < 5e-4
    assert mean[1] == pytest.approx(0.9 * LIMIT, abs=2e-4)
    missed = after(tracks, heard(0.0005), sensor__bearing_resolution=0.0)
    assert_array_equal(missed.tracks.misses, [0, 1])


def test_marks_near_another_contact_are_trusted_less() -> None:
    """Interference: each mark pulls its own track, but less than where nobody is near."""
    tracks, scan = tracks_at(0.0, 1.1 * LIMIT), heard(0.002, 1.1 * LIMIT + 0.002)
    moved = [
        after(tracks, scan, unresolved__interference=part).tracks.planes[0].moments()[0][0, 0]
        for part in (0.0, 0.1, 0.5)
    ]
    assert moved[0] > 1.1 * moved[1] > 1.5 * moved[2] > 0.0


def test_mark_of_one_that_drowned_another_is_trusted_less_too() -> None:
    """The louder contact moves less on a mark at which the other pulls."""
    tracks, scan = tracks_at(0.0, 0.9 * LIMIT, level=(20.0, 10.0)), heard(0.002)
    moved = [
        after(tracks, scan, unresolved__capture=0.99, unresolved__interference=part)
        .tracks.planes[0].moments()[0][0, 0]
        for part in (0.0, 0.2)
    ]  # fmt: skip
    assert moved[0] > 1.2 * moved[1] > 0.0
