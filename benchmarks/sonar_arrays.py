# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What do arrays that are not as told do to sonar tracks?

Run ``python -m benchmarks.sonar_arrays [--runs N] [--only SCENE ...] [--set NAME=VALUE ...]``.
The scenes are in ``array_scenes``. Mean and standard error over the runs; what the columns are,
``Figures`` says. With ``--set`` each scene is played once, with these values over its own.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import astuple, dataclass
from functools import partial
from time import process_time
from typing import Any

import numpy as np
from tqdm import tqdm

from benchmarks.array_scenes import Array, CONTACTS, Heard, listen
from benchmarks.scene_figures import mean_of
from benchmarks.sonar_data import preset
from benchmarks.sonar_score import BearingRows, match
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Floats
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle
from tracking_tools.parameter_file import parse_value

SETTLED = 30  # cycles, after which contacts ought to be held, and all else is counted
Values = Mapping[str, Any]
NOTHING: Values = {}
BOTH: Values = {
    'sensor.both_sides': True, 'sensor.sector_width': 2.0 * np.pi, 'sensor.sector_centre': 0.0,
}  # fmt: skip
HULL: dict[str, Any] = {'linear': False, 'sd': 0.5, 'false': 0.5}
LEAST = {'sensor.bearing_sd_min': 0.00175}
TIGHT, PATIENT = {'gate.probability': 0.997}, {'m_of_n.drop_misses': 60}
WEAK = {'sensor.detection_probability': 0.5}
# Each scene, and what is set in turn.
CASES: dict[str, tuple[Array, tuple[Values, ...]]] = {
    'as told, to starboard': (Array(side='starboard'), (NOTHING,)),
    'as told, to port': (Array(side='port'), (NOTHING,)),
    'as told, all': (Array(), (NOTHING,)),
    'as told, where they are': (Array(both_sides=True), (NOTHING,)),
    'heading 0.5 deg white': (Array(heading_sd=0.5), (NOTHING,)),
    'heading 0.5 deg white, told': (Array(heading_sd=0.5, heading_told=True), (NOTHING,)),
    'heading 0.5 deg in 30 s': (Array(heading_sd=0.5, heading_memory=30.0), (NOTHING,)),
    'heading 0.5 deg in 30 s, told': (
        Array(heading_sd=0.5, heading_memory=30.0, heading_told=True), (NOTHING,),
    ),
    'heading 0.2 deg in 30 s, to starboard': (
        Array(side='starboard', heading_sd=0.2, heading_memory=30.0), (NOTHING,),
    ),
    'heading 0.5 s late': (Array(heading_late=0.5), (NOTHING,)),
    'heading 0.5 s late, to starboard': (
        Array(side='starboard', heading_late=0.5), (NOTHING,)
    ),
    'towed, the heading of own ship told': (Array(towed=60.0), (NOTHING,)),
    'sd told half': (Array(sd_told=0.5), (NOTHING, LEAST)),
    'sd told twice': (Array(sd_told=2.0), (NOTHING,)),
    'fades, where they are': (Array(fades=True, both_sides=True), (NOTHING, PATIENT)),
    'hull array': (Array(**HULL), (NOTHING,)),
    'hull array, sd told half': (Array(**HULL, sd_told=0.5), (NOTHING, TIGHT)),
    'hull array, fades': (Array(**HULL, fades=True), (NOTHING, WEAK)),
    'hull array, contacts turn by 10 deg': (Array(**HULL, turn=10.0), (NOTHING,)),
    'hull array, contacts turn by 40 deg': (Array(**HULL, turn=40.0), (NOTHING,)),
    'hull array, lane of 3': (Array(**HULL, lane=3.0), (NOTHING,)),
    'hull array, lane of 12': (Array(**HULL, lane=12.0), (NOTHING,)),
}  # fmt: skip


@dataclass(frozen=True)
class Figures:
    """How well it went, in the columns of the table; shares are of cycles that can hear it."""

    held: float  # share of the cycles of all contacts with a confirmed track
    found: float  # cycles to the first one, of those that had one
    ids: float  # that a contact had
    doubles: float  # second tracks on a contact, at a time, of all contacts
    false: float  # confirmed tracks near nobody, at a time; images on the other side among them
    nees: float  # of the bearing; 1: the covariance is right
    told: float  # share with a range
    wrong: float  # of these more than 30 % off
    cost: float  # CPU of a cycle [ms]


NAMES = (
    'scene, and what is set', 'held', 'cycles', 'ids', 'doubles', 'false', 'NEES', 'with a range',
    'of these wrong', 'CPU ms',
)  # fmt: skip


def run(name: str, values: Values, seed: int) -> Figures:
    """Return the figures of one run of a scene."""
    array = CASES[name][0]
    heard = listen(seed, array)
    own = {**(preset('passive_linear_array') if array.linear else {}), **values}
    if array.both_sides:
        own = {**own, **BOTH}
    tracker = SonarTracker(with_values(SonarTrackerConfig(), own))
    rows, sds, spent = [], [], 0.0
    for marks in heard.record.cycles:
        begin = process_time()
        tracks = tracker.track(marks, heard.record.platform)
        ranges, sure = tracker.ranges(), tracks.confirmed
        spent += process_time() - begin
        states = bearing_states(tracks)
        rows.append(BearingRows(tracks.id[sure], states.bearing[sure], ranges.range[sure]))
        sds.append(states.bearing_sd[sure])
    return judge(heard, rows, sds, 1e3 * spent / len(rows))


def judge(
    heard: Heard, rows: Sequence[BearingRows], sds: Sequence[Floats], cost: float
) -> Figures:
    """Compare the confirmed tracks of all cycles, and their sds, with the truth."""
    record = heard.record
    found = match(record, rows)
    on, late = found.id >= 0, record.scan >= SETTLED
    begin, begun = (
        np.where(which, record.scan, len(rows)).reshape(-1, CONTACTS).min(axis=0)
        for which in (heard.audible, on & heard.audible)
    )
    seen = (begun - begin + 1.0)[begun < len(rows)]
    pairs = np.unique(np.stack([record.contact[on], found.id[on]]), axis=1).shape[1]
    doubles, false, squares = 0, 0, []
    for cycle in range(SETTLED, len(rows)):
        here = slice(cycle * CONTACTS, (cycle + 1) * CONTACTS)
        off = wrap_angle(rows[cycle].bearing[:, None] - record.bearing[here])
        near = (np.abs(off) < record.near).any(axis=1)
        mine = np.isin(rows[cycle].id, found.id[here])
        doubles, false = doubles + (near & ~mine).sum(), false + (~near).sum()
        sd_of = dict(zip(rows[cycle].id.tolist(), sds[cycle], strict=True))
        sd = np.array([sd_of.get(number, np.nan) for number in found.id[here].tolist()])
        squares.append((found.error[here] / sd) ** 2)
    told, wanted = on & np.isfinite(found.range) & late, heard.audible & late
    wrong = np.abs(found.range[told] / record.distance[told] - 1.0) > 0.3
    cycles = len(rows) - SETTLED
    return Figures(
        on[wanted].mean(), seen.mean(), pairs / CONTACTS, doubles / cycles,
        false / cycles, float(np.nanmean(squares)), told[wanted].mean(),
        wrong.mean() if len(wrong) else np.nan, cost,
    )  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description='Arrays that are not as told.')
    parser.add_argument('--runs', type=int, default=6, help='of each row')
    parser.add_argument('--first', type=int, default=0, help='seed of the first run')
    parser.add_argument('--jobs', type=int, default=2, help='processes')
    parser.add_argument('--only', nargs='*', default=[''], help='scenes that begin so')
    parser.add_argument('--set', nargs='*', default=[], help='parameters as name=value')
    given = parser.parse_args(arguments)
    own = {k: parse_value(v) for k, v in (item.split('=', 1) for item in given.set)}
    seeds = range(given.first, given.first + given.runs)
    print('| ' + ' | '.join(NAMES) + ' |\n' + '|---' * len(NAMES) + '|')
    with ProcessPoolExecutor(given.jobs) as pool:
        for name, (_, variants) in CASES.items():
            if not name.startswith(tuple(given.only)):
                continue
            for values in (own,) if own else variants:
                title = ', '.join([name, *(f'`{k}: {v}`' for k, v in values.items())])
                found = pool.map(partial(run, name, values), seeds)
                runs = list(tqdm(found, total=given.runs, desc=title, leave=False))
                columns = np.array([astuple(figures) for figures in runs]).T
                print('| ' + ' | '.join([title, *map(mean_of, columns)]) + ' |', flush=True)


if __name__ == '__main__':
    main()
