# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a radar, turning or staring, see of contacts? The scene with its truth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from benchmarks.simulated_scene import Rng, Scene, truth_of
from tracking_core.batches import Floats, Plots
from tracking_tools.scenarios.legs import Legs
from tracking_tools.scenarios.passes import Contact, find_passes, place, TrueStates
from tracking_tools.scenarios.radar import SimulatedRadar

_ROUNDING = 1e-9  # s
# From the passes, where plots may come from (N rows) and the chance (N,) of each.
Echoes = Callable[[TrueStates], tuple[TrueStates, Floats]]


def watched(
    rng: Rng, radar: SimulatedRadar, paths: Sequence[Legs], looks: int, radius: float,
    echoes: Echoes | None = None,
) -> Scene:  # fmt: skip
    """
    Return what a radar sees of contacts, and its false plots.

    Parameters
    ----------
    rng : Generator
        Of all chance.
    radar : SimulatedRadar
        With its detection probability and the number of false plots.
    paths : sequence of Legs
        Of the contacts.
    looks : int
        How many.
    radius : float
        Farther off, a track follows somebody else [m].
    echoes : callable, optional
        Where plots come from; without it from where the contacts are, with the detection
        probability.

    """
    contacts = tuple(Contact(k, path) for k, path in enumerate(paths))
    states = find_passes(radar, contacts, looks * radar.period)
    shine, chance = states, np.full(len(states), radar.detection_probability)
    if echoes is not None:
        shine, chance = echoes(states)
    columns = _plots(rng, radar, shine.rows(rng.random(len(shine)) < chance), looks)
    cuts = np.searchsorted(columns['time'] + _ROUNDING, radar.period * np.arange(looks + 1))
    messages = [
        _message(radar, {name: values[cuts[k] : cuts[k + 1]] for name, values in columns.items()},
                 k * radar.period)
        for k in range(looks)
    ]  # fmt: skip
    there = np.zeros((looks, len(paths)), bool)
    look = ((states.time + _ROUNDING) / radar.period).astype(int)
    there[np.minimum(look, looks - 1), states.id] = True
    dimensions = 2 if radar.elevation_sd is None else 3
    return Scene({}, messages, truth_of(states, dimensions), there, radius)


def _plots(rng: Rng, radar: SimulatedRadar, shine: TrueStates, looks: int) -> dict[str, Floats]:
    """Return the columns (M,) of all plots with noise, and false ones, in order of time."""
    azimuth, width = radar.azimuth_coverage
    rate, far = radar.range_rate_limit, radar.range_limits[1]
    measured = {
        'range': (radar.range_sd, radar.range_limits),
        'azimuth': (radar.azimuth_sd, (azimuth, azimuth + width)),
        'elevation': (radar.elevation_sd, radar.elevation_limits),
        'range_rate': (radar.range_rate_sd, (-rate, rate)),
    }
    true, columns = place(radar, shine), {}
    number = rng.poisson(radar.clutter_per_turn, looks)
    for name, (sd, edges) in measured.items():
        if sd is not None:
            noisy = true[name] + sd * rng.standard_normal(len(shine))
            columns[name] = np.append(noisy, rng.uniform(*edges, number.sum()))
    into = radar.time_into_turn(columns['azimuth'][len(shine) :])
    false_time = radar.period * np.repeat(np.arange(looks), number) + into
    columns['time'] = np.append(shine.time, false_time)
    seen = np.flatnonzero((columns['range'] > 0.0) & (columns['range'] < far))
    order = seen[np.argsort(columns['time'][seen], kind='stable')]
    return {name: values[order] for name, values in columns.items()}


def _message(radar: SimulatedRadar, columns: dict[str, Floats], stamp: float) -> Plots:
    """Return one message: polar, or x and y of a radar that has a `position_sd`."""
    time, reach, azimuth = (columns.pop(name) for name in ('time', 'range', 'azimuth'))
    if not radar.position_sd:
        return replace(Plots.polar(time, reach, azimuth, **columns), stamp=stamp)
    where = reach * np.stack([np.cos(azimuth), np.sin(azimuth)])
    return replace(Plots.cartesian(time, where.T, **columns), stamp=stamp)
