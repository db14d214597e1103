# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The live radar node for a long time: memory and cost of a turn stay, ids are given once."""

from pathlib import Path

import pytest

from benchmarks.endurance import CROWD, crowd, CROWDED, day, DRIFT, GROWTH

LITTLE = 0.03  # of memory: an hour is 40 turns here, so that buffers still fill in the second

pytestmark = pytest.mark.skipif(not Path('/proc/self/statm').exists(), reason='needs /proc')


def test_node_does_not_grow_in_a_short_day(tmp_path):
    """Three hours of 40 turns with contacts that come and go."""
    watch = day(3, tmp_path / 'node.log', turns=40)
    assert watch.growth < LITTLE
    assert watch.newest > 100
    assert watch.again == 0


@pytest.mark.soak
def test_node_does_not_grow_in_a_day(tmp_path):
    """21,600 turns: the first hour is the measure."""
    watch = day(24, tmp_path / 'node.log')
    print(watch.verdict())
    assert watch.growth < GROWTH
    assert watch.drift < DRIFT
    assert watch.again == 0


@pytest.mark.soak
def test_node_does_not_grow_with_ten_thousand_tracks(tmp_path):
    """1000 turns: the first hundred are the measure."""
    watch = crowd(tmp_path / 'node.log')
    print(watch.verdict())
    assert watch.confirmed > 0.98 * CROWD
    assert watch.growth < CROWDED
    assert watch.trend < GROWTH
    assert watch.drift < DRIFT
    assert watch.again == 0
