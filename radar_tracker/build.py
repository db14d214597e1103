# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the parameters of a radar tracker become filters and rules?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from radar_tracker.antenna import Antenna
from radar_tracker.config import RadarTrackerConfig, ScanConfig
from radar_tracker.planes import build_planes
from radar_tracker.sensor import Radar
from radar_tracker.turns import Turns
from tracking_core.assembly import assemble
from tracking_core.batches import Plots
from tracking_core.composition import Setup
from tracking_core.cycles import Cycles
from tracking_core.several_plots import Extent

__all__ = [
    'build_antenna', 'build_collectors', 'build_planes', 'build_setup', 'told_turn_time',
]  # fmt: skip


def build_setup(config: RadarTrackerConfig, radar: Radar) -> Setup:
    """Return sensor, filters and rules for these parameters."""
    planes = build_planes(config, radar.dimensions)
    size = config.sensor.contact_size
    resolution = max(config.sensor.range_resolution, size)
    setup = assemble(config, radar, planes, config.initiation, resolution)
    extent = Extent(size, config.initiation.speed_max)
    return replace(setup, extent=extent)


def build_antenna(scan: ScanConfig) -> Antenna:
    """Return an antenna of which nothing is known beside these parameters."""
    collects = scan.assembly == 'rotation'
    return Antenna(
        scan.period,
        full_turns=scan.assembly != 'sector',
        # A collected turn has the stamp of its first sector, and begins about there.
        time_reference='start' if collects else scan.time_reference,
        stares=scan.assembly == 'snapshot',
        collects=collects,
    )


def build_collectors(scan: ScanConfig, most: int) -> tuple[Turns | None, Cycles[Plots] | None]:
    """Return what puts sectors together to turns, and messages to looks, of `most` plots each."""
    is_look = scan.assembly == 'snapshot' and scan.period > 0.0
    return (
        Turns(scan.period, most) if scan.assembly == 'rotation' else None,
        Cycles[Plots](scan.period, most) if is_look else None,
    )


def told_turn_time(scan: ScanConfig) -> float:
    """Return the time of a scan in several messages [s]; 0: there are none, inf: to be learnt."""
    return {'sector': np.inf, 'rotation': np.inf, 'snapshot': scan.period}.get(scan.assembly, 0.0)
