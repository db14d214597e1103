# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When the antenna points at each contact, and where the contact truly is at that moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

import numpy as np

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.linalg import wrap_angle
from tracking_tools.scenarios.radar import SimulatedRadar
from tracking_tools.scenarios.trajectory import Trajectory

# Samples in a turn between which a contact's azimuth is followed.
_SAMPLES = 8
_NEWTON_STEPS = 8
# A contact right above the antenna has no azimuth to solve for: it is not seen there [rad].
_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Contact:
    """Something that flies or floats between two times [s]."""

    id: int
    trajectory: Trajectory
    appear: float = 0.0
    disappear: float = math.inf


@dataclass(frozen=True)
class TrueStates:
    """True states of contacts, in order of time."""

    id: Ints  # (P,)
    time: Floats  # (P,) [s]
    position: Floats  # (P, 3) east, north, up [m]
    velocity: Floats  # (P, 3) [m/s]

    def __len__(self) -> int:
        return len(self.id)

    def rows(self, which: slice | Bools | Ints) -> TrueStates:
        """Select some of them."""
        return TrueStates(
            self.id[which], self.time[which], self.position[which], self.velocity[which]
        )

    @staticmethod
    def joined(parts: Sequence[TrueStates]) -> TrueStates:
        """One after the other; none make an empty one."""
        nothing = TrueStates(np.zeros(0, int), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)))
        names = ('id', 'time', 'position', 'velocity')
        return TrueStates(
            *(np.concatenate([getattr(part, n) for part in (*parts, nothing)]) for n in names)
        )

    def columns(self) -> dict[str, Floats | Ints]:
        """Return them as the columns of a ``truth`` table; ``time`` [s of the scenario]."""
        names = ('x', 'y', 'z', 'vx', 'vy', 'vz')
        values = np.concatenate([self.position, self.velocity], axis=1).T
        return {'id': self.id, **dict(zip(names, values, strict=True)), 'time': self.time}


def find_passes(
    radar: SimulatedRadar, contacts: tuple[Contact, ...], duration: float
) -> TrueStates:
    """
    Return the state of every contact each time the antenna passes it, detected or not.

    Parameters
    ----------
    radar : SimulatedRadar
        What sees them.
    contacts : tuple of Contact
        What is there.
    duration : float
        The radar runs from 0 to this [s].

    Returns
    -------
    TrueStates
        Contacts outside the radar's limits are left out.

    """
    every = TrueStates.joined([_passes_of(radar, contact, duration) for contact in contacts])
    in_order = every.rows(np.lexsort((every.id, every.time)))
    return in_order.rows(radar.covers(place(radar, in_order)))


def place(radar: SimulatedRadar, truth: TrueStates) -> dict[str, Floats]:
    """
    Where the radar has these contacts, without noise.

    Returns
    -------
    dict
        ``range`` [m], ``azimuth``, ``elevation`` [rad] and ``range_rate`` [m/s], each (P,).

    """
    origin, drift = radar.platform.at(truth.time)
    line, closing = truth.position - origin, truth.velocity - drift
    if radar.elevation_sd is None:
        line, closing = line * [1.0, 1.0, 0.0], closing * [1.0, 1.0, 0.0]
    distance: Floats = np.maximum(np.sqrt(np.sum(line * line, axis=-1)), 1e-3)
    x, y, z = np.ascontiguousarray(line.T)  # see _azimuth
    return {
        'range': distance,
        'azimuth': np.arctan2(y, x),
        'elevation': np.arcsin(z / distance),
        'range_rate': np.sum(line * closing, axis=-1) / distance,
    }


def _passes_of(radar: SimulatedRadar, contact: Contact, duration: float) -> TrueStates:
    first, last = max(contact.appear, 0.0), min(contact.disappear, duration)
    if radar.is_staring:
        looks: Floats = radar.period * np.arange(radar.turns(duration), dtype=np.float64)
        time = looks[(first <= looks) & (looks < last)]
    else:
        time = _pass_times(radar, contact.trajectory, first, last)
    position, velocity = contact.trajectory.at(time)
    return TrueStates(np.full(len(time), contact.id), time, position, velocity)


def _pass_times(
    radar: SimulatedRadar, trajectory: Trajectory, first: float, last: float
) -> Floats:
    """
    Solve antenna_azimuth(t) = azimuth(t) for every turn in first <= t < last.

    The lead of the antenna over the contact grows by 2 pi each turn; where it reaches a multiple
    of 2 pi is found between samples, then to rounding by Newton's method.
    """
    step = radar.period / _SAMPLES
    if last <= first:
        return np.zeros(0)
    samples = np.arange(first - step, last + 2.0 * step, step)
    sense = math.copysign(1.0, radar.antenna_rate)
    azimuth, _ = _azimuth(radar, trajectory, samples)
    ahead = sense * (radar.azimuth_start + radar.antenna_rate * samples - np.unwrap(azimuth))
    ahead = np.maximum.accumulate(ahead)
    turns = np.arange(math.ceil(ahead[0] / (2 * np.pi)), math.floor(ahead[-1] / (2 * np.pi)) + 1)
    guess = np.interp(2 * np.pi * turns, ahead, samples)
    time = guess.copy()
    for _ in range(_NEWTON_STEPS):
        azimuth, rate = _azimuth(radar, trajectory, time)
        error = wrap_angle(radar.antenna_azimuth(time) - azimuth)
        time = np.clip(time - error / (radar.antenna_rate - rate), guess - step, guess + step)
    azimuth, _ = _azimuth(radar, trajectory, time)
    solved = np.abs(wrap_angle(radar.antenna_azimuth(time) - azimuth)) < _TOLERANCE
    seen: Floats = time[solved & (first <= time) & (time < last)]
    return seen


def _azimuth(radar: SimulatedRadar, trajectory: Trajectory, time: Floats) -> tuple[Floats, Floats]:
    """
    Azimuth [rad] and its rate [rad/s] as seen from the platform, each (P,).

    On contiguous columns: numpy 1.26 rounds arctan2 of strided ones as their addresses have it.
    """
    position, velocity = trajectory.at(time)
    origin, drift = radar.platform.at(time)
    x, y, _ = np.ascontiguousarray((position - origin).T)
    vx, vy, _ = np.ascontiguousarray((velocity - drift).T)
    squared = np.maximum(x * x + y * y, 1e-6)
    return np.arctan2(y, x), (x * vy - y * vx) / squared
