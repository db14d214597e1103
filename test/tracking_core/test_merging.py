# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Two tracks on one contact become one."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from tracking_core.batches import Mixture, Tracks
from tracking_core.merging import duplicates
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
        history=np.zeros(T, np.int64),
        gate_size=np.zeros((T, 2)),
        gate_volume=zero,
        nis=zero,
        doubled=np.zeros(len(zero), np.int64),
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
    """A track that was seen two seconds later is two seconds further on."""
    tracks = make_tracks([[0, 100, 0, 0], [200, 100, 0, 0]], time=[0.0, 2.0])
    assert_array_equal(duplicates(tracks, 1.0), [False, False])
    near = make_tracks([[0, 10, 0, 0], [20, 10, 0, 0]], time=[0.0, 2.0])
    assert_array_equal(duplicates(near, 1.0), [False, True])


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
