# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""All figures of one recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math
from pathlib import Path

import numpy as np

from tracking_core.rows import take
from tracking_tools.evaluation.contacts import judge_contacts
from tracking_tools.evaluation.judgement import Judgement, Scans
from tracking_tools.evaluation.ranges import judge_ranges
from tracking_tools.evaluation.reading import read_recorded
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.evaluation.summaries import (
    consistencies,
    summarise_gospa,
    summarise_held,
    summarise_ospa,
    summarise_timing,
)
from tracking_tools.evaluation.tracks import judge_tracks
from tracking_tools.scoring import (
    GospaParts,
    Matches,
    Stretches,
    track_error,
    TrackRows,
    Truth,
)
from tracking_tools.scoring.gospa import gospa_of_distances
from tracking_tools.scoring.matching import candidates, choose_pairs
from tracking_tools.scoring.ospa import distances_of_scans, ospa_of_distances, OspaParts
from tracking_tools.scoring.sampling import error_between_samples
from tracking_tools.scoring.siap import siap

NAN = float('nan')
RADIUS = {'radar': 1000.0, 'sonar': math.radians(1.5)}


@dataclass(frozen=True)
class Yardstick:
    """With what measure tracks are judged."""

    radius: float | None = None  # match radius; None: 1000 m, of a sonar 1.5 deg [m or rad]
    cutoff: float | None = None  # of GOSPA and OSPA; None: the radius [m or rad]
    gospa_power: float = 2.0
    ospa_power: float = 1.0
    turning: float = math.radians(0.8)  # course changes faster in a turn [rad/s]

    def of_sensor(self, sensor: str) -> tuple[float, float]:
        """Return radius and cutoff for this sensor."""
        radius = RADIUS[sensor] if self.radius is None else self.radius
        return radius, radius if self.cutoff is None else self.cutoff


def evaluate(
    tracks: Path | str,
    truth: Path | str,
    yardstick: Yardstick | None = None,
    rules: Sequence[str] = (),
    sensor: str | None = None,
) -> Judgement:
    """Return all figures of a tracks bag beside the truth; parameters as of `read_recorded`."""
    yardstick = yardstick or Yardstick()
    return judge(read_recorded(tracks, truth, rules, sensor, yardstick.turning), yardstick)


def judge(recorded: Recorded, yardstick: Yardstick) -> Judgement:
    """Return all figures of a recording."""
    rows, truth = recorded.rows, recorded.truth
    radius, cutoff = yardstick.of_sensor(recorded.sensor)
    stretches = Stretches.of_truth(truth, recorded.starts)
    slack = float(np.median(np.diff(recorded.starts)))  # rows just before or after all samples
    wide = candidates(rows, truth, max(radius, cutoff), slack)
    close = take(wide, wide.distance <= radius)
    near = take(close, stretches.wanted(close.contact, close.scan))
    matches = choose_pairs(near, radius)
    contacts = judge_contacts(recorded, matches, stretches)
    far = take(wide, wide.distance <= cutoff)
    gospas, ospas = _sets(recorded, far, stretches, cutoff, yardstick)
    starts = recorded.starts
    return Judgement(
        sensor=recorded.sensor,
        scans=recorded.scans,
        duration=recorded.duration,
        contacts=len(contacts),
        tracks=len(np.unique(rows.id)),
        radius=radius,
        extent=float(np.linalg.norm(np.ptp(truth.position, axis=0))),
        truth_error=error_between_samples(truth),
        outside=_outside(rows, truth, slack),
        dimensions=int(rows.position.shape[1]),
        held=summarise_held(recorded, matches, close, stretches, contacts),
        timing=summarise_timing(recorded, matches, contacts),
        accuracy=track_error(rows, matches, recorded.has_velocity),
        **consistencies(recorded, matches),
        gospa=summarise_gospa(gospas, cutoff, yardstick.gospa_power),
        ospa=summarise_ospa(ospas, cutoff, yardstick.ospa_power),
        siap=siap(rows, near, stretches),
        ranges=judge_ranges(recorded, matches),
        per_contact=contacts,
        per_track=judge_tracks(recorded, matches, close),
        by_scan=Scans(
            starts[:-1] - starts[0],
            np.array([part.total for part in gospas]),
            np.array([part.total for part in ospas]),
            np.array([part.missed for part in gospas]),
            np.array([part.false for part in gospas]),
        ),
    )


def _outside(rows: TrackRows, truth: Truth, slack: float) -> float:
    """Return which share of the rows are of before or after all samples; NaN of none."""
    begin, end = truth.time.min() - slack, truth.time.max() + slack
    return float(((rows.time < begin) | (rows.time > end)).mean()) if len(rows) else NAN


def _sets(
    recorded: Recorded, near: Matches, stretches: Stretches, cutoff: float, yardstick: Yardstick
) -> tuple[list[GospaParts], list[OspaParts]]:
    """Return both metrics of every scan."""
    distances = list(distances_of_scans(recorded.rows, near, stretches, recorded.scans, cutoff))
    return (
        [gospa_of_distances(d, cutoff, yardstick.gospa_power) for d in distances],
        [ospa_of_distances(d, cutoff, yardstick.ospa_power) for d in distances],
    )
