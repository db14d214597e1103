# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do the plots measure of one plane? Position at the plot's own time, perhaps range rate."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tracking_core.batches import Bools, Floats, Measurement, Pairs, Scan
from tracking_core.rows import take_rows

_SURE = 2.0  # sd, that must fit into half of the interval of range rates


def of_plane(
    coordinates: tuple[int, ...], pairs: Pairs, scan: Scan, position: Floats
) -> Measurement:
    """
    Measure the position of a plane, z = position + velocity times lag.

    The track stands at the time of its look, the plot at its own; H moves the track over this
    small lag, so that every plot is used at its own time.

    Parameters
    ----------
    coordinates : tuple of int
        Coordinates of `scan.position` that belong to the plane.
    pairs : Pairs
        P pairs.
    scan : Scan
        Plots; a coordinate that is NaN is absent.
    position : (P, d) array
        Of the plots; angles within half a turn of where they are expected.

    Returns
    -------
    Measurement
        Absent components have a row of zeros, value 0 and variance 1.

    """
    part = slice(coordinates[0], coordinates[-1] + 1)
    covariance = take_rows(scan.covariance[:, part, part], pairs.plot)
    return without_absent(position[:, part], after(pairs.lag, len(coordinates)), covariance)


def after(lag: Floats, d: int) -> Floats:
    """Return H (P, d, 2 d) that moves d coordinates over these times (P,) [s]."""
    matrix = np.zeros((len(lag), d, 2 * d), order='F')
    for axis in range(d):
        matrix[:, axis, 2 * axis], matrix[:, axis, 2 * axis + 1] = 1.0, lag
    return matrix


def with_range_rate(
    measurement: Measurement,
    coordinates: tuple[int, ...],
    pairs: Pairs,
    scan: Scan,
    place: Floats,
    velocity: Floats,
    velocity_covariance: Floats,
) -> Measurement:
    """
    Append range rate as one more component of the plane: u (v - v_sensor) along the line of sight.

    Velocity outside the plane is taken as predicted, its variance added to the noise; so is what
    the noise of the plot's position does to the line of sight: it swings it, and so turns what the
    contact moves across it, as seen from the sensor, into range rate.

    Parameters
    ----------
    measurement : Measurement
        Position of the plane.
    coordinates : tuple of int
        Coordinates of the plane.
    pairs : Pairs
        P pairs.
    scan : Scan
        Plots with `range_rate`, NaN where absent.
    place : (P, d) array
        Of the plots, where they lack a height at that of the track [m].
    velocity, velocity_covariance : (P, d) and (P, d, d) arrays
        Predicted velocity in all coordinates of the scan [m/s, m^2/s^2].

    """
    d, rows = scan.position.shape[1], pairs.plot
    inside = np.isin(np.arange(d), coordinates)
    line = place - scan.sensor_position[rows, :d]
    distance = np.maximum(np.linalg.norm(line, axis=1), 1.0)
    sight = line / distance[:, None]
    platform = (sight * scan.sensor_velocity[rows, :d]).sum(axis=1)
    outside = (sight * velocity)[:, ~inside].sum(axis=1)
    value = scan.range_rate[rows] + platform - outside

    relative = velocity - scan.sensor_velocity[rows, :d]
    across = relative - (relative * sight).sum(axis=1)[:, None] * sight
    noise = np.nan_to_num(scan.covariance[rows])
    swing = np.einsum('pd,pde,pe->p', across, noise, across) / distance**2
    variance = scan.range_rate_variance[rows] + swing
    variance += _along(sight * ~inside, velocity_covariance)
    row = np.zeros((len(pairs), 1, measurement.matrix.shape[2]))
    row[:, 0, 1::2] = sight[:, inside]
    if not scan.range_rate_interval:
        return _append(measurement, value, row, variance)
    expected = (sight * velocity)[:, inside].sum(axis=1)
    doubt = variance + _along(sight * inside, velocity_covariance)
    interval = scan.range_rate_interval
    value, row, variance, vague = _unfold(value, row, variance, expected, doubt, interval)
    full = _append(measurement, value, row, variance)
    return replace(full, absent=full.absent + vague)


def _along(sight: Floats, covariance: Floats) -> Floats:
    """Return the variance (P,) of velocities along the lines of sight (P, d)."""
    return np.asarray(np.einsum('pd,pe,pde->p', sight, sight, covariance))


def _unfold(
    value: Floats, row: Floats, variance: Floats, expected: Floats, doubt: Floats, interval: float
) -> tuple[Floats, Floats, Floats, Bools]:
    """
    Return range rates (P,) that come again after an interval, those nearest to the expected ones.

    Where the expectation, of variance `doubt`, is too vague to say which, the range rate says
    nothing: it is as likely as any other within the interval, and no component. Which these are
    is the last that is returned.
    """
    near = value + interval * np.rint((expected - value) / interval)
    sure = _SURE * np.sqrt(doubt) < 0.5 * interval
    return (
        np.where(sure, near, 0.0 * near),  # NaN stays NaN
        np.where(sure[:, None, None], row, 0.0),
        np.where(sure, variance, interval**2),  # a determinant as of the density 1 / interval
        ~sure & np.isfinite(value),
    )


def with_unknown(measurement: Measurement) -> Measurement:
    """Append one more component that nothing is known of."""
    P, _, n = measurement.matrix.shape
    return _append(measurement, np.full(P, np.nan), np.zeros((P, 1, n)), np.ones(P))


def _append(old: Measurement, value: Floats, row: Floats, variance: Floats) -> Measurement:
    P, d = old.value.shape
    covariance = np.zeros((P, d + 1, d + 1))
    covariance[:, :d, :d], covariance[:, d, d] = old.covariance, variance
    full = np.concatenate([old.value, value[:, None]], axis=1)
    new = without_absent(full, np.concatenate([old.matrix, row], axis=1), covariance)
    return Measurement(new.value, new.matrix, new.covariance, new.absent + old.absent)


def without_absent(value: Floats, matrix: Floats, covariance: Floats) -> Measurement:
    """Neutralise NaN components: nothing measured, noise of variance 1 apart from the rest."""
    absent = np.isnan(value)
    count = np.zeros(len(value), np.int64)
    if absent.any():
        count = absent.sum(axis=1)
        value, matrix = np.where(absent, 0.0, value), np.where(absent[..., None], 0.0, matrix)
        covariance = np.where(absent[..., :, None] | absent[..., None, :], 0.0, covariance)
        axis = np.arange(value.shape[1])
        covariance[:, axis, axis] = np.where(absent, 1.0, covariance[:, axis, axis])
    return Measurement(value, matrix, covariance, count)
