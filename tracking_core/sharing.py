# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How are the plots of a look shared among tracks that exist only perhaps?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import expit

from tracking_core.batches import Association, Bools, Floats, Scan
from tracking_core.composition import Density, Setup
from tracking_core.kalman import log
from tracking_core.lifecycle import existence_after
from tracking_core.linalg import sum_by_track
from tracking_core.pairing import Gated


@dataclass(frozen=True)
class Share:
    """How the plots are shared, and what follows for existence."""

    association: Association  # given that the tracks exist
    existence_probability: Floats  # (T,)
    claim: Floats  # (P,) chance that the pair is right and the contact exists
    approximate: Bools  # (T,)


def share_plots(
    existence: Floats,
    detection_probability: Floats,
    gated: Gated,
    scan: Scan,
    setup: Setup,
    density: Density,
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

    References
    ----------
    [MUSICKI04] JIPDA; hard associations are followed by the IPDA update of [MUSICKI94].

    """
    track = gated.pairs.track
    weight = log(detection_probability * existence)[track] + gated.log_likelihood
    weight = weight - np.log(_other_sources(gated, scan, setup, density))
    detection = detection_probability * setup.gate_probability
    log_miss = np.log1p(-detection * existence)
    shared = setup.associate(track, gated.pairs.plot, weight, log_miss, len(scan))

    exists = 1.0 if setup.is_soft else expit(weight - log(1.0 - existence)[track])
    claim = shared.probability * exists
    found = sum_by_track(claim, track, len(existence))
    posterior, missed = existence_after(existence, shared.miss, found, detection)
    given = Association(claim / np.maximum(posterior, 1e-300)[track], missed, shared.approximate)
    return Share(given, posterior, claim, shared.approximate)


def _other_sources(gated: Gated, scan: Scan, setup: Setup, density: Density) -> Floats:
    """Return the density of other plots at each pair's plot (P,), in the plot's own space."""
    plot = gated.pairs.plot
    other = density.total * scan.clutter_volume[plot]
    has_range_rate = np.isfinite(scan.range_rate[plot])
    return np.where(has_range_rate, other * setup.sensor.range_rate_density, other)
