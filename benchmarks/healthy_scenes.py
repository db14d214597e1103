# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts that move gently for ever, to be tracked while something else is tried."""

from __future__ import annotations

import numpy as np

from benchmarks.column_faults import Columns

START, PERIOD = 1_000_000.0, 4.0  # s, first stamp and time between scans


def contacts(stamp: float) -> Columns:
    """
    Return the radar plots of three aircraft that circle slowly.

    Their ranges stay 5 km apart and their azimuths 0.19 from whole numbers: the range of one with
    the azimuth of another, or an azimuth without its fraction, is in nobody's gate. Else such a
    plot would be like one of a contact that turns.
    """
    flown, rng = stamp - START, np.random.default_rng(round((stamp - START) * 10.0) % 2**32)
    turn = 2.0 * np.pi / 600.0 * flown + np.array([0.0, 2.0, 4.0])
    x = np.array([8.8e3, -17.1e3, 2.4e3]) + 3e3 * np.cos(turn)
    y = np.array([4.8e3, 12.8e3, -33.9e3]) + 3e3 * np.sin(turn)
    columns = {
        'range': np.hypot(x, y) + rng.normal(0.0, 20.0, 3),
        'azimuth': np.arctan2(y, x) + rng.normal(0.0, 1e-3, 3),
    }
    return {name: values.astype(np.float32) for name, values in columns.items()}


def marks(stamp: float) -> Columns:
    """Return the sonar marks of eight ships all around, one of them on either side of +-pi."""
    listened, rng = stamp - START, np.random.default_rng(round((stamp - START) * 10.0) % 2**32)
    ships = np.arange(8)
    bearing = 45.0 * ships - 171.5 + 10.0 * np.sin(np.pi * listened / 1e3 + ships)
    return {'bearing': np.deg2rad(bearing + rng.normal(0.0, 0.2, 8)).astype(np.float32)}


HEALTHY = {'radar': contacts, 'sonar': marks}
