# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Do the measures that judge a recording say what a person would count by hand?"""

from __future__ import annotations

from itertools import permutations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_tools.scoring import match, Stretches, TrackRows, Truth
from tracking_tools.scoring.consistency import consistency
from tracking_tools.scoring.continuity import find_changes
from tracking_tools.scoring.matching import candidates
from tracking_tools.scoring.onsets import false_alarms, onset_delays
from tracking_tools.scoring.ospa import distances_of_scans, ospa_of_distances
from tracking_tools.scoring.segments import holders, relative_tracking_time, segment_lengths
from tracking_tools.scoring.siap import siap

RADIUS = 10.0


def rows(*table: tuple[int, int, float, float], angular: bool = False) -> TrackRows:
    """Rows (scan, id, x, y), a scan each second; a bearing is x alone."""
    scan, ids, x, y = (np.array(column) for column in zip(*table, strict=True))
    d = 1 if angular else 2
    position = np.stack([x, y], axis=1).astype(float)[:, :d]
    P = np.tile(np.eye(2 * d), (len(ids), 1, 1))
    return TrackRows(scan, ids, scan.astype(float), position, 0.0 * position, P, angular)


def truth(*parts: tuple[int, float, range]) -> Truth:
    """Contacts (id, y, times) that stand at x = 0."""
    ids = np.concatenate([np.full(len(times), contact) for contact, _, times in parts])
    time = np.concatenate([np.array(times, float) for _, _, times in parts])
    y = np.concatenate([np.full(len(times), place) for _, place, times in parts])
    position = np.stack([0.0 * y, y], axis=1)
    return Truth.of(ids, time, position, np.zeros_like(position))


STARTS = np.arange(21.0)  # twenty scans of a second


def test_stretches_of_truth_leave_out_an_absence() -> None:
    """A contact seen in seconds 2 to 5 and 12 to 14 is wanted then and not between."""
    stretches = Stretches.of_truth(truth((7, 0.0, range(2, 6)), (7, 0.0, range(12, 15))), STARTS)
    assert stretches.id.tolist() == [7, 7]
    assert (stretches.first_scan.tolist(), stretches.last_scan.tolist()) == ([2, 12], [5, 14])
    scan = np.array([1, 2, 5, 6, 11, 12, 14, 15])
    wanted = stretches.wanted(np.full(len(scan), 7), scan)
    assert wanted.tolist() == [False, True, True, False, False, True, True, False]


def test_stretches_of_truth_end_with_the_tracks() -> None:
    """Truth before the first and after the last scan asks for nothing."""
    stretches = Stretches.of_truth(truth((7, 0.0, range(-9, 40)), (8, 0.0, range(30, 40))), STARTS)
    assert (stretches.id, stretches.first_scan, stretches.last_scan) == ([7], [0], [19])


def test_stretches_of_truth_know_a_pause_of_the_recording() -> None:
    """Neither tracks nor truth for fifty seconds: another track afterwards is a return."""
    starts = np.concatenate([np.arange(10.0), np.arange(60.0, 71.0)])
    for back in (58, 60):  # the truth comes before the tracks, or with them
        real = truth((7, 0.0, range(10)), (7, 0.0, range(back, 70)), (8, 0.0, range(20, 50)))
        stretches = Stretches.of_truth(real, starts)
        assert stretches.id.tolist() == [7, 7]
        assert (stretches.first_scan.tolist(), stretches.last_scan.tolist()) == ([0, 10], [9, 19])
    found = match(rows((8, 1, 0.0, 0.0), (12, 2, 0.0, 0.0)), real, RADIUS)
    changes = find_changes(found, stretches)
    assert (changes.switches, changes.breaks, changes.returns) == (0, 0, 1)


def test_find_changes_tells_a_switch_from_a_return() -> None:
    """Track 1 to 2 in sight is a switch, 2 to 3 over an absence is a return, a gap is a break."""
    real = truth((7, 0.0, range(8)), (7, 0.0, range(14, 20)))
    ids = {0: 1, 1: 1, 2: 2, 3: 2, 6: 2, 14: 3, 15: 3}
    found = match(rows(*((k, i, 0.0, 1.0) for k, i in ids.items())), real, RADIUS)
    changes = find_changes(found, Stretches.of_truth(real, STARTS))
    assert (changes.switches, changes.breaks, changes.returns) == (1, 1, 1)


def test_relative_tracking_time_halves_with_one_break() -> None:
    """Held in 10 of 10 scans: 1; with one scan missing in the middle: mean of 5 and 4 over 10."""
    real = truth((7, 0.0, range(10)))
    stretches = Stretches.of_truth(real, STARTS)
    whole = match(rows(*((k, 1, 0.0, 0.0) for k in range(10))), real, RADIUS)
    broken = match(rows(*((k, 1, 0.0, 0.0) for k in range(10) if k != 5)), real, RADIUS)
    assert relative_tracking_time(holders(whole, stretches)) == 1.0
    assert_allclose(relative_tracking_time(holders(broken, stretches)), (5 + 4) / 2 / 10)


def test_segment_lengths_end_with_another_track() -> None:
    """Stays of track 5 (2 scans), 6 (1), none (2), 6 (3)."""
    assert segment_lengths(np.array([5, 5, 6, -1, -1, 6, 6, 6])).tolist() == [2, 1, 3]


def test_match_of_bearings_goes_the_short_way() -> None:
    """A bearing of -3.1 rad is 0.083 rad from 3.1 rad, and from 3.1 rad and three turns."""
    for turns in (0.0, 6.0 * np.pi):
        real = Truth.of(np.zeros(2, int), np.arange(2.0), np.full((2, 1), 3.1 + turns),
                        np.zeros((2, 1)))  # fmt: skip
        found = match(rows((0, 1, -3.1, 0.0), angular=True), real, radius=0.2)
        assert len(found) == 1
        assert_allclose(found.distance, 2.0 * np.pi - 6.2, atol=1e-12)
        assert_allclose(found.position, -3.1 - (2.0 * np.pi - 6.2), atol=1e-12)


@pytest.mark.parametrize('interval', [1.0, 7.0])
def test_candidates_are_all_pairs_within_the_radius(interval: float) -> None:
    """On circles, sampled often and seldom, the coarse look rules nothing out by mistake."""
    rng = np.random.default_rng(8)
    time = np.arange(0.0, 120.0, interval)
    parts = []
    for contact in range(12):
        rate, radius = rng.uniform(-0.2, 0.2), rng.uniform(5.0, 60.0)
        angle = rng.uniform(0.0, 6.0) + rate * time
        turn = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        ahead = radius * rate * np.stack([-turn[:, 1], turn[:, 0]], axis=1)
        parts.append((np.full(len(time), contact), time, radius * turn, ahead))
    real = Truth.of(*(np.concatenate(column) for column in zip(*parts, strict=True)))
    N = 600
    tracks = TrackRows(
        np.arange(N), np.arange(N), np.sort(rng.uniform(-5.0, 125.0, N)),
        rng.uniform(-70.0, 70.0, (N, 2)), np.zeros((N, 2)), np.zeros((N, 4, 4)),
    )  # fmt: skip
    found = candidates(tracks, real, RADIUS, slack=3.0)
    expected = []
    for contact in range(12):
        path = real.of_contact(contact)
        apart = np.linalg.norm(tracks.position - path.at(tracks.time).position, axis=1)
        there = (tracks.time >= time[0] - 3.0) & (tracks.time <= time[-1] + 3.0)
        expected += [(int(row), contact) for row in np.flatnonzero(there & (apart <= RADIUS))]
    assert len(expected) > 100
    assert set(zip(found.row.tolist(), found.contact.tolist(), strict=True)) == set(expected)
    assert len(found) == len(expected)


@pytest.mark.parametrize(('n', 'm'), [(1, 1), (3, 4), (5, 3), (4, 4), (0, 2)])
def test_ospa_is_the_best_of_all_permutations(n: int, m: int) -> None:
    """On random distances the metric equals its definition by brute force."""
    distance = np.random.default_rng(n + 10 * m).uniform(0.0, 2.0, (n, m))
    for p in (1.0, 2.0):
        wide = distance if n <= m else distance.T
        least, most = wide.shape
        best = min(
            sum(min(wide[i, j], 1.0) ** p for i, j in enumerate(order))
            for order in permutations(range(most), least)
        )
        expected = ((best + most - least) / most) ** (1.0 / p)
        assert_allclose(ospa_of_distances(distance, 1.0, p).total, expected, rtol=1e-12)


def test_ospa_parts_add_up() -> None:
    """For power 1 localisation and cardinality are the total; of nothing the metric is 0."""
    parts = ospa_of_distances(np.random.default_rng(1).uniform(0.0, 2.0, (3, 5)), 1.0)
    assert_allclose(parts.total, parts.localisation + parts.cardinality)
    assert ospa_of_distances(np.zeros((0, 0)), 1.0).total == 0.0


def test_distances_of_scans_know_who_is_there() -> None:
    """A track 3 m from one of two contacts, then none, then a false one and a contact away."""
    real = truth((7, 0.0, range(3)), (8, 50.0, range(2)))
    tracks = rows((0, 1, 3.0, 0.0), (2, 9, 500.0, 0.0))
    near = candidates(tracks, real, RADIUS, 0.0)
    stretches = Stretches.of_truth(real, STARTS[:4])
    found = list(distances_of_scans(tracks, near, stretches, 3, RADIUS))
    assert [distance.tolist() for distance in found] == [[[3.0, RADIUS]], [], [[RADIUS]]]
    assert [distance.shape for distance in found] == [(1, 2), (0, 2), (1, 1)]


def test_consistency_of_right_covariances_is_in_its_band() -> None:
    """Of 200 sets of chi-square samples 95 % are inside, give or take three sigma."""
    rng = np.random.default_rng(5)
    found = [consistency(rng.chisquare(3, 400), 3) for _ in range(200)]
    inside = sum(item.is_inside for item in found)
    assert 190 - 9 <= inside <= 200
    assert_allclose(np.mean([item.inside for item in found]), 0.95, atol=0.01)
    assert not consistency(1.3 * rng.chisquare(3, 400), 3).is_inside


def test_consistency_leaves_out_what_is_not_there() -> None:
    """Tracks without a look have no innovation; of nothing nothing is said."""
    assert consistency(np.array([2.0, np.nan]), 2).mean == 1.0
    assert np.isnan(consistency(np.array([np.nan]), 2).mean)


def test_siap_counts_every_track_at_its_nearest_contact() -> None:
    """Two tracks on one of two contacts and one on none, in one scan."""
    real = truth((7, 0.0, range(1)), (8, 9.0, range(1)))
    tracks = rows((0, 1, 0.0, 1.0), (0, 2, 0.0, 3.0), (0, 3, 99.0, 0.0))
    found = siap(tracks, candidates(tracks, real, RADIUS, 0.0), Stretches.of_truth(real, STARTS))
    assert (found.completeness, found.ambiguity) == (0.5, 2.0)
    assert_allclose((found.spuriousness, found.position_accuracy), (1.0 / 3.0, 2.0))


def test_onset_delays_are_measured_from_the_beginning_of_the_turn() -> None:
    """The turn begins between samples 5 and 6 and is told in row 8: 2.5 s; the next never."""
    real = truth((7, 0.0, range(20)))
    turning = np.isin(np.arange(20), [6, 7, 8, 9, 15, 16, 17])
    real = Truth(real.id, real.time, real.position, real.velocity, turning)
    tracks = rows(*((k, 1, 0.0, 0.0) for k in range(20)))
    probability = np.where(np.isin(np.arange(20), [3, 8, 9, 12]), 0.9, 0.1)
    matches = match(tracks, real, RADIUS)
    assert_allclose(onset_delays(tracks, probability, matches, real), [2.5, np.nan])
    assert_allclose(false_alarms(probability, matches), 2.0 / 13.0)
    unknown = np.full(20, np.nan)  # of a tracker that tells none
    assert onset_delays(tracks, unknown, matches, real) == []
    assert np.isnan(false_alarms(unknown, matches))
