# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does a session stand whatever comes on all of its inputs, and keep the tracks that it is fed?

A message that is refused must leave the tracker as it was, to the object; nothing may raise; what
is held stays flat (``PYTHONMALLOC=malloc`` shows all of it). Some hostile messages are well-formed
and only lie: a scan that lacks the contacts, or of another time. They are used, as nobody could
tell; two healthy scans follow each of them, one every second of the others. A flipped bit may put
a plot where a contact might just have flown: a track that it leads astray and that is lost is
counted apart. Any other loss is a fault.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import dataclass, field
import logging
import time
from types import SimpleNamespace
from typing import Any
import warnings

import numpy as np

from benchmarks.column_faults import Columns, Rng
from benchmarks.healthy_scenes import ASTRAY, HEALTHY, PERIOD, START, TRUE
from benchmarks.hostile_messages import odd_odometry, odd_point, spoil
from benchmarks.processes import Memory
from msg_adapters.message_types import rosbags_types, seconds
from msg_adapters.table import from_columns, to_columns
from tracking_core.linalg import is_positive_definite
from tracking_session.orders import acquire, cancel
from tracking_session.session import Session
from tracking_tools.parameter_file import configure
from tracking_tools.sensors import SENSORS

TYPES = rosbags_types()
WARM_UP = 15  # healthy scans before the siege
INPUTS, SHARES = ('plots', 'ownship', 'acquire', 'cancel'), (0.85, 0.07, 0.05, 0.03)
MANY = 100_000  # rows that no table has
LOOK = 20  # messages from one look at the memory to the next


@dataclass
class Siege:
    """
    One session, and what happened to it.

    Parameters
    ----------
    sensor : str
        'radar' or 'sonar'.
    rng : Generator
        Decides all that is hostile.
    parameters : dict
        Of the node, by name; the defaults without.

    """

    sensor: str
    rng: Rng
    parameters: dict[str, Any] = field(default_factory=dict)
    stamp: float = START - PERIOD  # of the last healthy scan [s]
    outcomes: Counter[str] = field(default_factory=Counter)  # of hostile messages
    kept: set[int] = field(default_factory=set)  # ids that should stay
    settling: int = WARM_UP  # healthy scans until every contact is a confirmed track
    astray: dict[int, int] = field(default_factory=dict)  # healthy scans for which ids are excused

    def __post_init__(self) -> None:
        """Begin with healthy scans, until every contact is a confirmed track."""
        kind, log = SENSORS[self.sensor], logging.getLogger('siege')
        log.setLevel(logging.CRITICAL)
        configs = configure(kind.configs, self.parameters)
        self.session: Session = kind.make_session(*configs, TYPES, log)
        self.topic = kind.topic
        for _ in range(WARM_UP):
            self.feed()

    def confirmed(self) -> set[int]:
        """Return the ids of the confirmed tracks."""
        tracks = self.session.tracks
        return set(tracks.id[tracks.confirmed].tolist())

    def feed(self) -> None:
        """Send a healthy scan; the tracks that are fed should be there, and must be sound."""
        self.stamp += PERIOD
        columns = HEALTHY[self.sensor](self.stamp)
        msg = from_columns(columns, self.stamp, self.sensor, TYPES)
        table = self.session.plots(msg, self.stamp)
        if table is None:  # only a hostile message that lied about its time may be the cause
            assert seconds(self.session.stamp) >= self.stamp, 'a healthy scan was refused'
        else:
            to_columns(table, MANY)
        self._count_losses()
        self._check_numbers()

    def _count_losses(self) -> None:
        lost = self.kept - self.confirmed()
        if lost:
            self.outcomes['tracks lost to a lie'] += len(lost & self.astray.keys())
            self.outcomes['tracks lost'] += len(lost - self.astray.keys())
            self.kept, self.settling = set(), WARM_UP
        elif self.settling:
            self.settling -= 1
            self.kept = self.kept if self.settling else self.confirmed()
        self.astray = {number: left - 1 for number, left in self.astray.items() if left > 1}

    def _note_astray(self, rows: Columns, stamp: float) -> None:
        """Excuse tracks that a hostile plot has put where no contact is."""
        true = TRUE[self.sensor](stamp + rows['time'].astype(np.float64))
        off = np.abs((rows['x'] + 1j * rows['y'])[:, None] - true).min(axis=1)
        astray = self.kept.intersection(rows['id'][off > ASTRAY[self.sensor]].tolist())
        self.astray.update(dict.fromkeys(astray, WARM_UP))

    def attack(self) -> bool:
        """Send one hostile message on one of the inputs; return whether it was used."""
        topic = str(self.rng.choice(INPUTS, p=SHARES))
        tracker = self.session.instrument.tracker
        before = tracker.state
        outcome = getattr(self, f'_{topic}')(self.session.counts[self.topic])
        self.outcomes[f'{topic} {outcome}'] += 1
        if outcome == 'refused':
            assert tracker.state is before, 'a refused message changed the tracker'
        return outcome.startswith('used')

    def _plots(self, count: Any) -> str:
        columns, stamp = HEALTHY[self.sensor](self.stamp + 2.0), self.stamp + 0.5 * PERIOD
        msg = spoil(columns, stamp, self.sensor, self.rng).to_message(TYPES)
        late = count.late_used
        table = self.session.plots(msg, self.stamp)
        if table is not None:
            self._note_astray(to_columns(table, MANY), seconds(table.header.stamp))
            return 'used'
        return 'used late' if count.late_used > late else 'refused'

    def _ownship(self, _: Any) -> str:
        self.session.ownship(odd_odometry(self.sensor, self.rng), self.stamp)
        return 'refused'

    def _acquire(self, _: Any) -> str:
        before = self.session.instrument.tracker.state.next_id
        acquire(self.session, odd_point(self.sensor, self.rng))
        return 'used' if self.session.instrument.tracker.state.next_id > before else 'refused'

    def _cancel(self, _: Any) -> str:
        number = int(self.rng.choice([0, 2**31, 2**32 - 1]))
        cancel(self.session, SimpleNamespace(data=number))
        return 'without a track'

    def _check_numbers(self) -> None:
        tracks = self.session.tracks
        chances = [tracks.existence_probability, *(p.mode_probability for p in tracks.planes)]
        assert all(((p >= 0.0) & (p <= 1.0 + 1e-9)).all() for p in chances)
        assert all(is_positive_definite(plane.covariance).all() for plane in tracks.planes)
        assert len(np.unique(tracks.id)) == len(tracks)


def besiege(siege: Siege, messages: int) -> Memory:
    """Send so many hostile messages; return the memory on the way."""
    memory = Memory()
    for number in range(messages):
        for _ in range(2 if siege.attack() else number % 2):
            siege.feed()
        if number % LOOK == 0:
            memory.look()
    return memory


def stand(sensor: str, messages: int, seed: int = 1) -> tuple[dict[str, int], Memory]:
    """Return what became of so many hostile messages to a new session, and its memory."""
    siege = Siege(sensor, np.random.default_rng(seed))
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        memory = besiege(siege, messages)
    return dict(siege.outcomes), memory


def main() -> None:
    """Print how many messages of each kind a session has stood."""
    parser = argparse.ArgumentParser(prog='siege', description=__doc__.splitlines()[1])
    parser.add_argument('--sensor', choices=HEALTHY, default='radar')
    parser.add_argument('--messages', type=int, default=10_000)
    parser.add_argument('--seed', type=int, default=1)
    chosen = parser.parse_args()
    began = time.process_time()
    outcomes, memory = stand(chosen.sensor, chosen.messages, chosen.seed)
    print(f'{chosen.sensor}: {chosen.messages} hostile messages: {outcomes}')
    print(f'CPU time {time.process_time() - began:.0f} s, held [MB] in tenths:', *memory.held)
    print('resident [MB]:', *memory.resident)


if __name__ == '__main__':
    main()
