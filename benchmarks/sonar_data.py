# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How well are real movements tracked by their bearings? The shared data and fresh scenes, scored.

Run ``python -m benchmarks.sonar_data FOLDER``, the folder with ``sea_ais`` and
``marine_autoferry``; recordings that are not there are left out. The presets are those of
``config/``. The marks of a recording of vessels are one draw of luck: ``--draws`` of the same
movements are made anew. As many simulated scenes of that kind follow as ``--scenes`` says
(``sonar_scenes.py``): the presets were not chosen on those.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import astuple, fields
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.recordings import data_folder, PROJECT
from benchmarks.sonar_recordings import camera, Record, vessels
from benchmarks.sonar_scenes import heard, sea
from benchmarks.sonar_score import BearingRows, BearingScore, score
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.config import parameters, with_values
from tracking_tools.parameter_file import parse_value, read_parameter_file

# Those to 1039, and 3000 to 3059, were looked at while presets and map of clutter were made.
FIRST = 5000
COLUMNS = tuple(field.name for field in fields(BearingScore))


def preset(name: str) -> dict[str, Any]:
    """Return what a file of ``config/`` says of the tracker."""
    values = read_parameter_file(PROJECT / 'config' / f'{name}.yaml', '/sonar_tracker')
    of_node = {p.name for p in parameters(sonar_node_config())}
    return {key: value for key, value in values.items() if key not in of_node}


def track(record: Record, values: Mapping[str, Any]) -> list[BearingRows]:
    """Return the confirmed tracks after each cycle."""
    tracker, rows = SonarTracker(with_values(SonarTrackerConfig(), values)), []
    for message in record.cycles:
        tracks = tracker.track(message, record.platform)
        sure, ranges = tracks.confirmed, tracker.ranges()
        rows.append(BearingRows(tracks.id[sure], bearing_states(tracks).bearing[sure],
                         ranges.range[sure]))  # fmt: skip
    return rows


def records(folder: Path) -> Iterator[tuple[Record, str]]:
    """Yield the recordings that are there, with the preset for their sensor."""
    for path in sorted((folder / 'sea_ais').glob('btr_*.npz')):
        yield vessels(path.parent, path.stem), 'direction_finder'
    for path in sorted((folder / 'marine_autoferry').glob('autoferry_*.npz')):
        for sensor in ('eo', 'ir'):
            yield camera(path.parent, path.stem, sensor), 'camera'


def line(name: str, values: tuple[float, ...]) -> str:
    """Return a row of the table."""
    return '| ' + ' | '.join([name, *(f'{x:.3g}' for x in values)]) + ' |'


def scene_score(values: Mapping[str, Any], seed: int) -> tuple[float, ...]:
    """Return the score of a simulated scene."""
    return vessel_score(sea(seed), values)


def drawn_score(record: Record, values: Mapping[str, Any], seed: int) -> tuple[float, ...]:
    """Return the score of the record with other marks."""
    return vessel_score(heard(record, np.random.default_rng(seed)), values)


def vessel_score(record: Record, values: Mapping[str, Any]) -> tuple[float, ...]:
    """Return the score of a record of vessels, `values` over the preset."""
    return astuple(score(record, track(record, {**preset('direction_finder'), **values})))


def mean_lines(name: str, scores: Iterable[tuple[float, ...]]) -> Iterator[str]:
    """Yield two rows of the table: the mean of the scores, and how well it is known."""
    found = np.array(list(scores), np.float64)
    yield line(f'{name}, mean of {len(found)}', tuple(np.nanmean(found, axis=0)))
    error = np.nanstd(found, axis=0) / np.sqrt(np.isfinite(found).sum(axis=0))
    yield line('... standard error', tuple(error))


def main() -> None:
    """Print the scores."""
    parser = argparse.ArgumentParser(description='Bearing tracks of real movements, scored.')
    parser.add_argument('folder', type=Path, nargs='?', default=data_folder())
    parser.add_argument('--first', type=int, default=FIRST, help='seed of draws and scenes')
    parser.add_argument('--draws', type=int, default=30, help='of marks for each recording')
    parser.add_argument('--scenes', type=int, default=40, help='simulated scenes')
    parser.add_argument('--jobs', type=int, default=2, help='processes')
    parser.add_argument('--set', nargs='*', default=[], help='parameters as name=value')
    given = parser.parse_args()
    values = {k: parse_value(v) for k, v in (item.split('=', 1) for item in given.set)}
    print('| ' + ' | '.join(('recording', *COLUMNS)) + ' |\n' + '|---' * (len(COLUMNS) + 1) + '|')
    with ProcessPoolExecutor(given.jobs) as pool:
        for record, name in records(given.folder):
            rows = track(record, {**preset(name), **values})
            print(line(record.name, astuple(score(record, rows))), flush=True)
            if given.draws and name == 'direction_finder':
                seeds = range(given.first, given.first + given.draws)
                drawn = pool.map(partial(drawn_score, record, values), seeds)
                print(*mean_lines('... drawn anew', drawn), sep='\n', flush=True)
        if given.scenes:
            seeds = range(given.first, given.first + given.scenes)
            found = pool.map(partial(scene_score, values), seeds)
            print(*mean_lines('scenes', found), sep='\n')


if __name__ == '__main__':
    main()
