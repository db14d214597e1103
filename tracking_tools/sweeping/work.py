# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""One run: simulate or take a recording, track it, and compare the tracks with the truth."""

from __future__ import annotations

from dataclasses import asdict, replace
import json
from pathlib import Path
from tempfile import TemporaryDirectory

from tracking_tools.bags import BadBag
from tracking_tools.evaluation import evaluate, Judgement
from tracking_tools.evaluation.text import plain
from tracking_tools.parameter_file import configure
from tracking_tools.replay import replay
from tracking_tools.replay_topics import Topics
from tracking_tools.scenarios import build_any
from tracking_tools.sensors import SENSORS
from tracking_tools.simulate import record
from tracking_tools.sweeping.tasks import Task


def work(task: Task) -> str:
    """
    Do one run and return its result, which is the same wherever it is done.

    Returns
    -------
    str
        JSON: the task, and all figures in SI units and radians, but not scan by scan.

    """
    with TemporaryDirectory(prefix='sweep_') as folder:
        recording, tracks = _recording(task, Path(folder)), Path(folder) / 'tracks'
        sensor = SENSORS[task.sensor]
        configs = configure(sensor.configs, dict(task.values))
        rules = task.rules if not task.source.is_scenario else ()
        topics = Topics.remapped(rules, sensor)
        summary = replay(recording, tracks, configs, topics, quiet=True, sensor=sensor)
        if summary.unused:
            raise BadBag(f'no message of {topics.plots} could be used: {summary.unused}')
        truth = Path(task.source.truth) if task.source.truth else recording
        judgement = evaluate(tracks, truth, task.yardstick, rules, task.sensor)
    result = {'task': task.identity, 'figures': _figures(judgement)}
    return json.dumps(result, indent=1, sort_keys=True, allow_nan=False) + '\n'


def _recording(task: Task, folder: Path) -> Path:
    if not task.source.is_scenario:
        return Path(task.source.name)
    scene = replace(build_any(task.source.name), seed=task.seed)
    if task.source.duration is not None:
        scene = replace(scene, duration=task.source.duration)
    record(scene, folder / 'plots', quiet=True)
    return folder / 'plots'


def _figures(judgement: Judgement) -> dict[str, object]:
    figures: dict[str, object] = plain(asdict(judgement))
    del figures['by_scan']
    return figures
