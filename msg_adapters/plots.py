# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How radar plots come out of a PointCloud2, and go into one.

Rows that cannot be right are dropped and counted by reason, so that one bad row costs nothing but
itself. Compass angles end here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from msg_adapters.azimuths import anticlockwise
from msg_adapters.bad_message import BadMessage
from msg_adapters.fields import AMBIGUOUS, describe, PLOTS
from msg_adapters.kinds.menu import is_single
from msg_adapters.message_types import MessageTypes
from msg_adapters.position_noise import position_covariance
from msg_adapters.reading import Fields, read_fields, Reading, refuse_if_useless
from msg_adapters.row_checks import choose_rows, plot_checks, usable_values
from msg_adapters.table import from_columns
from tracking_core.batches import Floats, Plots
from tracking_core.linalg import wrap_angle
from tracking_core.rows import take

OPTIONAL = ('range_sd', 'azimuth_sd', 'elevation_sd', 'range_rate_sd', 'range_rate', 'snr')
_SINGLE = (
    'each message is one plot, and taken for all that a look saw: if there are several contacts, '
    'set scan.assembly to snapshot and scan.period to the time in which each of them is told once'
)
DISAGREEMENT = 0.01  # of the range, between polar and Cartesian columns of one row


class Convention(Protocol):
    """What must be known of a sensor to read its plots."""

    @property
    def angle_unit(self) -> str:
        """Return 'rad' or 'deg'."""

    @property
    def azimuth_convention(self) -> str:
        """Return 'enu', 'compass' or 'clockwise'."""

    @property
    def range_rate_sign(self) -> int:
        """Return 1 where receding is positive."""

    @property
    def range_min(self) -> float:
        """Return the nearest range that counts [m]."""

    @property
    def range_max(self) -> float:
        """Return the farthest range that counts [m]."""


def to_plots(
    msg: Any,
    sensor: Convention,
    max_plots: int,
    overrides: Mapping[str, str] | None = None,
    longest: float = np.inf,
) -> Reading[Plots]:
    """
    Return the plots of a PointCloud2.

    Parameters
    ----------
    msg : PointCloud2
        Polar (`range`, `azimuth`) or Cartesian (`x`, `y`); polar wins when both are there.
    sensor : Convention
        Conventions and range limits.
    max_plots : int
        A message with more rows is refused.
    overrides : mapping, optional
        Our field names to theirs.
    longest : float
        Time between a plot and its message's stamp that can be true [s]; others are dropped.

    Raises
    ------
    BadMessage
        For sizes that do not fit or needed fields that are missing; says which.

    """
    message = read_fields(msg, max_plots, PLOTS, overrides or {}, sensor.angle_unit)
    read = message.values
    polar = {'range', 'azimuth'} <= read.keys()
    if not polar and len(message) and not {'x', 'y'} <= read.keys():
        missing = [name for name in ('range', 'azimuth') if name not in read]
        raise BadMessage(
            'missing field',
            f'field {" and ".join(missing)} is missing, and so is a pair x, y; '
            f'{describe(message.columns)}',
        )
    told, doubtful = usable_values(read)
    covariance, odd = position_covariance(read, len(message))
    doubtful |= {'covariance that is none': odd} if odd else {}
    plots = _assemble({**read, **told}, covariance, polar, message, sensor)
    checks = plot_checks(plots, polar, sensor.range_min, sensor.range_max)
    keep, dropped = choose_rows(plots, checks, longest)
    refuse_if_useless(msg, keep, dropped)
    plots = take(plots, keep)
    if polar:
        plots = replace(plots, azimuth=wrap_angle(plots.azimuth))
    if polar and 'x' in read:
        contradictions = _contradictions(plots)
        doubtful |= {'polar and x, y disagree': contradictions} if contradictions else {}
        plots = replace(plots, position=np.full((len(plots), 3), np.nan))
    return Reading(
        plots, dropped, doubtful, message.mapping, _SINGLE if is_single(msg) else _note(message)
    )


def _assemble(
    read: Mapping[str, Floats],
    covariance: Floats,
    polar: bool,
    message: Fields,
    sensor: Convention,
) -> Plots:
    """Return the plots of all rows, in our conventions, good and bad."""
    nothing = np.full(len(message), np.nan)
    azimuth = read['azimuth'] if polar else nothing
    position = np.stack([read.get(axis, nothing) for axis in 'xyz'], axis=1)
    return Plots(
        time=message.time,
        range=read['range'] if polar else nothing,
        azimuth=anticlockwise(azimuth, sensor.azimuth_convention),
        elevation=_elevation(read, position) if polar else nothing,
        position=position,
        position_covariance=covariance,
        range_rate=read.get('range_rate', nothing) * sensor.range_rate_sign,
        snr=read.get('snr', read.get('amplitude', nothing)),
        range_sd=read.get('range_sd', nothing),
        azimuth_sd=read.get('azimuth_sd', nothing),
        elevation_sd=read.get('elevation_sd', nothing),
        range_rate_sd=read.get('range_rate_sd', nothing),
        stamp=message.stamp,
        frame=message.frame,
    )


def _elevation(read: Mapping[str, Floats], position: Floats) -> Floats:
    """Return the elevation (M,), from x, y, z (M, 3) if there is none; all z are 0: no height."""
    x, y, z = position.T
    if 'elevation' in read or not np.nan_to_num(z).any():
        return read.get('elevation', np.full(len(z), np.nan))
    with np.errstate(over='ignore'):
        return np.asarray(np.arctan2(z, np.hypot(x, y)))


def _contradictions(plots: Plots) -> int:
    """Count the rows whose position is not where range and azimuth say."""
    x, y, z = np.nan_to_num(plots.position).T
    with np.errstate(over='ignore'):
        ground = np.hypot(x, y)
        off = np.minimum(abs(ground - plots.range), abs(np.hypot(ground, z) - plots.range))
    turned = abs(wrap_angle(np.arctan2(y, x) - plots.azimuth))
    return int(np.sum((off > DISAGREEMENT * plots.range) | (turned > DISAGREEMENT)))


def _note(message: Fields) -> str:
    ambiguous = [name for name in message.columns if name.lower() == AMBIGUOUS]
    if not ambiguous or 'range_rate' in message.mapping:
        return ''
    return (
        f'field {ambiguous[0]} is ambiguous and not used; if it is the range rate, '
        f'set fields.range_rate: {ambiguous[0]}'
    )


def from_plots(plots: Plots, types: MessageTypes) -> Any:
    """Return a PointCloud2 with the columns that the plots have, `time` after their stamp."""
    columns: dict[str, NDArray[Any]] = {'time': (plots.time - plots.stamp).astype(np.float32)}
    for name in ('range', 'azimuth', 'elevation', *OPTIONAL):
        columns[name] = getattr(plots, name).astype(np.float32)
    columns |= dict(zip('xyz', plots.position.T.astype(np.float32), strict=True))
    told = {name: values for name, values in columns.items() if not np.isnan(values).all()}
    return from_columns(told or columns, plots.stamp, plots.frame, types)
