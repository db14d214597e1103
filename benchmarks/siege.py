# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does a session stand whatever comes on all of its inputs, and keep the tracks that it is fed?

A message that is refused must leave the tracker as it was, to the object; nothing may raise;
memory stays flat. Some hostile messages are well-formed and only lie: a scan that lacks the
contacts, or of another time. They are used, as nobody could tell; two healthy scans follow each of
them, one every second of the others. One in some hundred thousand lies where a contact might just
have flown, and takes its track along: such losses are counted.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import dataclass, field
import logging
import time
from types import SimpleNamespace
from typing import Any

import numpy as np

from benchmarks.column_faults import ODD_NUMBERS, ODD_TEXTS, Rng
from benchmarks.healthy_scenes import HEALTHY, PERIOD, START
from benchmarks.hostile_messages import spoil
from benchmarks.message_faults import odd_stamp
from benchmarks.processes import own_memory
from msg_adapters.message_types import rosbags_types, seconds
from msg_adapters.session import Session
from msg_adapters.table import from_columns, to_columns
from tracking_core.linalg import is_positive_definite
from tracking_tools.parameter_file import configure
from tracking_tools.sensors import SENSORS

TYPES = rosbags_types()
WARM_UP = 15  # healthy scans before the siege
INPUTS, SHARES = ('plots', 'ownship', 'acquire', 'cancel'), (0.85, 0.07, 0.05, 0.03)
MANY = 100_000  # rows that no table has


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
            self.outcomes['tracks lost'] += len(lost)
            self.kept, self.settling = set(), WARM_UP
        elif self.settling:
            self.settling -= 1
            self.kept = self.kept if self.settling else self.confirmed()

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
            return 'used'
        return 'used late' if count.late_used > late else 'refused'

    def _ownship(self, _: Any) -> str:
        """Send an odometry whose pose is bad; one that is well-formed would be a lie."""
        numbers = [0.0, 0.0, 0.0, *self.rng.choice(ODD_NUMBERS, 4)]
        numbers[int(self.rng.integers(7))] = float(self.rng.choice([np.nan, np.inf, 1e30]))
        x, y, z, *q = map(float, numbers)
        pose = SimpleNamespace(
            position=SimpleNamespace(x=x, y=y, z=z),
            orientation=SimpleNamespace(**dict(zip('xyzw', q, strict=True))),
        )
        velocity = SimpleNamespace(
            **dict(zip('xyz', self.rng.choice(ODD_NUMBERS, 3), strict=True))
        )
        self.session.ownship(
            SimpleNamespace(
                header=self._header(),
                pose=SimpleNamespace(pose=pose, covariance=self.rng.choice(ODD_NUMBERS, 36)),
                twist=SimpleNamespace(twist=SimpleNamespace(linear=velocity)),
            ),
            self.stamp,
        )
        return 'refused'

    def _acquire(self, _: Any) -> str:
        before = self.session.instrument.tracker.state.next_id
        position = self.rng.choice(ODD_NUMBERS, 3)
        position[self.rng.integers(3)] = self.rng.choice([np.nan, np.inf, 1e30])  # else an order
        point = SimpleNamespace(**dict(zip('xyz', map(float, position), strict=True)))
        self.session.acquire(SimpleNamespace(header=self._header(), point=point))
        return 'used' if self.session.instrument.tracker.state.next_id > before else 'refused'

    def _cancel(self, _: Any) -> str:
        number = int(self.rng.choice([0, 2**31, 2**32 - 1]))
        self.session.cancel(SimpleNamespace(data=number))
        return 'without a track'

    def _header(self) -> Any:
        sec, nanosec = odd_stamp(self.rng)
        frame = str(self.rng.choice([*ODD_TEXTS, *[self.sensor] * 10]))
        return SimpleNamespace(stamp=SimpleNamespace(sec=sec, nanosec=nanosec), frame_id=frame)

    def _check_numbers(self) -> None:
        tracks = self.session.tracks
        chances = [tracks.existence_probability, *(p.mode_probability for p in tracks.planes)]
        assert all(((p >= 0.0) & (p <= 1.0 + 1e-9)).all() for p in chances)
        assert all(is_positive_definite(plane.covariance).all() for plane in tracks.planes)
        assert len(np.unique(tracks.id)) == len(tracks)


def besiege(siege: Siege, messages: int) -> list[float]:
    """Send so many hostile messages; return the memory [MB], eleven times on the way."""
    memory = []
    for number in range(messages):
        if number % max(messages // 10, 1) == 0:
            memory.append(own_memory())
        for _ in range(2 if siege.attack() else number % 2):
            siege.feed()
    return [*memory, own_memory()]


def main() -> None:
    """Print how many messages of each kind a session has stood."""
    parser = argparse.ArgumentParser(prog='siege', description=__doc__.splitlines()[1])
    parser.add_argument('--sensor', choices=HEALTHY, default='radar')
    parser.add_argument('--messages', type=int, default=10_000)
    parser.add_argument('--seed', type=int, default=1)
    chosen = parser.parse_args()
    began, siege = time.process_time(), Siege(chosen.sensor, np.random.default_rng(chosen.seed))
    memory = besiege(siege, chosen.messages)
    print(f'{chosen.sensor}: {chosen.messages} hostile messages: {dict(siege.outcomes)}')
    print(f'CPU time {time.process_time() - began:.0f} s, memory [MB] on the way:', *memory)


if __name__ == '__main__':
    main()
