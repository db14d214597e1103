# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts that move gently for ever, to be tracked while something else is tried."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from benchmarks.column_faults import Columns, Rng
from tracking_core.batches import Floats

Complexes = NDArray[np.complex128]
START, PERIOD = 1_000_000.0, 4.0  # s, first stamp and time between scans


def flights(stamp: Floats) -> Complexes:
    """
    Return where three aircraft that circle slowly are at stamps (...,), as (..., 3) x + iy [m].

    Their ranges stay 5 km apart and their azimuths 0.19 from whole numbers: the range of one with
    the azimuth of another, or an azimuth without its fraction, is in nobody's gate. Else such a
    plot would be like one of a contact that turns.
    """
    turn = 2.0 * np.pi / 600.0 * (stamp[..., None] - START) + np.array([0.0, 2.0, 4.0])
    centre = np.array([8.8e3 + 4.8e3j, -17.1e3 + 12.8e3j, 2.4e3 - 33.9e3j])
    return np.asarray(centre + 3e3 * np.exp(1j * turn))


def ships(stamp: Floats) -> Complexes:
    """Return directions (..., 8), |x + iy| = 1, of ships all around, one beside +-pi."""
    number = np.arange(8)
    swing = 10.0 * np.sin(np.pi / 1e3 * (stamp[..., None] - START) + number)
    return np.asarray(np.exp(1j * np.deg2rad(45.0 * number - 171.5 + swing)))


def contacts(stamp: float) -> Columns:
    """Return the radar plots of the flights."""
    place, rng = flights(np.array(stamp)), _noise_at(stamp)
    columns = {
        'range': np.abs(place) + rng.normal(0.0, 20.0, 3),
        'azimuth': np.angle(place) + rng.normal(0.0, 1e-3, 3),
    }
    return {name: values.astype(np.float32) for name, values in columns.items()}


def marks(stamp: float) -> Columns:
    """Return the sonar marks of the ships."""
    bearing = np.angle(ships(np.array(stamp)))
    noise = np.deg2rad(_noise_at(stamp).normal(0.0, 0.2, 8))
    return {'bearing': (bearing + noise).astype(np.float32)}


def _noise_at(stamp: float) -> Rng:
    return np.random.default_rng(round((stamp - START) * 10.0) % 2**32)


HEALTHY = {'radar': contacts, 'sonar': marks}
TRUE = {'radar': flights, 'sonar': ships}
ASTRAY = {'radar': 150.0, 'sonar': 0.02}  # farther off is no noise: five to seven sds [m, rad]
