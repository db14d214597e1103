# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Processes around the live radar node are killed and started again: the tracks come back."""

import pytest

from benchmarks.fault_outcome import play, repeat, staged
from benchmarks.faults import kill
from benchmarks.faults_of_messages import MESSAGE_FAULTS
from benchmarks.faults_of_processes import KILL_NODE, KILL_PLOTS, KILLS
from benchmarks.shared_memory import shared_memory

MOST = 15.0  # s: start of a process and discovery on a loaded machine, then six scans
TIMES = 20
LEAP = next(fault for fault in MESSAGE_FAULTS if 'for 3 s' in fault.name)


@pytest.mark.parametrize('fault', [KILL_PLOTS, KILL_NODE], ids=['radar', 'tracker'])
def test_tracks_come_back_after_a_process_was_killed(fault, tmp_path):
    """SIGKILL and a new start: all contacts are held again."""
    ((_, seconds),) = repeat(fault, 1, tmp_path)
    assert seconds < MOST


def test_what_a_killed_process_leaves_goes_with_the_stage(tmp_path):
    """Its segment in shared memory, that is, and no file of a process that may still begin."""
    with staged(KILL_NODE, tmp_path) as (stage, scan):
        stage.settle(scan)
        node = stage.nodes[-1]
        left = shared_memory(node.process.pid)
        stage.kill(node)
        assert len(left) == 2
        assert all(file.exists() for file in left)
    assert not any(file.exists() for file in left)


@pytest.mark.soak
@pytest.mark.parametrize('fault', KILLS, ids=['radar', 'tracker', 'ship'])
def test_tracks_come_back_after_every_one_of_many_kills(fault, tmp_path):
    """Twenty times in one graph; prints how long it took."""
    print(kill(fault, TIMES, tmp_path))


@pytest.mark.soak
@pytest.mark.parametrize('fault', MESSAGE_FAULTS, ids=lambda fault: fault.name)
def test_tracks_come_back_after_bad_messages(fault, tmp_path):
    """Each fault of the table in docs/reliability.md; prints its row."""
    print(play(fault, tmp_path).row(fault.name))


@pytest.mark.soak
def test_leap_of_own_ship_is_told(tmp_path):
    """The diagnostics name it."""
    assert 'ownship refused: own ship leaps' in play(LEAP, tmp_path).seen
