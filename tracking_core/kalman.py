# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How do plots, each only perhaps the right one, change the Gaussians of a plane?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.chances import log, TINY
from tracking_core.linalg import inverse, over_modes, sum_by_track, symmetrise
from tracking_core.rows import take_rows

_LOG_TWO_PI = float(np.log(2.0 * np.pi))
_ROUNDING = 64 * float(np.finfo(np.float64).eps)  # of what is subtracted


def innovate(mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
    """
    Compare the pairs with every mode's prediction.

    Parameters
    ----------
    mixture : Mixture
        Predicted plane.
    track : (P,) array
        Row of each pair's track.
    measurement : Measurement
        What the pairs measure of this plane.

    Returns
    -------
    Innovations
        The log likelihood counts only the components that a plot has.

    References
    ----------
    [ZHUK09] eq. 22 to 24 with the sign, S^-1 and (2 pi)^(d/2) that print lacks.

    """
    mean, covariance = take_rows(mixture.mean, track), take_rows(mixture.covariance, track)
    H = measurement.matrix  # (P, d, n)
    cross = np.einsum('pjnm,pdm->pjnd', covariance, H, order='F')  # P H^T
    S = np.einsum('pdn,pjne->pjde', H, cross) + measurement.covariance[:, None]
    nu = measurement.value[:, None] - np.einsum('pjn,pdn->pjd', mean, H)
    return from_innovation(nu, S, cross, measurement.covariance, measurement.absent)


def from_innovation(
    nu: Floats, S: Floats, cross: Floats, noise: Floats, absent: Ints
) -> Innovations:
    """
    Return distances and likelihoods of innovations nu (P, J, d) with covariance S.

    Where S is so large that rounding leaves it singular, the mode tells nothing of its plots.
    """
    S_inverse, determinant = inverse(S)
    distance = np.einsum('pjd,pjd->pj', nu, np.einsum('pjde,pje->pjd', S_inverse, nu))
    sound = determinant > 0.0
    if not sound.all():
        distance, determinant = (
            np.where(sound, distance, np.inf),
            np.where(sound, determinant, 1.0),
        )
    present = nu.shape[-1] - absent[:, None]
    log_likelihood = -0.5 * (distance + np.log(determinant) + present * _LOG_TWO_PI)
    return Innovations(nu, S, distance, log_likelihood, cross, noise)


def mixture_log_likelihood(mode_probability: Floats, innovations: Innovations) -> Floats:
    """Return log sum_j mu_j Lambda_j (P,), the likelihood of a pair; mu (P, J)."""
    weight = log(mode_probability) + innovations.log_likelihood
    top = over_modes(np.maximum, weight)
    top = np.where(np.isfinite(top), top, 0.0)  # no mode can have made the plot: log 0
    with np.errstate(divide='ignore'):
        return np.asarray(top + np.log(over_modes(np.add, np.exp(weight - top[:, None]))))


def kalman_gain(innovations: Innovations) -> Floats:
    """Return K = P H^T S^-1 (P, J, n, d)."""
    S_inverse, _ = inverse(innovations.covariance)
    return np.asarray(np.einsum('pjnd,pjde->pjne', innovations.cross_covariance, S_inverse))


def condition(
    mixture: Mixture,
    track: Ints,
    innovations: Innovations,
    association: Association,
    gain: Floats | None = None,
) -> Mixture:
    """
    Update every mode with the plots of its track, weighted by their association probability.

    The covariance after a plot with gain K is P - K C^T - C K^T + K S K^T, C = P H^T, which holds
    for any gain and is P - K C^T for Kalman's, where K S = C.

    Parameters
    ----------
    mixture : Mixture
        Predicted plane, T tracks.
    track : (P,) array
        Row of each pair's track, sorted.
    innovations : Innovations
        Of the pairs.
    association : Association
        Given that the tracks exist: per track miss + sum of probabilities = 1.
    gain : (P, J, n, d) array, optional
        K of every pair and mode, Kalman's if not given.

    Returns
    -------
    Mixture
        Posterior: mode probabilities, and per mode the moment-matched mixture over the plots.

    References
    ----------
    [ZHUK09] eq. 22 to 24; mode-conditioned association weights as in IMM-JPDA.

    """
    T, prior = len(mixture.mean), mixture.mode_probability
    weight = take_rows(log(prior), track) + innovations.log_likelihood
    weight = np.exp(weight - over_modes(np.maximum, weight)[:, None])
    weight *= (association.probability / over_modes(np.add, weight))[:, None]  # (P, J)
    posterior = association.miss[:, None] * prior + sum_by_track(weight, track, T)
    safe = np.maximum(posterior, TINY)
    weight = weight / take_rows(safe, track)

    K, C = kalman_gain(innovations) if gain is None else gain, innovations.cross_covariance
    shift = np.einsum('pjnd,pjd->pjn', K, innovations.innovation)  # K nu
    weighted, weighted_K = weight[..., None] * shift, weight[..., None, None] * K
    change = np.einsum('pjn,pjm->pjnm', weighted, shift)
    change -= np.einsum('pjnd,pjmd->pjnm', weighted_K, C)
    if gain is not None:
        excess = np.einsum('pjnd,pjde->pjne', K, innovations.covariance) - C
        change += np.einsum('pjnd,pjmd->pjnm', weighted_K, excess)
    mean_shift = sum_by_track(weighted, track, T)
    covariance = mixture.covariance + sum_by_track(change, track, T)
    covariance -= np.einsum('tjn,tjm->tjnm', mean_shift, mean_shift)
    # What the subtractions rounded off is not known: so small a part of what was there is left.
    there = np.einsum('tjnn->tjn', mixture.covariance) + mean_shift**2
    np.einsum('tjnn->tjn', covariance)[...] += _ROUNDING * there
    total = over_modes(np.add, posterior)[:, None]
    return Mixture(
        mean=mixture.mean + mean_shift,
        covariance=symmetrise(covariance),
        mode_probability=posterior / np.maximum(total, TINY),
        memory=mixture.memory,
    )
