# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which marks does the array of [VORONINA19] give of two contacts that cross? Scenario V-0."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from tracking_core.batches import Bearings, Floats
from tracking_core.platform import Platform
from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.listening import Watch
from tracking_tools.scenarios.passes import Contact
from tracking_tools.scenarios.watches import v0

DEGREE = np.pi / 180.0


TURNS = {'away': -0.5 * DEGREE, 'towards': 0.5 * DEGREE}  # of the weaker contact [rad/s]
TURN = (1250.0, 40.0)  # start and duration, while both are one mark [s]
LATE = 2450.0  # end of the scene in which they stay one mark for longer [s]


@lru_cache(maxsize=8)
def scene(name: str) -> Watch:
    """Return the scene: 'nominal', 'fluct', or the weaker turns while merged: see `TURNS`."""
    nominal = v0()
    if name == 'fluct':
        array = replace(nominal.array, height=39.0, fluctuation=4.0)
        return replace(nominal, array=array, levels=(0.0, -2.0))
    if name in TURNS:
        weaker = nominal.contacts[1].trajectory
        if not isinstance(weaker, Legs):
            raise TypeError('the contacts of v0 must be on legs')
        path = replace(weaker, legs=(Leg(TURN[0]), Leg(TURN[1], turn_rate=TURNS[name])))
        end = LATE if name == 'towards' else nominal.duration
        return replace(nominal, contacts=(nominal.contacts[0], Contact(2, path)), duration=end)
    return nominal


@lru_cache(maxsize=8)
def truth(name: str) -> tuple[Floats, Floats, Platform]:
    """Return time (K,), true bearings (K, C) in tracking axes, and own ship."""
    watch = scene(name)
    time = watch.times
    own, velocity = watch.own.at(time)
    paths = np.stack([contact.trajectory.at(time)[0] for contact in watch.contacts], axis=1)
    line = paths - own[:, None]
    yaw = 0.5 * np.arctan2(velocity[:, 1], velocity[:, 0])
    zero = np.zeros_like(time)
    platform = Platform(
        time, own, np.stack([zero, zero, np.sin(yaw), np.cos(yaw)], axis=1), velocity,
        np.zeros((len(time), 3, 3)), zero, capacity=len(time) + 1,
    )  # fmt: skip
    return time, np.arctan2(line[..., 1], line[..., 0]), platform


def marks(name: str, seed: int, end: float, mark_sd: float = 0.0) -> list[Bearings]:
    """Return the marks of each cycle until `end` [s]; `mark_sd` above 0 replaces the array's."""
    watch, rng = scene(name), np.random.default_rng(seed)
    time, distance, lobes = _sound(name)
    used = time < end
    height = watch.array.heights(distance[used], np.array(watch.levels), rng)
    cycle, found, snr = watch.array.marks(watch.array.listen(lobes[:, used], height, rng))
    sd = watch.array.reported_sd(found, snr)
    sd = np.full_like(sd, mark_sd) if mark_sd > 0.0 else sd
    ends = np.searchsorted(cycle, np.arange(int(used.sum()) + 1))
    return [
        Bearings(
            np.full(last - first, now), watch.array.side * found[first:last], sd[first:last],
            10.0 * np.log10(snr[first:last]), float(now),
        )
        for now, first, last in zip(time[used], ends[:-1], ends[1:], strict=True)
    ]  # fmt: skip


@lru_cache(maxsize=8)
def _sound(name: str) -> tuple[Floats, Floats, Floats]:
    """Return time (K,), distances (K, C) and lobes (C, K, B): the same in every run."""
    watch = scene(name)
    time, bearing, platform = truth(name)
    own, _ = watch.own.at(time)
    far = np.stack([c.trajectory.at(time)[0] for c in watch.contacts], axis=1) - own[:, None]
    angle = watch.array.from_axis(bearing - platform.at(time).yaw[:, None])
    return time, np.hypot(far[..., 0], far[..., 1]), watch.array.lobes(angle)
