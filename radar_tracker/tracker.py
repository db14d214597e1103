# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does a message of radar plots become tracks? The object that node and replay drive."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from typing import Any

import numpy as np

from radar_tracker.build import build_antenna, build_collectors, build_setup, told_turn_time
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.conversion import azimuth_of, farthest
from radar_tracker.heights import flat_after, is_other
from radar_tracker.mounting import coverage_of
from radar_tracker.platform_doubt import PlatformDoubt
from radar_tracker.plausible import coarsest, fastest
from radar_tracker.sector_clock import SectorClock
from radar_tracker.sensor import Radar
from radar_tracker.sweep import Beam
from tracking_core.batches import Coverage, Floats, Plots, Tracks
from tracking_core.platform import Platform, pose_at
from tracking_core.space import Space
from tracking_core.state import State
from tracking_core.tracker import Tracker


class RadarTracker:
    """
    Tracks of one radar.

    What the parameters leave open (dimensions, coordinates, rotation) is learnt from the plots.
    """

    def __init__(self, config: RadarTrackerConfig) -> None:
        self.config = config
        self._forget(next_id=1)

    def _forget(self, next_id: int) -> None:
        scan, most = self.config.scan, self.config.max_plots
        self.antenna = build_antenna(scan)
        self.sectors = SectorClock(scan)
        self.turns, self.cycles = build_collectors(scan, most)
        self.radar = Radar(self.config.sensor, self.config.sensor.dimensions or 2, is_polar=True)
        self.is_known, self.flat = False, 0  # which radar it is; plots in a row without a height
        self.farthest = 0.0  # plot so far [m]
        self.coverage = Coverage(0.0, 0.0)  # of the last message, in the tracking frame
        self.core = Tracker(build_setup(self.config, self.radar))
        self.core.reset(next_id)

    @property
    def state(self) -> State:
        """All that the tracker remembers, with the report of the last step."""
        return self.core.state

    @state.setter
    def state(self, state: State) -> None:
        self.core.state = state

    @property
    def turn_time(self) -> float:
        """Time of a turn, or of a look in parts [s]; 0: messages are looks, inf: not known yet."""
        return self.antenna.turn_time or told_turn_time(self.config.scan)

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
        return self.core.tracks

    @property
    def space(self) -> Space:
        """Plots are points."""
        return self.radar.space

    @property
    def is_ready(self) -> bool:
        """Whether tracks may be ordered: their dimensions are known."""
        return self.is_known or self.config.sensor.dimensions > 0

    @property
    def sensor_position(self) -> tuple[float, float, float]:
        """Where the radar was at its last look, tracking frame [m]."""
        return self.coverage.sensor_position

    def plot_noise(self, position: Floats) -> Floats:
        """Return the covariance (K, d, d) [m^2] of a plot at each of these places (K, 3) [m]."""
        return self.radar.noise(position[:, : self.radar.dimensions], self.coverage)

    def reset(self) -> None:
        """Forget all but the next id, as after a restart."""
        self._forget(self.state.next_id)

    def reconfigure(self, config: RadarTrackerConfig) -> None:
        """Go on with other live parameters from the next message; tracks are kept."""
        self.config = config
        self.radar = replace(self.radar, config=config.sensor)
        self.core.setup = build_setup(config, self.radar)

    def start_track(self, position: Floats, time: float) -> int:
        """Start a confirmed track at a position (2,) or (3,) [m] at a time [s]; return its id."""
        d = self.radar.dimensions
        full = np.append(position, 0.0)[:d]  # at height 0 where none is told
        return self.core.acquire(full, time, self.coverage)

    def drop_track(self, track_id: int) -> bool:
        """Delete one track; return whether there was one with this id."""
        return self.core.cancel(track_id)

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
        collected = self._collect(plots)
        if collected is None:
            return self.tracks
        self._recognise(collected)
        pose = pose_at(platform, collected.time)
        self._allow_for(PlatformDoubt.of(pose) if platform is not None else None)
        azimuth, turns = azimuth_of(collected, self.radar.is_polar), self.turns
        sweep = self.antenna.follow(collected, azimuth, beam, turns.part if turns else 0.0)
        poses = pose_at(platform, sweep.moments if platform is not None else sweep.ends)
        coverage = self.coverage = coverage_of(sweep, poses, self.config.sensor)
        volume = self.radar.plot_space_volume(self.farthest or self.config.sensor.range_max)
        return self.core.step(self.radar.measure(collected, pose, coverage, volume))

    def _collect(self, plots: Plots) -> Plots | None:
        """Return the turn or the look that is complete now, plots themselves where they are."""
        if self.turns:
            return self.turns.add(plots, self.antenna.rotation_rate)
        return self.cycles.add(plots) if self.cycles else plots

    def _recognise(self, plots: Plots) -> None:
        """Learn from the first plots what radar this is, and how far it sees."""
        if len(plots):
            seen = Radar.for_plots(self.config.sensor, plots)
            self.flat = flat_after(self.flat, self.radar, seen, len(plots))
            other = is_other(self.radar, seen, self.flat) and not self.tracks.confirmed.any()
            if other or not self.is_known:
                self._become(seen)
            self._see(farthest(plots, self.radar.is_polar, self.radar.dimensions))

    def _become(self, radar: Radar) -> None:
        tracker = Tracker(build_setup(self.config, radar))
        tracker.reset(self.state.next_id)
        if self.config.sensor.dimensions and len(self.tracks):  # ordered ones, of these dimensions
            tracker.state = self.state
        self.radar, self.core, self.is_known = radar, tracker, True

    def _see(self, distance: float) -> None:
        """Take note how far the radar sees, and saw all the time when false plots were counted."""
        if distance > self.farthest > 0.0:
            seen, sees = (self.radar.plot_space_volume(r) for r in (self.farthest, distance))
            self.state = replace(self.state, clutter=self.state.clutter.times(seen / sees))
        self.farthest = max(self.farthest, distance)

    def _allow_for(self, doubt: PlatformDoubt | None) -> None:
        """Heed what own ship does not know of itself, and what plots say against parameters."""
        known, state, limit = self.radar, self.state, coarsest(self.farthest)
        raised = state.scatter.raised(is_round=not known.is_polar)
        if doubt is not known.doubt or (raised, limit) != (known.raised, known.coarsest):
            self.radar = replace(known, doubt=doubt, raised=raised, coarsest=limit)
            self.core.setup = self.core.setup.with_sensor(self.radar)
        speed = fastest(self.config.initiation, self.farthest, state.steps, self.coverage)
        self.core.setup = self.core.setup.with_speed_max(speed)
