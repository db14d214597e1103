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

from tracking_core.config import parameters
from tracking_session.parameter_blocks import BadParameterFile
from tracking_tools.evaluation import Yardstick
from tracking_tools.parameter_file import configure, parse_value
from tracking_tools.scenarios import build_any, SCENES
from tracking_tools.scenarios.broadcast import broadcast
from tracking_tools.sensors import SENSORS

Values = Mapping[str, Any]  # of parameters, by dotted name
PIECE = 2**20  # of a recording that is read at once [bytes]


@dataclass(frozen=True)
class Source:
    """Where plots come from: a scenario, or a recording with its truth."""

    name: str  # of the scenario, or the path of the bag
    digest: str = ''  # of the recording and its truth; '' for a scenario
    duration: float | None = None  # of the scenario, None: its own [s]
    truth: str = ''  # path of the bag that has it; '': the recording itself

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
    rules: tuple[str, ...] = ()  # where in a recording the messages are, plots:=/radar/plots

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


def source_of(name: str, duration: float | None = None, truth: Path | None = None) -> Source:
    """
    Return the scenario of that name or the recording at that path: a bag or its storage file.

    Raises
    ------
    ValueError
        Where there is neither, or no truth.

    """
    if name in SCENES:
        if truth is not None:
            raise ValueError(f'--truth is of a recording, but {name} is a scenario')
        return Source(name, duration=duration)
    path = Path(name)
    if not path.exists() and path.name == name and not path.suffix:
        build_any(name)  # says which scenarios there are
    digests = [_digest(bag) for bag in (path, truth) if bag is not None]
    return Source(str(path), ' '.join(digests), truth=str(truth or ''))


def _digest(bag: Path) -> str:
    """Return what a recording has in its storage, the same for a bag and its only file."""
    if not bag.exists():
        raise ValueError(f'no recording at {bag}')
    files = sorted(bag.iterdir()) if bag.is_dir() else [bag]
    parts = [_hash_of(file) for file in files if file.is_file() and file.name != 'metadata.yaml']
    return _hash(' '.join(parts).encode())


def _hash_of(file: Path) -> str:
    """Return the hash of a file, which may be larger than the memory."""
    digest = hashlib.sha256()
    with file.open('rb') as content:
        while piece := content.read(PIECE):
            digest.update(piece)
    return digest.hexdigest()


def swept_values(texts: Sequence[str]) -> dict[str, list[Any]]:
    """
    Return the values to try of each parameter, from texts as ``name=v1,v2``.

    A value may be a list in brackets: ``name=[0.2,2],[0.5,5]``.

    Raises
    ------
    BadParameterFile
        For a text of another form, and for a parameter or a value that is there twice.

    """
    swept: dict[str, list[Any]] = {}
    for text in texts:
        name, equals, values = text.partition('=')
        if not (name and equals and values):
            raise BadParameterFile(f'--set takes name=value,value, got {text!r}')
        if name.strip() in swept:
            raise BadParameterFile(f'--set {name} is there twice: give {name}=V1,V2 once')
        tried = swept[name.strip()] = parse_value(f'[{values}]')
        if not tried:
            raise BadParameterFile(f'--set {name} has no value')
        twice = [value for k, value in enumerate(tried) if value in tried[:k]]
        if twice:
            raise BadParameterFile(f'--set {name} has {twice[0]} twice')
    return swept


def check_apart(sources: Sequence[Source]) -> None:
    """Refuse with ValueError a source that is there twice: it would count as two."""
    seen: dict[str, str] = {}
    for source in sources:
        other = seen.setdefault(source.digest or source.name, source.name)
        if other != source.name:
            raise ValueError(f'{other} and {source.name} are the same recording')
    names = [source.name for source in sources]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f'{name} is there twice')


def check_sensor(sources: Sequence[Source], sensor: str) -> None:
    """Refuse with ValueError a scenario that another sensor than this sees."""
    for source in sources:
        if source.is_scenario and (of := broadcast(build_any(source.name)).sensor) != sensor:
            raise ValueError(f'{source.name} is a scenario of a {of}: give --sensor {of}')


def settings_of(swept: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Return every combination of the values, the last parameter changing fastest."""
    return [dict(zip(swept, values, strict=True)) for values in product(*swept.values())]


def tasks_of(
    sources: Sequence[Source], runs: int, settings: Sequence[Values], fixed: Values, sensor: str,
    yardstick: Yardstick, version: str, rules: Sequence[str],
) -> Iterator[tuple[Values, Task]]:  # fmt: skip
    """
    Yield each setting with each of its runs; a recording is run once, whatever the runs.

    The same values make the same task, in whatever order and form they were given.
    """
    for setting in settings:
        values = tuple(sorted(_as_configured({**fixed, **setting}, sensor).items()))
        for source in sources:
            seeds = range(1, runs + 1) if source.is_scenario else (0,)
            for seed in seeds:
                yield setting, Task(source, seed, sensor, values, yardstick, version, tuple(rules))


def _as_configured(values: Values, sensor: str) -> dict[str, Any]:
    """Return the values in the types that the parameters have: 100 is 100.0 for a range."""
    configs = configure(SENSORS[sensor].configs, values)
    typed = {p.name: p.value for config in configs for p in parameters(config)}
    return {name: typed.get(name, value) for name, value in values.items()}
