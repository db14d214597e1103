# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Do the measures say what a person would count by hand?"""

from __future__ import annotations

from itertools import permutations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.batches import Floats, Mixture, Tracks
from tracking_tools.scoring import (
    confirmed_rows,
    gospa,
    gospa_of_scans,
    join_rows,
    match,
    PlotRows,
    Score,
    score,
    Stretches,
    TrackRows,
    Truth,
)

RADIUS = 10.0


def rows(*table: tuple[int, int, float, float], sd: float = 1.0) -> TrackRows:
    """Rows (scan, id, x, y), a scan each second, with the same sd on all four components."""
    scan, ids, x, y = (np.array(column) for column in zip(*table, strict=True))
    position = np.stack([x, y], axis=1).astype(float)
    return TrackRows(
        scan, ids, scan.astype(float), position, np.tile([1.0, 0.0], (len(ids), 1)),
        np.tile(sd**2 * np.eye(4), (len(ids), 1, 1)),
    )  # fmt: skip


def truth(*starts: float, scans: int = 6) -> Truth:
    """Contacts 0, 1, ... that fly east from x = 0 with 1 m/s at these y."""
    ids = np.repeat(np.arange(len(starts)), scans)
    time = np.tile(np.arange(float(scans)), len(starts))
    position = np.stack([time, np.repeat(starts, scans)], axis=1)
    return Truth.of(ids, time, position, np.tile([1.0, 0.0], (len(ids), 1)))


def all_wanted(real: Truth) -> Stretches:
    """Every contact in all its scans."""
    ids = np.unique(real.id)
    return Stretches(ids, np.zeros(len(ids), np.int64), np.full(len(ids), int(real.time.max())))


def judged(tracks: TrackRows, real: Truth) -> Score:
    """Score against plots that are 2 m off."""
    plots = PlotRows(real.time, real.position + np.array([0.0, 2.0]), real.id)
    return score(tracks, real, plots, all_wanted(real), RADIUS)


def test_score_of_one_perfect_track() -> None:
    """A track on its contact is held all the time by one id, without an error."""
    result = judged(rows(*((k, 7, float(k), 0.0) for k in range(6))), truth(0.0))
    c = result.continuity
    assert (c.held, c.switches, c.breaks, c.ghosts, c.purity) == (1.0, 0, 0, 0, 1.0)
    assert result.tracks.rmse == 0.0
    assert_allclose(result.plots.rmse, 2.0)


def test_score_counts_held_break_and_switch() -> None:
    """Held in scans 1, 2 by track 7 and in 4, 5 by track 8: 4 of 6, a break and a switch."""
    tracks = rows((1, 7, 1.0, 0.0), (2, 7, 2.0, 0.0), (4, 8, 4.0, 0.0), (5, 8, 5.0, 0.0))
    c = judged(tracks, truth(0.0)).continuity
    assert_allclose(c.held, 4.0 / 6.0)
    assert (c.breaks, c.switches, c.latency, c.tracks) == (1, 1, 1.0, 2)


def test_score_counts_a_swap_on_both_contacts() -> None:
    """Two tracks that change places are two switches, and half of their rows are impure."""
    table = [(k, 7 if k < 3 else 8, float(k), 0.0) for k in range(6)]
    table += [(k, 8 if k < 3 else 7, float(k), 30.0) for k in range(6)]
    c = judged(rows(*table), truth(0.0, 30.0)).continuity
    assert (c.switches, c.held, c.purity) == (2, 1.0, 0.5)


def test_score_counts_ghosts_of_five_rows() -> None:
    """A track far from everything is a ghost from its fifth row on, one that was near is not."""
    far = [(k, 9, 100.0, 100.0) for k in range(5)]
    short = [(k, 10, 100.0, 200.0) for k in range(4)]
    second = [(k, 11, float(k), 9.0 if k == 0 else 50.0) for k in range(6)]
    on_contact = [(k, 7, float(k), 0.0) for k in range(6)]
    c = judged(rows(*far, *short, *second, *on_contact), truth(0.0)).continuity
    assert c.ghosts == 1


def test_match_takes_the_pairs_with_the_least_sum() -> None:
    """The nearest pair is given up when the other contact would get no track."""
    matches = match(rows((0, 1, 0.0, 4.0), (0, 2, 0.0, 11.0)), truth(0.0, 5.0), RADIUS)
    assert dict(zip(matches.contact, matches.track, strict=True)) == {0: 1, 1: 2}


def test_match_prefers_the_nearer() -> None:
    """Two tracks that are near both contacts go to the nearer one each."""
    matches = match(rows((0, 1, 0.0, 4.0), (0, 2, 0.0, 1.0)), truth(0.0, 5.0), RADIUS)
    assert dict(zip(matches.contact, matches.track, strict=True)) == {0: 2, 1: 1}


def test_match_compares_with_the_truth_at_the_time_of_the_state() -> None:
    """A state half a second old is compared with where the contact was then."""
    tracks = rows((3, 7, 2.5, 0.0))
    tracks = TrackRows(
        tracks.scan, tracks.id, np.array([2.5]), tracks.position, tracks.velocity,
        tracks.covariance,
    )  # fmt: skip
    assert_allclose(match(tracks, truth(0.0), RADIUS).distance, [0.0], atol=1e-12)


def test_score_of_accuracy_by_hand() -> None:
    """Errors of 3 m and 4 m: rms 3.54 m; with sd 2 m the NEES per dimension is 12.5 / 8."""
    tracks = rows((0, 7, 3.0, 0.0), (1, 7, 1.0, 4.0), sd=2.0)
    result = judged(tracks, truth(0.0)).tracks
    assert_allclose(result.rmse, np.sqrt(12.5))
    assert_allclose(result.nees_position, 12.5 / 4.0 / 2.0)
    assert_allclose(result.nees_state, 12.5 / 4.0 / 4.0)
    assert result.rows == 2


def test_score_counts_a_look_once() -> None:
    """A track that was not looked at again is published again, but adds no error."""
    tracks = rows((0, 7, 3.0, 0.0), (1, 7, 3.0, 0.0))
    tracks = TrackRows(
        tracks.scan, tracks.id, np.zeros(2), tracks.position, tracks.velocity, tracks.covariance
    )
    result = judged(tracks, truth(0.0))
    assert result.tracks.rows == 1
    assert_allclose(result.continuity.held, 2.0 / 6.0)


def test_stretches_begin_with_the_fourth_plot() -> None:
    """A contact with plots in scans 1, 2, 4, 7, 9 is wanted from 7 to 9; with three, never."""
    contact = np.array([5, 5, 5, 5, 5, 6, 6, 6, -1])
    stretches = Stretches.of_plots(contact, np.array([1, 2, 4, 7, 9, 1, 2, 3, 4]))
    assert (stretches.id, stretches.first_scan, stretches.last_scan) == ([5], [7], [9])


def test_truth_between_samples_follows_a_turn() -> None:
    """On a circle sampled every 10 degrees the places between are right to 1e-5."""
    angle = np.deg2rad(np.arange(0.0, 91.0, 10.0))
    circle = Truth.of(
        np.zeros(len(angle), np.int64), angle, np.stack([np.cos(angle), np.sin(angle)], axis=1),
        np.stack([-np.sin(angle), np.cos(angle)], axis=1),
    )  # fmt: skip
    asked = np.deg2rad(np.arange(3.0, 90.0, 10.0))
    place = circle.at(asked).position
    assert_allclose(place, np.stack([np.cos(asked), np.sin(asked)], axis=1), atol=1e-5)


def test_confirmed_rows_have_positions_first() -> None:
    """States (x, vx, y, vy) and their covariances come out as (x, y, vx, vy)."""
    P = np.diag([1.0, 2.0, 3.0, 4.0])
    P[0, 1] = P[1, 0] = 0.5
    plane = Mixture(
        np.array([[[1.0, 10.0, 2.0, 20.0]]] * 2), np.array([[P]] * 2), np.ones((2, 1)),
        np.zeros((2, 0)),
    )  # fmt: skip
    number, value = np.arange(2), np.zeros(2)
    tracks = Tracks(
        id=number, time=value, birth_time=value, planes=(plane,), existence_probability=value,
        confirmed=np.array([False, True]), hits=number, misses=number, history=number,
        gate_size=np.zeros((2, 2)), gate_volume=value, nis=value,
        **dict.fromkeys(set(Tracks.__dataclass_fields__) - BASIC, number),
    )  # fmt: skip
    found = confirmed_rows(3, tracks)
    assert (found.scan.tolist(), found.id.tolist()) == ([3], [1])
    assert_allclose(np.concatenate([found.position, found.velocity], axis=1), [[1, 2, 10, 20]])
    assert_allclose(np.diag(found.covariance[0]), [1.0, 3.0, 2.0, 4.0])
    assert found.covariance[0, 0, 2] == 0.5
    assert len(join_rows([found, found])) == 2


BASIC = {
    'id', 'time', 'birth_time', 'planes', 'existence_probability', 'confirmed', 'hits', 'misses',
    'history', 'gate_size', 'gate_volume', 'nis',
}  # fmt: skip


def by_trial(estimates: Floats, contacts: Floats, c: float, p: float, alpha: float) -> float:
    """GOSPA by its definition: the best of all permutations."""
    if len(estimates) > len(contacts):
        estimates, contacts = contacts, estimates
    m, n = len(estimates), len(contacts)
    gap = np.linalg.norm(estimates[:, None] - contacts, axis=-1)
    best = min(
        sum(min(gap[i, j], c) ** p for i, j in enumerate(order))
        for order in permutations(range(n), m)
    )
    return float((best + c**p / alpha * (n - m)) ** (1.0 / p))


@pytest.mark.parametrize('alpha', [1.0, 2.0])
@pytest.mark.parametrize(('n', 'm'), [(0, 0), (0, 3), (2, 0), (1, 1), (3, 4), (5, 3), (4, 4)])
def test_gospa_is_the_best_of_all_permutations(n: int, m: int, alpha: float) -> None:
    """On random sets the metric equals its definition by brute force."""
    rng = np.random.default_rng(10 * n + m)
    for power in (1.0, 2.0):
        a, b = rng.normal(0.0, 1.0, (n, 2)), rng.normal(0.0, 1.0, (m, 2))
        total = gospa(a, b, cutoff=1.0, power=power, alpha=alpha).total
        assert_allclose(total, by_trial(a, b, 1.0, power, alpha), atol=1e-12)


def test_gospa_parts_add_up() -> None:
    """For alpha = 2 the total is localisation plus half the cutoff power for each error."""
    rng = np.random.default_rng(3)
    parts = gospa(rng.normal(0.0, 1.0, (5, 2)), rng.normal(0.0, 1.0, (4, 2)), cutoff=0.7)
    assert_allclose(parts.total**2, parts.localisation + 0.49 / 2.0 * (parts.missed + parts.false))


def test_gospa_tells_missed_from_false() -> None:
    """Three estimates of which one is near one of two contacts: one missed, two false."""
    estimates, contacts = np.array([[0.0], [50.0], [90.0]]), np.array([[3.0], [200.0]])
    parts = gospa(estimates, contacts, cutoff=10.0)
    assert (parts.localisation, parts.missed, parts.false) == (9.0, 1, 2)


def test_gospa_of_scans_by_hand() -> None:
    """A contact missed in scan 0 and found 3 m off in scan 1."""
    real = truth(0.0, scans=2)
    first, second = gospa_of_scans(rows((1, 7, 4.0, 0.0)), real, np.array([0.0, 1.0]), cutoff=10.0)
    assert_allclose([first.total, second.total], [np.sqrt(50.0), 3.0])
    assert (first.missed, second.missed, second.false) == (1, 0, 0)
