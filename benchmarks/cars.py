# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Cars before a radar on a car: several plots each, range rates, guard rails, all in a bend."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.simulated_scene import Rng, Scene
from tracking_core.batches import Bools, Floats, Plots
from tracking_core.platform import Platform
from tracking_tools.scoring import Truth

PERIOD, LOOKS = 1.0 / 15.0, 300  # [s]
FARTHEST, HALF_SECTOR, BEND, SPEED = 100.0, np.radians(60.0), 0.005, 15.0  # [m], [1/m], [m/s]
SD = np.array([0.15, 0.01, 0.1])  # of range [m], azimuth [rad], range rate [m/s]
FALSE_PLOTS, RATE_LIMIT = 3, 40.0  # [m/s]
LANES = ((-3.5, 13.0), (0.0, 16.0), (3.5, 18.0), (11.0, -14.0), (14.5, -15.0))  # [m], [m/s]
RAILS, POLES = (-6.0, 7.3, 18.0), (-12.0, -9.0, 21.0, 25.0)  # to the left of own ship's lane [m]
CAR = np.array([
    [-2.2, -0.9], [-2.2, 0.9], [2.2, -0.9], [2.2, 0.9], [-2.2, 0.0], [2.2, 0.0],
    [-1.3, -0.9], [-1.3, 0.9], [1.3, -0.9], [1.3, 0.9],
])  # fmt: skip
# What shines on a car, ahead of its middle and to its left [m], and which way each faces.
FACES = np.array([
    [-1, -1], [-1, 1], [1, -1], [1, 1], [-1, 0], [1, 0], [0, -1], [0, 1], [0, -1], [0, 1]
])  # fmt: skip
VALUES: dict[str, Any] = {
    'scan.assembly': 'snapshot', 'sensor.dimensions': 2, 'sensor.range_sd': 0.5,
    'sensor.azimuth_sd': 0.015, 'sensor.range_rate_sd': 0.3, 'sensor.range_rate_max': RATE_LIMIT,
    'sensor.range_max': FARTHEST, 'sensor.sector_width': 2.0 * HALF_SECTOR,
    'motion.horizontal.acceleration_sd': (4.0, 15.0),
    'motion.horizontal.sojourn_time': (10.0, 2.0), 'initiation.speed_max': 50.0,
    'existence.new_contacts': 3600.0, 'existence.lifetime': 10.0,
}  # fmt: skip


def cars(
    seed: int, several: bool = False, rails: bool = False, fold: float = 0.0, doppler: bool = True
) -> Scene:
    """
    Return 20 s of cars that come and go.

    Parameters
    ----------
    seed : int
        Of all chance.
    several : bool
        Whether a car gives one plot from each face that is seen, instead of one.
    rails : bool
        Guard rails and poles stand beside the road.
    fold : float
        Range rates are told within plus or minus so much [m/s]; 0: as they are.
    doppler : bool
        Whether there are range rates.

    """
    rng = np.random.default_rng(seed)
    start = _traffic(rng)
    standing = _standing(rng) if rails else np.zeros((0, 3))
    messages, platforms, there, truth = [], Platform.empty(), [], []
    for look in range(LOOKS):
        time = look * PERIOD
        own = _on_road(np.array([[SPEED * time, 0.0]]), np.array([SPEED]))[0]
        road = np.column_stack([start[:, 0] + start[:, 2] * time, start[:, 1]])
        state = _on_road(road, start[:, 2])
        shine = _shine(rng, state, own, BEND * road[:, 0], several)
        still = standing[rng.random(len(standing)) < standing[:, 2], :2]
        still = still + rng.normal(0.0, 0.3, still.shape)
        shine = np.concatenate([shine, np.column_stack([still, np.zeros_like(still)])])
        heading = BEND * SPEED * time
        polar = _measured(rng, shine, own, heading)
        if fold:
            polar[:, 2] = (polar[:, 2] + fold) % (2.0 * fold) - fold
        rate = {'range_rate': polar[:, 2]} if doppler else {}
        plots = Plots.polar(np.full(len(polar), time), polar[:, 0], polar[:, 1], **rate)
        messages.append(replace(plots, stamp=time))
        platforms = platforms.add(_platform(time, own, heading))
        there.append(_is_visible(state, own, heading))
        truth.append(state)
    C = len(start)
    flat = np.concatenate(truth)
    ids, times = np.tile(np.arange(C), LOOKS), np.repeat(PERIOD * np.arange(LOOKS), C)
    return Scene(
        VALUES, messages, Truth.of(ids, times, flat[:, :2], flat[:, 2:]), np.array(there),
        radius=3.5, platform=platforms, slowest=4.0,
    )  # fmt: skip


def _traffic(rng: Rng) -> Floats:
    """Return along and beside the road [m] and speed [m/s] of all cars (C, 3)."""
    found = []
    for beside, speed in LANES:
        along = rng.uniform(0.0, 20.0) - (40.0 if speed > 0.0 else 0.0)
        while along < 160.0 + 2.0 * SPEED * LOOKS * PERIOD:
            along += 10.0 * (beside == 0.0 and along < 15.0)  # not upon own ship
            found.append((along, beside, speed))
            along += rng.uniform(20.0, 60.0)
    return np.array(found)


def _standing(rng: Rng) -> Floats:
    """Return where rails and poles shine (N, 2) [m], and the chance of a plot of each."""
    along = np.arange(-50.0, 500.0, 4.0)
    rails = np.column_stack([np.tile(along, len(RAILS)), np.repeat(RAILS, len(along))])
    poles = np.column_stack([rng.uniform(-50.0, 500.0, 60), rng.choice(POLES, 60)])
    road = np.concatenate([rails, poles])
    place = _on_road(road, np.zeros(len(road)))[:, :2]
    return np.column_stack([place, np.repeat([0.35, 0.6], [len(rails), len(poles)])])


def _on_road(road: Floats, speed: Floats) -> Floats:
    """Return position and velocity (N, 4) at places along and beside the bend."""
    radius, angle = 1.0 / BEND - road[:, 1], BEND * road[:, 0]
    speed = speed * (1.0 - BEND * road[:, 1])
    return np.column_stack([
        radius * np.sin(angle), 1.0 / BEND - radius * np.cos(angle),
        speed * np.cos(angle), speed * np.sin(angle),
    ])  # fmt: skip


def _seen_from(place: Floats, own: Floats, heading: float) -> tuple[Floats, Floats]:
    line = place - own[:2]
    azimuth = np.arctan2(line[:, 1], line[:, 0]) - heading
    return np.hypot(*line.T), (azimuth + np.pi) % (2.0 * np.pi) - np.pi


def _is_visible(state: Floats, own: Floats, heading: float) -> Bools:
    distance, azimuth = _seen_from(state[:, :2], own, heading)
    wide = np.abs(azimuth) < HALF_SECTOR - 0.04
    return np.asarray(wide & (distance > 3.0) & (distance < FARTHEST - 3.0))


def _shine(rng: Rng, state: Floats, own: Floats, course: Floats, several: bool) -> Floats:
    """Return where plots of the cars come from, with their velocities (M, 4)."""
    if not several:
        return state[rng.random(len(state)) < 0.9]
    cos, sin = np.cos(course), np.sin(course)
    turn = np.stack([np.stack([cos, sin], -1), np.stack([-sin, cos], -1)], axis=1)  # (C, 2, 2)
    points = state[:, None, :2] + CAR @ turn
    faces = ((FACES @ turn) * (own[:2] - points)).sum(axis=2) > 0.0  # (C, 10)
    distance = np.hypot(*(state[:, :2] - own[:2]).T)
    chance = np.clip(0.75 - 0.5 * distance / FARTHEST, 0.15, 0.7)
    hit = faces & (rng.random(faces.shape) < chance[:, None])
    lone = faces.any(axis=1) & ~hit.any(axis=1) & (rng.random(len(state)) < 0.7)
    hit[lone, faces[lone].argmax(axis=1)] = True
    car, face = np.nonzero(hit)
    return np.column_stack([points[car, face], state[car, 2:]])


def _measured(rng: Rng, shine: Floats, own: Floats, heading: float) -> Floats:
    """Return range, azimuth and range rate (M, 3) with noise and false plots."""
    distance, azimuth = _seen_from(shine[:, :2], own, heading)
    line = (shine[:, :2] - own[:2]) / distance[:, None]
    polar = np.column_stack([distance, azimuth, ((shine[:, 2:] - own[2:]) * line).sum(axis=1)])
    polar += SD * rng.standard_normal(polar.shape)
    edge = np.array([FARTHEST, HALF_SECTOR, RATE_LIMIT])
    false = rng.uniform([2.0, -edge[1], -edge[2]], edge, (rng.poisson(FALSE_PLOTS), 3))
    polar = np.concatenate([polar, false])
    inside = (polar[:, 0] > 1.0) & (polar[:, 0] < edge[0]) & (np.abs(polar[:, 1]) < edge[1])
    return polar[inside]


def _platform(time: float, own: Floats, heading: float) -> Platform:
    orientation = np.array([[0.0, 0.0, np.sin(0.5 * heading), np.cos(0.5 * heading)]])
    return Platform(
        np.array([time]), np.append(own[:2], 0.0)[None], orientation,
        np.append(own[2:], 0.0)[None], np.zeros((1, 3, 3)), np.zeros(1),
    )  # fmt: skip
