# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The paths and radars on which trackers are compared: fixed to the last figure."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
import math

from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.passes import Contact
from tracking_tools.scenarios.plots import Scenario
from tracking_tools.scenarios.radar import SimulatedRadar


def two_mode_path() -> Legs:
    """Straight, a quarter turn left, straight, a quarter turn right, straight: 495 s."""
    return Legs(
        position=(25_000.0, 10_000.0, 0.0),
        speed=120.0,
        course=math.pi,
        legs=(
            Leg(125.0),
            Leg(90.0, turn_rate=math.radians(1.0)),
            Leg(125.0),
            Leg(30.0, turn_rate=math.radians(-3.0)),
            Leg(125.0),
        ),
    )


def two_mode() -> Scenario:
    """One manoeuvring aircraft, Cartesian plots, no misses: for runs of a filter alone."""
    radar = SimulatedRadar(
        period=5.0,
        rotation='staring',
        range_sd=0.0,
        azimuth_sd=0.0,
        position_sd=100.0,
        detection_probability=1.0,
    )
    return Scenario(radar, (Contact(1, two_mode_path()),), 500.0, 'the two-mode IMM path')


def crossing() -> Scenario:
    """Two manoeuvring aircraft on mirrored paths, 100 scans, all of a scan at one time."""
    path = two_mode_path()
    limits = (1_000.0, 40_000.0)
    radar = SimulatedRadar(
        period=5.0,
        rotation='staring',
        range_sd=10.0,
        azimuth_sd=math.radians(0.1),
        detection_probability=0.8,
        clutter_per_turn=2e-5 * (limits[1] - limits[0]) * 2.0 * math.pi,
        range_limits=limits,
    )
    contacts = (Contact(1, path), Contact(2, path.mirrored(6_500.0)))
    return Scenario(radar, contacts, 500.0, 'two crossing manoeuvring aircraft in clutter')


def crossing_rotating() -> Scenario:
    """Return ``crossing`` seen by an antenna that turns."""
    scene = crossing()
    return replace(
        scene,
        radar=replace(scene.radar, rotation='clockwise'),
        description=f'{scene.description}, turning antenna',
    )


def z0_path() -> Legs:
    """Path of scenario Z-0: turns of 32 m/s^2, climbs and dives at 500 m/s over the ground."""
    return _manoeuvres(
        (175_000.0, 140_000.0, 9_000.0),
        speed=500.0,
        course=math.radians(215.0),
        turns=((180, 210, 32.0), (290, 330, -32.0), (520, 550, 32.0)),
        climbs=(
            (240, 250, -25.0),
            (270, 280, 25.0),
            (420, 430, 25.0),
            (450, 460, -25.0),
            (520, 530, -20.0),
            (540, 550, 20.0),
        ),
    )


def z0() -> Scenario:
    """Scenario Z-0 of [ZHUK09]: a fast aircraft far away, 76 contacts 10 s apart."""
    radar = SimulatedRadar(
        period=10.0,
        rotation='staring',
        range_sd=300.0,
        azimuth_sd=math.radians(0.166),
        elevation_sd=math.radians(0.166),
        detection_probability=1.0,
        range_limits=(0.0, 400_000.0),
    )
    return Scenario(radar, (Contact(1, z0_path()),), 760.0, 'Z-0 of [ZHUK09], one aircraft')


def z_near_path() -> Legs:
    """Path of scenario Z-near: close and high."""
    return _manoeuvres(
        (-40_000.0, -8_000.0, 11_000.0),
        speed=280.0,
        course=math.radians(5.0),
        turns=((95, 115, 30.0), (185, 210, -30.0), (275, 295, 30.0)),
        climbs=((60, 65, -15.0), (75, 80, 15.0), (240, 245, 15.0), (255, 260, -15.0)),
    )


def z_near() -> Scenario:
    """Z-near: as Z-0 with elevations up to 47 degrees, 70 contacts 5 s apart."""
    radar = replace(z0().radar, period=5.0)
    return Scenario(radar, (Contact(1, z_near_path()),), 350.0, 'Z-near, high elevations')


def _manoeuvres(
    position: tuple[float, float, float],
    speed: float,
    course: float,
    turns: tuple[tuple[float, float, float], ...],
    climbs: tuple[tuple[float, float, float], ...],
) -> Legs:
    """Legs of intervals (from, to [s], acceleration [m/s^2]) across and above the course."""
    edges = sorted({0.0, *(edge for span in turns + climbs for edge in span[:2])})
    legs = [
        Leg(
            duration=end - start,
            turn_rate=_during(turns, start) / speed,
            vertical_acceleration=_during(climbs, start),
        )
        for start, end in pairwise(edges)
    ]
    return Legs(position, speed, course, tuple(legs))


def _during(spans: tuple[tuple[float, float, float], ...], time: float) -> float:
    return sum(value for start, end, value in spans if start <= time < end)
