# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is to be done: every setting on every scenario and seed, and on every recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
import hashlib
from itertools import product
import json
from pathlib import Path
from typing import Any

from msg_adapters.parameter_blocks import BadParameterFile
from tracking_tools.evaluation import Yardstick
from tracking_tools.parameter_file import parse_value
from tracking_tools.scenarios import build, SCENARIOS

Values = Mapping[str, Any]  # of parameters, by dotted name


@dataclass(frozen=True)
class Source:
    """Where plots come from: a scenario, or a recording with its truth."""

    name: str  # of the scenario, or the path of the bag
    digest: str = ''  # of the recording; '' for a scenario
    duration: float | None = None  # of the scenario, None: its own [s]

    @property
    def is_scenario(self) -> bool:
        """Whether it is simulated, with a seed for every run."""
        return not self.digest


@dataclass(frozen=True)
class Task:
    """One run. It says all that its result depends on, and travels to other machines."""

    source: Source
    seed: int
    sensor: str
    values: tuple[tuple[str, Any], ...]  # of all parameters that are not left as they are
    yardstick: Yardstick
    version: str  # of this package

    @property
    def identity(self) -> dict[str, Any]:
        """All of it, as JSON has it."""
        return dict(json.loads(json.dumps(asdict(self))))

    @property
    def key(self) -> str:
        """A name for its file: readable, and different for every task."""
        text = json.dumps(self.identity, sort_keys=True)
        return f'{Path(self.source.name).name}-{self.seed}-{_hash(text.encode())[:16]}'


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def source_of(name: str, duration: float | None = None) -> Source:
    """
    Return the scenario of that name or the recording at that path.

    Raises
    ------
    ValueError
        Where there is neither.

    """
    if name in SCENARIOS:
        return Source(name, duration=duration)
    folder = Path(name)
    if not folder.is_dir():
        build(name)  # says which scenarios there are
    parts = [_hash(file.read_bytes()) for file in sorted(folder.iterdir()) if file.is_file()]
    return Source(str(folder), _hash(' '.join(parts).encode()))


def swept_values(texts: Sequence[str]) -> dict[str, list[Any]]:
    """
    Return the values to try of each parameter, from texts as ``name=v1,v2``.

    A value may be a list in brackets: ``name=[0.2,2],[0.5,5]``.
    """
    swept: dict[str, list[Any]] = {}
    for text in texts:
        name, equals, values = text.partition('=')
        if not (name and equals and values):
            raise BadParameterFile(f'--set takes name=value,value, got {text!r}')
        swept[name.strip()] = parse_value(f'[{values}]')
    return swept


def settings_of(swept: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Return every combination of the values, the last parameter changing fastest."""
    return [dict(zip(swept, values, strict=True)) for values in product(*swept.values())]


def tasks_of(
    sources: Sequence[Source], runs: int, settings: Sequence[Values], fixed: Values, sensor: str,
    yardstick: Yardstick, version: str,
) -> Iterator[tuple[Values, Task]]:  # fmt: skip
    """Yield each setting with each of its runs; a recording is run once, whatever the runs."""
    for setting in settings:
        values = tuple({**fixed, **setting}.items())
        for source in sources:
            for seed in range(1, runs + 1) if source.is_scenario else (0,):
                yield setting, Task(source, seed, sensor, values, yardstick, version)
