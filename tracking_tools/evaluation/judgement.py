# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the figures are called. Units: m, m/s, s; of a sonar rad, rad/s, s; shares are 0 to 1."""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.batches import Floats
from tracking_tools.scoring.accuracy import Accuracy
from tracking_tools.scoring.consistency import Consistency
from tracking_tools.scoring.siap import Siap


@dataclass(frozen=True)
class Held:
    """How unbroken the tracks were."""

    coverage: float  # share of the scans with a contact that a confirmed track was on it
    breaks: int  # a contact in sight was lost and held again
    id_switches: int  # a contact in sight got another track
    lasting_switches: int  # of those, the ones that were not undone later
    new_ids_after_absence: int  # a contact that had been away got another track
    purity: float  # share of the matched rows of a track that are on its main contact
    relative_tracking_time: float  # [VORONINA19] (16), mean over the contacts
    false_tracks: int  # confirmed tracks that were never near a contact
    false_tracks_per_hour: float


@dataclass(frozen=True)
class Timing:
    """How soon the tracker knew."""

    time_to_confirm_mean: float  # from when a contact was there to its first confirmed track [s]
    time_to_confirm_median: float
    time_to_confirm_max: float
    never_confirmed: int  # contacts
    manoeuvres: int  # that began while a track was on the contact
    manoeuvres_told: int  # the manoeuvre probability reached one half before they ended
    onset_delay_mean: float  # of those, from the beginning of the turn [s]
    onset_delay_median: float
    manoeuvre_false_alarm: float  # share of the rows on straight contacts that tell a manoeuvre


@dataclass(frozen=True)
class Gospa:
    """
    The metric over all scans; alpha is 2.

    ``rms**p = localisation**p + missed**p + false**p``: the parts are roots of means, too.
    """

    mean: float
    rms: float
    localisation: float
    missed: float
    false: float
    missed_number: float  # contacts without a track, mean of a scan
    false_number: float  # tracks without a contact, mean of a scan
    cutoff: float
    power: float


@dataclass(frozen=True)
class Ospa:
    """Means over all scans; for power 1 localisation and cardinality add up to the mean."""

    mean: float
    localisation: float
    cardinality: float
    cutoff: float
    power: float


@dataclass(frozen=True)
class Ranges:
    """How well a sonar knows ranges where it says it can."""

    rmse: float  # [m]
    relative_rmse: float  # of error / range
    nees: Consistency
    share: float  # of the matched rows that tell a range


@dataclass(frozen=True)
class ContactJudgement:
    """How one contact was held."""

    contact: int
    duration: float  # that it was there [s]
    coverage: float
    breaks: int
    id_switches: int
    new_ids_after_absence: int
    tracks: tuple[int, ...]  # ids in order of time
    relative_tracking_time: float
    time_to_confirm: float  # NaN: never [s]
    onset_delays: tuple[float, ...]  # of its manoeuvres, NaN: not told [s]
    accuracy: Accuracy


@dataclass(frozen=True)
class TrackJudgement:
    """How one confirmed track did."""

    track: int
    contact: int | None  # that it was mostly on; None: false
    begin: float  # since the first scan [s]
    end: float
    rows: int
    matched: float  # share of the rows that are matched with a contact
    purity: float  # share of those that are on its main contact
    rmse: float
    nees_position: float
    nis: float  # mean, per dimension


@dataclass(frozen=True)
class Scans:
    """Figures scan by scan, (K,) each."""

    time: Floats  # since the first scan [s]
    gospa: Floats
    ospa: Floats
    missed: Floats  # contacts
    false: Floats  # tracks


@dataclass(frozen=True)
class Judgement:
    """All figures of one recording."""

    sensor: str
    scans: int
    duration: float  # [s]
    contacts: int
    tracks: int  # confirmed
    radius: float  # a track farther off is not the contact's
    extent: float  # of the space in which contacts were
    truth_error: float  # of the truth between its samples, about; NaN: nobody knows
    outside: float  # share of the rows of tracks from before or after all truth
    dimensions: int  # that are compared; 2 also where the truth of 3-D tracks has no heights
    held: Held
    timing: Timing
    accuracy: Accuracy
    nees_position: Consistency
    nees_state: Consistency
    nis: Consistency
    gospa: Gospa
    ospa: Ospa
    siap: Siap
    ranges: Ranges | None
    per_contact: tuple[ContactJudgement, ...]
    per_track: tuple[TrackJudgement, ...]
    by_scan: Scans
