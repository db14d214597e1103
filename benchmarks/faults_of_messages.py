# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of what comes in: lost, doubled, late, leaping. Each acts on a stage, then it is over."""

from __future__ import annotations

import numpy as np

from benchmarks.fault_outcome import Fault
from benchmarks.fault_stage import PERIOD, Stage

LONG = 24  # scans for which messages are bad
SILENCE = 20  # scans without own ship, longer than its timeout of 2 s
LEAP, JUMP = 1000.0, 500.0  # m, s


def drop(stage: Stage) -> None:
    """Lose every third scan on the way."""
    for number in range(LONG):
        stage.scan() if number % 3 else stage.idle()


def double(stage: Stage) -> None:
    """Send every scan twice."""
    for _ in range(LONG):
        stamp = stage.tick()
        for _ in range(2):
            stage.probe.send(stage.scene.plots(stamp), stamp)


def late(stage: Stage, most: int) -> None:
    """Delay each scan by up to so many scans, at random."""
    rng, waiting = np.random.default_rng(0), []
    for _ in range(LONG):
        stamp = stage.tick()
        waiting.append((stamp + PERIOD * rng.integers(0, most + 1), -stamp))  # the newest first
        for entry in sorted(waiting):
            if entry[0] <= stamp + 0.5 * PERIOD:
                waiting.remove(entry)
                stage.probe.send(stage.scene.plots(-entry[1]), -entry[1])


def too_late(stage: Stage) -> None:
    """Send one scan in six once more with the stamp of five scans ago, as a slow network would."""
    for number in range(LONG):
        stage.scan()
        if number % 6 == 5:
            stamp = stage.now - 5.5 * PERIOD
            stage.probe.send(stage.scene.plots(stamp), stamp)


def silent_ship(stage: Stage) -> None:
    """Let own ship say nothing for longer than its timeout."""
    stage.scans(SILENCE, stage.plots)


def leaping_ship(stage: Stage, scans: int) -> None:
    """Let own ship be far off for so many scans."""
    for _ in range(scans):
        stamp = stage.tick()
        stage.tell_own_ship(stamp, LEAP)
        stage.probe.send(stage.scene.plots(stamp), stamp)


def clock_jump(stage: Stage, by: float) -> None:
    """Let the stamps, and /clock where there is one, jump."""
    stage.shift += by
    stage.probe.tables.clear()


MESSAGE_FAULTS = (
    Fault('every third scan is lost', drop),
    Fault('every scan comes twice', double),
    Fault('scans are late and out of order by up to 3', lambda stage: late(stage, 3)),
    Fault('an old scan comes again and again, 5.5 scans late', too_late),
    Fault('own ship is silent for 5 s', silent_ship, is_afloat=True),
    Fault('own ship leaps by 1 km for one message', lambda s: leaping_ship(s, 1), is_afloat=True),
    Fault('own ship leaps by 1 km for 3 s', lambda s: leaping_ship(s, 12), is_afloat=True),
    Fault('stamps go back by 500 s', lambda stage: clock_jump(stage, -JUMP)),
    Fault('stamps go ahead by 500 s', lambda stage: clock_jump(stage, JUMP)),
    Fault(
        '/clock and stamps go back by 500 s, as in a looped bag',
        lambda stage: clock_jump(stage, -JUMP), ('use_sim_time:=true',), has_clock=True,
    ),
    Fault(
        '/clock and stamps go ahead by 500 s', lambda stage: clock_jump(stage, JUMP),
        ('use_sim_time:=true',), has_clock=True,
    ),
)  # fmt: skip
