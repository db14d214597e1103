# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Does the watch see a node that grows through the noise of one that does not?"""

import os
from pathlib import Path

import numpy as np
import pytest

from benchmarks.endurance import CROWD_TURNS, GROWTH, SPANS
from benchmarks.node_watch import Watch

pytestmark = pytest.mark.skipif(not Path('/proc/self/statm').exists(), reason='needs /proc')
TABLE = {'id': np.array([1]), 'status': np.array([1])}


def watched(leak: float, seed: int) -> Watch:
    """Return what is seen of 250 MB of which buffers come and go, and so much [MB] stays."""
    watch, rng = Watch(), np.random.default_rng(seed)
    for span in range(SPANS):
        for turn in range(CROWD_TURNS):
            done = (span * CROWD_TURNS + turn) / (SPANS * CROWD_TURNS)
            watch.hear(TABLE, round(1e6 * (250.0 + leak * done + rng.uniform(-12.0, 12.0))))
        watch.span(os.getpid(), CROWD_TURNS)
    return watch


@pytest.mark.parametrize('seed', range(20))
def test_growth_is_seen_through_noise(seed):
    """20 MB of 250 that stay are seen each time; buffers alone are not mistaken for growth."""
    assert watched(20.0, seed).trend > GROWTH
    assert abs(watched(0.0, seed).trend) < GROWTH
