# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""At which rate did the antenna turn, if all these plots were on its beam?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Bools, Floats
from tracking_core.linalg import TURN, wrap_angle

PERIODS = (0.4, 60.0)  # of antennas [s]
IN_STEP = 0.97  # mean resultant length of azimuth minus antenna; 1: every plot on the beam
_NEARLY = 0.6  # the same of a candidate, which may be off by a part of the step between them
_USUAL = 0.1  # part by which a turn may differ from the interval between full turns
_RIVAL = 0.05  # resultant length by which a rate must fit better than any quite different one
_STEPS = 8  # candidates from the top of a fit to its first zero
_STILL = 1e-9  # part of the rate by which it may change and still stand
_AT_ONCE = 2**16  # plots times candidates whose arrays stay near the processor
_TURNS = 10.0  # of the slowest antenna; to look for a rate in more is too costly
_FOLLOWED, _ENOUGH = 3.0, 30  # turns of a known rotation, or so many plots, tell how it is now
_MOST, _BEYOND = 0.9, 1.3  # of the plots, as wrong times tell nothing; so far off are the others
_NEIGHBOURS = 12  # candidates to either side of one that are no different rate


def find_rate(time: Floats, azimuth: Floats, period: float, interval: float) -> float:
    """
    Return the rate [rad/s], anticlockwise positive, or 0 if none fits, or several do.

    Parameters
    ----------
    time, azimuth : (M,) arrays
        Of the plots, not all of one time [s, rad].
    period : float
        Of a turn, if it is known, else 0 [s].
    interval : float
        Between messages, if each is a full turn, else 0 [s].

    """
    if period:
        candidates = TURN / period * np.array([1.0, -1.0])
        fit, least = in_step(time, azimuth, candidates), IN_STEP
    else:
        step = TURN / np.ptp(time) / _STEPS
        rates = np.arange(TURN / PERIODS[1], TURN / PERIODS[0], step)
        candidates = np.concatenate([-rates[::-1], rates])
        fit, least = _plausible(candidates, in_step(time, azimuth, candidates), interval), _NEARLY
    best = int(np.argmax(fit))
    return float(candidates[best]) if fit[best] > least else 0.0


def worth_keeping(time: Floats, turn_time: float, period: float) -> Bools:
    """
    Return which plots at these times (M,) [s] tell of the rotation.

    Parameters
    ----------
    time : (M,) array
        [s].
    turn_time : float
        Of one turn, as far as it is known by now, else 0 [s]. Motors and wind let an antenna be
        faster and slower: a line through a minute of plots is soon degrees from where it should
        be, so only the last turns tell how it turns now.
    period : float
        Of a turn, if the parameters tell it, else 0 [s].

    """
    latest = float(time.max(initial=-np.inf))
    if not turn_time:
        return np.asarray(latest - time < _TURNS * max(period, PERIODS[1]))
    newest = np.sort(time)[::-1][:_ENOUGH]
    return np.asarray(time >= newest.min(initial=latest - _FOLLOWED * turn_time))


def refine_rate(time: Floats, azimuth: Floats, rate: float) -> float:
    """
    Return the rate near this one that fits the plots best, 0 when they are not on the beam.

    Parameters
    ----------
    time, azimuth : (M > 0,) arrays
        Of the plots [s]; sensor axes [rad].
    rate : float
        About that of the antenna, anticlockwise positive [rad/s].

    """
    t = time - time.mean()
    square = float(t @ t)
    for _ in range(3):
        beam = azimuth - rate * t
        sine, cosine = np.sin(beam).sum(), np.cos(beam).sum()
        step = float(t @ wrap_angle(beam - np.arctan2(sine, cosine))) / square
        rate += step
        if abs(step) < _STILL * abs(rate):
            break
    return 0.0 if np.hypot(sine, cosine) < IN_STEP * len(t) else rate


def unevenness(time: Floats, azimuth: Floats, rate: float) -> float:
    """Return how far nearly all plots (M > 0,) are at most from where the antenna points [rad]."""
    beam = azimuth - rate * (time - time.mean())
    off = np.abs(wrap_angle(beam - np.arctan2(np.sin(beam).sum(), np.cos(beam).sum())))
    last = int(_MOST * (len(off) - 1))
    return _BEYOND * float(np.partition(off, last)[last])


def in_step(time: Floats, azimuth: Floats, rates: Floats) -> Floats:
    """Return the mean resultant length (R,) of azimuths (M,) [rad] minus antenna at each rate."""
    middle, parts = time - time.mean(), len(rates) * len(time) // _AT_ONCE + 1
    return np.concatenate(
        [_resultant(azimuth - part[:, None] * middle) for part in np.array_split(rates, parts)]
    )


def _resultant(angle: Floats) -> Floats:
    """Return the mean resultant length (R,) of angles (R, M)."""
    return np.asarray(np.hypot(np.cos(angle).mean(axis=1), np.sin(angle).mean(axis=1)))


def _plausible(rates: Floats, fit: Floats, interval: float) -> Floats:
    """
    Return how well the rates fit, 0 for all if quite different ones fit as well.

    Two contacts at rest fit many: turns may lie between them, either way round. If messages are
    full turns, the rate of the messages is tried first.
    """
    turns = np.abs(rates) * interval / TURN
    usual = np.where(np.abs(turns - 1.0) < _USUAL, fit, 0.0)
    if usual.max() > fit.max() - _RIVAL:
        fit = usual
    best = int(np.argmax(fit))
    apart = np.abs(np.arange(len(rates)) - best) > _NEIGHBOURS
    is_sure = fit[apart].max(initial=0.0) < fit[best] - _RIVAL
    return fit if is_sure else np.zeros_like(fit)
