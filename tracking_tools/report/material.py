# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a page shows: the rows of a recording, its figures, its parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tracking_core.batches import Floats
from tracking_core.config import parameters
from tracking_session.node_config import Configs
from tracking_tools.bags import BadBag, open_bag, POINT_CLOUD
from tracking_tools.bearing_scene import BearingScene, read_bearing_scene
from tracking_tools.evaluation import judge, Judgement, Yardstick
from tracking_tools.evaluation.reading import read_tracks
from tracking_tools.replay_topics import check_named, check_topics, DIAGNOSTICS, Topics
from tracking_tools.scene import read_scene, Scene
from tracking_tools.sensors import SENSORS

STEP_TIME = 'step time [s]'


class Setting(NamedTuple):
    """One parameter as a reader sees it."""

    name: str
    value: str
    unit: str
    meaning: str
    is_default: bool


@dataclass(frozen=True)
class Material:
    """All that a page shows."""

    title: str
    scene: Scene | BearingScene
    judgement: Judgement | None  # None without a truth
    settings: Sequence[Setting]  # empty: the parameters are not known
    step_times: Floats  # of each scan [s]; empty: not recorded
    sources: Sequence[tuple[str, str]]  # what comes from where


@dataclass(frozen=True)
class Sources:
    """Which bags and topics."""

    kind: str  # 'radar' or 'sonar'
    topics: Topics
    tracks: Path
    plots: Path | None = None
    truth: Path | None = None


def gather(
    sources: Sources,
    configs: Configs | None = None,
    step_times: Sequence[float] = (),
    yardstick: Yardstick | None = None,
    title: str = '',
) -> Material:
    """
    Read what there is.

    Parameters
    ----------
    sources : Sources
        Bags; what is missing is not shown.
    configs : tuple, optional
        Parameters that the tracks were made with, if known.
    step_times : sequence of float
        Of each scan [s]; by default what their node told in the diagnostics of the tracks bag.
    yardstick : Yardstick, optional
        With what measure tracks are judged.
    title : str
        Of the page; by default the name of the tracks bag.

    Raises
    ------
    BadBag
        If there is nothing to show, or no plots or truth where they were promised.

    """
    if sources.plots is not None:
        with open_bag(sources.plots) as bag:
            check_topics(bag, sources.topics, sources.plots)
    topics, usual = sources.topics, SENSORS[sources.kind].configs
    scene = _read_scene(sources, configs or usual)
    published = scene.published if isinstance(scene, Scene) else scene.tracks
    if not len(published.get('id', ())):
        raise BadBag(f'{sources.tracks}: {topics.tracks} has no confirmed track')
    recorded = step_times or _recorded_step_times(sources.tracks, topics.tracks)
    taken = np.array(recorded, np.float64)
    named = {'tracks': (sources.tracks, topics.tracks), 'plots': (sources.plots, topics.plots),
             'truth': (sources.truth, topics.truth)}  # fmt: skip
    return Material(
        title or sources.tracks.name,
        scene,
        _judge(sources, yardstick or Yardstick()),
        tuple(_settings(configs, usual)) if configs else (),
        taken,
        [(what, f'{bag}, topic {topic}') for what, (bag, topic) in named.items() if bag],
    )


def of_replay(kind: str, topics: Topics, recording: Path, tracks: Path) -> Sources:
    """Return the sources of a recording that was tracked, with its truth if it has one."""
    with open_bag(recording) as bag:
        check_named(bag, topics, recording, ('truth',))
        tables = {c.topic for c in bag.connections if c.msgtype == POINT_CLOUD}
        truth = recording if topics.truth in tables else None
    return Sources(kind, topics, tracks, recording, truth)


def _read_scene(sources: Sources, configs: Configs) -> Scene | BearingScene:
    tracker, node = configs
    plots, fields = sources.plots or sources.tracks, vars(node.fields)
    read: Any = read_scene if sources.kind == 'radar' else read_bearing_scene
    found: Scene | BearingScene = read(
        plots, sources.tracks, sources.topics, tracker.sensor, fields, sources.truth
    )
    return found if sources.truth else replace(found, truth={})


def _judge(sources: Sources, yardstick: Yardstick) -> Judgement | None:
    if sources.truth is None:
        return None
    where = (sources.kind, sources.topics, sources.tracks, sources.truth)
    return judge(read_tracks(*where, yardstick.turning), yardstick)


def _settings(configs: Configs, defaults: Configs) -> list[Setting]:
    usual = {p.name: p.value for config in defaults for p in parameters(config)}
    return [
        Setting(p.name, _in_words(p.value), p.unit, p.doc, p.value == usual[p.name])
        for config in configs
        for p in parameters(config)
    ]


def _in_words(value: Any) -> str:
    if isinstance(value, (tuple, list)):
        return ', '.join(_in_words(part) for part in value)
    return f'{value:.6g}' if isinstance(value, float) else str(value)


def _recorded_step_times(bag: Path, tracks: str) -> list[float]:
    """Return what the live node of the tracks, or the only one, told of its steps, if recorded."""
    told: dict[str, list[float]] = {}  # by node
    with open_bag(bag) as reader:
        chosen = [c for c in reader.connections if c.topic == DIAGNOSTICS]
        for connection, _, raw in reader.messages(chosen) if chosen else ():
            msg: Any = reader.deserialize(raw, connection.msgtype)
            for status in msg.status:
                times = [float(v.value) for v in status.values if v.key == STEP_TIME]
                if times:
                    told.setdefault(status.name.partition(':')[0], []).extend(times)
    only = next(iter(told.values())) if len(told) == 1 else []
    return told.get(tracks.rpartition('/')[0].lstrip('/'), only)
