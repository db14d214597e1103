# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is seen, what is true of it, and what every tracker is told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tracking_core.batches import Bools, Floats
from tracking_core.motion import Motion
from tracking_tools.scenarios import Contact
from tracking_tools.scoring import Stretches, Truth


@dataclass(frozen=True)
class Knowledge:
    """What is known before the first scan; every tracker gets the same."""

    period: float  # from scan to scan [s]
    noise: float  # sd of the plots on each axis [m], bearings [rad]
    detection_probability: float
    clutter_density: float  # [1/m^2], bearings [1/rad]
    region: float  # radius of what is looked at [m], bearings [rad]
    modes: tuple[Motion, ...]  # for trackers with more than one
    sojourn: tuple[float, ...]  # in the modes [s]
    single: Motion  # for trackers with one model
    speed_sd: float  # of new contacts on each axis [m/s], bearings [rad/s]
    speed_max: float
    arrivals: float  # of new contacts [1/h]
    cutoff: float  # of GOSPA, and the match radius [m], bearings [rad]

    @property
    def axes(self) -> int:
        """How many coordinates a plot has."""
        return self.single.axes

    def transition(self) -> Floats:
        """Return F (n, n) from scan to scan; the state is (position, velocity) on each axis."""
        return self.single.transition(np.array([self.period]))[0]

    def process_noise(self, motion: Motion) -> Floats:
        """Return Q (n, n) from scan to scan."""
        return motion.process_noise(np.array([self.period]))[0]

    def measurement(self) -> Floats:
        """Return H (d, n)."""
        return np.kron(np.eye(self.axes), [[1.0, 0.0]])

    def mode_transition(self) -> Floats:
        """Return the chance (J, J) to go from mode i to mode j between two scans."""
        J = len(self.modes)
        leave = 1.0 - np.exp(-self.period / np.array(self.sojourn))
        return np.diag(1.0 - leave) + (np.ones((J, J)) - np.eye(J)) * leave[:, None] / (J - 1)


@dataclass(frozen=True)
class Scene:
    """A few minutes of plots."""

    name: str
    knowledge: Knowledge
    times: Floats  # (K,) [s]
    plots: tuple[Floats, ...]  # (M, d) in each scan
    truth: Truth
    stretches: Stretches  # of contacts, from their fourth plot to their last

    def first(self, scans: int) -> Scene:
        """Return the beginning of the scene."""
        return replace(self, times=self.times[:scans], plots=self.plots[:scans])

    @cached_property
    def contacts(self) -> float:
        """How many there are in a scan, in the mean."""
        return len(self.truth.id) / len(np.unique(self.truth.time))


def observe(
    name: str,
    knowledge: Knowledge,
    contacts: Sequence[Contact],
    scans: int,
    seed: int,
) -> Scene:
    """Return what a staring radar makes of contacts in a disc around it."""
    times = knowledge.period * np.arange(scans)
    states = [contact.trajectory.at(times) for contact in contacts]
    position, velocity = (np.array([s[k] for s in states])[..., :2] for k in (0, 1))
    inside = np.linalg.norm(position, axis=-1) < knowledge.region
    return measured(name, knowledge, position, velocity, inside, seed)


def measured(
    name: str, knowledge: Knowledge, position: Floats, velocity: Floats, inside: Bools, seed: int
) -> Scene:
    """
    Return the plots of what is true: noise, misses, and false plots evenly over the region.

    Parameters
    ----------
    name : str
        Of the scene.
    knowledge : Knowledge
        True as well as told.
    position, velocity : (N, K, d) arrays
        Of N contacts in K scans.
    inside : (N, K) array
        Whether they are looked at.
    seed : int
        Of the random numbers.

    """
    rng = np.random.default_rng(seed)
    N, K, d = position.shape
    times = knowledge.period * np.arange(K)
    found = inside & (rng.random((N, K)) < knowledge.detection_probability)
    noisy = position + knowledge.noise * rng.standard_normal(position.shape)
    plots = tuple(
        rng.permutation(np.concatenate([noisy[found[:, k], k], _clutter(knowledge, d, rng)]))
        for k in range(K)
    )
    who, when = np.nonzero(inside)
    truth = Truth.of(who + 1, times[when], position[who, when], velocity[who, when])
    contact, scan = np.nonzero(found)
    return Scene(name, knowledge, times, plots, truth, Stretches.of_plots(contact + 1, scan))


def _clutter(knowledge: Knowledge, d: int, rng: np.random.Generator) -> Floats:
    R = knowledge.region
    if d == 1:
        count = rng.poisson(knowledge.clutter_density * 2.0 * R)
        return rng.uniform(-R, R, (count, 1))
    count = rng.poisson(knowledge.clutter_density * np.pi * R**2)
    distance, angle = R * np.sqrt(rng.random(count)), rng.uniform(-np.pi, np.pi, count)
    return np.stack([distance * np.cos(angle), distance * np.sin(angle)], axis=1)
