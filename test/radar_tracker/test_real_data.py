# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Are real aircraft and boats tracked as well as promised, with the presets that are shipped?"""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.boat_recordings import autoferry
from benchmarks.real_data import HALF_HOUR, judge, preset, run
from benchmarks.recordings import air_scene, air_tracks, data_folder, Recording
from tracking_tools.scoring import Score

pytestmark = pytest.mark.skipif(
    not data_folder().is_dir(), reason='the shared recordings are not beside the project'
)


def tracked(recording: Recording) -> Score:
    """Track a recording with its preset and compare with the truth."""
    return judge(recording, run(recording, preset(recording.preset))[0])


def test_en_route_traffic_is_held_without_mistakes() -> None:
    """Half an hour of 54 aircraft: all held, no ghost, errors and covariances as wanted."""
    result = tracked(air_scene(data_folder()).part(0, HALF_HOUR))
    assert result.continuity.held >= 0.99
    assert result.continuity.switches <= 3
    assert result.continuity.ghosts == 0
    assert result.gain <= 0.72
    assert 0.75 <= result.tracks.nees_position <= 1.2
    assert 0.75 <= result.tracks.nees_state <= 1.2


@pytest.mark.slow
def test_manoeuvring_aircraft_are_never_lost() -> None:
    """Eleven aircraft in turns and holding patterns: one track each, better than the plots."""
    scenes = [tracked(recording.part(0, 300)) for recording in air_tracks(data_folder())]
    assert min(scene.continuity.held for scene in scenes) >= 0.99
    assert sum(scene.continuity.switches for scene in scenes) == 0
    assert sum(scene.continuity.ghosts for scene in scenes) == 0
    assert np.mean([scene.gain for scene in scenes]) <= 0.95


@pytest.mark.parametrize(('number', 'held'), [('02', 0.97), ('04', 0.80), ('13', 0.95)])
def test_boats_are_held_from_a_moving_ferry(number: str, held: float) -> None:
    """Two boats on a real radar keep their tracks; in 04 they share one plot at first."""
    result = tracked(autoferry(data_folder(), number))
    assert result.continuity.held >= held
    assert result.continuity.switches == 0
