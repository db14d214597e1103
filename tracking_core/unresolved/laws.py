# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which set of tracks may have made which plot, and by which law?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats, Ints, Scan
from tracking_core.composition import Setup
from tracking_core.linalg import inverse
from tracking_core.pairing import thresholds
from tracking_core.prediction import longest_lag, Predicted
from tracking_core.unresolved.grouping import Groups
from tracking_core.unresolved.resolution import Places, Resolution
from tracking_core.unresolved.sets import Common, Sets


@dataclass(frozen=True)
class Laws:
    """
    Laws by which sets of tracks may have made plots: Q pairs of a set and a plot, R rows.

    A row is a track and a law: the plot is of all (`share` below 1), or of this track alone.
    """

    set: Ints  # (Q,)
    plot: Ints  # (Q,)
    log_likelihood: Floats  # (Q,) of all laws together
    pair: Ints  # (R,)
    member: Ints  # (R,) row of the groups' members
    share: Floats  # (R,) of the track in the plot
    expected: Floats  # (R, d) plot
    noise: Floats  # (R, d, d) beside that of plot and track
    part: Floats  # (R,) chance of the law, given the pair; twice for a law of two tracks
    alone: Ints  # (R,) 1: the track has drowned the others


def candidates(
    places: Places,
    sets: Sets,
    groups: Groups,
    passed: Predicted,
    scan: Scan,
    setup: Setup,
    resolution: Resolution,
) -> tuple[Ints, Ints, Floats]:
    """Return sets, plots and lags where a plot is in a box about the gates of all laws."""
    bound = _bound(scan, setup)
    leader = groups.member[sets.start]
    lag_max = longest_lag(passed, scan)[leader]
    noise = setup.sensor.noise(places.mean, scan.coverage)
    d = noise.shape[1]
    noise = noise + np.diag(np.array(scan.excess)[:d])
    own = np.sqrt(bound * np.einsum('tdd->td', places.covariance + noise))[groups.member]
    blur = _blur(sets, resolution) + noise[leader]
    half = np.sqrt(bound * np.einsum('bdd->bd', blur))
    low = np.minimum(np.minimum.reduceat(sets.place - own, sets.start), sets.mean - half)
    high = np.maximum(np.maximum.reduceat(sets.place + own, sets.start), sets.mean + half)
    reach = 0.5 * (high - low) + np.abs(sets.velocity) * lag_max[:, None]
    row, plot = setup.sensor.space.find_pairs(0.5 * (low + high), reach, scan.position)
    lag = scan.time[plot] - passed.time[leader[row]]
    fits = np.isfinite(scan.position[plot]).all(axis=1) & (np.abs(lag) <= lag_max[row])
    return row[fits], plot[fits], lag[fits]


def compare(
    places: Places,
    sets: Sets,
    groups: Groups,
    scan: Scan,
    setup: Setup,
    resolution: Resolution,
    found: tuple[Ints, Ints, Floats],
) -> Laws:
    """
    Weigh the laws by which each set may have made the plots `found`: sets, plots, lags.

    Pairs of a set and a plot that no law explains are left out.
    """
    row, plot, _ = found
    mean, of_all = _made_by_all(sets, scan, setup, resolution, found)
    pair, member, own, of_one = _made_by_one(places, sets, groups, scan, setup, resolution, found)
    top = of_all.copy()
    np.maximum.at(top, pair, of_one)
    heard = np.isfinite(top)
    row, plot, mean, of_all, top = row[heard], plot[heard], mean[heard], of_all[heard], top[heard]
    rows = heard[pair]
    member, own, of_one = member[rows], own[rows], of_one[rows]
    pair = (np.cumsum(heard) - 1)[pair[rows]]
    total = top + np.log(
        np.exp(of_all - top) + np.bincount(pair, np.exp(of_one - top[pair]), len(top))
    )
    share, P = sets.share[member], places.covariance[groups.member[member]]
    blurred = _blur(sets, resolution)[row[pair]] - share[:, None, None] ** 2 * P
    return Laws(
        row, plot, total,
        pair=np.concatenate([pair, pair]),
        member=np.concatenate([member, member]),
        share=np.concatenate([share, np.ones(len(pair))]),
        expected=np.concatenate([mean[pair], own]),
        noise=np.concatenate([blurred, np.zeros_like(blurred)]),
        part=np.exp(np.concatenate([of_all[pair], of_one]) - np.tile(total[pair], 2)),
        alone=np.repeat([0, 1], len(pair)),
    )  # fmt: skip


def _blur(sets: Sets, resolution: Resolution) -> Floats:
    """Return how sure (B, d, d) the place of a plot of all members is, without its own noise."""
    return sets.covariance + resolution.spread * sets.spread


def _made_by_all(
    sets: Sets, scan: Scan, setup: Setup, resolution: Resolution,
    found: tuple[Ints, Ints, Floats],
) -> tuple[Floats, Floats]:  # fmt: skip
    """Return where all members together would make the plot (Q, d), and its log density (Q,)."""
    row, plot, lag = found
    mean = sets.mean[row] + sets.velocity[row] * lag[:, None]
    z = setup.sensor.space.beside(scan.position[plot], sets.mean, row)
    S = _blur(sets, resolution)[row] + scan.covariance[plot]
    return mean, _log_gaussian(z - mean, S, _bound(scan, setup)) + np.log1p(-resolution.capture)


def _made_by_one(
    places: Places, sets: Sets, groups: Groups, scan: Scan, setup: Setup, resolution: Resolution,
    found: tuple[Ints, Ints, Floats],
) -> tuple[Ints, Ints, Floats, Floats]:  # fmt: skip
    """
    Return the same for each member that may have drowned the others.

    Its pair and row of the groups' members (R,), where it would make the plot (R, d), log density.
    """
    row, plot, lag = found
    pair = np.repeat(np.arange(len(row)), sets.size[row])
    member = sets.start[row[pair]] + _rank(pair)
    track = groups.member[member]
    own = sets.place[member] + places.velocity[track] * lag[pair, None]
    z = setup.sensor.space.beside(scan.position[plot], sets.mean, row)[pair]
    S = places.covariance[track] + scan.covariance[plot][pair]
    density = _log_gaussian(z - own, S, _bound(scan, setup))
    return pair, member, own, density + np.log(resolution.capture * sets.share[member])


def as_common(laws: Laws, sets: Sets, groups: Groups) -> Common:
    """Return what the association must know of the laws."""
    T = len(groups.existence_apart)
    alone = laws.alone == 1
    pair, part = laws.pair[alone], laws.part[alone]
    drowned = np.bincount(pair, part, len(laws.set))[pair] - part
    return Common(
        partitions=groups.partitions,
        existence_apart=groups.existence_apart,
        size=np.concatenate([np.ones(T, np.int64), sets.size]),
        unit=T + laws.set,
        plot=laws.plot,
        log_likelihood=laws.log_likelihood,
        law_pair=laws.pair,
        law_part=laws.part,
        law_size=np.where(laws.alone == 1, 1, sets.size[laws.set[laws.pair]]),
        hidden_pair=pair,
        hidden_track=groups.member[laws.member[alone]],
        hidden_part=drowned,
    )


def _bound(scan: Scan, setup: Setup) -> float:
    d = scan.position.shape[1]
    return float(thresholds(setup.gate_probability, d)[d])


def _log_gaussian(nu: Floats, S: Floats, bound: float) -> Floats:
    """Return the log density (P,), -inf outside the gate."""
    inverted, determinant = inverse(S)
    distance = np.einsum('pd,pde,pe->p', nu, inverted, nu)
    log_density = -0.5 * (distance + np.log(determinant) + nu.shape[1] * np.log(2.0 * np.pi))
    return np.where(distance <= bound, log_density, -np.inf)


def _rank(pair: Ints) -> Ints:
    """Return the place of each row among those of the same pair; `pair` ascends."""
    start = np.flatnonzero(np.diff(pair, prepend=-1))
    return np.arange(len(pair)) - start[pair]
