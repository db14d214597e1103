# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How do plots become tracks? `Tracker.step` is the algorithm, to be read from top to bottom.

Everything that changes is in `Tracker.state`; all else is functions of batches. Read `update.py`
next: what one look of the antenna tells about the tracks that it has passed.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from tracking_core.batches import Coverage, Floats, Ints, Scan, Seeds, Tracks
from tracking_core.birth import new_tracks, start_tracks
from tracking_core.clutter import Clutter
from tracking_core.clutter_map import ClutterMap
from tracking_core.composition import Setup
from tracking_core.density import Density, expected_density
from tracking_core.heap import keep_freed_memory
from tracking_core.initiation import one_point, Starts
from tracking_core.interval import add_step, interval_of_looks
from tracking_core.learning import learn_clutter
from tracking_core.linalg import TURN
from tracking_core.merging import end_doubles
from tracking_core.rows import concatenate, take
from tracking_core.scatter import Scatter
from tracking_core.state import State, StepReport
from tracking_core.update import Look, look

FEWEST_TURNS = 3.0  # of the antenna; shorter is no pause


@dataclass
class Tracker:
    """Tracks of one sensor; `state` is the only thing that changes."""

    setup: Setup
    state: State = field(init=False)

    def __post_init__(self) -> None:
        keep_freed_memory()
        self.reset(next_id=1)

    def reset(self, next_id: int | None = None) -> None:
        """Forget all; ids go on, unless the next one is given."""
        d = self.setup.sensor.dimensions
        nothing = Starts.none(d)
        none = np.zeros(0)
        seeds = Seeds(none, np.zeros((0, d)), np.zeros((0, d, d)), none, none, none)
        first = self.state.next_id if next_id is None else next_id
        self.state = State(
            new_tracks(nothing, seeds.time, self.setup, first, Coverage(0.0, 0.0)),
            seeds,
            Clutter(ClutterMap.blank(self.setup.sensor.space)),
            Scatter.none(d),
            next_id=first,
        )

    @property
    def tracks(self) -> Tracks:
        """All tracks after the last step, each at the time of its last look."""
        return self.state.tracks

    def step(self, scan: Scan) -> Tracks:
        """
        Follow all contacts through one scan.

        A track is worked on once the antenna has passed it; plots of passes that are not over yet
        wait for the next scan. What a look does (predict, gate, share, update, judge) is in
        `update.look`; here is what becomes of all tracks and plots of the scan.

        Parameters
        ----------
        scan : Scan
            Plots in the tracking frame, and what the sensor looked at.

        Returns
        -------
        Tracks
            Every track, each at the time of its last look.

        """
        state, silent = self._without_silent(scan)
        steps = add_step(state.steps, scan.coverage.end_time - state.time)
        interval = interval_of_looks(steps, scan.coverage)
        scan = self.setup.extent.gather(state.held, scan, interval, self.setup.sensor.space)
        density = self._density(state, scan, interval)
        seen = self._look(state.tracks, scan, density)
        born = start_tracks(scan, seen, density, steps, self.setup, state)

        kept, merged = self._without_doubles(seen)
        room = max(self.setup.max_tracks - len(kept), 0)
        started = born.tracks
        fitting = started if len(started) <= room else take(started, slice(0, room))
        report = StepReport(
            plots=len(scan),
            held=int(seen.waiting.sum()),
            pairs=seen.pairs,
            approximate=seen.approximate,
            started=len(fitting),
            merged=len(merged),
            refused=len(started) - len(fitting),
            broken=seen.broken,
            clutter_density=density.clutter,
            densest_clutter=density.clutter * float(born.seeds.relief.max(initial=1.0)),
            silent=len(silent) + len(self.state.seeds) - len(state.seeds),
            deleted=np.concatenate([silent, seen.ended, merged]),
        )
        self.state = State(
            tracks=concatenate(kept, fitting) if len(fitting) else kept,
            seeds=born.seeds,
            held=take(scan, seen.waiting) if seen.waiting.any() else None,
            next_id=state.next_id + len(fitting),
            clutter=learn_clutter(state, scan, seen, born.used, kept, self.setup),
            scatter=self._scatter(state, scan, seen, interval),
            leniency=born.leniency,
            time=max(scan.coverage.end_time, state.time),
            steps=steps,
            report=report,
        )
        return self.state.tracks

    def acquire(self, position: Floats, time: float, coverage: Coverage | None = None) -> int:
        """
        Start a confirmed track at a position, at rest with a velocity prior; return its id.

        Parameters
        ----------
        position : (d,) array
            [m]
        time : float
            [s]
        coverage : Coverage, optional
            Where the sensor is, if not at rest in the origin.

        """
        coverage = coverage or Coverage(time, time)
        noise = self.setup.sensor.noise(position[None], coverage)
        one = np.ones(1)
        seed = Seeds(np.array([time]), position[None], np.asarray(noise), one, one, one)
        starts = one_point(seed, 1.0, self.setup.initiation)
        born = new_tracks(starts, seed.time, self.setup, self.state.next_id, coverage)
        born = replace(born, confirmed=np.ones(1, bool))
        tracks = concatenate(self.state.tracks, born)
        self.state = replace(self.state, tracks=tracks, next_id=self.state.next_id + 1)
        return int(born.id[0])

    def cancel(self, track_id: int) -> bool:
        """Delete a track; return whether there was one with this id."""
        kept = self.state.tracks.id != track_id
        self.state = replace(self.state, tracks=take(self.state.tracks, kept))
        return not bool(kept.all())

    def _without_silent(self, scan: Scan) -> tuple[State, Ints]:
        """Return the state without what nobody looked at for too long, and the ids of tracks."""
        tracks, seeds = self.state.tracks, self.state.seeds
        pause, rate = self.setup.longest_pause or np.inf, abs(scan.coverage.rotation_rate)
        if rate:
            pause = max(pause, FEWEST_TURNS * TURN / rate)
        earliest = scan.coverage.start_time - pause
        if min(tracks.time.min(initial=np.inf), seeds.time.min(initial=np.inf)) >= earliest:
            return self.state, tracks.id[:0]
        silent, old = tracks.time < earliest, seeds.time < earliest
        left = replace(self.state, tracks=take(tracks, ~silent), seeds=take(seeds, ~old))
        return left, tracks.id[silent]

    def _look(self, tracks: Tracks, scan: Scan, density: Density) -> Look:
        seen = look(tracks, scan, self.setup, density)
        while seen.again:
            seen = seen.and_then(look(seen.tracks, scan, self.setup, density))
        return seen

    def _without_doubles(self, seen: Look) -> tuple[Tracks, Ints]:
        """Return the tracks without those that follow another's contact, and the ids of these."""
        merge, is_unresolved = self.setup.merge, self.setup.resolution is not None
        living, doubled = end_doubles(
            seen.tracks, seen.passed, merge, self.setup.sensor.space, is_unresolved,
            self.setup.has_own_plots,
        )  # fmt: skip
        return take(living, ~doubled), living.id[doubled]

    def _scatter(self, state: State, scan: Scan, seen: Look, interval: float) -> Scatter:
        """Return what is known of the noise of plots after this scan."""
        space, speed = self.setup.sensor.space, self.setup.initiation.speed_max
        return state.scatter.learn(seen.owner, scan, interval, space, speed)

    def _density(self, state: State, scan: Scan, interval: float) -> Density:
        """Return the sources of other plots, per unit of plot space and look."""
        setup = self.setup
        return expected_density(
            state.clutter, setup.clutter_density, setup.arrival_rate * interval, scan,
            setup.sensor, state.leniency,
        )  # fmt: skip
