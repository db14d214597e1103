# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What reading rows has in common, whatever the sensor: columns, times, and what is left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from msg_adapters.angles import in_radians
from msg_adapters.bad_message import BadMessage
from msg_adapters.fields import find_fields, Names
from msg_adapters.kinds.menu import columns_of, tells_unit
from msg_adapters.message_types import frame_of, NANOSECONDS, stamp_of
from msg_adapters.row_checks import NO_NUMBER, OUT_OF_RANGE
from msg_adapters.table import Columns
from tracking_core.batches import Bearings, Bools, Floats, Plots

ABSOLUTE_TIME = 1e8  # s; a larger `time` counts from the epoch, not from the stamp

Rows = TypeVar('Rows', Plots, Bearings)


@dataclass(frozen=True)
class Reading(Generic[Rows]):
    """Plots of one message, and what there is to say about the rest of it."""

    plots: Rows
    dropped: dict[str, int]  # rows by reason
    doubtful: dict[str, int]  # values that were not used, or rows that contradict themselves
    mapping: dict[str, str]  # our field: theirs
    note: str = ''  # what a user may have meant otherwise, '' for nothing

    @property
    def is_polar(self) -> bool:
        """Whether the rows are directions from the sensor; otherwise they are places."""
        return 'bearing' in self.mapping or {'range', 'azimuth'} <= self.mapping.keys()


@dataclass(frozen=True)
class Fields:
    """A message by the names of our fields."""

    columns: Columns  # all of them, by their names
    mapping: dict[str, str]  # our field: theirs
    values: dict[str, Floats]  # ours, one number per row
    stamp: float  # of the message [s]
    time: Floats  # (M,) of each row [s]
    frame: str

    def __len__(self) -> int:
        return len(self.time)


def read_fields(
    msg: Any, max_rows: int, names: Names, overrides: Mapping[str, str], angle_unit: str
) -> Fields:
    """
    Return a message of any type on the menu by the names of our fields, angles in radians.

    Raises
    ------
    BadMessage
        For another type, sizes that do not fit, fields that the user named and that are not
        there, and for degrees where radians should be.

    """
    columns = columns_of(msg, max_rows)
    mapping = find_fields(columns, names, overrides)
    with np.errstate(invalid='ignore'):  # a signalling NaN becomes just a NaN
        values = {ours: _numbers(columns, theirs) for ours, theirs in mapping.items()}
        values = in_radians(values, 'rad' if tells_unit(msg) else angle_unit)
    stamp = stamp_of(msg)
    rows = len(next(iter(columns.values()))) if columns else msg.width * msg.height
    offset = _offset(values, columns, mapping, stamp, rows)
    return Fields(columns, mapping, values, stamp, stamp + offset, frame_of(msg))


def _numbers(columns: Columns, name: str) -> Floats:
    values = columns[name]
    if values.ndim != 1:
        raise BadMessage('bad field', f'field {name} has count {values.shape[1]}, not 1')
    return np.add(values, 0.0, dtype=np.float64)


def _offset(
    values: Mapping[str, Floats],
    columns: Columns,
    mapping: Mapping[str, str],
    stamp: float,
    rows: int,
) -> Floats:
    """Return the time of each row after the stamp [s]."""
    if 'time' not in values:
        return np.zeros(rows)
    time, kind = values['time'], columns[mapping['time']].dtype
    if kind.kind in 'iu':
        return time / NANOSECONDS
    absolute = (time > ABSOLUTE_TIME) & (kind == np.float64)
    return np.where(absolute, time - stamp, time)


def refuse_if_useless(msg: Any, keep: Bools, dropped: Mapping[str, int]) -> None:
    """
    Raise BadMessage where no row (M,) is left for other reasons than the sensor's limits.

    Rows without a number are none either where the message says that not all are points.
    """
    reasons = [reason for reason in dropped if not reason.startswith(OUT_OF_RANGE)]
    if not getattr(msg, 'is_dense', True):
        reasons = [reason for reason in reasons if not reason.endswith(NO_NUMBER)]
    if not keep.any() and reasons:
        # Not the same as a scan that saw nothing: tracks must not miss it.
        told = ', '.join(f'{reason} ({count})' for reason, count in dropped.items())
        raise BadMessage('no usable row', f'none of {len(keep)} rows can be used: {told}')
