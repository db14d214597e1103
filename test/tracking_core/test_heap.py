# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Memory that scans take again and again is not fetched from the system each time."""

from __future__ import annotations

import os
import platform
import subprocess
import sys

import pytest

TUNED = ('GLIBC_TUNABLES', 'MALLOC_TRIM_THRESHOLD_', 'MALLOC_TOP_PAD_', 'MALLOC_MMAP_THRESHOLD_')
SCANS = """
import resource
import numpy as np
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
{call}
def faults():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for turn in range(20):
    before = faults()
    parts = [np.ones(12_000) for _ in range(60)]  # 6 MB in blocks that glibc does not map
    del parts
print(faults() - before)
"""


def faults(call: str) -> int:
    """Return the page faults of the last scan in a process of its own."""
    done = subprocess.run(
        [sys.executable, '-c', SCANS.format(call=call)], capture_output=True, text=True,
        timeout=60, check=True, env={k: v for k, v in os.environ.items() if k not in TUNED},
    )  # fmt: skip
    return int(done.stdout)


@pytest.mark.skipif(platform.libc_ver()[0] != 'glibc', reason='other C libraries do as they like')
def test_a_scan_finds_the_memory_of_the_last_one() -> None:
    """Without a tracker all pages are asked for anew, in a process with one none."""
    without = faults('')
    if without < 100:
        pytest.skip('pages of this system are so large that there is nothing to save')
    assert faults('RadarTracker(RadarTrackerConfig())') < 0.1 * without
