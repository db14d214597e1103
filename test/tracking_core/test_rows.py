# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of batches within batches are taken, joined and replaced all alike."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from tracking_core.batches import Floats, Ints
from tracking_core.rows import concatenate, put, take


@dataclass(frozen=True)
class _Inner:
    """One array and something that is none."""

    value: Floats  # (T, 2)
    name: str


@dataclass(frozen=True)
class _Outer:
    """Arrays at every depth."""

    id: Ints  # (T,)
    inner: _Inner
    parts: tuple[_Inner, ...]


def batch(ids: list[int], name: str = 'a') -> _Outer:
    """Return a batch in which every value tells its id."""
    number = np.array(ids, np.int64)
    inner = _Inner(np.stack([number, 10.0 * number], axis=1), name)
    return _Outer(number, inner, (inner, inner))


def assert_is(result: _Outer, ids: list[int], name: str) -> None:
    """Check the rows at every depth."""
    assert_array_equal(result.id, ids)
    for inner in (result.inner, *result.parts):
        assert_array_equal(inner.value, batch(ids).inner.value)
        assert inner.name == name
    assert len(result.parts) == 2


@pytest.mark.parametrize(
    ('rows', 'ids'),
    [
        (np.array([True, False, True]), [5, 7]),
        (np.array([True, True, True]), [5, 6, 7]),
        (np.array([False, False, False]), []),
        (np.array([2, 0, 0]), [7, 5, 5]),
        (slice(0, 2), [5, 6]),
    ],
)
def test_take_indexes_every_array(rows: Ints | slice, ids: list[int]) -> None:
    """By mask, by number or by slice."""
    assert_is(take(batch([5, 6, 7]), rows), ids, 'a')


def test_concatenate_keeps_what_is_no_array_of_the_second() -> None:
    """Rows of the first come first."""
    assert_is(concatenate(batch([1, 2], 'first'), batch([3], 'second')), [1, 2, 3], 'second')


def test_put_replaces_rows_and_leaves_the_old_batch_alone() -> None:
    """Some rows, then all of them."""
    old = batch([1, 2, 3])
    assert_is(put(old, np.array([0, 2]), batch([8, 9], 'new')), [8, 2, 9], 'a')
    assert_is(put(old, np.arange(3), batch([7, 8, 9], 'new')), [7, 8, 9], 'a')
    assert_is(old, [1, 2, 3], 'a')
