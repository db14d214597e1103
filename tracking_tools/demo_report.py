# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the demo says at its end."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tracking_tools.held import count_false, find_holds, Hold
from tracking_tools.scene import Scene

MINUTE = 60.0


def report(scene: Scene, tracks: Path, topic: str, picture: Path) -> str:
    """Return how long each contact was held, where the results are, and what to look at."""
    return '\n'.join(
        [
            '',
            *_holds(scene),
            '',
            f'tracks:  {tracks} (rosbag2, mcap), topic {topic}',
            f'picture: {picture}',
            'Look at: the holding patterns in the plan view, and how the tracks stay on them',
            'through turns, false plots and missed looks; the gates, which widen where a plot is',
            'missing; and below, how the manoeuvre probability of one aircraft follows its turns.',
        ]
    )


def _holds(scene: Scene) -> list[str]:
    holds = find_holds(scene)
    if not holds:
        numbers, looks = np.unique(scene.tracks.get('id', ()), return_counts=True)
        why = 'the scene has no truth'
        if scene.has_truth:
            why = 'the truth is of other moments than the tracks: evaluate compares them'
        return [f'{len(numbers)} confirmed tracks, {looks.sum()} looks; {why}']
    return [
        ' aircraft  in sight    held  tracks       error',
        *(_line(hold) for hold in holds),
        _total(scene, holds),
    ]


def _line(hold: Hold) -> str:
    ids = ', '.join(str(number) for number in hold.tracks) or 'none'
    return (
        f'{hold.contact:9d} {hold.duration / MINUTE:5.1f} min {hold.share:7.1%}  {ids:10} '
        f'{hold.error:5.0f} m'
    )


def _total(scene: Scene, holds: list[Hold]) -> str:
    duration = np.array([hold.duration for hold in holds])
    share = np.array([hold.share for hold in holds])
    switches, returns = (sum(getattr(h, name) for h in holds) for name in ('switches', 'returns'))
    return (
        f'{len(holds)} aircraft were held {duration @ share / duration.sum():.1%} of the time '
        f'after three looks: {duration @ share / MINUTE:.0f} of {duration.sum() / MINUTE:.0f} '
        'minutes.\n'
        f'{len(np.unique(scene.published["id"]))} confirmed tracks, '
        f'{count_false(scene, holds)} of them false; {switches} id switches in sight, '
        f"{returns} new ids after being out of the radar's sight."
    )
