# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How far are plots of contacts scattered, beside what they tell?

Three plots of a contact in even steps lie on a line but for their noise, whatever the filter
thinks of them: how far the third is off the line of the first two is the noise itself. Contacts
that turn are off it, too, so it is the usual that counts, of several contacts. Before tracks tell
it, plots that stand alone do: where their noise is told far too small, no track comes to be.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats, Ints, Scan
from tracking_core.bends import Bends, bends_of, Followed, REMEMBERED
from tracking_core.chains import chains
from tracking_core.rows import change, concatenate, take
from tracking_core.space import Space

_LOOKS = 5  # are learnt from at a time
_BEFORE = 4.5  # looks before these, from which their lines may begin
_MOST_TRACKS = 100  # are followed a message, the oldest ones
_MOST_PLOTS = 3000  # of them all
_MOST_LOOSE = 200  # plots of a look, among which contacts are sought before there are tracks
_REST, _LONGEST = 3.0, 300.0  # times as long as it learnt it rests, at most so long [s]


@dataclass(frozen=True)
class Scatter:
    """What has been learnt of the noise of plots."""

    followed: Followed
    bends: Bends
    began: float = -np.inf  # to follow tracks [s]
    until: float = -np.inf  # it rests: noise seldom changes [s]
    blind: float = -np.inf  # until then plots outside tracks are left alone: they told nothing [s]

    @staticmethod
    def none(d: int) -> Scatter:
        """Return what is known of plots with d coordinates before any came."""
        return Scatter(Followed.none(d), Bends(np.zeros(0, np.int64), np.zeros((0, d))))

    def learn(
        self, owner: Ints, scan: Scan, interval: float, space: Space, speed: float
    ) -> Scatter:
        """
        Return what is known after one more scan.

        Parameters
        ----------
        owner : (M,) array
            Id of the track that a plot is surely of, 0: of none.
        scan : Scan
            M plots.
        interval : float
            From one look at a track to the next [s].
        space : Space
            Where plots are.
        speed : float
            Of the fastest contact [m/s].

        """
        end = scan.coverage.end_time
        if end < self.until:
            return self
        began = self.began if len(self.followed.id) else end
        seeks = began >= self.blind and not self.bends.are_enough and space.has_range
        seeks = seeks and _are_few(scan, interval)
        (plot,) = (((owner > 0) | seeks) & np.isfinite(scan.position).all(axis=1)).nonzero()
        if not seeks and len(plot) > _MOST_TRACKS:
            plot = plot[np.argsort(owner[plot])[:_MOST_TRACKS]]
        fresh = Followed(
            owner[plot], scan.time[plot], scan.position[plot], scan.covariance[plot],
            scan.sensor_position[plot],
        )  # fmt: skip
        followed = concatenate(self.followed, fresh)
        if end < began + _LOOKS * interval and len(followed.id) < _MOST_PLOTS:
            return change(self, followed=followed, began=began)
        found = _all_bends(followed, began, scan, interval, speed, space)
        bends, rest = self.bends.and_then(found), _REST * (end - began)
        nobody = Followed.none(scan.position.shape[1])
        if bends.raised != self.bends.raised:  # what is told of the plots so far is another noise
            # Gates of far too small noise let pass what bends little; chains are not of gates.
            return Scatter(nobody, bends if bends.is_of_tracks else bends.some(bends.track < 0))
        if len(bends.track) >= REMEMBERED:
            return Scatter(nobody, bends, until=end + min(rest, _LONGEST))
        if seeks and (found.track >= 0).all():
            return Scatter(take(followed, followed.id > 0), bends, end, blind=end + rest)
        followed = take(followed, followed.time > end - _BEFORE * interval)
        return Scatter(followed, bends, end, blind=self.blind)

    @property
    def ratio(self) -> Floats:
        """How large the noise is over what is told (d,), see `Bends.ratio`."""
        return self.bends.ratio

    def raised(self, is_round: bool = False) -> tuple[float, float, float]:
        """
        Return by what told sds are to be multiplied on each axis: never less than 1.

        A filter that is surer of plots than they are loses contacts, starts second tracks on them
        and takes noise for turns; one that is less sure is only slower. What is told of noise that
        lasts, as of long ships, three plots do not show. `is_round`: the same on all axes.
        """
        raised = self.bends.raised
        most = max(raised)
        return (most, most, most) if is_round else raised


def _are_few(scan: Scan, interval: float) -> bool:
    """Return whether a look has so few plots that contacts stand out among them."""
    coverage = scan.coverage
    part = (coverage.end_time - coverage.start_time) / interval if coverage.rotation_rate else 1.0
    return len(scan) <= _MOST_LOOSE * min(part, 1.0)


def _all_bends(
    plots: Followed, since: float, scan: Scan, interval: float, speed: float, space: Space
) -> Bends:
    """Return the bends since then [s] of tracks, and of chains of the plots if all are there."""
    raised = np.array(scan.raised)
    found = bends_of(take(plots, plots.id > 0), since, raised, space)
    if (plots.id > 0).all():
        return found  # no others were followed
    variance = plots.covariance.diagonal(0, 1, 2)
    chain = chains(plots.time, plots.position, variance, interval, speed, space)
    loose = take(change(plots, id=-chain), chain > 0)
    return concatenate(found, bends_of(loose, since, raised, space))
