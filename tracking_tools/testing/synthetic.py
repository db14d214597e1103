# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a sensor would send that sees a few contacts move evenly: plots for tests."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from msg_adapters.table import Columns

START = 1_000_000.0  # stamp of the first scan [s]
PERIOD = 4.0  # between scans [s]
DEGREE = np.pi / 180.0


@dataclass(frozen=True)
class SyntheticSensor:
    """Plots for every stamp, and the tracker that they are for."""

    node: str
    """Name of the tracker's node, and of its package."""
    topic: str
    frame: str
    contacts: Callable[[float], Columns]
    """Returns the columns of a scan at a stamp [s]."""
    count: int
    """Of the contacts."""
    period: float = PERIOD
    """Between scans [s]."""


def straight_flights(stamp: float) -> Columns:
    """Return the plots (`range`, `azimuth`) of three aircraft that fly straight."""
    flown = stamp - START
    rng = np.random.default_rng(int(flown * 10) % 2**32)
    x = np.array([20e3, -15e3, 5e3]) + np.array([150.0, 100.0, -120.0]) * flown
    y = np.array([5e3, 18e3, -25e3]) + np.array([-80.0, 120.0, 90.0]) * flown
    distance = np.hypot(x, y) + rng.normal(0.0, 20.0, 3)
    azimuth = np.arctan2(y, x) + rng.normal(0.0, 1e-3, 3)
    order = np.argsort(azimuth % (2.0 * np.pi))
    columns = {'range': distance[order], 'azimuth': azimuth[order]}
    return {name: values.astype(np.float32) for name, values in columns.items()}


def marks_all_round(stamp: float) -> Columns:
    """Return the marks (`bearing`) of twenty contacts, two of them on either side of +-pi."""
    rng = np.random.default_rng(int((stamp - START) * 10) % 2**32)
    start = 18.0 * np.arange(20) - 171.5
    rate = np.where(np.arange(20) % 2, 0.01, -0.01)
    bearing = (start + rate * (stamp - START) + rng.normal(0.0, 0.2, 20)) * DEGREE
    return {'bearing': (bearing + 0.01 * DEGREE).astype(np.float32)}


RADAR = SyntheticSensor('radar_tracker', 'plots', 'radar', straight_flights, 3)
SONAR = SyntheticSensor('sonar_tracker', 'bearings', 'sonar', marks_all_round, 20)
