# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How much purity can be had where contacts of one bearing pass each other? Ask an oracle.

``python -m benchmarks.sonar_oracle FOLDER`` scores the tracker when it is told, of every mark,
which contact made it and that a false mark is false; it gets no word only while the contact is
within an angle of another. An angle of 0 tells all. What is lost beside it is lost where contacts
cannot be told apart by their marks, in which nobody can help but a better knowledge of motion.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from dataclasses import astuple, replace
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.recordings import data_folder
from benchmarks.sonar_data import COLUMNS, FIRST, preset
from benchmarks.sonar_recordings import DEGREE, Record, vessels
from benchmarks.sonar_scenes import sea
from benchmarks.sonar_score import BearingRows, score
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.association import ASSOCIATORS
from tracking_core.batches import Association, Bools, Floats, Ints
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

ANGLES = (0.0, 0.5, 1.0, 2.0, 3.0, np.inf)  # [deg]
PURITY, SWAPS = (COLUMNS.index(name) for name in ('purity', 'swaps'))
NOBODY, NOT_TOLD = -1, -2
_NEVER = -60.0  # log weight of what the oracle rules out


class Oracle:
    """The usual association, less what the truth of a cycle rules out."""

    def __init__(self, name: str) -> None:
        self._associate = ASSOCIATORS[name]
        self.owner = np.zeros(0, np.int64)  # (T,) contact of each track, or NOT_TOLD
        self.source = np.zeros(0, np.int64)  # (M,) contact of each mark, NOBODY, or NOT_TOLD

    def __call__(
        self, track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int
    ) -> Association:
        """Share the marks among the tracks, as an `Associator`."""
        owner, source = self.owner[track], self.source[plot]
        wrong = (source == NOBODY) | ((source >= 0) & (owner >= 0) & (owner != source))
        told = np.where(wrong, _NEVER, log_weight)
        return self._associate(track, plot, told, log_miss, plots)


def track(record: Record, angle: float) -> list[BearingRows]:
    """Return the confirmed tracks after each cycle; the oracle is silent within `angle` [rad]."""
    values = {**preset('direction_finder'), 'ranging.enabled': False}
    tracker, rows = SonarTracker(with_values(SonarTrackerConfig(), values)), []
    oracle = Oracle(tracker.config.association)
    tracker.core.setup = replace(tracker.core.setup, associate=oracle)
    for cycle, message in enumerate(record.cycles):
        here = np.flatnonzero(record.scan == cycle)
        contact, bearing = record.contact[here], record.bearing[here]
        apart = np.abs(wrap_angle(bearing[:, None] - bearing))
        np.fill_diagonal(apart, np.inf)
        alone = apart.min(axis=1, initial=np.inf) >= angle
        source = record.source[cycle]
        oracle.source = np.where(np.isin(source, contact[~alone]), NOT_TOLD, source)
        tracks = tracker.track(message, record.platform)
        where, sure = bearing_states(tracks).bearing, tracks.confirmed
        oracle.owner = np.where(sure, _owners(where, contact, bearing, alone), NOT_TOLD)
        rows.append(BearingRows(tracks.id[sure], where[sure], np.full(sure.sum(), np.nan)))
    return rows


def _owners(where: Floats, contact: Ints, bearing: Floats, alone: Bools) -> Ints:
    """Return the contact that each track (T,) is on, NOT_TOLD if that is not alone."""
    if len(contact) == 0:
        return np.full(len(where), NOT_TOLD)
    nearest = np.abs(wrap_angle(where[:, None] - bearing)).argmin(axis=1)
    return np.where(alone[nearest], contact[nearest], NOT_TOLD)


def told_score(what: Path | int, angle: float) -> tuple[float, ...]:
    """Return the score of a recording, or of the scene with this seed, with the oracle's help."""
    record = sea(what) if isinstance(what, int) else vessels(what.parent, what.stem)
    return astuple(score(record, track(record, angle)))


def main() -> None:
    """Print purity and coverage by the angle within which the oracle is silent."""
    parser = argparse.ArgumentParser(description='Purity that can be had, told by an oracle.')
    parser.add_argument('folder', type=Path, nargs='?', default=data_folder())
    parser.add_argument('--scenes', type=int, default=40, help='simulated scenes')
    parser.add_argument('--jobs', type=int, default=2, help='processes')
    given = parser.parse_args()
    recordings = sorted((given.folder / 'sea_ais').glob('btr_*.npz'))
    seeds = list(range(FIRST, FIRST + given.scenes))
    names = [path.stem for path in recordings] + [f'{given.scenes} scenes']
    print('| silent within [deg] | ' + ' | '.join(f'{n} purity | swaps' for n in names) + ' |')
    print('|---' * (1 + 2 * len(names)) + '|')
    with ProcessPoolExecutor(given.jobs) as pool:
        for angle in ANGLES:
            ask = partial(told_score, angle=angle * DEGREE)
            found = np.array(list(pool.map(ask, [*recordings, *seeds])))[:, [PURITY, SWAPS]]
            alone, scenes = found[: len(recordings)], found[len(recordings) :]
            cells = [f'{x:.3f} | {n:.0f}' for x, n in alone]
            error = scenes[:, 0].std() / np.sqrt(len(scenes))
            cells.append(f'{scenes[:, 0].mean():.3f} +- {error:.3f} | {scenes[:, 1].mean():.1f}')
            print(f'| {"all" if np.isinf(angle) else f"{angle:g}"} | ' + ' | '.join(cells) + ' |',
                  flush=True)  # fmt: skip


if __name__ == '__main__':
    main()
