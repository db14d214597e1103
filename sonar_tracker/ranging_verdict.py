# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is the range observable? From the information that the fit has, and from its residuals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc, ndtr

from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.ranging_drift import strayed
from sonar_tracker.ranging_fit import Fit
from sonar_tracker.ranging_heading import misheaded
from sonar_tracker.ranging_model import courses, distances, Legs
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.chances import TINY
from tracking_core.linalg import inverse, symmetrise
from tracking_core.rows import take

_UNKNOWNS = 4
_WORST_CONDITION = 1e10  # of the information; beyond it the inverse is rounding
_SURELY = 3.0  # sds of the noise that neighbouring marks show
_LEAST_NOISE = 0.25  # variance over the one that is told; below it averaged marks show as bends
_EDGE = 1e-3  # a range as near to its limits as this has been stopped there


@dataclass(frozen=True)
class Verdict:
    """What the fits of T tracks are worth."""

    state: Floats  # (T, 4) x, y, vx, vy at the time of the newest mark [m, m/s]
    covariance: Floats  # (T, 4, 4) of a contact that strays as far as its marks allow
    observable: Bools  # (T,)
    straight: Bools  # (T,) the residuals are those of a straight course
    bent: Bools  # (T,) surely no straight course


def may_tell(legs: Legs, config: RangingConfig) -> Bools:
    """Return whether even the nearest contact's range could be observed (T,)."""
    information = np.einsum('tk,tkx->t', legs.weight, legs.aside**2) * legs.reach**2
    return np.asarray(information * config.relative_sd**2 > config.range_min**2)


def judge(best: Fit, legs: Legs, config: RangingConfig, heading_sd: float = 0.0) -> Verdict:
    """
    Say which ranges are observable.

    A range is, if the information is well conditioned, if the relative sd of the range is small,
    even if the contact strays from its course a little and own ship's heading is wrong, and if the
    residuals are as small and as white as those of a straight course. How noisy the marks are the
    residuals tell, too; a heading that is wrong for a while they need not. If marks were whitened
    because of it, it must be the only reason, and a good one.

    Parameters
    ----------
    best, legs, config
        The fits, to which marks, and how they are believed.
    heading_sd : float
        That own ship tells [rad]; less than `config.heading_noise` is not believed.

    """
    scale = 1.0 / np.sqrt(np.maximum(np.einsum('taa->ta', best.information), TINY))
    unit = best.information * scale[:, :, None] * scale[:, None, :]
    sound = np.linalg.cond(unit) < _WORST_CONDITION
    unit = np.where(sound[:, None, None], unit, np.eye(_UNKNOWNS))
    bound = inverse(unit)[0] * scale[:, :, None] * scale[:, None, :]
    count = (legs.weight > 0.0).sum(axis=1)
    noise, alarm = _noise(best, count), config.false_alarm
    gain = _gain(best, legs, bound[:, 3])
    astray = config.velocity_noise**2 * _straying(best, legs, gain)
    if legs.whitening is None:
        astray += config.heading_error(heading_sd) ** 2 * misheaded(legs, gain)
    else:
        noise, alarm = np.minimum(noise, 1.0), np.sqrt(alarm)
    raised = np.maximum(noise, 1.0)
    bound *= raised[:, None, None]
    range_variance = bound[:, 3, 3] + astray
    observable = sound & (range_variance < (config.relative_sd * best.state[:, 3]) ** 2)

    distance = legs.reach / best.state[:, 3]
    observable &= distance > (1.0 + _EDGE) * config.range_min
    observable &= distance < (1.0 - _EDGE) * config.range_max
    chance = _chance(best, noise, count)
    straight = chance > alarm
    observable &= best.arrived & straight
    if observable.any():
        bound[observable] = strayed(
            bound[observable], take(best, observable), take(legs, observable),
            raised[observable], config.velocity_noise,
        )  # fmt: skip
    state, jacobian = courses(best.state, legs)
    return Verdict(
        state=state,
        covariance=symmetrise(jacobian @ bound @ np.swapaxes(jacobian, 1, 2)),
        observable=observable,
        straight=straight,
        # A false alarm would cost the leg before the manoeuvre: be twice as sure.
        bent=best.arrived & (chance < config.false_alarm**2),
    )


def _gain(best: Fit, legs: Legs, bound: Floats) -> Floats:
    """Return how an unknown of these covariances (T, 4) follows each mark (T, K) [1/rad]."""
    follows = (best.slope @ bound[..., None])[..., 0]
    if legs.whitening is not None:
        follows = (follows[:, None] @ legs.whitening)[:, 0]
    return np.asarray(follows * np.sqrt(legs.weight))


def _noise(best: Fit, count: Ints) -> Floats:
    """
    Return the variance of the marks in units of the one that they tell (T,).

    From the steps between neighbouring residuals, in which no bend shows. What the marks tell is
    believed unless it is surely wrong.
    """
    steps = (best.chi_square - np.sqrt(count) * best.serial) / count
    told = np.abs(steps - 1.0) < _SURELY * np.sqrt(3.0 / count)
    return np.where(told, 1.0, np.maximum(steps, _LEAST_NOISE))


def _chance(best: Fit, noise: Floats, count: Ints) -> Floats:
    """Return how probable residuals as large or as even as these are on a straight course (T,)."""
    size = chdtrc(count - _UNKNOWNS, best.chi_square / noise)
    evenness = ndtr(-best.serial / noise)
    return np.asarray(2.0 * np.minimum(size, evenness))


def _straying(best: Fit, legs: Legs, gain: Floats) -> Floats:
    """Return what a velocity that drifts by 1 m/s/sqrt(s) adds to the variance of u reach (T,)."""
    distance, direction = distances(best.state, legs)
    moved = gain / distance  # (T, K) change of u reach by metres across
    age = -legs.tau * legs.span[:, None]
    variance = np.zeros(len(age))
    for part in (moved * np.cos(direction), moved * np.sin(direction)):
        # The noise of s seconds ago moved each older mark by its age less s: in between
        # neighbouring marks the sum of what it did is a straight line of s.
        rate, start = np.cumsum(part, axis=1), np.cumsum(part * age, axis=1)
        younger = np.append(age[:, 1:], np.zeros((len(age), 1)), axis=1)
        old, young = start - rate * age, start - rate * younger
        variance += ((age - younger) * (old**2 + old * young + young**2)).sum(axis=1) / 3.0
    return variance
