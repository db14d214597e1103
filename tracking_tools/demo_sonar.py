# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The demo of the sonar: two contacts cross in bearing and are one mark for ten minutes."""

from __future__ import annotations

from pathlib import Path
import sys

import numpy as np

from tracking_session.node_config import Configs
from tracking_tools import simulate
from tracking_tools.bearing_picture import draw, NEAR
from tracking_tools.bearing_scene import BearingScene, read_bearing_scene
from tracking_tools.crossings import Crossing, find_crossings, find_hearings, Hearing
from tracking_tools.demo import Demo, ROOT, run
from tracking_tools.replay_topics import Topics
from tracking_tools.scenarios.watches import long_watch
from tracking_tools.sensors import SENSORS

MINUTE = 60.0
SONAR = SENSORS['sonar']
PARAMETERS = ROOT / 'config' / 'passive_linear_array.yaml'
TITLE = 'Sonar bearings to tracks: two contacts cross, heard as one'


def record(path: Path) -> None:
    """Write the bag of the demo: what a ship with a passive array hears in 45 minutes."""
    print('simulating what the array hears ...', flush=True)
    simulate.record(long_watch(), path, compress=True)


def report(scene: BearingScene, tracks: Path, topic: str, picture: Path) -> str:
    """Return how each contact was held, where the results are, and what to look at."""
    return '\n'.join(
        [
            '',
            ' contact  in hearing    held  tracks  bearing error  range at the end',
            *(_line(hearing) for hearing in find_hearings(scene)),
            *(_crossed(crossing) for crossing in find_crossings(scene.tracks, NEAR)),
            '',
            f'tracks:  {tracks} (rosbag2, mcap), topic {topic}',
            f'picture: {picture}',
            'Look at: the crossing, where both contacts have one mark for minutes and each track',
            'comes out on the other side under its id; and the ranges, which nobody can know',
            'before own ship has turned.',
        ]
    )


def _line(hearing: Hearing) -> str:
    ids = ', '.join(str(number) for number in hearing.tracks) or 'none'
    told = 'not observable'
    if np.isfinite(hearing.range_error):
        told = f'off by {hearing.range_error:.0f} m, sd {hearing.range_sd:.0f} m'
    return (
        f'{hearing.contact:8d} {hearing.duration / MINUTE:7.1f} min {hearing.share:7.1%}  {ids:6}'
        f'  {np.degrees(hearing.error):9.3f} deg  {told}'
    )


def _crossed(crossing: Crossing) -> str:
    one, other = crossing.ids
    return f'Tracks {one} and {other} cross in minute {crossing.time / MINUTE:.1f}.'


def finish(
    recording: Path, tracks: Path, picture: Path, configs: Configs, topics: Topics, is_ours: bool
) -> str:
    """Draw the recording and its tracks, and return what there is to say."""
    tracker, node = configs
    scene = read_bearing_scene(recording, tracks, topics, tracker.sensor, vars(node.fields))
    draw(scene, picture, TITLE if is_ours else recording.name)
    return report(scene, tracks, topics.tracks, picture)


DEMO = Demo(
    name='demo_sonar',
    sensor=SONAR,
    recording=None,
    make_recording=record,
    parameters=PARAMETERS,
    rate=60.0,  # 45 minutes in 45 seconds
    finish=finish,
)


if __name__ == '__main__':
    sys.exit(run(DEMO))
