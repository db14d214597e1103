# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does one look of the antenna tell about the tracks that it has passed?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.association.clusters import clusters
from tracking_core.batches import Bools, Floats, Ints, Scan, Tracks
from tracking_core.chances import MORE_LIKELY_THAN_NOT, TINY
from tracking_core.composition import Setup
from tracking_core.density import Density
from tracking_core.detection import detection_probability
from tracking_core.lifecycle import count_looks, has_left
from tracking_core.linalg import is_positive_definite, sum_by_track, TURN
from tracking_core.looks import LONGEST_WAIT
from tracking_core.pairing import Gated, pair, thresholds
from tracking_core.prediction import longest_lag, next_passes, predict_tracks, Predicted
from tracking_core.rows import change, take, take_of_both
from tracking_core.sharing import Share, share_plots
from tracking_core.unresolved.common_pairs import add_common

_LOST = 10.0  # strange plots expected in the gate of a track that is no track any more

_SURE = 0.8  # chance of a pair, beside all others of its track and of its plot

_LEVEL_GAIN = 0.05  # of the usual snr: contacts flutter from look to look


@dataclass(frozen=True)
class Look:
    """The tracks after a look, and what became of the plots."""

    tracks: Tracks  # those that live on
    ended: Ints  # ids of the others
    broken: int  # tracks deleted because a covariance was not positive definite
    claimed: Floats  # (M,) chance that a known contact made the plot
    owner: Ints  # (M,) id of the confirmed track that the plot is surely of, 0: of none
    waiting: Bools  # (M,) in the gate of a track that the antenna has not passed yet
    passed: Bools  # of the tracks that live on: which were worked on
    pairs: int
    approximate: int  # tracks in clusters too large for exact marginals
    again: bool  # the antenna has passed a track once more in the same scan

    def and_then(self, second: Look) -> Look:
        """Return both looks as one."""
        claimed = self.claimed + second.claimed
        return Look(
            tracks=second.tracks,
            ended=np.concatenate([self.ended, second.ended]),
            broken=self.broken + second.broken,
            claimed=claimed,
            owner=np.maximum(self.owner, second.owner),
            waiting=second.waiting & (claimed < MORE_LIKELY_THAN_NOT),
            passed=second.passed | np.isin(second.tracks.id, self.tracks.id[self.passed]),
            pairs=self.pairs + second.pairs,
            approximate=self.approximate + second.approximate,
            again=second.again,
        )


def look(tracks: Tracks, scan: Scan, setup: Setup, density: Density) -> Look:
    """
    Update every track that the antenna has passed, once, at the time of the pass.

    Parameters
    ----------
    tracks : Tracks
        T tracks, each at the time of its last look.
    scan : Scan
        M plots.
    setup : Setup
        Sensor, filters and rules.
    density : Density
        Of false plots and of new contacts.

    """
    near = predict_tracks(tracks, scan, setup)
    bounds = thresholds(setup.gate_probability, setup.sensor.dimensions)
    gated = pair(
        setup.planes, near.planes, near.gates, near.time, longest_lag(near, scan), scan, bounds,
        setup.sensor.space,
    )  # fmt: skip
    due = _due(near, gated, scan)
    waiting = np.zeros(len(scan), bool)
    waiting[gated.pairs.plot[~due[gated.pairs.track]]] = True

    # A track that waits is not seen now; it stays as it was.
    strange = near.crowd * density.total(density.relief(near.gates.centre))
    own = detection_probability(near.tracks, near.detection, strange)
    predicted = change(near, detection=np.where(due, own, 0.0))
    gated = take(gated, (predicted.detection > 0.0)[gated.pairs.track])
    gated, common = add_common(predicted, gated, scan, setup)
    existence = predicted.tracks.existence_probability
    share = share_plots(existence, predicted.detection, gated, scan, setup, density, common)
    updated, ended, broken = _update(predicted, gated, share, scan, setup, density.leniency)
    ended |= strange > _LOST  # it follows nobody any more

    claimed = np.asarray(np.bincount(gated.pairs.plot, share.claim, len(scan)), np.float64)
    lives = due & ~(ended | broken)
    again, early = next_passes(updated, predicted.gates.half_size, lives, scan)
    kept, worked_on = np.ones(len(tracks), bool), np.zeros(len(tracks), bool)
    kept[near.row[due]], worked_on[near.row[due]] = lives[due], True
    return Look(
        tracks=_merge(tracks, near.row, updated, kept, worked_on),
        ended=tracks.id[~kept],
        broken=int((due & broken).sum()),
        claimed=claimed,
        owner=_owners(predicted.tracks, gated, share, scan),
        waiting=(waiting | early) & (claimed < MORE_LIKELY_THAN_NOT),
        passed=worked_on[kept],
        pairs=len(gated.pairs),
        approximate=int(share.approximate.sum()),
        again=again,
    )


def _owners(tracks: Tracks, gated: Gated, share: Share, scan: Scan) -> Ints:
    """Return the id of the confirmed track (M,) that each plot is surely of alone, 0: of none."""
    track, plot = gated.pairs.track, gated.pairs.plot
    sure = (share.claim > _SURE) & (gated.common < 0) & tracks.confirmed[track]
    owner = np.zeros(len(scan), np.int64)
    owner[plot[sure]] = tracks.id[track[sure]]
    return owner


def _merge(tracks: Tracks, row: Ints, updated: Tracks, kept: Bools, worked_on: Bools) -> Tracks:
    """Return those `kept` of the tracks (T,), those `worked_on` as `updated`, their `row` (N,)."""
    if worked_on.all():
        return take(updated, kept)
    waiting = (~worked_on).nonzero()[0]
    source = np.empty(len(tracks), np.int64)  # first the rows of `updated`, then those of `tracks`
    source[row], source[waiting] = np.arange(len(row)), len(row) + waiting
    return take_of_both(updated, tracks, source[kept])


def _due(near: Predicted, gated: Gated, scan: Scan) -> Bools:
    """
    Return which tracks (T,) can be worked on.

    Not those whose gate is still being swept, and not those that compete with them for plots,
    unless they have waited long enough.
    """
    left_behind = near.time + near.margin <= scan.coverage.end_time
    if left_behind.all():
        return np.asarray(left_behind)
    label, _ = clusters(gated.pairs.track, gated.pairs.plot, len(near.time), len(scan))
    waits = np.zeros(len(near.time), bool)
    waits[label[~left_behind]] = True
    patience = LONGEST_WAIT * TURN / abs(scan.coverage.rotation_rate)
    overdue = near.time + near.margin + patience <= scan.coverage.end_time
    return np.asarray(left_behind & (~waits[label] | overdue))


def _update(
    predicted: Predicted, gated: Gated, share: Share, scan: Scan, setup: Setup, leniency: float
) -> tuple[Tracks, Bools, Bools]:
    """Return the updated tracks, which have ended, and which are no longer sound."""
    track, T = gated.pairs.track, len(predicted.row)
    planes = tuple(
        plane.estimator.update(mixture, track, innovations, share.association)
        for plane, mixture, innovations in zip(
            setup.planes, predicted.planes, gated.innovations, strict=True
        )
    )
    found = share.found
    inside = predicted.detection > 0.0
    hit = setup.lifecycle.hits(found, predicted.planes[0], planes[0])
    weighted = sum_by_track(share.association.probability * gated.distance, track, T)
    tracks = change(
        count_looks(predicted.tracks, hit, inside),
        planes=planes,
        existence_probability=share.existence_probability,
        gate_size=predicted.gates.three_sigma,
        gate_volume=predicted.gates.volume,
        level=_follow_level(predicted.tracks, gated, share, scan),
        nis=np.where(found > 0.5, weighted / np.maximum(found, 0.5), np.nan),
    )
    confirmed, ended = setup.lifecycle.judge(tracks, share.existence_probability, leniency)
    ended |= has_left(tracks, inside, setup.looks_outside)
    sound = [is_positive_definite(mixture.covariance).all(axis=1) for mixture in planes]
    return change(tracks, confirmed=confirmed), ended, ~np.logical_and.reduce(sound)


def _follow_level(tracks: Tracks, gated: Gated, share: Share, scan: Scan) -> Floats:
    """Return the usual snr (T,) [dB]: plots in common do not tell whose it is."""
    track, T, snr = gated.pairs.track, len(tracks), scan.snr[gated.pairs.plot]
    told = (gated.common < 0) & np.isfinite(snr)
    if not told.any():
        return tracks.level
    weight = np.where(told, share.association.probability, 0.0)
    total = sum_by_track(weight, track, T)
    mean = sum_by_track(weight * np.where(told, snr, 0.0), track, T) / np.maximum(total, TINY)
    old = np.where(np.isfinite(tracks.level), tracks.level, mean)
    gain = total * np.maximum(_LEVEL_GAIN, 1.0 / (1.0 + tracks.hits))
    return np.where((total > 0.5) | np.isfinite(tracks.level), old + gain * (mean - old), np.nan)
