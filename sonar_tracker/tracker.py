# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does a cycle of bearings become tracks? The object that node and replay drive."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from sonar_tracker.build import build_setup
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.ranging import RangeEstimates, Ranging
from sonar_tracker.sensor import Sonar
from sonar_tracker.turn_check import TurnCheck
from tracking_core.batches import Bearings, Coverage, Floats, Tracks
from tracking_core.cycles import Cycles
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform, pose_at
from tracking_core.platform_pose import PlatformPose
from tracking_core.rows import take
from tracking_core.space import Space
from tracking_core.state import State
from tracking_core.tracker import Tracker


@dataclass(frozen=True)
class BearingStates:
    """What is known of the bearings of T tracks."""

    bearing: Floats  # (T,) tracking axes, in [-pi, pi) [rad]
    bearing_rate: Floats  # (T,) [rad/s]
    bearing_sd: Floats  # (T,) [rad]
    bearing_rate_sd: Floats  # (T,) [rad/s]


def bearing_states(tracks: Tracks, output: str = 'mmse') -> BearingStates:
    """Return bearing and rate of every track, each at the time of its last look."""
    mean, covariance = tracks.planes[0].estimate(output)
    sd = np.sqrt(np.einsum('tnn->tn', covariance))
    return BearingStates(wrap_angle(mean[:, 0]), mean[:, 1], sd[:, 0], sd[:, 1])


class SonarTracker:
    """Tracks of one sonar."""

    def __init__(self, config: SonarTrackerConfig) -> None:
        self.config = config
        self._forget(next_id=1)

    def _forget(self, next_id: int) -> None:
        self.sonar = Sonar(self.config.sensor)
        self.core = Tracker(build_setup(self.config, self.sonar))
        self.core.reset(next_id)
        period, most = self.config.scan.period, self.config.max_plots
        self.cycles = Cycles[Bearings](period, most) if period else None
        self.coverage = Coverage(0.0, 0.0)  # of the last cycle, in the tracking frame
        self.ranging = Ranging(self.config.ranging)
        self.turns = TurnCheck()
        self.heard = -np.inf  # end of the newest cycle that told of ranges [s]

    @property
    def state(self) -> State:
        """All that the tracker remembers, with the report of the last step."""
        return self.core.state

    @state.setter
    def state(self, state: State) -> None:
        self.core.state = state

    @property
    def turn_time(self) -> float:
        """Time of a cycle of several messages [s], 0: every message is a cycle."""
        return self.config.scan.period

    def save(self) -> tuple[Any, ...]:
        """Return what `restore` takes to go back to this moment: references, no copies of data."""
        return self.config, self.sonar, copy(self.core), self.coverage, copy(self.cycles)

    def restore(self, memory: tuple[Any, ...]) -> None:
        """
        Go back to a moment that was saved; the parameters stay as they are.

        What was learnt of ranges stays too: marks that come late do not count for it.
        """
        config, self.sonar, tracker, self.coverage, cycles = memory
        self.core, self.cycles = copy(tracker), copy(cycles)
        if self.config != config:
            self.reconfigure(self.config)

    @property
    def tracks(self) -> Tracks:
        """All tracks, each at the time of its last look."""
        return self.core.tracks

    @property
    def space(self) -> Space:
        """Bearings are angles."""
        return self.sonar.space

    @property
    def is_ready(self) -> bool:
        """Whether tracks may be ordered: always."""
        return True

    @property
    def sensor_position(self) -> tuple[float, float, float]:
        """Where the sonar was at its last cycle, tracking frame [m]."""
        return self.coverage.sensor_position

    def reset(self) -> None:
        """Forget all but the next id, as after a restart."""
        self._forget(self.state.next_id)

    def reconfigure(self, config: SonarTrackerConfig) -> None:
        """Go on with other live parameters from the next message; tracks are kept."""
        self.config = config
        self.sonar = replace(self.sonar, config=config.sensor)
        self.core.setup = build_setup(config, self.sonar)

    def start_track(self, position: Floats, time: float) -> int:
        """
        Start a confirmed track at a time [s]; return its id.

        `position` is a bearing (1,) [rad], or a point (2,) or (3,) in the tracking frame [m].
        """
        bearing = np.asarray(position[:1], np.float64)
        if len(position) > 1:
            x, y = np.asarray(position[:2]) - self.coverage.sensor_at(np.array([time]))[0, :2]
            bearing = np.array([np.arctan2(y, x)])
        return self.core.acquire(bearing, time, self.coverage)

    def drop_track(self, track_id: int) -> bool:
        """Delete one track; return whether there was one with this id."""
        return self.core.cancel(track_id)

    def track(self, bearings: Bearings, platform: Platform | None = None) -> Tracks:
        """
        Follow all contacts through one cycle.

        Parameters
        ----------
        bearings : Bearings
            All marks of a cycle, none is one that heard nothing; with `scan.period` those of
            one message, and the cycle before is followed where this begins another one.
        platform : Platform, optional
            Own ship in the tracking frame; without it the sonar stands at the origin.

        Returns
        -------
        Tracks
            Every track, at the time of its last look.

        Raises
        ------
        StalePlatform
            If own ship is not known at the time of the marks.

        """
        cycle = self.cycles.add(bearings) if self.cycles else bearings
        if cycle is None:
            return self.tracks
        bearings = self.sonar.heard(cycle)
        times = bearings.time if len(bearings) else np.array([bearings.stamp])
        start, end = float(times.min()), float(times.max())
        pose = pose_at(platform, np.append(bearings.time, 0.5 * (start + end)))
        self.coverage = self.sonar.listen(take(pose, slice(-1, None)), start, end)
        at_marks = take(pose, slice(0, -1))
        self._expect(bearings, at_marks)
        scan = self.sonar.measure(bearings, at_marks, self.coverage)
        self.turns.note(scan, self.coverage.sector_centre)
        tracks = self.core.step(scan)
        if self.config.ranging.enabled and end > self.heard:
            self.heard = end
            self.ranging.add(tracks, self.coverage, self.sonar.heading_sd)
        return tracks

    def ranges(self) -> RangeEstimates:
        """Return what is known of range, course and speed of every track, row by row."""
        return self.ranging.estimates(self.tracks, self.coverage)

    def _expect(self, bearings: Bearings, pose: PlatformPose) -> None:
        """Open the gates for marks as sure as they usually are, and the heading at its worst."""
        if len(bearings):
            sensor, raised = self.config.sensor, self.state.scatter.raised()[0]
            sd = Sonar(sensor, raised=raised).mark_sd(bearings)
            sd = sd[bearings.bearing_sd > 0.0]  # NaN: not told
            usual = float(np.median(sd)) if len(sd) else 0.0
            heading_sd = float(np.sqrt(pose.yaw_variance.max()))
            self.sonar = Sonar(sensor, usual, heading_sd, raised)
            self.core.setup = self.core.setup.with_sensor(self.sonar)
