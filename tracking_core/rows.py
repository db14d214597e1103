# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How are rows of a batch taken, joined and replaced, whatever arrays the batch holds?

Arrays of more than one axis lie in memory with the rows innermost (order F): the same entry of
all the small matrices of a batch is one stretch, and numpy works along it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any, cast, TypeVar

import numpy as np
from numpy.typing import NDArray

Batch = TypeVar('Batch')

_PLAIN = ('float', 'int', 'bool', 'str', 'tuple[float, float, float]', 'Gaps')  # as annotated


def take(batch: Batch, rows: NDArray[Any] | slice) -> Batch:
    """Return the batch of these rows: every array is indexed, everything else is kept."""
    if isinstance(rows, np.ndarray) and rows.dtype == np.bool_:
        if np.count_nonzero(rows) == len(rows):
            return batch  # the usual case: nothing was deleted, all were passed
        rows = rows.nonzero()[0]
    return cast('Batch', _take(batch, rows))


def concatenate(first: Batch, second: Batch) -> Batch:
    """Return one batch with the rows of both; what is not an array comes from the second."""
    return cast('Batch', _join(second, first, _append))


def take_of_both(first: Batch, second: Batch, rows: NDArray[Any]) -> Batch:
    """Return these rows of two batches, where those of the second count on from the first."""
    return cast('Batch', _join(second, first, lambda new, old: take_rows(_append(new, old), rows)))


def put(batch: Batch, rows: NDArray[Any], part: Batch) -> Batch:
    """Return the batch with these rows, ascending, replaced by the rows of `part`."""

    def replace(old: NDArray[Any], new: NDArray[Any]) -> NDArray[Any]:
        if len(new) == len(old):
            return new
        result = old.copy('K')
        result[rows] = new
        return result

    return cast('Batch', _join(batch, part, replace))


def change(batch: Batch, **columns: Any) -> Batch:
    """Return what `dataclasses.replace` returns, in half its time."""
    kind: Any = type(batch)
    old, names = vars(batch), _names(kind)
    if len(old) > len(names):
        old = {name: old[name] for name in names}
    return cast('Batch', _batch(kind, {**old, **columns}))


def take_rows(values: NDArray[Any], rows: NDArray[Any] | slice) -> NDArray[Any]:
    """Return these rows of one array, innermost in memory."""
    if isinstance(rows, slice):
        return values[rows]
    return values.take(rows) if values.ndim == 1 else values.T.take(rows, axis=-1).T


def _append(new: NDArray[Any], old: NDArray[Any]) -> NDArray[Any]:
    return np.concatenate((old.T, new.T), axis=-1).T


def _take(value: Any, rows: NDArray[Any] | slice) -> Any:
    """Index every array of a dataclass, of those in it and in its tuples."""
    if type(value) is np.ndarray:
        return take_rows(value, rows)
    if type(value) is tuple:
        return tuple([_take(part, rows) for part in value])
    kind: Any = type(value)
    if not _is_batch(kind):
        return value
    # Most parts are arrays: a call for each is a third of the time.
    return _batch(kind, {
        name: take_rows(part, rows) if type(part) is np.ndarray else _take(part, rows)
        for name, part in vars(value).items()
    })  # fmt: skip


def _join(value: Any, other: Any, join: Callable[..., NDArray[Any]]) -> Any:
    """Join every array of a dataclass with that of another of the same kind."""
    if type(value) is np.ndarray:
        return join(value, other)
    if type(value) is tuple:
        return tuple([_join(*both, join) for both in zip(value, other, strict=True)])
    kind: Any = type(value)
    if not _is_batch(kind):
        return value
    one, two = vars(value), vars(other)
    joined = {name: _join(part, two[name], join) for name, part in one.items() if name in two}
    return _batch(kind, joined)


def _batch(kind: type, columns: dict[str, Any]) -> Any:
    """Return what `kind(**columns)` returns; a frozen dataclass takes twice the time for it."""
    batch: Any = object.__new__(kind)
    vars(batch).update(columns)
    return batch


@lru_cache(maxsize=64)
def _names(kind: type) -> tuple[str, ...]:
    """Return the fields; beside them an instance may hold what it worked out."""
    return tuple(f.name for f in fields(kind))


@lru_cache(maxsize=64)
def _is_batch(kind: type) -> bool:
    """Return whether this is a dataclass with more than numbers and words in it."""
    return is_dataclass(kind) and any(f.type not in _PLAIN for f in fields(kind))
