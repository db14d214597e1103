# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are rows of a batch taken, joined and replaced, whatever arrays the batch holds?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any, cast, TypeVar

import numpy as np
from numpy.typing import NDArray

Batch = TypeVar('Batch')


def take(batch: Batch, rows: NDArray[Any] | slice) -> Batch:
    """Return the batch of these rows: every array is indexed, everything else is kept."""
    if isinstance(rows, np.ndarray) and rows.dtype == np.bool_:
        if rows.all():
            return batch  # the usual case: nothing was deleted, all were passed
        rows = rows.nonzero()[0]
    return cast('Batch', _take(batch, rows))


def concatenate(first: Batch, second: Batch) -> Batch:
    """Return one batch with the rows of both; what is not an array comes from the second."""
    return cast('Batch', _join(second, first, _append))


def put(batch: Batch, rows: NDArray[Any], part: Batch) -> Batch:
    """Return the batch with these rows replaced by the rows of `part`."""

    def replace(old: NDArray[Any], new: NDArray[Any]) -> NDArray[Any]:
        if len(new) == len(old):
            return new
        result = old.copy()
        result[rows] = new
        return result

    return cast('Batch', _join(batch, part, replace))


def _append(new: NDArray[Any], old: NDArray[Any]) -> NDArray[Any]:
    return np.concatenate([old, new])


def _take(value: Any, rows: NDArray[Any] | slice) -> Any:
    """Index every array of a dataclass, of those in it and in its tuples."""
    if isinstance(value, np.ndarray):
        return value[rows] if isinstance(rows, slice) else value.take(rows, axis=0)
    if isinstance(value, tuple):
        return tuple([_take(part, rows) for part in value])
    kind: Any = type(value)
    names = _names(kind)
    return kind(*[_take(getattr(value, n), rows) for n in names]) if names else value


def _join(value: Any, other: Any, join: Callable[..., NDArray[Any]]) -> Any:
    """Join every array of a dataclass with that of another of the same kind."""
    if isinstance(value, np.ndarray):
        return join(value, other)
    if isinstance(value, tuple):
        return tuple([_join(*both, join) for both in zip(value, other, strict=True)])
    kind: Any = type(value)
    names = _names(kind)
    if not names:
        return value
    return kind(*[_join(getattr(value, n), getattr(other, n), join) for n in names])


@lru_cache(maxsize=64)
def _names(kind: type) -> tuple[str, ...]:
    """Return the fields of a dataclass, none for any other type."""
    return tuple(f.name for f in fields(kind)) if is_dataclass(kind) else ()
