# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is a track real, confirmed, or to be deleted? Two answers: existence probability, M of N."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from tracking_core.batches import Bools, Floats, Mixture, Tracks
from tracking_core.chances import MORE_LIKELY_THAN_NOT, TINY
from tracking_core.detection import lengths, ones, REMEMBERED
from tracking_core.lifecycle_config import ErrorRatioConfig, ExistenceConfig, MOfNConfig
from tracking_core.rows import change

_HISTORY = (1 << REMEMBERED) - 1


class Lifecycle(Protocol):
    """What a tracker asks about the life of its tracks."""

    counts: ClassVar[bool]  # looks with plots; how likely these are clutter is not weighed

    def prior(self, tracks: Tracks, dt: Floats) -> Floats:
        """Return the existence probability (T,) at the next look, dt (T,) [s] later."""
        ...

    def hits(self, found: Floats, before: Mixture, after: Mixture) -> Bools:
        """
        Return which tracks (T,) count this look as one with a plot.

        `found` is the chance that a plot is theirs, `before` and `after` the look is their first
        plane.
        """
        ...

    def judge(
        self, tracks: Tracks, existence: Floats, leniency: float = 1.0
    ) -> tuple[Bools, Bools]:
        """
        Return which tracks (T,) are confirmed and which are to be deleted.

        In dense clutter tentative tracks may be less likely than usual, by `leniency`.
        """
        ...


@dataclass(frozen=True)
class Existence:
    """
    Integrated existence probability (IPDA, JIPDA): a track is as real as its plots say.

    Contacts leave the coverage after `lifetime` on average, so that an existence probability never
    sticks at 1.
    """

    config: ExistenceConfig
    counts: ClassVar[bool] = False

    def prior(self, tracks: Tracks, dt: Floats) -> Floats:
        """Return the existence probability (T,) at the next look, dt (T,) [s] later."""
        survival = np.exp(-np.maximum(dt, 0.0) / self.config.lifetime)
        return np.asarray(tracks.existence_probability * survival)

    def hits(self, found: Floats, before: Mixture, after: Mixture) -> Bools:
        """Return which tracks (T,) more probably than not have a plot."""
        return np.asarray(found > MORE_LIKELY_THAN_NOT)

    def judge(
        self, tracks: Tracks, existence: Floats, leniency: float = 1.0
    ) -> tuple[Bools, Bools]:
        """Return which tracks (T,) are confirmed and which are to be deleted."""
        confirmed = tracks.confirmed | (existence >= self.config.confirm)
        return confirmed, existence * np.where(confirmed, 1.0, leniency) < self.config.drop


@dataclass(frozen=True)
class MOfN:
    """
    Confirmed by M plots in the first N looks, or deleted as soon as these can no longer come.

    Once confirmed, a track is deleted after misses in a row.
    """

    config: MOfNConfig
    counts: ClassVar[bool] = True

    def prior(self, tracks: Tracks, dt: Floats) -> Floats:
        """Return 1 (T,): counting knows no doubt."""
        return np.ones(len(tracks))

    def hits(self, found: Floats, before: Mixture, after: Mixture) -> Bools:
        """Return which tracks (T,) more probably than not have a plot."""
        return np.asarray(found > MORE_LIKELY_THAN_NOT)

    def judge(
        self, tracks: Tracks, existence: Floats, leniency: float = 1.0
    ) -> tuple[Bools, Bools]:
        """Return which tracks (T,) are confirmed and which are to be deleted."""
        return _count(tracks, self.config)


@dataclass(frozen=True)
class ErrorRatio:
    """
    As `MOfN`, but what counts is whether a look has made the track any surer of its place.

    References
    ----------
    [VORONINA19] eq. 15, with the comparison put right: the ratio is below 1 when a plot was used.

    """

    config: ErrorRatioConfig
    counts: ClassVar[bool] = True

    def prior(self, tracks: Tracks, dt: Floats) -> Floats:
        """Return 1 (T,): counting knows no doubt."""
        return np.ones(len(tracks))

    def hits(self, found: Floats, before: Mixture, after: Mixture) -> Bools:
        """Return which tracks (T,) are surer of their place than before."""
        old, new = before.moments()[1][:, 0, 0], after.moments()[1][:, 0, 0]
        return np.asarray(np.sqrt(np.maximum(new, 0.0) / old) < self.config.ratio)

    def judge(
        self, tracks: Tracks, existence: Floats, leniency: float = 1.0
    ) -> tuple[Bools, Bools]:
        """Return which tracks (T,) are confirmed and which are to be deleted."""
        return _count(tracks, self.config)


LIFECYCLES = {'existence': Existence, 'm_of_n': MOfN, 'error_ratio': ErrorRatio}


def _count(tracks: Tracks, config: MOfNConfig | ErrorRatioConfig) -> tuple[Bools, Bools]:
    window = np.int64((1 << config.looks) - 1)
    plots = ones(tracks.history & window)
    misses = np.minimum(lengths(tracks.history), config.looks) - plots
    confirmed = tracks.confirmed | (plots >= config.hits)
    hopeless = misses > config.looks - config.hits
    lost = tracks.misses >= config.drop_misses
    return confirmed, np.where(confirmed, lost, hopeless)


def existence_after(
    prior: Floats, miss: Floats, found: Floats, detection: Floats
) -> tuple[Floats, Floats]:
    """
    Return existence probability after a look, and the chance that an existing contact was missed.

    Parameters
    ----------
    prior : (T,) array
        Existence probability r before the look.
    miss : (T,) array
        Posterior that no plot is the track's, because it was missed or does not exist.
    found : (T,) array
        Posterior that one of the plots is the track's and that the contact exists.
    detection : (T,) array
        P_D P_G.

    Returns
    -------
    existence, missed : (T,) arrays
        `missed` is conditional on existence: 1 - missed is the weight of the plots.

    References
    ----------
    [MUSICKI04]. By Bayes: `miss` is the chance that no plot is the track's. Before the scan
    1 - P_D P_G prior was, and (1 - P_D P_G) prior of it that the contact exists and was missed.

    """
    unseen = miss * (1.0 - detection) * prior / (1.0 - detection * prior)
    existence = found + unseen
    return existence, unseen / np.maximum(existence, TINY)


def count_looks(tracks: Tracks, hit: Bools, inside: Bools) -> Tracks:
    """
    Return the tracks with this look in hits, misses and history.

    A look at what is not `inside` (T,) the coverage says nothing of the track: it is only counted
    in `outside`.
    """
    return change(
        tracks,
        hits=tracks.hits + hit,
        misses=np.where(hit, 0, tracks.misses + inside),
        outside=np.where(hit, 0, tracks.outside + ~inside),
        history=np.where(inside, (tracks.history << 1 | hit) & _HISTORY, tracks.history),
    )


def has_left(tracks: Tracks, inside: Bools, looks: int) -> Bools:
    """Return which tracks (T,) are outside the coverage, after so many looks there."""
    return np.asarray(~inside & (tracks.outside >= looks))
