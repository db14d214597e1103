# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do simulated scenes reach a tracker without messages?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tracking_core.batches import Plots
from tracking_tools.scenarios import plots, Scenario
from tracking_tools.scenarios.plots import SimulatedScan


def messages(
    scenario: Scenario, rng: np.random.Generator, sectors: int = 1
) -> Iterator[tuple[Plots, SimulatedScan]]:
    """Yield what the tracker gets of each turn or sector, and the truth beside."""
    for scan in plots(scenario, rng, sectors):
        columns = dict(scan.columns)
        time = columns.pop('time')
        if 'x' in columns:
            axes = [columns.pop(name) for name in 'xyz' if name in columns]
            made = Plots.cartesian(time, np.stack(axes, axis=1), **columns)
        else:
            made = Plots.polar(time, columns.pop('range'), columns.pop('azimuth'), **columns)
        yield replace(made, stamp=scan.start), scan
