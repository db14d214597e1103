# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How well are real movements tracked by their bearings? The shared data, scored.

Run ``python -m benchmarks.sonar_data FOLDER``, the folder with ``sea_ais`` and
``marine_autoferry``; recordings that are not there are left out.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import astuple, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.sonar_recordings import camera, DEGREE, Record, vessels
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle

VESSELS: dict[str, Any] = {
    'sensor.bearing_sd': 1.0 * DEGREE,
    'sensor.detection_probability': 0.85,
    'estimator': 'modified_polar',
    'motion.bearing_noise': [1e-4],
    'motion.rate_noise': [3e-6],
    'motion.sojourn_time': [600.0],
    'initiation.rate_max': 0.3 * DEGREE,
    'initiation.rate_sd': 0.03 * DEGREE,
    'existence.new_contacts': 8.0,
    'existence.lifetime': 3600.0,
    'merge.distance': 0.0,  # contacts stay within the noise of each other for long
    'ranging.enabled': False,
}
CAMERAS: dict[str, Any] = {
    'sensor.bearing_sd': 0.5 * DEGREE,
    'sensor.detection_probability': 0.7,
    'motion.bearing_noise': [2e-3],
    'motion.rate_noise': [5e-3],
    'initiation.rate_max': 6.0 * DEGREE,
    'initiation.rate_sd': 1.5 * DEGREE,
    'existence.new_contacts': 60.0,
    'existence.lifetime': 120.0,
    'ranging.enabled': False,
}


@dataclass(frozen=True)
class Score:
    """How well the contacts were held."""

    heard: float  # share of contact cycles with a mark near the contact
    coverage: float  # share of contact cycles with a confirmed track
    purity: float  # share of a track's rows that are on its main contact, by rows
    breaks: int  # a contact lost and held again
    swaps: int  # a contact that got a track of another contact
    false_per_hour: float  # confirmed tracks that are on nothing for most of their rows
    error: float  # rms, less the median [deg]
    tracks: int


def track(record: Record, values: Mapping[str, Any]) -> list[tuple[Ints, Floats]]:
    """Return id and bearing of the confirmed tracks after each cycle."""
    tracker, rows = SonarTracker(with_values(SonarTrackerConfig(), values)), []
    for message in record.cycles:
        tracks = tracker.track(message, record.platform)
        sure = tracks.confirmed
        rows.append((tracks.id[sure], bearing_states(tracks).bearing[sure]))
    return rows


@dataclass(frozen=True)
class Held:
    """Which track was last on which contact."""

    last: dict[int, int]

    def going_on(self, ids: Ints, contacts: Ints, near: Bools) -> Bools:
        """Return the pairs of tracks and contacts that go on as they were."""
        before = np.array([self.last.get(int(c), -1) for c in contacts], np.int64)
        return near & (ids[:, None] == before)


def score(record: Record, rows: list[tuple[Ints, Floats]]) -> Score:
    """Compare tracks with the truth, cycle by cycle, nearest first and one to one."""
    found = np.full(len(record.scan), -1)
    error = np.full(len(record.scan), np.nan)
    seen: dict[int, list[int]] = {}
    held = Held({})
    for cycle, (ids, bearing) in enumerate(rows):
        here = np.flatnonzero(record.scan == cycle)
        off = np.abs(wrap_angle(bearing[:, None] - record.bearing[here]))
        for number in ids.tolist():
            seen.setdefault(number, [])
        # Who was on a contact stays on it while near: close contacts do not swap by noise.
        stays = held.going_on(ids, record.contact[here], off < record.near)
        while off.size and (off - 100.0 * stays).min() < record.near:
            row, column = np.unravel_index((off - 100.0 * stays).argmin(), off.shape)
            found[here[column]] = ids[row]
            error[here[column]] = wrap_angle(bearing[row] - record.bearing[here[column]])
            seen[int(ids[row])].append(int(record.contact[here[column]]))
            held.last[int(record.contact[here[column]])] = int(ids[row])
            off[row], off[:, column] = np.inf, np.inf
            stays[row], stays[:, column] = False, False
    length = {int(i): sum((ids == i).sum() for ids, _ in rows) for i in seen}
    false = sum(len(seen[i]) < 0.5 * length[i] for i in seen)
    duration = record.cycles[-1].stamp - record.cycles[0].stamp
    wanted = record.distance <= record.reach
    breaks, swaps = _changes(record, found)
    main = sum(max((on.count(c) for c in set(on)), default=0) for on in seen.values())
    left = error[np.isfinite(error)] / DEGREE
    return Score(
        heard=float(_heard(record)[wanted].mean()),
        coverage=float((found[wanted] >= 0).mean()),
        purity=main / max(sum(len(on) for on in seen.values()), 1),
        breaks=breaks,
        swaps=swaps,
        false_per_hour=false * 3600.0 / duration,
        error=float(np.sqrt(np.mean((left - np.median(left)) ** 2))),
        tracks=len(seen),
    )


def _heard(record: Record) -> Bools:
    """Return for which true rows (N,) there is a mark near."""
    heard = np.zeros(len(record.scan), bool)
    for cycle, marks in enumerate(record.cycles):
        here = np.flatnonzero(record.scan == cycle)
        off = np.abs(wrap_angle(marks.bearing[:, None] - record.bearing[here]))
        heard[here] = off.min(axis=0, initial=np.inf) < record.near
    return heard


def _changes(record: Record, found: Ints) -> tuple[int, int]:
    """Return how often contacts lost their track for another one, and for one of another."""
    breaks, swaps, owner = 0, 0, {}
    last: dict[int, int] = {}
    for contact, number in zip(record.contact.tolist(), found.tolist(), strict=True):
        if number < 0:
            continue
        before = last.get(contact)
        if before is not None and before != number:
            breaks += 1
            swaps += owner.get(number, contact) != contact
        last[contact], owner[number] = number, contact
    return breaks, swaps


def records(folder: Path) -> list[tuple[Record, dict[str, Any]]]:
    """Return the recordings that are there, with the parameters for their sensor."""
    found: list[tuple[Record, dict[str, Any]]] = []
    for path in sorted((folder / 'sea_ais').glob('btr_*.npz')):
        found.append((vessels(path.parent, path.stem), VESSELS))
    for path in sorted((folder / 'marine_autoferry').glob('autoferry_*.npz')):
        found += [(camera(path.parent, path.stem, sensor), CAMERAS) for sensor in ('eo', 'ir')]
    return found


def main() -> None:
    """Print the scores."""
    parser = argparse.ArgumentParser(description='Bearing tracks on the shared data.')
    parser.add_argument('folder', type=Path)
    columns = ('recording', *(field.name for field in fields(Score)))
    print('| ' + ' | '.join(columns) + ' |\n' + '|---' * len(columns) + '|')
    for record, values in records(parser.parse_args().folder):
        result = score(record, track(record, values))
        print('| ' + ' | '.join([record.name, *(f'{x:.3g}' for x in astuple(result))]) + ' |')


if __name__ == '__main__':
    main()
