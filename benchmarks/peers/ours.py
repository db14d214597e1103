# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Our own trackers on the plots of a scene."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from benchmarks.peers.scenes import Knowledge
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.tracker import bearing_states, SonarTracker
from tracking_core.batches import Bearings, Floats, Ints, Plots
from tracking_core.config import with_values

_LIFETIME = 600.0  # of a contact in view [s]


class OurRadar:
    """IMM with two modes, existence probability; JPDA* or another."""

    def __init__(self, knowledge: Knowledge, **values: str) -> None:
        volume = np.pi * knowledge.region**2
        self._tracker = RadarTracker(
            with_values(
                RadarTrackerConfig(),
                {
                    'scan.assembly': 'snapshot',
                    'sensor.position_sd': knowledge.noise,
                    'sensor.detection_probability': knowledge.detection_probability,
                    'sensor.range_max': knowledge.region,
                    'clutter_density': max(knowledge.clutter_density, 1.0 / (10.0 * volume)),
                    'motion.horizontal.acceleration_sd': [
                        mode.acceleration_sd for mode in knowledge.modes
                    ],
                    'motion.horizontal.sojourn_time': list(knowledge.sojourn),
                    'initiation.speed_max': knowledge.speed_max,
                    'initiation.speed_sd': knowledge.speed_sd,
                    'existence.new_contacts': knowledge.arrivals,
                    'existence.lifetime': _LIFETIME,
                    **values,
                },
            )
        )

    def step(self, time: float, plots: Floats) -> tuple[Ints, Floats]:
        """Return ids (T,) and positions (T, 2) of the confirmed tracks after a scan."""
        scan = replace(Plots.cartesian(np.full(len(plots), time), plots), stamp=time)
        tracks = self._tracker.track(scan)
        mean, _ = tracks.planes[0].estimate('mmse')
        return tracks.id[tracks.confirmed], mean[tracks.confirmed][:, [0, 2]]


class OurSonar:
    """Kalman filter with two modes, existence probability; JPDA or another."""

    def __init__(self, knowledge: Knowledge, **values: str) -> None:
        self._tracker = SonarTracker(
            with_values(
                SonarTrackerConfig(),
                {
                    'estimator': 'kalman',
                    'sensor.bearing_sd': knowledge.noise,
                    'sensor.detection_probability': knowledge.detection_probability,
                    'sensor.sector_width': 2.0 * knowledge.region,
                    'clutter_density': knowledge.clutter_density,
                    'gate.probability': 0.997,  # as all others here
                    'motion.bearing_noise': [mode.position_noise for mode in knowledge.modes],
                    'motion.rate_noise': [mode.velocity_noise for mode in knowledge.modes],
                    'motion.sojourn_time': list(knowledge.sojourn),
                    'initiation.rate_max': knowledge.speed_max,
                    'initiation.rate_sd': knowledge.speed_sd,
                    'existence.new_contacts': knowledge.arrivals,
                    'merge.distance': 0.0,
                    'ranging.enabled': False,
                    **values,
                },
            )
        )

    def step(self, time: float, plots: Floats) -> tuple[Ints, Floats]:
        """Return ids (T,) and bearings (T, 1) of the confirmed tracks after a cycle."""
        marks = replace(Bearings.of(np.full(len(plots), time), plots[:, 0]), stamp=time)
        tracks = self._tracker.track(marks)
        bearing = bearing_states(tracks).bearing
        return tracks.id[tracks.confirmed], bearing[tracks.confirmed, None]


def ours(knowledge: Knowledge, **values: str) -> OurRadar | OurSonar:
    """Return the tracker for plots of one or two coordinates; `values` are parameters."""
    return (OurSonar if knowledge.axes == 1 else OurRadar)(knowledge, **values)
