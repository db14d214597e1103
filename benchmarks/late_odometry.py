# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does own ship's odometry cost that comes seldom or late, and what does waiting for it cost?

Run ``python -m benchmarks.late_odometry [--runs N] [--set NAME=VALUE ...]``. A ship at 5 m/s yaws
by 5 degrees to either side in 8 s; its radar, 24 turns a minute, range noise 20 m, azimuth noise
0.3 degree, sees twelve contacts within 12 km for five minutes, in whole turns and in 32 sectors a
turn. Off is the root mean square distance of the tracks, held the share of turns, from the tenth
on, in which a contact has one within 500 m; waited is how long plots did so, the mean and the
longest.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
import logging
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import linear_sum_assignment

from msg_adapters.message_types import rosbags_types, stamp_of
from msg_adapters.table import from_columns, to_columns
from msg_adapters.track_rows import CONFIRMED
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.batches import Floats
from tracking_session.waiting import Came, Waiting
from tracking_tools.parameter_file import configure, parse_value

PERIOD, TURNS, SECTORS = 2.5, 120, 32  # [s]
CONTACTS, FARTHEST, SETTLED, RADIUS = 12, 12e3, 10, 500.0  # [m]
SPEED, YAW, YAW_PERIOD = 5.0, np.radians(5.0), 8.0  # of the ship [m/s], [rad], [s]
SD = np.array([20.0, np.radians(0.3)])  # of a plot, [m] and [rad]
EPOCH, TYPES = 1000.0, rosbags_types()
ODOMETRY = ((10.0, 0.0), (10.0, 0.3), (2.0, 0.3), (1.0, 0.3), (1.0, 1.0))  # [Hz], [s] late
VALUES = {
    'sensor.range_sd': SD[0], 'sensor.azimuth_sd': SD[1], 'sensor.range_max': FARTHEST,
    'sensor.dimensions': 2, 'initiation.speed_max': 40.0,
    'motion.horizontal.acceleration_sd': [0.01, 0.2],
}  # fmt: skip


class Event(NamedTuple):
    """A message as it comes."""

    received: float  # [s]
    is_plots: bool
    msg: Any


class Result(NamedTuple):
    """What came of one run."""

    off: float  # [m]
    held: float
    waited: float  # [s]
    longest: float  # [s]


def heading(time: Floats) -> Floats:
    """Return that of the ship at these times [rad]."""
    return np.asarray(0.7 + YAW * np.sin(2.0 * np.pi * time / YAW_PERIOD))


def contacts(rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Return place and velocity (C, 2) of contacts that stay in range [m], [m/s]."""
    far, way, course = rng.uniform([[2e3], [-np.pi], [-np.pi]], [[9e3], [np.pi], [np.pi]], (3, 12))
    speed = rng.uniform(0.0, 8.0, CONTACTS)
    place = far * np.array([np.cos(way), np.sin(way)])
    return place.T, (speed * np.array([np.cos(course), np.sin(course)])).T


def plots_of(rng: np.random.Generator, place: Floats, velocity: Floats) -> tuple[Floats, Floats]:
    """Return times (M,) and plots (M, 2), range and azimuth from ahead, of all turns in order."""
    begin = PERIOD * np.repeat(np.arange(TURNS), CONTACTS)
    place, velocity = np.tile(place, (TURNS, 1)), np.tile(velocity, (TURNS, 1))
    time = begin
    for _ in range(20):  # where the antenna finds a contact depends on when
        line = place + velocity * time[:, None] - [SPEED, 0.0] * time[:, None]
        azimuth = np.arctan2(line[:, 1], line[:, 0]) - heading(time)
        time = begin + PERIOD * (azimuth / (2.0 * np.pi) % 1.0)
    seen = rng.random(len(time)) < 0.95
    plots = np.stack([np.hypot(*line.T), azimuth], axis=1) + SD * rng.standard_normal(line.shape)
    order = np.argsort(time[seen])
    return time[seen][order], plots[seen][order]


def messages(time: Floats, plots: Floats, parts: int) -> Iterator[Event]:
    """Yield the messages of a radar that sends so many a turn, each when it is complete."""
    length = PERIOD / parts
    part = (time / length).astype(int)
    for number in range(TURNS * parts):
        mine, begin = part == number, number * length
        columns = {'range': plots[mine, 0], 'azimuth': plots[mine, 1], 'time': time[mine] - begin}
        msg = from_columns(columns, EPOCH + begin, 'radar', TYPES)
        yield Event(begin + length, True, msg)


def odometry(time: float) -> Any:
    """Return own ship's."""
    half, zeros = 0.5 * float(heading(np.array(time))), np.zeros(36)
    turn = TYPES.Quaternion(x=0.0, y=0.0, z=np.sin(half), w=np.cos(half))
    course = -2.0 * half  # of the way over the ground, which goes along x, from ahead
    point = TYPES.Point(x=SPEED * time, y=0.0, z=0.0)
    linear = TYPES.Vector3(x=SPEED * np.cos(course), y=SPEED * np.sin(course), z=0.0)
    twist = TYPES.Twist(linear=linear, angular=TYPES.Vector3(x=0.0, y=0.0, z=0.0))
    return TYPES.Odometry(
        header=TYPES.header(EPOCH + time, 'odom'), child_frame_id='base_link',
        pose=TYPES.PoseWithCovariance(TYPES.Pose(point, turn), zeros),
        twist=TYPES.TwistWithCovariance(twist, zeros),
    )  # fmt: skip


def run(seed: int, rate: float, late: float, parts: int, values: dict[str, Any]) -> Result:
    """Let a radar track for five minutes."""
    rng = np.random.default_rng(seed)
    place, velocity = contacts(rng)
    samples = np.arange(-3.0 / rate, PERIOD * TURNS, 1.0 / rate) + rng.uniform(0.0, 1.0 / rate)
    events = [Event(time + late, False, odometry(time)) for time in samples]
    events += messages(*plots_of(rng, place, velocity), parts)
    assembly = {'scan.assembly': 'message' if parts == 1 else 'sector'}
    configs = (RadarTrackerConfig(), radar_node_config())
    configs = configure(configs, {**VALUES, **assembly, **values})
    session = radar_session(*configs, TYPES, logging.getLogger('late'))
    tables: list[Any] = []
    waits: list[float] = []

    def use(came: Came, patience: float) -> None:
        table = session.plots(came.msg, came.received, patience)
        tables.append(table)
        waits.append(now - came.received)

    waiting = Waiting(session, configs[1], use)
    for now, is_plots, msg in sorted(events, key=lambda event: event.received):
        waiting.retry(now)
        (waiting.plots if is_plots else waiting.ownship)(msg, now)
    waiting.release()
    last = [table for table in tables[parts - 1 :: parts] if table is not None]
    return judge(last[SETTLED:], place, velocity, np.array(waits))


def judge(tables: Sequence[Any], place: Floats, velocity: Floats, waits: Floats) -> Result:
    """Compare the tracks at the end of each turn with the contacts."""
    distances: list[float] = []
    for msg in tables:
        table = to_columns(msg, 10_000)
        there = table['status'] == CONFIRMED
        time = stamp_of(msg) - EPOCH + table['time'][there]
        off = place + velocity * time[:, None, None]
        off = off - np.stack([table['x'][there], table['y'][there]], axis=1)[:, None]
        apart = np.hypot(off[..., 0], off[..., 1])
        rows = linear_sum_assignment(np.minimum(apart, RADIUS))
        distances += apart[rows][apart[rows] < RADIUS].tolist()
    held = len(distances) / (CONTACTS * (TURNS - SETTLED))
    off = float(np.sqrt(np.mean(np.square(distances))))
    return Result(off, held, waits.mean(), waits.max())


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=3)
    parser.add_argument('--set', action='append', default=[], metavar='NAME=VALUE')
    chosen = parser.parse_args(arguments)
    logging.disable(logging.CRITICAL)
    values = {name: parse_value(value) for name, value in (s.split('=') for s in chosen.set)}
    print('| odometry | messages | off | held | waited, mean | longest |')
    print('|---|---|---|---|---|---|')
    for rate, late in ODOMETRY:
        for parts, what in ((1, 'turns'), (SECTORS, 'sectors')):
            runs = [run(seed, rate, late, parts, values) for seed in range(chosen.runs)]
            off, held, waited, longest = np.mean(runs, axis=0)
            name = f'{rate:g} Hz' + (f', {late:g} s late' if late else '')
            times = f'{waited:.2f} s | {longest:.2f} s'
            print(f'| {name} | {what} | {off:.0f} m | {held:.3f} | {times} |', flush=True)


if __name__ == '__main__':
    main()
