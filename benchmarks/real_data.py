# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How well is real data tracked? One line per recording.

Run ``python -m benchmarks.real_data [--data FOLDER] [--set NAME=VALUE ...] [--only NAME]``.
Presets are the files of ``config``; ``--set`` tries other parameter values.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from benchmarks.boat_recordings import autoferry, canal
from benchmarks.recordings import air_scene, air_tracks, data_folder, PROJECT, Recording
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.config import with_values
from tracking_core.rows import take
from tracking_tools.parameter_file import parse_value, read_parameter_file
from tracking_tools.scoring import confirmed_rows, join_rows, match, Score, score, TrackRows

HALF_HOUR = 180  # turns of air_scene
COLUMNS = (
    'scans', 'targets', 'held', 'least', 'switch', 'break', 'ghost', 'ids', 'purity', 'rmse',
    'plots', 'ratio', 'straight', 'turning', 'vel', 'NEES2', 'NEES4', 'ms',
)  # fmt: skip


def preset(name: str, **values: Any) -> RadarTrackerConfig:
    """Return the parameters of ``config/<name>.yaml``, with these values instead of its own."""
    given = read_parameter_file(PROJECT / 'config' / f'{name}.yaml', '/radar_tracker')
    return with_values(RadarTrackerConfig(), {**given, **values})


def run(recording: Recording, config: RadarTrackerConfig) -> tuple[TrackRows, float]:
    """Track a recording; return the confirmed tracks of all scans and CPU time per scan [ms]."""
    tracker, parts = RadarTracker(config), []
    spent = 0.0
    for scan, message in enumerate(recording.messages):
        begin = process_time()
        tracks = tracker.track(message, recording.platform)
        spent += process_time() - begin
        parts.append(confirmed_rows(scan, tracks, config.output))
    return join_rows(parts), 1e3 * spent / len(recording.messages)


def judge(recording: Recording, rows: TrackRows) -> Score:
    """Compare the tracks of a recording with its truth."""
    return score(
        rows, recording.truth, recording.plots, recording.stretches, recording.radius,
        recording.slack, recording.has_velocity,
    )  # fmt: skip


def line(recording: Recording, result: Score, cost: float) -> str:
    """Return the row of the table."""
    c, t, p = result.continuity, result.tracks, result.plots
    least = min(c.held_per_contact.values(), default=float('nan'))
    straight, turning = t.rmse_straight / p.rmse_straight, t.rmse_turning / p.rmse_turning
    ghosts = c.ghosts if len(recording.stretches.id) else float('nan')
    values = (
        len(recording.messages), len(recording.stretches.id), c.held, least, c.switches, c.breaks,
        ghosts, c.tracks, c.purity, t.rmse, p.rmse, result.gain, straight, turning,
        t.velocity_rmse, t.nees_position, t.nees_state, cost,
    )  # fmt: skip
    cells = [f'{v:9d}' if isinstance(v, int) else f'{v:9.3f}' for v in values]
    return f'{recording.name[-30:]:30}' + ''.join(cells)


def offsets(recording: Recording, rows: TrackRows) -> Iterator[str]:
    """Yield how far the tracks are ahead of each boat and to its left, and the rest."""
    if recording.platform is None:
        return
    matches = match(rows, recording.truth, recording.radius, recording.slack)
    for contact in recording.stretches.id:
        mine = take(matches, matches.contact == contact)
        error = rows.position[mine.row] - mine.position
        ahead = mine.velocity / np.linalg.norm(mine.velocity, axis=1, keepdims=True)
        along = (error * ahead).sum(axis=1)
        left = ahead[:, 0] * error[:, 1] - ahead[:, 1] * error[:, 0]
        spread = np.sqrt(np.var(along) + np.var(left))
        lag = -np.mean(along) / np.linalg.norm(mine.velocity, axis=1).mean()
        yield (
            f'  boat {contact}: on average {np.mean(along):+.1f} m ahead ({lag:.1f} s late), '
            f'{np.mean(left):+.1f} m to the left; {spread:.1f} m rms about that'
        )


def recordings(folder: Path) -> Iterator[Recording]:
    """Yield all recordings; air_scene in halves: judge on the first, tune on the second."""
    scene = air_scene(folder)
    yield _named(scene.part(0, HALF_HOUR), 'air_scene, first 30 min')
    yield _named(scene.part(HALF_HOUR, len(scene.messages)), 'air_scene, second 30 min')
    yield from air_tracks(folder)
    for number in ('02', '04', '13'):
        yield autoferry(folder, number)
    for name in ('2023-08-22-18-33-03', '2023-09-02-15-04-22'):
        yield canal(folder, name)


def _named(recording: Recording, name: str) -> Recording:
    return replace(recording, name=name)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description='How well is real data tracked?')
    parser.add_argument('--data', type=Path, default=data_folder(), help='shared recordings')
    parser.add_argument('--only', default='', help='recordings with this in their name')
    parser.add_argument('--set', nargs='*', default=[], help='parameters as name=value')
    given = parser.parse_args(arguments)
    values = {k: parse_value(v) for k, v in (item.split('=', 1) for item in given.set)}
    print(' ' * 30 + ''.join(f'{name:>9}' for name in COLUMNS))
    for recording in recordings(given.data):
        if given.only not in recording.name:
            continue
        rows, cost = run(recording, preset(recording.preset, **values))
        result = judge(recording, rows)
        print(line(recording, result, cost), flush=True)
        for text in offsets(recording, rows):
            print(text)


if __name__ == '__main__':
    main()
