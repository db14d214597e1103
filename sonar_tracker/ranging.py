# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How far are the contacts, and how do we know? Range, course and speed from bearings alone.

`Ranging` runs beside the tracker: it collects the marks of confirmed tracks, fits straight courses
to a few tracks in each cycle, and says of every track whether its range is observable. Read
``ranging_model.py`` next: what can be known, and why.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sonar_tracker.bearing_history import BearingHistory
from sonar_tracker.marked import last_marks
from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.ranging_courses import Courses, UNKNOWNS
from sonar_tracker.ranging_fit import fit
from sonar_tracker.ranging_heading import with_wandering
from sonar_tracker.ranging_model import Legs, legs_of
from sonar_tracker.ranging_verdict import judge, may_tell, Verdict
from tracking_core.batches import Bools, Coverage, Floats, Ints, Tracks
from tracking_core.linalg import symmetrise
from tracking_core.rows import put, take


@dataclass(frozen=True)
class RangeEstimates:
    """Where T tracks are, NaN where that is not observable."""

    id: Ints  # (T,)
    observable: Bools  # (T,)
    range: Floats  # (T,) from the sensor [m]
    range_sd: Floats  # (T,) [m]
    speed: Floats  # (T,) over ground [m/s]
    course: Floats  # (T,) of the motion over ground, anticlockwise from x [rad]
    state: Floats  # (T, 4) x, y, vx, vy in the tracking frame [m, m/s]
    covariance: Floats  # (T, 4, 4) of the state

    def __len__(self) -> int:
        return len(self.id)


class Ranging:
    """Ranges of the confirmed tracks of one sonar."""

    def __init__(self, config: RangingConfig) -> None:
        self.config = config
        self.reset()

    def reset(self) -> None:
        """Forget all."""
        self.history = BearingHistory(self.config.points, self.config.window)
        self.courses = Courses.unknown(0)

    def add(self, tracks: Tracks, coverage: Coverage, heading_sd: float) -> None:
        """
        Hear what a cycle brought, and fit the tracks whose turn it is.

        Parameters
        ----------
        tracks : Tracks
            After the cycle, followed by a filter that is `Marked`.
        coverage : Coverage
            Of the cycle: says where the sensor was.
        heading_sd : float
            Of own ship, as it tells [rad].

        """
        bearing, weight = last_marks(tracks.planes[0])
        own = coverage.sensor_at(tracks.time)[:, :2]
        rows = np.flatnonzero(tracks.confirmed)
        self.hear(tracks.id[rows], tracks.time[rows], bearing[rows], weight[rows], own[rows])
        self.fit_in_turn(heading_sd)

    def hear(self, ids: Ints, time: Floats, bearing: Floats, weight: Floats, own: Floats) -> None:
        """
        Follow these tracks and no others; a mark is new data if its time and weight say so.

        Parameters
        ----------
        ids : (T,) array
            Of all confirmed tracks.
        time, bearing, weight : (T,) arrays
            Of their marks [s]; tracking axes [rad]; 1 / variance, 0: no mark [1/rad^2].
        own : (T, 2) array
            Position of the sensor at these times [m].

        """
        self._follow(ids)
        rows = np.flatnonzero((weight > 0.0) & (time > self.history.newest()))
        self.history.add(rows, time[rows], bearing[rows], weight[rows], own[rows])

    def fit_in_turn(self, heading_sd: float = 0.0) -> None:
        """Fit those tracks that have waited longest; own ship's heading has this sd [rad]."""
        waiting = np.flatnonzero(self.history.newest() > self.courses.time)
        order = np.argsort(self.courses.time[waiting], kind='stable')
        self.fit_rows(waiting[order[: self.config.tracks_per_cycle]], heading_sd)

    def fit_rows(self, rows: Ints, heading_sd: float = 0.0) -> None:
        """Fit the tracks of these rows (N,); those of no straight course start anew."""
        if len(rows) == 0:
            return
        found = self.courses
        found.time[rows] = self.history.newest()[rows]
        found.state[rows] = found.covariance[rows] = np.nan
        points = self.history.read(rows)
        enough = points.count >= self.config.least_points
        rows, points = rows[enough], take(points, enough)
        if len(rows) == 0:
            return
        legs = legs_of(points)
        told = may_tell(legs, self.config)
        rows, legs = rows[told], take(legs, told)
        if len(rows) == 0:
            return
        bent_before = found.are_bent(legs.time.max())[rows]
        verdict = self._explain(rows, legs, heading_sd)
        # Not at the first sign: until others bend too, a wrong heading looks like one's turn.
        self.history.forget_older_half(rows[verdict.bent & bent_before])
        observable = verdict.observable
        found.state[rows[observable]] = verdict.state[observable]
        found.covariance[rows[observable]] = verdict.covariance[observable]

    def _explain(self, rows: Ints, legs: Legs, heading_sd: float) -> Verdict:
        """
        Fit straight courses to the tracks of these rows and judge them.

        First as if the heading were true. Where it is in doubt, marks that no straight course
        explains are fitted again as those of a heading that wanders as far as a range must stand.
        """
        config, limits = self.config, (self.config.range_min, self.config.range_max)
        verdict = judge(fit(legs, *limits), legs, config, heading_sd)
        doubted = np.flatnonzero(~verdict.straight)
        self.courses.straight[rows[verdict.straight]] = legs.time[verdict.straight]
        self.courses.bent[rows[doubted]] = legs.time[doubted]
        if len(doubted) == 0 or not self.courses.doubt_heading(legs.time.max()):
            return verdict
        legs = with_wandering(take(legs, doubted), config.heading_error(heading_sd))
        return put(verdict, doubted, judge(fit(legs, *limits), legs, config, heading_sd))

    def estimates(self, tracks: Tracks, coverage: Coverage) -> RangeEstimates:
        """Return what is known of every track at its time, seen from where the sensor is."""
        return self.at(tracks.id, tracks.time, coverage.sensor_at(tracks.time)[:, :2])

    def at(self, ids: Ints, time: Floats, own: Floats) -> RangeEstimates:
        """Return what is known of these tracks at these times (T,) [s], sensor at (T, 2) [m]."""
        found = self.courses.of(self.history.id, ids)
        dt = np.where(np.isfinite(found.time), time - found.time, 0.0)
        F = np.tile(np.eye(UNKNOWNS), (len(ids), 1, 1))
        F[:, 0, 2] = F[:, 1, 3] = dt
        state = (F @ found.state[..., None])[..., 0]
        covariance = symmetrise(F @ found.covariance @ np.swapaxes(F, 1, 2))
        line = state[:, :2] - own
        distance = np.hypot(line[:, 0], line[:, 1])
        along = line / distance[:, None]
        sd = np.sqrt(np.einsum('tx,txy,ty->t', along, covariance[:, :2, :2], along))
        observable = np.nan_to_num(sd / distance, nan=np.inf) < self.config.relative_sd

        def known(values: Floats) -> Floats:
            return np.where(observable.reshape(-1, *[1] * (values.ndim - 1)), values, np.nan)

        return RangeEstimates(
            ids, observable, known(distance), known(sd),
            known(np.hypot(state[:, 2], state[:, 3])), known(np.arctan2(state[:, 3], state[:, 2])),
            known(state), known(covariance),
        )  # fmt: skip

    def _follow(self, ids: Ints) -> None:
        self.courses = self.courses.of(self.history.id, ids)
        self.history.follow(ids)
