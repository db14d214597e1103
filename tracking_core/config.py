# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How is a parameter written once? A dataclass field with unit, meaning and range beside it.

`parameters` walks nested config dataclasses into dotted names, `with_values` builds a config from
such names; both serve nodes, replay, documentation and tests alike.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from difflib import get_close_matches
from typing import Any, TypeVar

import numpy as np

Config = TypeVar('Config')
CLOSE = 0.88  # likeness of a name and the one that was meant, 0 to 1
LARGEST = 1e15  # number without a limit of its own: its powers up to the tenth stay numbers
MOST = 64  # values of one parameter: matrices of modes grow with the square of their number


@dataclass(frozen=True)
class Parameter:
    """One parameter as a user sees it."""

    name: str  # dotted
    value: Any
    unit: str
    doc: str
    low: float | None
    high: float | None
    choices: tuple[str, ...]
    live: bool  # may change while the node runs


def parameter(
    default: Any,
    *,
    unit: str,
    doc: str,
    low: float | None = None,
    high: float | None = None,
    choices: tuple[str, ...] = (),
    live: bool = False,
) -> Any:
    """Return a dataclass field with its unit, meaning and limits [low, high] as metadata."""
    meta = {
        'unit': unit, 'doc': doc, 'low': low, 'high': high, 'choices': choices, 'live': live,
    }  # fmt: skip
    return field(default=default, metadata=meta)


def validate(config: Any) -> None:
    """
    Check every parameter of one config dataclass against its type, limits and choices.

    Raises
    ------
    ValueError
        Says field, allowed and got.

    """
    for f in fields(config):
        if 'unit' in f.metadata:
            _check(f'{type(config).__name__}.{f.name}', getattr(config, f.name), f)


def check_quiet_first(config: Any, name: str, calm: Collection[float] | None = None) -> None:
    """Refuse modes of which a later one is quieter than the first; `calm`: compare these only."""
    values = getattr(config, name)
    if values and values[0] > min(values if calm is None else calm):
        raise ValueError(
            f'{type(config).__name__}.{name} must be least in the first mode, the quiet one, '
            f'got {list(values)}'
        )


def _check(name: str, value: Any, f: Any) -> None:
    meta = f.metadata
    if meta['choices'] and value not in meta['choices']:
        raise ValueError(f'{name} must be one of {", ".join(meta["choices"])}, got {value!r}')
    for number in _numbers(name, value, f):
        if isinstance(f.default, (str, bool)):
            if not isinstance(number, type(f.default)):
                raise ValueError(f'{name} must be a {type(f.default).__name__}, got {number!r}')
            continue
        if not isinstance(number, (int, float)) or isinstance(number, bool):
            raise ValueError(f'{name} must be a number, got {number!r}')
        if isinstance(f.default, int) and not isinstance(number, int):
            raise ValueError(f'{name} must be a whole number, got {number!r}')
        low = -LARGEST if meta['low'] is None else meta['low']
        high = LARGEST if meta['high'] is None else meta['high']
        if not low <= number <= high:
            limits = with_unit(f'[{low}, {high}]', meta['unit'])
            raise ValueError(f'{name} must be in {limits}, got {number}')


def with_unit(figure: str, unit: str) -> str:
    """Return a figure as it stands in a text: plain numbers, of the unit '1', have none."""
    return figure if unit in ('', '1') else f'{figure} {unit}'


def _numbers(name: str, value: Any, f: Any) -> tuple[Any, ...]:
    if not isinstance(f.default, tuple):
        return (value,)
    if len(value) > MOST:
        raise ValueError(f'{name} takes at most {MOST} values, got {len(value)}')
    return tuple(value)


def parameters(config: Any, prefix: str = '') -> Iterator[Parameter]:
    """Yield every parameter of a config and of the configs nested in it, in order."""
    for f in fields(config):
        value = getattr(config, f.name)
        if is_dataclass(value):
            yield from parameters(value, f'{prefix}{f.name}.')
        else:
            m = f.metadata
            yield Parameter(
                prefix + f.name, value, m['unit'], m['doc'], m['low'], m['high'], m['choices'],
                m['live'],
            )  # fmt: skip


def with_values(config: Config, values: Mapping[str, Any]) -> Config:
    """
    Return the config with these parameters set, by dotted name.

    An int is accepted for a float and a list for a tuple.

    Raises
    ------
    ValueError
        For an unknown name (the nearest known one is named) or a value outside its limits, by
        dotted name.

    """
    known = [p.name for p in parameters(config)]
    for name in values:
        if name not in known:
            raise ValueError(f'unknown parameter {name}{hint(name, known)}')
    return _with_values(config, dict(values), '')


def hint(name: str, known: Collection[str]) -> str:
    """Return which known name was probably meant, as the end of a sentence, or ''."""
    near = get_close_matches(name, sorted(known), 1, CLOSE) or [
        other for other in sorted(known) if other.endswith(f'.{name}')
    ]
    return f'; did you mean {" or ".join(near)}?' if near else ''


def _with_values(config: Config, values: dict[str, Any], prefix: str) -> Config:
    changed: dict[str, Any] = {}
    for f in fields(config):  # type: ignore[arg-type]
        old = getattr(config, f.name)
        if is_dataclass(old):
            changed[f.name] = _with_values(old, values, f'{prefix}{f.name}.')
        elif prefix + f.name in values:
            changed[f.name] = coerce(values[prefix + f.name], old)
    try:
        return replace(config, **changed)  # type: ignore[type-var]
    except ValueError as error:
        raise ValueError(_by_dotted_name(str(error), type(config).__name__, prefix)) from error


def _by_dotted_name(text: str, kind: str, prefix: str) -> str:
    """Return what a config of a kind says of its parameters, by the names that users know."""
    return text.replace(f'{kind}.', prefix).replace(f'{kind}: ', f'{prefix[:-1]}: ')


def coerce(value: Any, like: Any) -> Any:
    """Return the value in the type of `like`: int to float, list or array to tuple."""
    if isinstance(like, tuple):
        items = list(value) if np.iterable(value) and not isinstance(value, str) else [value]
        return tuple(coerce(item, like[0]) if like else item for item in items)
    if isinstance(like, float) and isinstance(value, int) and not isinstance(value, bool):
        return float(value) if abs(value) <= LARGEST else value
    return value
