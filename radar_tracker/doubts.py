# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Are the radar's plots what its parameters tell?"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from radar_tracker.tracker import RadarTracker
from tracking_session.doubts import Doubt, noise_doubts, Told

_ENOUGH = 200  # plots, of which the farthest tells how far the radar sees, and one has a height
_ADVICE = 'that is used; set it right, unless most contacts turn all the time'


def doubts(tracker: RadarTracker, plots: int, is_own: bool) -> Iterator[Doubt]:
    """
    Yield what looks wrong.

    Parameters
    ----------
    tracker : RadarTracker
        With its parameters.
    plots : int
        How many came so far.
    is_own : bool
        Whether plots tell their own noise.

    """
    c, radar, ratio = tracker.config.sensor, tracker.radar, tracker.state.scatter.ratio
    told = [
        Told('range', 'sensor.range_sd', c.range_sd, 'm'),
        Told('azimuth', 'sensor.azimuth_sd', c.azimuth_sd, 'rad'),
        Told('elevation', 'sensor.elevation_sd', c.elevation_sd, 'rad'),
    ]
    if not radar.is_polar:
        axes = ('range', 'azimuth', 'elevation')
        told = [Told(axis, 'sensor.position_sd', c.position_sd, 'm') for axis in axes]
    if is_own:
        told = [t._replace(name=t.name.replace('sensor.', ''), sd=None) for t in told]
    name, sd = told[0].name, told[0].sd
    if sd is not None and sd > radar.coarsest:
        ratio = np.where([t.name == name for t in told[: len(ratio)]], np.nan, ratio)
        if plots >= _ENOUGH:
            yield Doubt(
                f'{name} is too large',
                f'{name} = {sd:.3g} m is that of a radar which sees far, but the farthest of '
                f'{plots} plots is {tracker.farthest:.0f} m away: '
                f'{radar.raised[0] * radar.coarsest:.2g} m is used. Begin with a preset for '
                'short ranges',
            )
    yield from noise_doubts('plots', told, ratio, _ADVICE)


def height_doubts(plots: int) -> Iterator[Doubt]:
    """Yield what is wrong where none of so many plots of a 3-D radar has a height."""
    if plots >= _ENOUGH:
        yield Doubt(
            'no plot has a height',
            f'sensor.dimensions is 3, but none of {plots} plots has a height, and without one no '
            'track starts: set it to 2, or name the field with fields.elevation or fields.z',
        )
