# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts among hundreds of false plots, with a speed limit that leaves room for all of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

INTERVAL, RANGE, SD = 4.0, 50e3, 80.0  # [s], [m], [m]


def held(
    false_plots: float, looks: int = 25, seed: int = 1, **values: str
) -> tuple[np.ndarray, int, int]:
    """Return which contacts (4,) have a track at the end, false tracks, and most tracks ever."""
    rng = np.random.default_rng(seed)
    tracker = RadarTracker(
        with_values(
            RadarTrackerConfig(),
            {
                'scan.assembly': 'snapshot',
                'sensor.position_sd': SD,
                'sensor.detection_probability': 0.9,
                'sensor.range_max': RANGE,
                'clutter_density': false_plots / (np.pi * RANGE**2),
                **values,
            },
        )
    )
    place = np.array([[20e3, 0.0], [-20e3, 5e3], [0.0, 22e3], [3e3, -21e3]])
    velocity, most = np.array([[0.0, 200], [150, 0.0], [-180, 90], [100, 100]]), 0
    for k in range(looks):
        seen = place[rng.random(4) < 0.9]
        count = rng.poisson(false_plots)
        distance, angle = RANGE * np.sqrt(rng.random(count)), rng.uniform(-np.pi, np.pi, count)
        clutter = distance[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        position = np.concatenate([seen + rng.normal(0.0, SD, seen.shape), clutter])
        time = INTERVAL * k
        plots = Plots.cartesian(np.full(len(position), time), position)
        tracks = tracker.track(replace(plots, stamp=time))
        most, place = max(most, len(tracks)), place + INTERVAL * velocity
    mean = tracks.planes[0].estimate('mmse')[0][tracks.confirmed][:, [0, 2]]
    near = np.hypot(*(mean[:, None] - (place - INTERVAL * velocity)).transpose(2, 0, 1)) < 500.0
    return near.any(axis=0), int((~near.any(axis=1)).sum()), most


@pytest.mark.parametrize('false_plots', [80.0, 150.0, 300.0])
def test_contacts_are_found_among_hundreds_of_false_plots(false_plots: float) -> None:
    """Two plots prove little there; more do, if they are waited for."""
    found, false, most = held(false_plots)
    assert found.all()
    assert false <= 1
    assert most < 300  # tentative ones included


def test_dense_clutter_stays_affordable() -> None:
    """Where nothing can be followed, tracks do not pile up."""
    _, false, most = held(3000.0, looks=8)
    assert false == 0
    assert most < 600


def test_counting_plots_confirms_no_clutter_there() -> None:
    """M of N knows nothing of clutter: faint tracks would nearly all be confirmed."""
    _, false, most = held(300.0, looks=8, lifecycle='m_of_n')
    assert false == 0
    assert most < 30
