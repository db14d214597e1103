# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ranges of real vessels from bearings of 1 deg, heard from a vessel that goes its own ways."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.recordings import data_folder
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings, Floats
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform

FOLDER = data_folder() / 'sea_ais'
DEGREE = np.pi / 180.0
HARBOUR = {
    'estimator': 'modified_polar',
    'sensor.bearing_sd': DEGREE,
    'sensor.detection_probability': 0.85,
    'ranging.velocity_noise': 0.05,
    'ranging.window': 900.0,
}
pytestmark = pytest.mark.skipif(
    not FOLDER.is_dir(), reason='the shared recordings are not beside the project'
)


def platform_of(recording) -> Platform:
    """Own ship; the recording has its bearings from north already."""
    time = recording['scan_t']
    none = np.zeros_like(time)
    position = np.column_stack([recording['own_e'], recording['own_n'], none]).astype(np.float64)
    turn = np.tile([0.0, 0.0, 0.0, 1.0], (len(time), 1))
    return Platform(time, position, turn, np.gradient(position, time, axis=0),
                    np.zeros((len(time), 3, 3)), none, max_extrapolation=1e4)  # fmt: skip


def told(name: str, values) -> tuple[Floats, int]:
    """Return error over range of everything told (N,), and the number of track looks."""
    recording = np.load(FOLDER / f'{name}.npz')
    platform = platform_of(recording)
    tracker = SonarTracker(with_values(SonarTrackerConfig(), values))
    errors, looks = [], 0
    for k, time in enumerate(recording['scan_t']):
        marks = recording['meas_bearing'][recording['meas_scan'] == k]
        marks = wrap_angle(0.5 * np.pi - marks.astype(np.float64))
        heard = Bearings.of(np.full(len(marks), time), marks)
        message = Bearings(heard.time, marks, heard.bearing_sd, heard.snr, float(time))
        tracks, found = tracker.track(message, platform), tracker.ranges()
        looks += int(tracks.confirmed.sum())
        now = recording['true_scan'] == k
        apart = np.abs(wrap_angle(
            bearing_states(tracks).bearing[:, None] + recording['true_bearing'][now] - 0.5 * np.pi
        ))  # fmt: skip
        nearest = apart.argmin(axis=1)
        true = recording['true_range'][now][nearest]
        judged = found.observable & (apart.min(axis=1) < 2.0 * DEGREE)
        errors.append(np.abs(found.range[judged] / true[judged] - 1.0))
    return np.concatenate(errors), looks


def test_ranges_are_right_where_own_ship_manoeuvres() -> None:
    """A fast own ship that turns: a fifth of all looks has a range, right within some percent."""
    errors, looks = told('btr_0', HARBOUR)
    assert len(errors) > 0.15 * looks
    assert np.median(errors) < 0.08
    assert np.quantile(errors, 0.9) < 0.3


def test_ranges_are_not_guessed_where_it_hardly_does() -> None:
    """An own ship that turns little among vessels that turn: nothing is told, or hardly."""
    errors, looks = told('btr_1', HARBOUR)
    assert (errors > 0.3).sum() < 0.005 * looks
