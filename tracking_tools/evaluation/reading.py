# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is compared? The rows of a tracks bag, and the truth of another or the same bag."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from msg_adapters.message_types import seconds
from msg_adapters.table import Columns
from tracking_core.batches import Floats
from tracking_tools.bags import BadBag, open_bag, POINT_CLOUD
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.evaluation.rows import (
    bearing_rows,
    has_heights,
    judged_rows,
    no_rows,
    position_rows,
)
from tracking_tools.evaluation.truths import bearings_of, positions_of, ranges_of
from tracking_tools.own_ship import read_platform
from tracking_tools.replay_topics import check_named, check_type_of, inventory, Topics
from tracking_tools.scene import choose, frame_of, read_rows, table_rows
from tracking_tools.sensors import SENSORS
from tracking_tools.track_table import check_table, NEEDED


def read_recorded(
    tracks: Path | str,
    truth: Path | str,
    rules: Sequence[str],
    sensor: str | None,
    turning: float,
) -> Recorded:
    """
    Return tracks and truth of bags.

    Parameters
    ----------
    tracks : Path or str
        Bag with track tables.
    truth : Path or str
        Bag with the truth; of a sonar also with own ship, if it moved.
    rules : sequence of str
        Other topics, ``truth:=/other``; also ``tracks`` and ``ownship``.
    sensor : str, optional
        'radar' or 'sonar'; the tracks tell by themselves which.
    turning : float
        A contact turns when its course changes faster than this [rad/s].

    Raises
    ------
    BadBag
        If a topic or a column is missing, nothing is there, or the times do not overlap.
    FileNotFoundError
        If there is no bag.

    """
    kind, topics = find_sensor(tracks, rules, sensor)
    return read_tracks(kind, topics, tracks, truth, turning)


def read_tracks(
    kind: str, topics: Topics, tracks: Path | str, truth: Path | str, turning: float
) -> Recorded:
    """Return what `read_recorded` returns, where the sensor and its topics are known."""
    table, stamps = _read_tracks(tracks, topics, kind)
    real = read_truth(truth, topics.truth, ('id', 'x', 'y'))
    _check_frames(tracks, topics.tracks, truth, topics.truth)
    _check_overlap(stamps, real['time'], tracks, truth)
    ranges = None
    if kind == 'sonar':
        with open_bag(truth) as bag:
            check_type_of('ownship', bag, topics, truth)
            check_named(bag, topics, truth, ('ownship',))
        platform = read_platform(truth, topics.ownship)
        told, ranges = bearings_of(real, platform, turning), ranges_of(real, platform)
    else:
        told = positions_of(real, turning)
    size = 1 if kind == 'sonar' else 3 if has_heights(table) else 2
    is_level = not np.isfinite(real.get('z', np.nan)).all()
    d = min(size, 2) if is_level else size
    rows = bearing_rows(table, stamps) if kind == 'sonar' else position_rows(table, stamps, d)
    told = replace(told, position=told.position[:, :d], velocity=told.velocity[:, :d])
    period = float(np.median(np.diff(stamps))) if len(stamps) > 1 else 1.0
    starts = np.append(stamps, stamps[-1] + period)
    has_velocity = bool(np.isfinite(real.get('vx', np.nan)).any())
    return Recorded(kind, rows, table, told, starts, has_velocity, size, ranges)


def find_sensor(bag: Path | str, rules: Sequence[str], sensor: str | None) -> tuple[str, Topics]:
    """Return which sensor's tracks a bag has, and the topics."""
    named = _topics_of_sensors(rules, SENSORS if sensor is None else (sensor,))
    with open_bag(bag) as reader:
        there = {c.topic: c for c in reader.connections if c.msgtype == POINT_CLOUD}
        fits = {kind: topics for kind, topics in named.items() if topics.tracks in there}
        if not fits:
            wanted = ' or '.join(dict.fromkeys(topics.tracks for topics in named.values()))
            raise BadBag(
                f'{bag} has no topic {wanted} of type {POINT_CLOUD}; it has {inventory(reader)}. '
                'Say which are the tracks with --remap tracks:=/TOPIC'
            )
        if len(fits) > 1:  # one topic, given by a rule
            topic = next(iter(fits.values())).tracks
            for _, _, raw in reader.messages([there[topic]]):
                msg: Any = reader.deserialize(raw, there[topic].msgtype)
                kind = 'sonar' if 'bearing' in {f.name for f in msg.fields} else 'radar'
                return kind, fits[kind]
    return next(iter(fits.items()))


def _topics_of_sensors(rules: Sequence[str], kinds: Iterable[str]) -> dict[str, Topics]:
    """Return the topics of each sensor that knows all names in the rules; BadBag if none does."""
    named, refused = {}, []
    for kind in kinds:
        try:
            named[kind] = Topics.remapped(rules, SENSORS[kind])
        except BadBag as error:  # plots:= is of a radar, bearings:= of a sonar
            refused.append(error)
    if not named:
        raise refused[0]
    return named


def read_truth(bag: Path | str, topic: str, needed: Sequence[str]) -> Columns:
    """
    Return the true rows on a topic, those that lack one of these columns left out.

    BadBag where there are none.
    """
    _check_topic(bag, topic, 'truth with --truth BAG, or with --remap truth:=/TOPIC')
    table = read_rows(bag, topic, table_rows)
    if not table:
        raise BadBag(f'{bag}: {topic} has no rows')
    missing = [name for name in needed if name not in table]
    if missing:
        raise BadBag(f'{bag}: {topic} has no column {", ".join(missing)}; it has '
                     f'{", ".join(table)}')  # fmt: skip
    told = np.all([np.isfinite(table[name]) for name in (*needed, 'time')], axis=0)
    if not told.any():
        raise BadBag(f'{bag}: no row of {topic} has numbers in all of {", ".join(needed)}')
    return choose(table, told)


def _read_tracks(bag: Path | str, topics: Topics, kind: str) -> tuple[Columns, Floats]:
    """Return the rows that are judged and the stamps of all tables, also of those without rows."""
    _check_topic(bag, topics.tracks, 'tracks with --remap tracks:=/TOPIC')
    tables: set[tuple[float, int]] = set()

    def convert(msg: Any) -> Columns:
        rows, copy = table_rows(msg), (seconds(msg.header.stamp), hash(msg.data.tobytes()))
        is_new = copy not in tables  # two recorders make copies
        tables.add(copy)
        return rows if is_new else choose(rows, slice(0))

    table = read_rows(bag, topics.tracks, convert) or no_rows(NEEDED[kind])
    if not tables:
        raise BadBag(f'{bag}: {topics.tracks} has no messages')
    moments = np.unique([stamp for stamp, _ in tables])
    if len(moments) < len(tables):
        told = f'{len(tables)} different tables, but of {len(moments)} moments'
        why = 'were the plots played again meanwhile, or are there two trackers of one name?'
        raise BadBag(f'{bag}: {topics.tracks} has {told}: {why}')
    check_table(table, kind, f'{topics.tracks} in {bag}')
    confirmed = choose(table, judged_rows(table, kind))
    return choose(confirmed, np.argsort(confirmed['stamp'], kind='stable')), moments


def _check_topic(bag: Path | str, topic: str, what: str) -> None:
    with open_bag(bag) as reader:
        kinds = {c.topic: c.msgtype for c in reader.connections}
        if kinds.get(topic) != POINT_CLOUD:
            raise BadBag(
                f'{bag} has no topic {topic} of type {POINT_CLOUD}; it has {inventory(reader)}. '
                f'Say which has the {what}'
            )


def _check_frames(tracks: Path | str, table: str, truth: Path | str, real: str) -> None:
    """Raise BadBag where both tables say in which frame they are, and not in the same."""
    ours, theirs = frame_of(tracks, table), frame_of(truth, real)
    if ours and theirs and ours != theirs:
        raise BadBag(
            f'the tracks of {tracks} are in frame {ours}, the truth of {truth} in frame {theirs}'
        )


def _check_overlap(stamps: Floats, real: Floats, tracks: Path | str, truth: Path | str) -> None:
    if stamps[-1] < real.min() or stamps[0] > real.max():
        raise BadBag(
            f'the tracks of {tracks} are from {stamps[0]:.3f} to {stamps[-1]:.3f} s, the truth of '
            f'{truth} from {real.min():.3f} to {real.max():.3f} s: they have no time in common'
        )
