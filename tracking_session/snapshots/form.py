# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is a tree of values of the form that this program would have made itself?"""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


def check_form(value: Any, like: Any, name: str = 'snapshot') -> None:
    """
    Raise ValueError unless a value has the form of another.

    The same kinds and names throughout, arrays of the same numbers and columns; rows may differ,
    but are as many in all arrays of one batch. What is None in one of the two may be anything in
    the other.
    """
    if value is None or like is None:
        return
    if type(value) is not type(like) and not _are_numbers(value, like):
        raise ValueError(f'{name} is a {type(value).__name__}, not a {type(like).__name__}')
    for kind, check in _CHECKS.items():
        if isinstance(like, kind):
            check(value, like, name)
    if is_dataclass(like):
        _check_batch(value, like, name)


def _check_array(value: Any, like: Any, name: str) -> None:
    if value.dtype != like.dtype or value.shape[1:] != like.shape[1:]:
        raise ValueError(f'{name} is {value.dtype} {value.shape}, not as {like.shape}')


def _check_dict(value: Any, like: Any, name: str) -> None:
    if value.keys() != like.keys():
        raise ValueError(f'{name} has {sorted(value)}, not {sorted(like)}')
    for key in like:
        check_form(value[key], like[key], f'{name}.{key}')


def _check_tuple(value: Any, like: Any, name: str) -> None:
    if len(value) != len(like):
        raise ValueError(f'{name} has {len(value)} parts, not {len(like)}')
    for number, (one, other) in enumerate(zip(value, like, strict=True)):
        check_form(one, other, f'{name}.{number}')


def _check_batch(value: Any, like: Any, name: str) -> None:
    for f in fields(like):
        check_form(getattr(value, f.name), getattr(like, f.name), f'{name}.{f.name}')
    _check_rows(value, name)


_CHECKS = {np.ndarray: _check_array, dict: _check_dict, tuple: _check_tuple}


def _are_numbers(value: Any, like: Any) -> bool:
    return all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in (value, like))


def _check_rows(batch: Any, name: str) -> None:
    """Raise ValueError unless all arrays of a batch have as many rows."""
    parts = [getattr(batch, f.name) for f in fields(batch)]
    arrays = [part for part in parts if isinstance(part, np.ndarray)]
    if type(batch).__name__ != 'StepReport' and len({len(part) for part in arrays}) > 1:
        raise ValueError(f'{name} has columns of different lengths')
