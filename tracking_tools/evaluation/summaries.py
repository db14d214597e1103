# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do the figures of scans and contacts become those of the whole recording?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tracking_core.batches import Floats
from tracking_core.rows import take
from tracking_tools.evaluation.judgement import ContactJudgement, Gospa, Held, Ospa, Timing
from tracking_tools.evaluation.recorded import Recorded
from tracking_tools.scoring import continuity, GospaParts, Matches, Stretches
from tracking_tools.scoring.accuracy import normalised
from tracking_tools.scoring.consistency import Consistency, consistency
from tracking_tools.scoring.onsets import false_alarms
from tracking_tools.scoring.ospa import OspaParts

HOUR = 3600.0
NAN = float('nan')


def summarise_held(
    recorded: Recorded,
    matches: Matches,
    close: Matches,
    stretches: Stretches,
    contacts: Sequence[ContactJudgement],
) -> Held:
    """Return how unbroken the tracks were; `close` are all pairs within the match radius."""
    found = continuity(recorded.rows, matches, np.unique(close.track), stretches, least_rows=1)
    return Held(
        coverage=found.held,
        breaks=found.breaks,
        id_switches=found.switches,
        lasting_switches=found.lasting_switches,
        new_ids_after_absence=found.returns,
        purity=found.purity,
        relative_tracking_time=_mean([contact.relative_tracking_time for contact in contacts]),
        false_tracks=found.ghosts,
        false_tracks_per_hour=found.ghosts * HOUR / recorded.duration,
    )


def summarise_timing(
    recorded: Recorded, matches: Matches, contacts: Sequence[ContactJudgement]
) -> Timing:
    """Return how soon the tracker knew of contacts and of their manoeuvres."""
    late = np.array([contact.time_to_confirm for contact in contacts])
    delays = np.array([delay for contact in contacts for delay in contact.onset_delays])
    told, sure = delays[np.isfinite(delays)], late[np.isfinite(late)]
    probability = recorded.manoeuvre_probability
    return Timing(
        time_to_confirm_mean=_mean(sure),
        time_to_confirm_median=float(np.median(sure)) if len(sure) else NAN,
        time_to_confirm_max=float(sure.max(initial=-np.inf)) if len(sure) else NAN,
        never_confirmed=len(late) - len(sure),
        manoeuvres=len(delays),
        manoeuvres_told=len(told),
        onset_delay_mean=_mean(told),
        onset_delay_median=float(np.median(told)) if len(told) else NAN,
        manoeuvre_false_alarm=false_alarms(probability, matches),
    )


def consistencies(recorded: Recorded, matches: Matches) -> dict[str, Consistency]:
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


def summarise_gospa(parts: Sequence[GospaParts], cutoff: float, p: float) -> Gospa:
    """Return the metric over all scans."""
    total, near, missed, false = (
        np.array([getattr(part, name) for part in parts], np.float64)
        for name in ('total', 'localisation', 'missed', 'false')
    )
    one = 0.5 * cutoff**p
    rms, localisation, lack, excess = (
        float(v.mean() ** (1.0 / p)) for v in (total**p, near, one * missed, one * false)
    )
    return Gospa(
        mean=_mean(total),
        rms=rms,
        localisation=localisation,
        missed=lack,
        false=excess,
        missed_number=_mean(missed),
        false_number=_mean(false),
        cutoff=cutoff,
        power=p,
    )


def summarise_ospa(parts: Sequence[OspaParts], cutoff: float, p: float) -> Ospa:
    """Return the means over all scans."""
    total, near, number = (
        _mean([getattr(part, name) for part in parts])
        for name in ('total', 'localisation', 'cardinality')
    )
    return Ospa(mean=total, localisation=near, cardinality=number, cutoff=cutoff, power=p)


def _mean(values: Floats | Sequence[float]) -> float:
    return float(np.mean(values)) if len(values) else NAN
