# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What can be wrong with the columns of a message, fault by fault?

Every fault takes columns and a random generator, and returns them spoilt.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msg_adapters.table import DATATYPES

Rng = np.random.Generator
Columns = dict[str, NDArray[Any]]

ODD_NUMBERS = np.array([
    np.nan, np.inf, -np.inf, -1.0, 0.0, -0.0, 1.0, 5e-324, 1e-300, 1e-9, 1e9, 1e30, -1e30, 1.7e308,
    np.pi, -np.pi, 2.0 * np.pi, 7.0, 359.0, 500.0, 2e4, 1e6, 2.0**31, 2.0**63,
])  # fmt: skip
ODD_TEXTS = (
    '', '/', 'radar', 'sonar', 'map', 'x', 'range', 'azimuth', 'bearing', 'time', 'RANGE', 'a\0b',
    'line\nbreak', '\x1b[31m', '測距', '%s%n{}', '../../etc', 'f' * 5000,
)  # fmt: skip
NAMES = (
    'range', 'azimuth', 'elevation', 'bearing', 'bearing_sd', 'x', 'y', 'z', 'range_rate', 'snr',
    'time', 'range_sd', 'azimuth_sd', 'elevation_sd', 'range_rate_sd', 'velocity', 'intensity',
)  # fmt: skip
MOST_ROWS = 300  # of one message; a few have more


def odd_values(kind: str, shape: tuple[int, ...], rng: Rng) -> NDArray[Any]:
    """Return odd numbers of this type: extremes, or any bits."""
    if rng.random() < 0.5:
        size = int(np.prod(shape)) * np.dtype(kind).itemsize
        return np.frombuffer(rng.bytes(size), kind).reshape(shape)
    with np.errstate(all='ignore'):
        return rng.choice(ODD_NUMBERS, shape).astype(kind)


def _any(names: Columns, rng: Rng) -> str:
    return str(rng.choice(list(names))) if names else ''


def _rows(columns: Columns) -> int:
    return len(next(iter(columns.values()))) if columns else 0


def _scatter(columns: Columns, rng: Rng) -> Columns:
    name = _any(columns, rng)
    if not name or not columns[name].size:
        return columns
    values = columns[name].copy()
    wrong = rng.random(values.shape) < rng.choice([0.1, 1.0])
    values[wrong] = odd_values(values.dtype.str, (int(wrong.sum()),), rng)
    return {**columns, name: values}


def _drop(columns: Columns, rng: Rng) -> Columns:
    gone = _any(columns, rng)
    return {name: values for name, values in columns.items() if name != gone}


def _rename(columns: Columns, rng: Rng) -> Columns:
    old, new = _any(columns, rng), str(rng.choice((*ODD_TEXTS, *NAMES)))
    return {new if name == old else name: values for name, values in columns.items()}


def _add(columns: Columns, rng: Rng) -> Columns:
    kind = str(rng.choice(list(DATATYPES.values())))
    tail = (int(rng.integers(2, 40)),) if rng.random() < 0.1 else ()
    return {**columns, str(rng.choice(NAMES)): odd_values(kind, (_rows(columns), *tail), rng)}


def _retype(columns: Columns, rng: Rng) -> Columns:
    name = _any(columns, rng)
    if not name:
        return columns
    with np.errstate(all='ignore'):
        values = columns[name].astype(str(rng.choice(list(DATATYPES.values()))))
    return {**columns, name: values}


def _repeat(columns: Columns, rng: Rng) -> Columns:
    rows = _rows(columns)
    count = int(rng.integers(0, MOST_ROWS)) if rng.random() < 0.98 else 30_000
    take = rng.integers(0, rows, count) if rows else np.zeros(0, np.int64)
    return {name: values[take] for name, values in columns.items()}


def _shuffle(columns: Columns, rng: Rng) -> Columns:
    return {name: values[rng.permutation(len(values))] for name, values in columns.items()}


OF_COLUMNS: tuple[Callable[[Columns, Rng], Columns], ...] = (
    _scatter, _scatter, _drop, _rename, _add, _retype, _repeat, _shuffle,
)  # fmt: skip
