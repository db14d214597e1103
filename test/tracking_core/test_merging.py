# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Two tracks on one contact become one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from tracking_core.batches import Mixture, Tracks
from tracking_core.lifecycle_config import MergeConfig
from tracking_core.merging import duplicates, end_doubles
from tracking_core.rows import take


def make_tracks(state, sd=20.0, time=0.0, confirmed=False, hits=5) -> Tracks:
    """Tracks at these states (x, vx, y, vy), position sd in m, velocity sd a tenth of it."""
    state = np.atleast_2d(np.asarray(state, float))
    T = len(state)
    scale = np.broadcast_to(np.asarray(sd, float), T)[:, None] * np.array([1.0, 0.1, 1.0, 0.1])
    mixture = Mixture(
        state[:, None], (scale[:, :, None] ** 2 * np.eye(4))[:, None], np.ones((T, 1)),
        np.zeros((T, 0)),
    )  # fmt: skip
    zero = np.zeros(T)
    return Tracks(
        id=1 + np.arange(T),
        time=np.broadcast_to(np.asarray(time, float), T).copy(),
        birth_time=zero,
        planes=(mixture,),
        existence_probability=zero,
        confirmed=np.broadcast_to(confirmed, T).copy(),
        hits=np.broadcast_to(np.asarray(hits), T).copy(),
        misses=np.zeros(T, np.int64),
        outside=np.zeros(T, np.int64),
        history=np.zeros(T, np.int64),
        gate_size=np.zeros((T, 2)),
        gate_volume=zero,
        nis=zero,
        doubled=np.zeros(len(zero), np.int64),
        level=zero,
    )


def test_duplicates_leave_one_of_two() -> None:
    """The younger of two equal ones goes; others stay."""
    tracks = make_tracks([[0, 10, 0, 0], [500, 10, 0, 0], [3, 10, 0, 0]])
    assert_array_equal(duplicates(tracks, 1.0), [False, False, True])


@pytest.mark.parametrize(
    ('better', 'lost'),
    [
        ({'confirmed': [False, True], 'hits': [9, 1]}, [True, False]),
        ({'hits': [4, 5]}, [True, False]),
        ({'hits': [5, 5]}, [False, True]),
    ],
)
def test_duplicates_keep_the_surer_track(better, lost) -> None:
    """Confirmed before tentative, then more hits, then the older."""
    tracks = make_tracks([[0, 10, 0, 0], [3, 10, 0, 0]], **better)
    assert_array_equal(duplicates(tracks, 1.0), lost)


def test_duplicates_compare_at_the_same_time() -> None:
    """At one place two seconds apart is 200 m apart; a little further on is the same contact."""
    behind = make_tracks([[0, 100, 0, 0], [0, 100, 0, 0]], time=[0.0, 2.0])
    assert_array_equal(duplicates(behind, 1.0), [False, False])
    same = make_tracks([[0, 25, 0, 0], [50, 25, 0, 0]], time=[0.0, 2.0])
    assert_array_equal(duplicates(same, 1.0), [False, True])


def test_duplicates_need_equal_velocities() -> None:
    """Contacts that cross are two."""
    tracks = make_tracks([[0, 100, 0, 0], [3, -100, 0, 0]])
    assert not duplicates(tracks, 1.0).any()


def test_duplicates_can_be_switched_off() -> None:
    """A distance of 0 keeps all; so do batches of none and of one."""
    tracks = make_tracks([[0, 10, 0, 0], [0, 10, 0, 0]])
    assert not duplicates(tracks, 0.0).any()
    assert not duplicates(take(tracks, slice(0, 1)), 1.0).any()
    assert len(duplicates(take(tracks, slice(0, 0)), 1.0)) == 0


@pytest.mark.parametrize('order', [[0, 1], [1, 0]])
def test_duplicates_do_not_mind_the_order(order: list[int]) -> None:
    """A sharp old track and a vague new one: whichever stands first."""
    tracks = make_tracks([[0, 10, 0, 0], [60, 10, 0, 0]], sd=[10.0, 100.0], hits=[9, 2])
    assert_array_equal(
        duplicates(take(tracks, np.array(order)), 1.0), np.array([False, True])[order]
    )


def looks_until_gone(tracks: Tracks, passed: list[bool]) -> int:
    """Return after how many looks a double goes, 99 for never."""
    for look, is_passed in enumerate(passed, start=1):
        tracks, ended = end_doubles(tracks, np.full(2, is_passed), MergeConfig(looks=3))
        if ended.any():
            assert_array_equal(ended, [False, True])
            return look
    return 99


def test_end_doubles_waits_for_confirmed_ones() -> None:
    """A tentative double goes at once, a confirmed one after three looks in a row."""
    states = [[0, 10, 0, 0], [3, 10, 0, 0]]
    tentative = make_tracks(states, confirmed=[True, False])
    assert looks_until_gone(tentative, [True]) == 1
    both = make_tracks(states, confirmed=True)
    assert looks_until_gone(both, [True] * 5) == 3
    assert looks_until_gone(both, [True, False, False, True, True]) == 5


def test_end_doubles_forgets_those_that_part() -> None:
    """Contacts that cross are apart again before three looks, and the count starts anew."""
    near = make_tracks([[0, 10, 0, 0], [3, 10, 0, 0]], confirmed=True)
    apart = make_tracks([[0, 10, 0, 0], [900, 10, 0, 0]], confirmed=True)
    config, passed = MergeConfig(looks=3), np.ones(2, bool)
    for _ in range(2):
        near, ended = end_doubles(near, passed, config)
        assert not ended.any()
    parted, _ = end_doubles(replace(apart, doubled=near.doubled), passed, config)
    assert_array_equal(near.doubled, [0, 2])
    assert_array_equal(parted.doubled, [0, 0])


@pytest.mark.parametrize(('apart', 'looks'), [(1, 3), (15, 8)])
def test_end_doubles_spares_contacts_that_were_apart_before(apart: int, looks: int) -> None:
    """Of unresolved contacts one goes after a double's third of its plots, at least three."""
    tracks = make_tracks([[0, 10, 0, 0], [3, 10, 0, 0]], confirmed=True, hits=[99, apart])
    for look in range(1, looks + 1):
        tracks = replace(tracks, hits=tracks.hits + 1)
        tracks, ended = end_doubles(
            tracks, np.ones(2, bool), MergeConfig(looks=3), is_unresolved=True
        )
        assert_array_equal(ended, [False, look == looks])


@pytest.mark.parametrize(
    ('nis', 'confirmed', 'own', 'is_double'),
    [
        ([1.0, 1.0], True, True, False),
        ([1.0, np.nan], True, True, True),
        ([1.0, 1.0], [True, False], True, True),
        ([1.0, 1.0], True, False, True),
    ],
)
def test_duplicates_have_one_plot_between_them(nis, confirmed, own, is_double) -> None:
    """Confirmed tracks with a plot each are two contacts, unless a plot may be that of both."""
    tracks = make_tracks([[0, 10, 0, 0], [3, 10, 0, 0]], confirmed=confirmed)
    tracks = replace(tracks, nis=np.array(nis))
    found = duplicates(tracks, 1.0, has_own_plots=own)
    assert_array_equal(found, [False, is_double])


def test_duplicates_of_three_in_one_place_are_ended_by_any_plots() -> None:
    """As a jammer makes them, which has a plot for each; a tentative third does not count."""
    tracks = make_tracks([[0, 10, 0, 0], [3, 10, 0, 0], [0, 10, 3, 0]], confirmed=True)
    tracks = replace(tracks, nis=np.ones(3))
    assert_array_equal(duplicates(tracks, 1.0, has_own_plots=True), [False, True, True])
    two = replace(tracks, confirmed=np.array([True, True, False]))
    assert_array_equal(duplicates(two, 1.0, has_own_plots=True), [False, False, True])
