# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts that come and go for as long as one likes, and what a rotating radar sees of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tracking_core.batches import Floats
from tracking_tools.scenarios.messages import as_table

REACH = 40e3  # m from the radar: contacts begin and false plots lie within
SPEEDS = (50.0, 250.0)  # m/s
TURN = 0.02  # rad/s at most; every second contact goes straight
DETECTED = 0.95
RANGE_SD, AZIMUTH_SD = 30.0, 0.002  # m, rad
SWELL = 2400.0  # s, from busy to quiet and back
CROWDED, CIRCLE, LAP = 300e3, 2000.0, 0.04  # m, m, rad/s: a crowd of holding patterns


@dataclass(frozen=True)
class Traffic:
    """All contacts of a long time, each on a circle or straight."""

    begin: Floats  # (K,) [s]
    end: Floats  # (K,) [s]
    start: Floats  # (K,) complex position at the begin [m]
    velocity: Floats  # (K,) complex, the same [m/s]
    turn: Floats  # (K,) [rad/s]

    @staticmethod
    def of(duration: float, alive: float, stay: float, rng: np.random.Generator) -> Traffic:
        """Return so many contacts alive at a time, each for `stay` [s] on average."""
        K = rng.poisson(alive * (duration + 3.0 * stay) / stay)
        begin = rng.uniform(-3.0 * stay, duration, K)
        begin += 0.15 * SWELL * np.sin(2.0 * np.pi * begin / SWELL)  # they come in crowds
        start = REACH * np.sqrt(rng.uniform(0.01, 1.0, K)) * np.exp(2j * np.pi * rng.random(K))
        velocity = rng.uniform(*SPEEDS, K) * np.exp(2j * np.pi * rng.random(K))
        turn = np.where(rng.random(K) < 0.5, 0.0, rng.uniform(-TURN, TURN, K))
        return Traffic(begin, begin + rng.exponential(stay, K), start, velocity, turn)

    def at(self, time: float) -> Floats:
        """Return the complex positions (A,) of those that are there [m]."""
        here = (self.begin <= time) & (time < self.end)
        since = time - self.begin[here]
        angle = 0.5j * self.turn[here] * since
        chord = np.exp(angle) * np.sinc(angle.imag / np.pi)
        return np.asarray(self.start[here] + self.velocity[here] * since * chord)


def circling(count: int) -> Callable[[float], Floats]:
    """Return where so many contacts are at a time: each circles about a place of its own."""
    place = np.arange(count) + 0.5
    golden = np.pi * (3.0 - np.sqrt(5.0))  # a sunflower: everywhere as far apart
    middle = CROWDED * np.sqrt(0.01 + 0.99 * place / count) * np.exp(1j * golden * place)
    return lambda time: middle + CIRCLE * np.exp(1j * (golden**2 * place + time * LAP))


def see(
    positions: Floats, clutter: float, stamp: float, period: float, rng: np.random.Generator
) -> dict[str, Floats]:
    """Return the plots of one turn in order of time, as columns of a message."""
    seen = positions[rng.random(len(positions)) < DETECTED]
    false = rng.poisson(clutter)
    distance = np.abs(seen) + rng.normal(0.0, RANGE_SD, len(seen))
    azimuth = np.angle(seen) + rng.normal(0.0, AZIMUTH_SD, len(seen))
    distance = np.concatenate([distance, rng.uniform(0.02, 1.0, false) * REACH])
    azimuth = np.concatenate([azimuth, rng.uniform(0.0, 2.0 * np.pi, false)]) % (2.0 * np.pi)
    order = np.argsort(azimuth)
    time = stamp + azimuth[order] / (2.0 * np.pi) * period
    return as_table(
        {'range': np.abs(distance[order]), 'azimuth': azimuth[order], 'time': time}, stamp
    )
