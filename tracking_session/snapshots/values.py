# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do batches become JSON and bytes, and bytes batches? Known kinds of values only, never code.

Numbers, texts, None, tuples, lists, dictionaries, arrays of numbers, and the dataclasses in
`CLASSES`, which are built by their constructors.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from math import prod
from typing import Any

import numpy as np

from tracking_core.batches import (
    Bearings,
    Coverage,
    Mixture,
    Plots,
    Scan,
    Seeds,
    Tracks,
)  # fmt: skip
from tracking_core.bends import Bends, Followed
from tracking_core.clutter import Clutter
from tracking_core.clutter_map import ClutterMap
from tracking_core.scatter import Scatter
from tracking_core.state import State, StepReport

CLASSES = {
    kind.__name__: kind
    for kind in (
        Bearings,
        Bends,
        Clutter,
        ClutterMap,
        Coverage,
        Followed,
        Mixture,
        Plots,
        Scan,
        Scatter,
        Seeds,
        State,
        StepReport,
        Tracks,
    )
}
DTYPES = ('|b1', '<i8', '<f8')  # truth, whole numbers, numbers: all that batches have


def to_plain(value: Any, arrays: list[Any]) -> Any:
    """
    Return a value as JSON knows it; arrays are added to the list, in order.

    Raises
    ------
    TypeError
        For a value of another kind.

    """
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, np.ndarray):
        if value.dtype.str not in DTYPES:
            raise TypeError(f'arrays of {value.dtype} cannot be kept')
        arrays.append(value)
        return {'array': [value.dtype.str, *value.shape]}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (tuple, list)):
        name = 'tuple' if isinstance(value, tuple) else 'list'
        return {name: [to_plain(item, arrays) for item in value]}
    if isinstance(value, dict):
        return {'dict': {name: to_plain(item, arrays) for name, item in value.items()}}
    if is_dataclass(value) and type(value).__name__ in CLASSES:
        of = {f.name: to_plain(getattr(value, f.name), arrays) for f in fields(value)}
        return {'class': type(value).__name__, 'of': of}
    raise TypeError(f'{type(value).__name__} cannot be kept')


def from_plain(plain: Any, data: memoryview) -> tuple[Any, int]:
    """
    Return the value, and how many bytes of the data its arrays have used.

    Raises
    ------
    ValueError, TypeError, KeyError
        For anything that `to_plain` does not make, or data that do not suffice.

    """
    reader = _Reader(data)
    return reader.value(plain), reader.used


class _Reader:
    """Takes the bytes of the arrays one after the other."""

    def __init__(self, data: memoryview) -> None:
        self._data, self.used = data, 0

    def value(self, plain: Any) -> Any:
        if not isinstance(plain, dict):
            return plain
        if 'array' in plain:
            return self._array(*plain['array'])
        if 'tuple' in plain:
            return tuple(self.value(item) for item in plain['tuple'])
        if 'list' in plain:
            return [self.value(item) for item in plain['list']]
        if 'dict' in plain:
            return {name: self.value(item) for name, item in plain['dict'].items()}
        kind: Any = CLASSES[plain['class']]
        return kind(**{name: self.value(item) for name, item in plain['of'].items()})

    def _array(self, dtype: str, *shape: int) -> Any:
        if dtype not in DTYPES or any(type(n) is not int or n < 0 for n in shape):
            raise ValueError(f'an array of {dtype} {shape}')
        size = np.dtype(dtype).itemsize * prod(shape)
        if size > len(self._data) - self.used:
            raise ValueError(f'an array of {size} bytes, more than are there')
        part = self._data[self.used : self.used + size]
        self.used += size
        return np.frombuffer(part, dtype).reshape(shape).copy()
