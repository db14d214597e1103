# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Are the sonar's marks what its parameters tell?"""

from __future__ import annotations

from collections.abc import Iterator

from sonar_tracker.sensor_config import SensorConfig
from sonar_tracker.tracker import SonarTracker
from tracking_session.doubts import Doubt, noise_doubts, Told

_ADVICE = 'that is used; set it right, or tell with own ship how sure the heading is'


def doubts(tracker: SonarTracker, is_own: bool, is_true: bool) -> Iterator[Doubt]:
    """
    Yield what looks wrong.

    Parameters
    ----------
    tracker : SonarTracker
        With its parameters.
    is_own : bool
        Whether marks tell their own noise.
    is_true : bool
        Whether own ship's heading is taken to be in the bearings already.

    """
    sensor = tracker.config.sensor
    told = Told('bearing', 'sensor.bearing_sd', sensor.bearing_sd, 'rad')
    if is_own:
        told = told._replace(name='bearing_sd', sd=None)
    yield from noise_doubts('marks', [told], tracker.state.scatter.ratio, _ADVICE)
    yield from _turn_doubts(tracker.turns.turn, sensor, is_true)


def _turn_doubts(turn: float, sensor: SensorConfig, is_true: bool) -> Iterator[Doubt]:
    """Yield what is wrong with how bearings count, if marks turn so far over own ship's turn."""
    if turn == 2.0 and not is_true:
        other = 'clockwise' if sensor.azimuth_convention == 'enu' else 'enu'
        side = ', or contacts are to the other side of the array: set sensor.both_sides'
        yield Doubt(
            'bearings count the other way round',
            'marks turn twice as far as own ship, as bearings do that count the other way round: '
            f'set sensor.azimuth_convention to {other}{side if sensor.array == "linear" else ""}',
        )
    elif turn == 1.0 and not is_true:
        yield Doubt(
            'bearings are true ones',
            'marks turn as far as own ship, as true bearings do that are taken for relative ones: '
            'set sensor.azimuth_reference to tracking_frame, unless it is own ship that is heard',
        )
    elif abs(turn) == 1.0 and is_true:
        yield Doubt(
            'bearings are relative ones',
            'marks turn with own ship, as relative bearings do that are taken for true ones: set '
            "sensor.azimuth_reference to frame, and header.frame_id to the sensor's frame",
        )
