# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the marks of a sonar come out of a PointCloud2; compass angles end here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from msg_adapters.azimuths import anticlockwise
from msg_adapters.bad_message import BadMessage
from msg_adapters.fields import BEARINGS, describe
from msg_adapters.kinds.menu import is_single
from msg_adapters.reading import read_fields, Reading, refuse_if_useless
from msg_adapters.row_checks import bearing_checks, choose_rows, usable_values
from tracking_core.batches import Bearings
from tracking_core.linalg import wrap_angle
from tracking_core.rows import take

_SINGLE = (
    'each message is one bearing, and taken for all that a cycle heard: if there are several '
    'contacts, set scan.period to the time in which each of them is told once'
)


class Convention(Protocol):
    """What must be known of a sonar to read its marks."""

    @property
    def angle_unit(self) -> str:
        """Return 'rad' or 'deg'."""

    @property
    def azimuth_convention(self) -> str:
        """Return 'enu', 'compass' or 'clockwise'."""


def to_bearings(
    msg: Any,
    sensor: Convention,
    max_marks: int,
    overrides: Mapping[str, str] | None = None,
) -> Reading[Bearings]:
    """
    Return the marks of one cycle from a PointCloud2.

    Parameters
    ----------
    msg : PointCloud2
        With `bearing`, perhaps `bearing_sd`, `snr` and `time`.
    sensor : Convention
        How bearings are counted.
    max_marks : int
        A message with more rows is refused.
    overrides : mapping, optional
        Our field names to theirs.

    Raises
    ------
    BadMessage
        For sizes that do not fit or a bearing that is missing; says which.

    """
    message = read_fields(msg, max_marks, BEARINGS, overrides or {}, sensor.angle_unit)
    if len(message) and 'bearing' not in message.values:
        raise BadMessage('missing field', f'field bearing is missing; {describe(message.columns)}')
    told, doubtful = usable_values(message.values)
    nothing = np.full(len(message), np.nan)
    bearing = anticlockwise(message.values.get('bearing', nothing), sensor.azimuth_convention)
    marks = Bearings(
        time=message.time,
        bearing=bearing,
        bearing_sd=told.get('bearing_sd', nothing),
        snr=told.get('snr', nothing),
        stamp=message.stamp,
        frame=message.frame,
    )
    keep, dropped = choose_rows(marks, bearing_checks(bearing))
    refuse_if_useless(msg, keep, dropped)
    marks = take(marks, keep)
    marks = replace(marks, bearing=wrap_angle(marks.bearing))
    note = _SINGLE if is_single(msg) else ''
    return Reading(marks, dropped, doubtful, message.mapping, note)
