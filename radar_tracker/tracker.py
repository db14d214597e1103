# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does a message of radar plots become tracks? The object that node and replay drive."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from typing import Any

import numpy as np

from radar_tracker.antenna import Antenna, Beam, TWO_PI
from radar_tracker.build import build_setup
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.mounting import coverage_of, PlatformDoubt
from radar_tracker.sector_clock import SectorClock
from radar_tracker.sensor import Radar
from tracking_core.batches import Coverage, Floats, Plots, State, Tracks
from tracking_core.platform import Platform, pose_at
from tracking_core.rows import concatenate
from tracking_core.tracker import Tracker


class RadarTracker:
    """
    Tracks of one radar.

    What the parameters leave open (2-D or 3-D, polar or Cartesian, rotation of the antenna) is
    learnt from the first plots.
    """

    def __init__(self, config: RadarTrackerConfig) -> None:
        self.config = config
        self._forget(next_id=1)

    def _forget(self, next_id: int) -> None:
        scan = self.config.scan
        self._antenna = Antenna(
            scan.period,
            full_turns=scan.assembly != 'sector',
            # A collected turn has the stamp of its first sector, and begins about there.
            time_reference='start' if scan.assembly == 'rotation' else scan.time_reference,
            stares=scan.assembly == 'snapshot',
            collects=scan.assembly == 'rotation',
        )
        self.sectors = SectorClock(scan)
        self._latest_stamp = np.nan  # of the messages that are collected to turns
        self._radar = Radar(self.config.sensor, self.config.sensor.dimensions or 2, is_polar=True)
        self._is_known = False  # which radar it is
        self._farthest = 0.0  # plot so far [m]
        self._collected: Plots | None = None
        self._last_coverage = Coverage(0.0, 0.0)
        self._tracker = Tracker(build_setup(self.config, self._radar))
        self._tracker.reset(next_id)

    @property
    def state(self) -> State:
        """All that the tracker remembers, with the report of the last step."""
        return self._tracker.state

    @state.setter
    def state(self, state: State) -> None:
        self._tracker.state = state

    @property
    def turn(self) -> float:
        """Time of one turn of the antenna [s], 0 if it is not known to turn."""
        rate = abs(self._antenna.rotation_rate)
        return TWO_PI / rate if rate else 0.0

    def save(self) -> dict[str, Any]:
        """Return what `restore` takes to go back to this moment: references, no copies of data."""
        return {name: copy(value) for name, value in vars(self).items()}

    def restore(self, memory: dict[str, Any]) -> None:
        """Go back to a moment that was saved; the parameters stay as they are."""
        config = self.config
        vars(self).update({name: copy(value) for name, value in memory.items()})
        if self.config != config:
            self.reconfigure(config)

    @property
    def tracks(self) -> Tracks:
        """All tracks, each at the time of its last look."""
        return self._tracker.tracks

    @property
    def dimensions(self) -> int:
        """2 or 3, as configured or as the first plots told."""
        return self._radar.dimensions

    def plot_noise(self, position: Floats) -> Floats:
        """Return the covariance (K, d, d) [m^2] of a plot at each of these places (K, 3) [m]."""
        return self._radar.noise(position[:, : self.dimensions], self._last_coverage)

    def reset(self) -> None:
        """Forget all but the next id, as after a restart."""
        self._forget(self.state.next_id)

    def reconfigure(self, config: RadarTrackerConfig) -> None:
        """Go on with other live parameters from the next message; tracks are kept."""
        self.config = config
        self._radar = replace(self._radar, config=config.sensor)
        self._tracker.setup = build_setup(config, self._radar)

    def start_track(self, position: Floats, time: float) -> int:
        """Start a confirmed track at a position (2,) or (3,) [m] at a time [s]; return its id."""
        full = np.zeros(self.dimensions)
        full[: min(len(position), self.dimensions)] = position[: self.dimensions]
        return self._tracker.acquire(full, time, self._last_coverage)

    def drop_track(self, track_id: int) -> bool:
        """Delete one track; return whether there was one with this id."""
        return self._tracker.cancel(track_id)

    def track(
        self, plots: Plots, platform: Platform | None = None, beam: Beam | None = None
    ) -> Tracks:
        """
        Follow all contacts through one message.

        Parameters
        ----------
        plots : Plots
            One message: a full turn, a sector, or a look everywhere at once.
        platform : Platform, optional
            Own ship in the tracking frame; without it the sensor stands at the origin.
        beam : Beam, optional
            Where the antenna points at the end of the message, if that is known.

        Returns
        -------
        Tracks
            Every track, each at the time of its last look.

        Raises
        ------
        StalePlatform
            If own ship is not known at the time of the plots.

        """
        self._recognise(plots)
        collected = self._collect(plots)
        if collected is None:
            return self.tracks
        pose = pose_at(platform, collected.time)
        self._allow_for(PlatformDoubt.of(pose) if platform is not None else None)
        sweep = self._antenna.follow(collected, self._azimuth(collected), beam)
        ends = pose_at(platform, np.array([sweep.start_time, sweep.end_time]))
        coverage = self._last_coverage = coverage_of(sweep, ends, self.config.sensor)
        volume = self._radar.plot_space_volume(self._farthest or self.config.sensor.range_max)
        return self._tracker.step(self._radar.measure(collected, pose, coverage, volume))

    def _recognise(self, plots: Plots) -> None:
        """Learn from the first plots what radar this is, and how far it sees."""
        if len(plots) == 0:
            return
        if not self._is_known:
            self._radar = Radar.for_plots(self.config.sensor, plots)
            tracker = Tracker(build_setup(self.config, self._radar))
            tracker.reset(self.state.next_id)
            self._tracker, self._is_known = tracker, True
        distance = plots.range
        if not self._radar.is_polar:
            x, y, z = plots.position.T
            distance = np.hypot(x, y)
            if self.dimensions == 3:
                distance = np.fmax(distance, np.hypot(distance, z))  # z may be NaN
        self._farthest = max(self._farthest, float(distance.max()))

    def _allow_for(self, doubt: PlatformDoubt | None) -> None:
        """Open the gates for what own ship does not know of itself."""
        if doubt is not self._radar.doubt:
            self._radar = replace(self._radar, doubt=doubt)
            self._tracker.setup = self._tracker.setup.with_sensor(self._radar)

    def _collect(self, plots: Plots) -> Plots | None:
        """Return the plots of a full turn when sectors are to be collected, or the message."""
        if self.config.scan.assembly != 'rotation':
            return plots
        joined = plots if self._collected is None else concatenate(self._collected, plots)
        first = plots.stamp if self._collected is None else self._collected.stamp
        rate = abs(self._antenna.rotation_rate)
        period = self.config.scan.period or (TWO_PI / rate if rate else 0.0)
        self._collected = replace(joined, stamp=first)
        ahead = plots.stamp - self._latest_stamp  # when this message will be over
        self._latest_stamp = plots.stamp
        if plots.stamp + np.nan_to_num(ahead) - first < period * (1.0 - 1e-3):
            return None
        turn, self._collected = self._collected, None
        return turn

    def _azimuth(self, plots: Plots) -> Floats:
        if self._radar.is_polar:
            return plots.azimuth
        return np.asarray(np.arctan2(plots.position[:, 1], plots.position[:, 0]))
