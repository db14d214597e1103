# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a radar sees for some minutes, and what was there: scenes, their plots and their truth."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tracking_core.batches import Bools, Floats, Plots
from tracking_core.platform import Platform
from tracking_tools.scenarios.legs import Legs
from tracking_tools.scenarios.passes import Contact, find_passes, TrueStates
from tracking_tools.scenarios.radar import SimulatedRadar
from tracking_tools.scoring import Truth

Rng = np.random.Generator
Range = tuple[int, int | None]  # first and last, exclusive
ALL = (0, None)


@dataclass(frozen=True)
class Part:
    """Some of the looks, of the contacts and of the places."""

    name: str = ''
    looks: Range = ALL
    contacts: Range = ALL
    inside: Callable[[Floats], Bools] | None = None  # of positions (N, d); None: everywhere

    def has(self, position: Floats) -> Bools:
        """Return which places (N, d) belong to it."""
        return np.ones(len(position), bool) if self.inside is None else self.inside(position)


@dataclass(frozen=True)
class Scene:
    """Messages of plots, and what is known about them."""

    values: Mapping[str, Any]  # parameters of the tracker
    messages: Sequence[Plots]  # K looks
    truth: Truth  # of contacts 0 to C - 1
    there: Bools  # (K, C) whether the radar can see it
    radius: float  # farther off, a track follows somebody else [m]
    platform: Platform | None = None
    slowest: float = 0.0  # slower tracks are of what stands, and nobody's concern [m/s]
    parts: tuple[Part, ...] = (Part(),)


def antenna(period: float, farthest: float, sd: Floats) -> SimulatedRadar:
    """Return one that turns anticlockwise from east; `sd` as the columns of `turns_of`."""
    return SimulatedRadar(
        period, *sd.tolist(), range_limits=(0.0, farthest), rotation='anticlockwise',
        azimuth_start=0.0,
    )  # fmt: skip


def passes(radar: SimulatedRadar, paths: Sequence[Legs], turns: int) -> TrueStates:
    """Return where the contacts were when the antenna passed them."""
    contacts = tuple(Contact(k, path) for k, path in enumerate(paths))
    return find_passes(radar, contacts, turns * radar.period)


def truth_of(states: TrueStates, dimensions: int) -> Truth:
    """Return the same as truth for scoring."""
    d = dimensions
    return Truth.of(states.id, states.time, states.position[:, :d], states.velocity[:, :d])


def there_of(states: TrueStates, period: float, turns: int, contacts: int) -> Bools:
    """Return in which turns (K, C) each contact was passed."""
    there = np.zeros((turns, contacts), bool)
    there[np.minimum((states.time / period).astype(int), turns - 1), states.id] = True
    return there


def turns_of(place: Floats, time: Floats, period: float, turns: int) -> list[Plots]:
    """
    Return a message for each turn.

    Parameters
    ----------
    place : (M, 2) or (M, 3) array
        Range [m], azimuth and, of a 3-D radar, elevation [rad]; NaN: not measured.
    time : (M,) array
        [s].
    period : float
        Of a turn [s].
    turns : int
        How many.

    """
    order = np.argsort(time, kind='stable')
    place, time = place[order], time[order]
    cuts = np.searchsorted(time, period * np.arange(turns + 1))
    messages = []
    for k in range(turns):
        mine = slice(cuts[k], cuts[k + 1])
        height = {'elevation': place[mine, 2]} if place.shape[1] == 3 else {}
        plots = Plots.polar(time[mine], place[mine, 0], place[mine, 1], **height)
        messages.append(replace(plots, stamp=k * period))
    return messages


def times_of(azimuth: Floats, turn: Floats, period: float) -> Floats:
    """Return when [s] the antenna points there [rad] in the turns with these numbers."""
    return np.asarray(period * (turn + np.mod(azimuth, 2.0 * np.pi) / (2.0 * np.pi)))
