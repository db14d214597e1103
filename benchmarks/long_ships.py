# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ships so long that they give a marine radar several plots each, boats, and their echoes."""

from __future__ import annotations

from typing import Literal

import numpy as np

from benchmarks.real_data import PROJECT
from benchmarks.simulated_scene import (
    antenna,
    Part,
    passes,
    Rng,
    Scene,
    there_of,
    times_of,
    truth_of,
    turns_of,
)
from tracking_core.batches import Floats
from tracking_tools.parameter_file import read_parameter_file
from tracking_tools.scenarios.legs import Legs

TURN_TIME, TURNS, FARTHEST = 2.5, 240, 12e3  # [s], [m]
SHIPS, BOATS, FALSE_PLOTS = 6, 6, 20
CELL = np.array([30.0, 0.0175])  # what the radar resolves, in range [m] and azimuth [rad]
SD, ROLL = np.array([8.0, 0.003]), 0.002  # of a plot [m], [rad]; of all plots of a ship [rad]
RADIUS = 300.0
PARTS = (Part('ships', contacts=(0, SHIPS)), Part('boats', contacts=(SHIPS, None)))
Echoes = Literal['', 'lobes', 'twice']


def ships(seed: int, echoes: Echoes = '') -> Scene:
    """
    Return ten minutes of six ships of 200 to 300 m at 2 to 7 km and six boats.

    Echoes are side lobes (same range, beside the ship) or twice the range, between ship and ship.
    """
    rng, radar = np.random.default_rng(seed), antenna(TURN_TIME, FARTHEST, SD)
    paths: list[Legs] = []
    while len(paths) < SHIPS + BOATS:
        path = _course(rng, is_ship=len(paths) < SHIPS)
        if all(np.hypot(*(_places(path) - _places(other)).T).min() > 1000.0 for other in paths):
            paths.append(path)
    hulls = [_hull(rng) if k < SHIPS else None for k in range(SHIPS + BOATS)]
    states = passes(radar, paths, TURNS)
    found, turn = [], []
    for ship, time, place, velocity in zip(
        states.id, states.time, states.position, states.velocity, strict=True
    ):
        plots = _seen(rng, place[:2], velocity[:2], hulls[ship])
        if hulls[ship] is not None and len(plots):
            plots = np.concatenate([plots, _echoes(rng, plots, velocity[:2], echoes)])
        found.append(plots)
        turn.append(np.full(len(plots), time // TURN_TIME))
    number = rng.poisson(FALSE_PLOTS, TURNS)
    found.append(rng.uniform([50.0, 0.0], [FARTHEST, 2.0 * np.pi], (number.sum(), 2)))
    turn.append(np.repeat(np.arange(TURNS), number))
    polar = np.concatenate(found)
    time = times_of(polar[:, 1], np.concatenate(turn), TURN_TIME)
    values = read_parameter_file(PROJECT / 'config' / 'marine_radar.yaml', '/radar_tracker')
    return Scene(
        values, turns_of(polar, time, TURN_TIME, TURNS), truth_of(states, 2),
        there_of(states, TURN_TIME, TURNS, SHIPS + BOATS), RADIUS, parts=PARTS,
    )  # fmt: skip


def _course(rng: Rng, is_ship: bool) -> Legs:
    """Return a straight course that stays within 2 to 7 km, a boat's within 0.6 to 10 km."""
    low, high = (1800.0, 7000.0) if is_ship else (600.0, 10e3)
    while True:
        distance = rng.uniform(2000.0, 6000.0) if is_ship else rng.uniform(1000.0, 9000.0)
        bearing, course = rng.uniform(-np.pi, np.pi, 2)
        place = (distance * np.cos(bearing), distance * np.sin(bearing), 0.0)
        path = Legs(place, rng.uniform(3.0, 9.0), course)
        away = np.hypot(*_places(path).T)
        if away.min() > low and away.max() < high:
            return path


def _places(path: Legs) -> Floats:
    return path.at(TURN_TIME * np.arange(TURNS))[0][:, :2]


def _hull(rng: Rng) -> Floats:
    """Return what shines on a ship: how far ahead of the middle, to the left [m], how bright."""
    length = rng.uniform(200.0, 300.0)
    place = rng.uniform(-0.5, 0.5, (14, 2)) * [length, length / 7.0]
    place[0] = [-0.35 * length, 0.0]  # the bridge, aft
    return np.column_stack([place, np.append(4.0, rng.gamma(1.0, 1.0, 13) + 0.2)])


def _seen(rng: Rng, place: Floats, velocity: Floats, hull: Floats | None) -> Floats:
    """Return the plots (M, 2) of one pass: peaks of the echo a cell and a half apart."""
    ahead = velocity / np.hypot(*velocity)
    if hull is None:
        points, bright = place[None], np.array([2.0 * (rng.random() < 0.9)])
    else:
        points = place + hull[:, :2] @ np.array([ahead, [-ahead[1], ahead[0]]])
        bright = hull[:, 2] * rng.exponential(1.0, len(hull))
    points, bright = points[bright > 1.0], bright[bright > 1.0]
    polar = np.column_stack([np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])])
    peaks = []
    while len(polar):
        off = polar - polar[bright.argmax()]
        off[:, 1] = (off[:, 1] + np.pi) % (2.0 * np.pi) - np.pi
        near = (np.abs(off) < 1.5 * CELL).all(axis=1)
        peaks.append(polar[bright.argmax()] + bright[near] @ off[near] / bright[near].sum())
        polar, bright = polar[~near], bright[~near]
    found = np.array(peaks).reshape(-1, 2)
    return found + SD * rng.standard_normal(found.shape) + [0.0, rng.normal(0.0, ROLL)]


def _echoes(rng: Rng, plots: Floats, velocity: Floats, kind: Echoes) -> Floats:
    """Return what a ship's first plot is seen as besides."""
    distance, azimuth = plots[0]
    place = np.zeros((0, 2))
    if kind == 'lobes':
        offset, chance = np.array([-0.11, -0.05, 0.05, 0.11]), np.array([0.25, 0.5, 0.5, 0.25])
        offset = offset[rng.random(4) < chance * (4000.0 - distance) / 2000.0]
        offset = offset + rng.normal(0.0, 0.006, len(offset))
        place = np.column_stack([np.full(len(offset), distance), azimuth + offset])
    elif kind == 'twice':
        side = abs(velocity[0] * np.sin(azimuth) - velocity[1] * np.cos(azimuth))
        if distance < 5000.0 and side > 0.7 * np.hypot(*velocity) and rng.random() < 0.4:
            place = np.array([[2.0 * distance, azimuth]])
    return place + SD * rng.standard_normal(place.shape)
