# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
When did the antenna look at each track?

A message is not a look: where a message is cut, a contact can be in it twice or not at all. What
counts is the antenna, which passes every track once a turn. A track is *due* once the antenna has
left its gate behind, *open* while the gate is only partly swept, and otherwise not yet concerned.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Bools, Coverage, Floats
from tracking_core.linalg import TURN, wrap_angle

LARGEST_MARGIN = 1.0 / 8.0  # of a turn: a gate about the sensor itself is not waited for longer
_OFF = 1.0 / 16.0 * TURN  # by which the antenna is not where it was thought to be, at most [rad]
LONGEST_WAIT = 1.0 / 4.0  # of a turn: then a track no longer waits for open neighbours


@dataclass(frozen=True)
class Looks:
    """The next look at each track, (T,) arrays."""

    time: Floats  # when the antenna points at the track [s]
    near: Bools  # the look, or the margin before it, has begun


def next_looks(position: Floats, velocity: Floats, time: Floats, coverage: Coverage) -> Looks:
    """
    Find when the antenna passes each track for the first time after its last look.

    Parameters
    ----------
    position, velocity : (T, 2) arrays
        Horizontal state in the tracking frame [m, m/s].
    time : (T,) array
        Of the state, which is the last look [s].
    coverage : Coverage
        What the scan swept.

    """
    rate = coverage.rotation_rate
    if rate == 0.0:
        middle = 0.5 * (coverage.start_time + coverage.end_time)
        return Looks(np.full(len(time), middle), np.ones(len(time), bool))
    period = TURN / abs(rate)
    sensor = coverage.sensor_at(time)
    (x, y), (vx, vy) = (position - sensor[:, :2]).T, (velocity - sensor[:, 2:]).T

    def azimuth(lag: Floats) -> Floats:
        return np.asarray(np.arctan2(y + vy * lag, x + vx * lag))

    lag = coverage.end_time - time
    for _ in range(2):  # the contact moves while the antenna turns
        lag = coverage.end_time - _travel(azimuth(lag), coverage) / abs(rate) - time
    margin = LARGEST_MARGIN * period
    passed = _first_pass(lag, time, period, coverage)
    # A turn later the contact is elsewhere, by more than its gate if it is fast and near; and the
    # antenna is where its platform has swung it.
    for _ in range(2 if any(coverage.swing) else 1):
        antenna = coverage.azimuth_at(time + passed)
        passed = passed + wrap_angle(azimuth(passed) - antenna) / rate
    passed = time + np.maximum(passed, 0.5 * period)
    return Looks(passed, passed - margin < coverage.end_time)


def may_be_passed_again(
    position: Floats, velocity: Floats, time: Floats, size: Floats, coverage: Coverage
) -> Bools:
    """
    Return which tracks (T,) the antenna can have come back to: few, and cheaper than when.

    `position`, `velocity` and `time` as for `next_looks`; `size` (T,) [m] is what the next look
    may begin earlier, or the last one was off.
    """
    rate, sensor = abs(coverage.rotation_rate), coverage.sensor_at(time)
    (x, y), (vx, vy) = (position - sensor[:, :2]).T, (velocity - sensor[:, 2:]).T
    reach = np.hypot(vx, vy) * (TURN / rate) + size
    swung = np.pi * reach / np.maximum(np.hypot(x, y), 1.0)  # no less than the angle that it is
    ahead = swung + _OFF + coverage.unevenness + max(map(abs, coverage.swing))
    return np.asarray(time + np.maximum(TURN - ahead, 0.0) / rate <= coverage.end_time)


def _first_pass(lag: Floats, time: Floats, period: float, coverage: Coverage) -> Floats:
    """Return when after `time` (T,) the antenna passes first [s], if in turns from `lag` (T,)."""

    def after(earliest: Floats) -> Floats:
        return np.asarray(lag + np.ceil((earliest - lag) / period - 1e-9) * period)

    # A pass may have waited for its neighbours; longer ago than that it was lost.
    since = coverage.start_time - (LONGEST_WAIT + LARGEST_MARGIN) * period
    recent = []
    for begin, end in coverage.gaps[::-1]:
        if end > since:
            since -= end - begin
            recent.append((begin, end))
    passed = after(np.maximum(0.5 * period, since - time))
    for begin, end in recent[::-1]:
        in_gap = (time + passed > begin) & (time + passed < end)
        passed = np.where(in_gap, after(end - time), passed)
    return passed


def _travel(azimuth: Floats, coverage: Coverage) -> Floats:
    """Return the angle in [0, 2 pi) that the antenna has turned since it pointed there."""
    end = coverage.start_azimuth + coverage.sweep
    ahead = end - azimuth if coverage.sweep > 0.0 else azimuth - end
    return np.asarray(ahead % TURN)


def looks_since(time: Floats, position: Floats, interval: float, coverage: Coverage) -> Floats:
    """
    Return how many looks ago plots (S,) were made, where this scan looked again; 0: elsewhere.

    `time` (S,) [s] and `position` (S, d) [m] are the plots', `interval` [s] is from look to look.
    """
    end, rate = coverage.end_time, coverage.rotation_rate
    if rate == 0.0:
        return np.maximum(np.rint((end - time) / interval), 1.0)
    x, y = (position[:, :2] - coverage.sensor_position[:2]).T
    travelled = _travel(np.arctan2(y, x), coverage)
    looks = np.maximum(np.rint((end - travelled / abs(rate) - time) / interval), 1.0)
    return np.where(travelled <= abs(coverage.sweep), looks, 0.0)


def longest_since(time: Floats, latest: float, coverage: Coverage) -> Floats:
    """
    Return how much later than these (S,) plots at the same place can be, in this scan (S,) [s].

    A rotating antenna comes back after whole turns. The margin is for contacts that move: of those
    that pass the antenna so near that their azimuth changes by more in a turn, a part of the
    pairs is not seen until they are farther away.

    Parameters
    ----------
    time : (S,) array
        Of earlier plots [s].
    latest : float
        Time of the last plot of the scan [s].
    coverage : Coverage
        What the scan swept.

    """
    longest = np.maximum(latest - time, 0.0)
    if coverage.rotation_rate == 0.0:
        return np.asarray(longest)
    period = TURN / abs(coverage.rotation_rate)
    turns = np.floor(longest / period + LARGEST_MARGIN)
    return np.minimum(longest, (turns + LARGEST_MARGIN) * period)


def margins(position: Floats, half_size: Floats, coverage: Coverage) -> Floats:
    """
    Return how long the antenna needs at most from a track's middle to its gate's edge (T,) [s].

    Parameters
    ----------
    position : (T, 2) or (T, 3) array
        Predicted [m].
    half_size : (T,) array
        Largest half size of the gate [m].
    coverage : Coverage
        What the scan swept.

    """
    rate = abs(coverage.rotation_rate)
    if rate == 0.0:
        return np.zeros(len(position))
    offset = position - np.array(coverage.sensor_position[: position.shape[1]])
    distance = np.hypot(offset[:, 0], offset[:, 1])
    angle = np.arctan2(half_size, distance) + coverage.unevenness
    if position.shape[1] == 3:  # one that leans passes what is high before its time, or after it
        angle += coverage.tilt * np.abs(offset[:, 2]) / np.maximum(distance, 1.0)
    return np.asarray(np.minimum(angle, LARGEST_MARGIN * TURN) / rate)


def inside_coverage(position: Floats, coverage: Coverage) -> Bools:
    """Return for positions (T, 2) or (T, 3), or bearings (T, 1), whether the sensor sees there."""
    if position.shape[1] == 1:
        return _in_sector(position[:, 0], coverage)
    offset = position - np.array(coverage.sensor_position[: position.shape[1]])
    distance = np.sqrt(np.einsum('td,td->t', offset, offset))
    within = (distance >= coverage.range_min) & (distance <= coverage.range_max)
    if coverage.sector_width >= TURN:
        return np.asarray(within)
    angle = np.arctan2(offset[:, 1], offset[:, 0])
    return np.asarray(within & _in_sector(angle, coverage))


def _in_sector(angle: Floats, coverage: Coverage) -> Bools:
    off_centre = np.abs(wrap_angle(angle - coverage.sector_centre))
    return np.asarray(off_centre <= 0.5 * coverage.sector_width + 1e-12)
