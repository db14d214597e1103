# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are the plots of a look shared among tracks that exist only perhaps?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.association.partitions import has_alternatives, over_partitions
from tracking_core.batches import Association, Bools, Floats, Scan
from tracking_core.chances import log, TINY
from tracking_core.composition import Setup
from tracking_core.density import Density
from tracking_core.lifecycle import existence_after
from tracking_core.linalg import sum_by_track
from tracking_core.pairing import Gated
from tracking_core.unresolved.sets import Common


@dataclass(frozen=True)
class Share:
    """How the plots are shared, and what follows for existence."""

    association: Association  # given that the tracks exist
    existence_probability: Floats  # (T,)
    claim: Floats  # (P,) chance that the pair is right and the contact exists
    found: Floats  # (T,) chance that a contact which exists made a plot, or was drowned in one
    approximate: Bools  # (T,)


def share_plots(
    existence: Floats,
    detection_probability: Floats,
    gated: Gated,
    scan: Scan,
    setup: Setup,
    density: Density,
    common: Common | None,
) -> Share:
    """
    Share the plots among the tracks, and judge from them whether the tracks exist.

    Parameters
    ----------
    existence : (T,) array
        Existence probabilities before the look.
    detection_probability : (T,) array
        P_D, 0 outside the coverage.
    gated : Gated
        P pairs.
    scan : Scan
        M plots.
    setup : Setup
        Association method and gate probability.
    density : Density
        Of plots that no known contact makes.
    common : Common, optional
        Plots that several tracks may have in common, if there are such.

    References
    ----------
    [MUSICKI04] JIPDA; hard associations are followed by the IPDA update of [MUSICKI94].

    """
    track = gated.pairs.track
    if common is not None:
        existence = np.where(_is_heard(gated, common), common.existence_apart, existence)
    own = log(detection_probability * existence)[track] + gated.log_likelihood
    own = own - np.log(_other_sources(gated, scan, setup, density))
    # A hard association gives a plot to a track, exists it or not: new ones would never get one.
    weight = own if setup.is_soft else np.logaddexp(own, log(1.0 - existence)[track])
    detection = detection_probability * setup.gate_probability
    log_miss = np.log1p(-detection * existence)
    hidden = np.zeros(len(existence))
    if common is None:
        shared = setup.associate(track, gated.pairs.plot, weight, log_miss, len(scan))
    else:
        shared, hidden = _share_in_common(gated, weight, log_miss, scan, setup, density, common)

    claim = shared.probability if setup.is_soft else shared.probability * np.exp(own - weight)
    found = sum_by_track(claim, track, len(existence)) + hidden
    posterior, missed = existence_after(existence, shared.miss, found, detection)
    safe = np.maximum(posterior, TINY)
    given = Association(claim / safe[track], missed + hidden / safe, shared.approximate)
    if common is not None:  # a plot of all is claimed once, not by each of its tracks
        claim = claim / np.append(common.law_size, 1)[gated.common]  # own: -1
    return Share(given, posterior, claim, 1.0 - missed, shared.approximate)


def _share_in_common(
    gated: Gated, weight: Floats, log_miss: Floats, scan: Scan, setup: Setup, density: Density,
    common: Common,
) -> tuple[Association, Floats]:  # fmt: skip
    """
    Share the plots where some may belong to several tracks.

    Tracks with nobody near go the usual way, unless they compete with tracks that have. Also
    returns the chance (T,) that a track is drowned by another, and so is not missed.
    """
    T, own, plots = len(log_miss), gated.common < 0, len(scan)
    P_D = 1.0 - (1.0 - setup.sensor.detection_probability) ** common.size
    other = _strange(scan, density)[common.plot]
    shared_weight = np.log(P_D[common.unit]) + common.log_likelihood - np.log(other)
    miss = np.concatenate([log_miss, np.log1p(-P_D[T:] * setup.gate_probability)])
    unit = np.concatenate([gated.pairs.track[own], common.unit])
    plot = np.concatenate([gated.pairs.plot[own], common.plot])
    busy = has_alternatives(unit, plot, plots, common.partitions)[unit]
    alone = np.flatnonzero(own)[~busy[: own.sum()]]

    usual = setup.associate(
        gated.pairs.track[alone], gated.pairs.plot[alone], weight[alone], log_miss, plots
    )
    both = np.concatenate([weight[own], shared_weight])
    by_unit, rough = over_partitions(
        unit[busy], plot[busy], both[busy], miss, plots, common.partitions
    )
    of_unit = np.zeros(len(unit))
    of_unit[busy] = by_unit
    probability = np.empty(len(weight))
    probability[own] = of_unit[: own.sum()]
    probability[alone] = usual.probability
    in_common, law = of_unit[own.sum() :], gated.common[~own]
    probability[~own] = in_common[common.law_pair[law]] * common.law_part[law]
    drowned = in_common[common.hidden_pair] * common.hidden_part
    hidden = np.zeros(T)
    np.add.at(hidden, common.hidden_track, drowned)
    taken = sum_by_track(probability, gated.pairs.track, T) + hidden
    approximate = usual.approximate | rough[common.partitions.unit_group[:T]]
    return Association(probability, np.maximum(1.0 - taken, 0.0), approximate), hidden


def _is_heard(gated: Gated, common: Common) -> Bools:
    """
    Return which tracks (T,) are of a group that has a plot in one of its gates.

    Without one there is nothing to share: who is one with whom says nothing, and two contacts
    that are one are missed as probably as two that are not.
    """
    group = common.partitions.unit_group
    heard = np.zeros(len(common.partitions.sizes), bool)
    heard[group[gated.pairs.track]] = heard[group[common.unit]] = True
    return np.asarray(heard[group[: len(common.existence_apart)]])


def _other_sources(gated: Gated, scan: Scan, setup: Setup, density: Density) -> Floats:
    """Return the density of other plots at each pair's plot (P,), in the plot's own space."""
    plot = gated.pairs.plot
    other = _strange(scan, density)[plot]
    has_range_rate = np.isfinite(scan.range_rate[plot])
    if not has_range_rate.any():
        return np.asarray(other)
    return np.where(has_range_rate, other * setup.sensor.range_rate_density, other)


def _strange(scan: Scan, density: Density) -> Floats:
    """Return the density (M,) at the plots of those of no known contact, per unit of position."""
    return density.total(density.at_plots) * scan.clutter_volume
