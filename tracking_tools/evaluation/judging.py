# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""All figures of one recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math
from pathlib import Path

import numpy as np

from tracking_core.batches import Floats
from tracking_core.rows import take
from tracking_tools.evaluation.contacts import judge_contacts
from tracking_tools.evaluation.judgement import (
    ContactJudgement,
    Gospa,
    Held,
    Judgement,
    Ospa,
    Scans,
    Timing,
)
from tracking_tools.evaluation.ranges import judge_ranges
from tracking_tools.evaluation.reading import read_recorded
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.evaluation.tracks import judge_tracks
from tracking_tools.scoring import continuity, GospaParts, Matches, Stretches, track_error
from tracking_tools.scoring.accuracy import normalised
from tracking_tools.scoring.consistency import Consistency, consistency
from tracking_tools.scoring.gospa import gospa_of_distances
from tracking_tools.scoring.matching import candidates, choose_pairs
from tracking_tools.scoring.onsets import false_alarms
from tracking_tools.scoring.ospa import distances_of_scans, ospa_of_distances, OspaParts
from tracking_tools.scoring.siap import siap

HOUR = 3600.0
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
        dimensions=int(rows.position.shape[1]),
        held=_held(recorded, matches, close, stretches, contacts),
        timing=_timing(recorded, matches, contacts),
        accuracy=track_error(rows, matches, recorded.has_velocity),
        **_consistencies(recorded, matches),
        gospa=_gospa(gospas, cutoff, yardstick.gospa_power),
        ospa=_ospa(ospas, cutoff, yardstick.ospa_power),
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


def _held(
    recorded: Recorded,
    matches: Matches,
    close: Matches,
    stretches: Stretches,
    contacts: Sequence[ContactJudgement],
) -> Held:
    found = continuity(recorded.rows, matches, np.unique(close.track), stretches, least_rows=1)
    return Held(
        found.held, found.breaks, found.switches, found.lasting_switches, found.returns,
        found.purity,
        _mean([contact.relative_tracking_time for contact in contacts]),
        found.ghosts, found.ghosts * HOUR / recorded.duration,
    )  # fmt: skip


def _timing(recorded: Recorded, matches: Matches, contacts: Sequence[ContactJudgement]) -> Timing:
    late = np.array([contact.time_to_confirm for contact in contacts])
    delays = np.array([delay for contact in contacts for delay in contact.onset_delays])
    told, sure = delays[np.isfinite(delays)], late[np.isfinite(late)]
    probability = recorded.manoeuvre_probability
    return Timing(
        _mean(sure),
        float(np.median(sure)) if len(sure) else NAN,
        float(sure.max(initial=-np.inf)) if len(sure) else NAN,
        len(late) - len(sure),
        len(delays),
        len(told),
        _mean(told),
        float(np.median(told)) if len(told) else NAN,
        false_alarms(probability, matches),
    )


def _consistencies(recorded: Recorded, matches: Matches) -> dict[str, Consistency]:
    """Return NEES and NIS; each look counts once."""
    rows, d = recorded.rows, recorded.rows.position.shape[1]
    new = rows.is_new
    matches = take(matches, new[matches.row])
    position = rows.position[matches.row] - matches.position
    velocity = rows.velocity[matches.row] - matches.velocity
    P, state = rows.covariance[matches.row], np.concatenate([position, velocity], axis=1)
    nis = recorded.table.get('nis', np.full(len(rows), NAN)).astype(np.float64)
    whole = normalised(state, P) if recorded.has_velocity else np.zeros(0)
    return {
        'nees_position': consistency(normalised(position, P[:, :d, :d]), d),
        'nees_state': consistency(whole, 2 * d),
        'nis': consistency(nis[new], recorded.plot_size),
    }


def _sets(
    recorded: Recorded, near: Matches, stretches: Stretches, cutoff: float, yardstick: Yardstick
) -> tuple[list[GospaParts], list[OspaParts]]:
    """Return both metrics of every scan."""
    distances = list(distances_of_scans(recorded.rows, near, stretches, recorded.scans, cutoff))
    return (
        [gospa_of_distances(d, cutoff, yardstick.gospa_power) for d in distances],
        [ospa_of_distances(d, cutoff, yardstick.ospa_power) for d in distances],
    )


def _gospa(parts: Sequence[GospaParts], cutoff: float, p: float) -> Gospa:
    total, near, missed, false = (
        np.array([getattr(part, name) for part in parts], np.float64)
        for name in ('total', 'localisation', 'missed', 'false')
    )
    one = 0.5 * cutoff**p
    rms, localisation, lack, excess = (
        float(v.mean() ** (1.0 / p)) for v in (total**p, near, one * missed, one * false)
    )
    return Gospa(
        _mean(total), rms, localisation, lack, excess, _mean(missed), _mean(false), cutoff, p
    )


def _ospa(parts: Sequence[OspaParts], cutoff: float, p: float) -> Ospa:
    total, near, number = (
        _mean([getattr(part, name) for part in parts])
        for name in ('total', 'localisation', 'cardinality')
    )
    return Ospa(total, near, number, cutoff, p)


def _mean(values: Floats | Sequence[float]) -> float:
    return float(np.mean(values)) if len(values) else NAN
