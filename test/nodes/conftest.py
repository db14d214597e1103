# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A node as its own process, and a probe that publishes to it and hears what it says."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from itertools import count
from pathlib import Path

import pytest

from tracking_tools.testing import (
    NodeProcess,
    python_node,
    RADAR,
    SONAR,
    SyntheticSensor,
    TrackerProbe,
)

ROOT = Path(__file__).parents[2]


@pytest.fixture
def radar() -> SyntheticSensor:
    """Return the radar."""
    return RADAR


@pytest.fixture
def sonar() -> SyntheticSensor:
    """Return the sonar."""
    return SONAR


@pytest.fixture
def sensor(radar: SyntheticSensor) -> SyntheticSensor:
    """Return the radar; tests of the sonar say otherwise."""
    return radar


@pytest.fixture
def start_node(
    ros_domain_id: int, sensor: SyntheticSensor, tmp_path: Path
) -> Iterator[Callable[..., NodeProcess]]:
    """Start nodes that end with the test."""
    started: list[NodeProcess] = []
    numbers = count(1)
    with ExitStack() as running:

        def start(*parameters: str, arguments: Sequence[str] = ()) -> NodeProcess:
            given = [word for parameter in parameters for word in ('-p', parameter)]
            command = python_node(f'{sensor.node}.node', *given, *arguments)
            log = tmp_path / f'node_{next(numbers)}.log'
            started.append(NodeProcess(command, ros_domain_id, log, folder=ROOT))
            return running.enter_context(started[-1])

        yield start
    for process in started:
        print(process.log)  # shown where a test fails


@pytest.fixture
def probe(ros_domain_id: int, sensor: SyntheticSensor) -> Iterator[TrackerProbe]:
    """Give a probe in the domain of the test."""
    with TrackerProbe(ros_domain_id, sensor) as probe:
        yield probe
