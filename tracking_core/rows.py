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
    return cast('Batch', _each(batch, lambda array: array[rows]))


def concatenate(first: Batch, second: Batch) -> Batch:
    """Return one batch with the rows of both; what is not an array comes from the second."""
    return cast('Batch', _each(second, lambda new, old: np.concatenate([old, new]), first))


def put(batch: Batch, rows: NDArray[Any], part: Batch) -> Batch:
    """Return the batch with these rows replaced by the rows of `part`."""
    return cast('Batch', _each(batch, lambda old, new: _put(old, rows, new), part))


def _put(old: NDArray[Any], rows: NDArray[Any], new: NDArray[Any]) -> NDArray[Any]:
    if len(new) == len(old):
        return new
    result = old.copy()
    result[rows] = new
    return result


def _each(value: Any, change: Callable[..., Any], *others: Any) -> Any:
    """Apply `change` to every array of a dataclass, of those in it and in its tuples."""
    if isinstance(value, np.ndarray):
        return change(value, *others)
    if isinstance(value, (int, float, str)) or value is None:
        return value
    if isinstance(value, tuple):
        return tuple(_each(*(v[0], change, *v[1:])) for v in zip(value, *others, strict=True))
    if not is_dataclass(value):
        return value
    kind: Any = type(value)
    return kind(
        *(
            _each(getattr(value, name), change, *(getattr(o, name) for o in others))
            for name in _names(kind)
        )
    )


@lru_cache(maxsize=64)
def _names(batch: type) -> tuple[str, ...]:
    return tuple(f.name for f in fields(batch))
