# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What arrays hear whose heading, sd or side is not as told, while own ship turns twice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.signal import lfilter

from benchmarks.sonar_recordings import DEGREE, Record
from tracking_core.batches import Bearings, Bools, Floats
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform

CYCLE, DURATION, STEP = 2.0, 2400.0, 0.25  # [s]
OWN_SPEED, TURN_RATE, TURNS = (
    4.0,
    1.0,
    ((600.0, 60.0), (1300.0, -60.0)),
)  # [m/s], [deg/s], [s, deg]
CONTACTS, RANGES, SPEEDS = 6, (3e3, 15e3), (2.0, 8.0)  # [m], [m/s]
LIMIT = 10.0 * DEGREE  # a linear array hears nothing nearer to its axis
DETECTED, FADED = 0.9, 0.05  # chance of a mark in a cycle
FADE_EVERY, FADE_LASTS = 300.0, (30.0, 120.0)  # [s]
LANE = (40.0 * DEGREE, 40.0 * DEGREE)  # where a lane of ships lies, and how wide
NEAR = 2.0 * DEGREE
Rng = np.random.Generator


@dataclass(frozen=True)
class Array:
    """A linear array, whose marks are counted to starboard, or an omnidirectional one."""

    linear: bool = True
    sd: float = 0.1  # at broadside [deg]
    false: float = 0.2  # marks in a cycle
    side: Literal['any', 'starboard', 'port'] = 'any'  # where the contacts are throughout
    both_sides: bool = False  # the tracker counts each mark on both: contacts are where they are
    heading_sd: float = 0.0  # [deg]
    heading_memory: float = 0.0  # over which it wanders [s]; 0: white
    heading_told: bool = False  # its variance is
    heading_late: float = 0.0  # [s]
    towed: float = 0.0  # own ship's heading is told, and the array comes round in so long [s]
    sd_told: float = 1.0  # times the true one
    turn: float = 0.0  # of each contact at a time of its own, to either side [deg]
    fades: bool = False
    lane: float = 0.0  # marks in a cycle of contacts that nobody can part


@dataclass(frozen=True)
class Heard:
    """A record, and which of its true rows (N,) can be heard at all."""

    record: Record
    audible: Bools


def listen(seed: int, array: Array) -> Heard:
    """Return forty minutes of marks."""
    rng = np.random.default_rng(seed)
    time = np.arange(-300.0, DURATION + 20.0, STEP)
    rate = np.zeros(len(time))
    for begin, angle in TURNS:
        now = (time >= begin) & (time < begin + abs(angle) / TURN_RATE)
        rate[now] = np.sign(angle) * TURN_RATE * DEGREE
    heading = rate.cumsum() * STEP
    course = np.stack([np.cos(heading), np.sin(heading)], axis=1)
    own = (OWN_SPEED * course * STEP).cumsum(axis=0)
    own -= own[np.searchsorted(time, 0.0)]
    cycles = np.arange(CYCLE, DURATION, CYCLE)
    at = np.searchsorted(time, cycles)
    axis = _axis(array, heading)[at]
    line = _contacts(rng, array, cycles, own[at], axis) - own[at][:, None]
    relative = wrap_angle(np.arctan2(line[..., 1], line[..., 0]) - axis[:, None])
    audible = np.abs(np.abs(relative) - np.pi / 2) < np.pi / 2 - LIMIT * array.linear
    marks = [
        _marks(rng, array, stamp, row[hit], toward)
        for stamp, row, hit, toward in zip(
            cycles, relative, _hits(rng, array, cycles, audible), axis, strict=True
        )
    ]
    if array.linear and not array.both_sides:
        relative = -np.abs(relative)  # where the array has it
    scan, contact = np.divmod(np.arange(relative.size), CONTACTS)
    record = Record(
        '', marks, _platform(rng, array, time, own, heading), scan, contact,
        wrap_angle(relative + axis[:, None]).ravel(),
        np.hypot(*line.transpose(2, 0, 1)).ravel(), NEAR, np.inf,
    )  # fmt: skip
    return Heard(record, audible.ravel())


def _axis(array: Array, heading: Floats) -> Floats:
    """Return where the array points (K,), every `STEP`: a towed one follows."""
    if not array.towed:
        return heading
    share = -np.expm1(-STEP / array.towed)
    return np.asarray(lfilter([share], [1.0, share - 1.0], heading))


def _contacts(rng: Rng, array: Array, time: Floats, own: Floats, heading: Floats) -> Floats:
    """Return places (K, C, 2) of contacts that go straight, on the side that is asked for."""
    found: list[Floats] = []
    while len(found) < CONTACTS:
        distance, speed = rng.uniform(*RANGES), rng.uniform(*SPEEDS)
        bearing, course = rng.uniform(-np.pi, np.pi, 2)
        way = speed * _way(rng, array, time, course)
        path = distance * np.array([np.cos(bearing), np.sin(bearing)]) + way
        line = path - own
        is_port = wrap_angle(np.arctan2(line[:, 1], line[:, 0]) - heading) > 0.0
        if array.side == 'any' or (is_port == (array.side == 'port')).all():
            found.append(path)
    return np.stack(found, axis=1)


def _way(rng: Rng, array: Array, time: Floats, course: float) -> Floats:
    """Return where a contact of 1 m/s gets to (K, 2)."""
    way = time[:, None] * np.array([np.cos(course), np.sin(course)])
    if array.turn:
        turned = course + array.turn * DEGREE * rng.choice([-1.0, 1.0])
        later = np.maximum(time - rng.uniform(0.2, 0.9) * DURATION, 0.0)[:, None]
        way += later * np.array([np.cos(turned) - np.cos(course), np.sin(turned) - np.sin(course)])
    return way


def _hits(rng: Rng, array: Array, time: Floats, audible: Bools) -> Bools:
    """Return which contacts (K, C) give a mark."""
    chance = np.full(audible.shape, DETECTED)
    for column in chance.T if array.fades else ():
        begin = rng.exponential(FADE_EVERY)
        while begin < DURATION:
            end = begin + rng.uniform(*FADE_LASTS)
            column[(time >= begin) & (time < end)] = FADED
            begin = end + rng.exponential(FADE_EVERY)
    return np.asarray(audible & (rng.random(audible.shape) < chance))


def _marks(rng: Rng, array: Array, stamp: float, relative: Floats, axis: float) -> Bearings:
    """Return the marks of a cycle: of contacts at these bearings, and of nobody."""
    false, lane = rng.poisson(array.false), rng.poisson(array.lane)
    stray = rng.uniform(-np.pi, np.pi, false)
    if array.linear:  # even in the cosine, as the beams are
        edge = np.cos(LIMIT)
        stray = np.arccos(rng.uniform(-edge, edge, false)) * rng.choice([-1.0, 1.0], false)
    ships = LANE[0] + LANE[1] * rng.uniform(-0.5, 0.5, lane) - axis
    sds = [_sd(array, angle) for angle in (relative, stray, ships)]
    noisy = relative + sds[0] * rng.standard_normal(len(relative))
    bearing = wrap_angle(np.concatenate([noisy, stray, ships]))
    if array.linear:
        bearing = -np.abs(bearing)
    order = rng.permutation(len(bearing))
    sd = array.sd_told * np.concatenate(sds)
    nothing = np.full(len(bearing), np.nan)
    return Bearings(np.full(len(bearing), stamp), bearing[order], sd[order], nothing, stamp)


def _sd(array: Array, relative: Floats) -> Floats:
    blur = np.maximum(np.abs(np.sin(relative)), 0.05) if array.linear else 1.0
    return np.full(len(relative), array.sd * DEGREE) / blur


def _platform(rng: Rng, array: Array, time: Floats, own: Floats, heading: Floats) -> Platform:
    """Return own ship as it is told, once a second."""
    stamp = np.arange(-5.0, DURATION + 10.0)
    at = np.searchsorted(time, stamp - array.heading_late)
    kept = np.exp(-1.0 / array.heading_memory) if array.heading_memory else 0.0
    error = rng.standard_normal(len(stamp))
    for k in range(1, len(error)):
        error[k] = kept * error[k - 1] + np.sqrt(1.0 - kept**2) * error[k]
    told = heading[at] + array.heading_sd * DEGREE * error
    flat, course = np.zeros((len(stamp), 1)), np.stack([np.cos(told), np.sin(told)], axis=1)
    turn = np.column_stack([flat, flat, np.sin(0.5 * told), np.cos(0.5 * told)])
    variance = (array.heading_sd * DEGREE) ** 2 if array.heading_told else 0.0
    return Platform(
        stamp, np.column_stack([own[at], flat]), turn,
        np.column_stack([OWN_SPEED * course, flat]), np.zeros((len(stamp), 3, 3)),
        np.full(len(stamp), variance), capacity=len(stamp) + 1,
    )  # fmt: skip
