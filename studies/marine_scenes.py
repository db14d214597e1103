# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do radar, gyro and log of a ship make of another ship? Scenarios of [A823] as a batch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from radar_tracker.conversion import to_polar
from radar_tracker.sensor import Radar
from radar_tracker.sensor_config import SensorConfig
from studies.passes import Measured
from tracking_core.batches import Coverage, Floats, Plots
from tracking_core.platform_pose import PlatformPose

MILE, KNOT, DEGREE = 1852.0, 1852.0 / 3600.0, np.pi / 180.0
PERIOD = 2.5  # s, a turn of the antenna
# Of [A823] appendix 3: bounds of rectangular errors, sd of the others; of the log it tells 3 sd.
BEAM, ENCODER, BACKLASH, QUANTUM = 0.05 * DEGREE, 0.03 * DEGREE, 0.05 * DEGREE, 0.1 * DEGREE
PULSE, RANGE_QUANTUM = 20.0, 0.01 * MILE  # m
GYRO_BIAS, GYRO = 0.5 * DEGREE, 0.12 * DEGREE
LOG_BIAS, LOG = 0.5 * KNOT, 0.2 / 3.0 * KNOT
ROLL_ERROR, ROLL_PERIOD = 0.22 * DEGREE, 10.0  # mean and amplitude; s, of the ship's roll
GLINT = (30.0, 1.0)  # m along and across a ship of 200 m, from memory


@dataclass(frozen=True)
class Encounter:
    """Two ships; own ship heads north."""

    name: str
    own_speed: float  # kn
    distance: float  # nautical miles
    bearing: float  # deg
    relative_course: float  # deg
    relative_speed: float  # kn
    turn: float = 0.0  # deg, of the other ship's true course, to starboard
    turn_at: float = 0.0  # s
    turn_rate: float = 1.0  # deg/s

    def paths(self, scans: int) -> Paths:
        """Return both ships at so many scans."""
        time = PERIOD * np.arange(scans)
        own_velocity = np.array([0.0, self.own_speed * KNOT])
        relative = self.relative_speed * KNOT * compass(self.relative_course * DEGREE)
        start = self.distance * MILE * compass(self.bearing * DEGREE)
        lasted = np.clip(time - self.turn_at, 0.0, abs(self.turn) / self.turn_rate)
        angle = -np.sign(self.turn) * self.turn_rate * DEGREE * lasted  # anticlockwise
        velocity = (relative + own_velocity)[:, None]
        c, s = np.cos(angle), np.sin(angle)
        turned = np.stack(
            [c * velocity[0] - s * velocity[1], s * velocity[0] + c * velocity[1]], 1
        )
        steps = 0.5 * PERIOD * (turned[1:] + turned[:-1])
        other = start + np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
        return Paths(time, time[:, None] * own_velocity, own_velocity, other, turned)


@dataclass(frozen=True)
class Paths:
    """Where both ships truly are at K scans: x east, y north."""

    time: Floats  # (K,) [s]
    own: Floats  # (K, 2) [m]
    own_velocity: Floats  # (2,) [m/s]
    other: Floats  # (K, 2) [m]
    velocity: Floats  # (K, 2) of the other ship [m/s]


@dataclass(frozen=True)
class Watched:
    """What T runs know of K scans, in the frame of their own dead reckoning."""

    plots: Measured
    own: Floats  # (K, T, 2) reckoned from gyro and log [m]


A823 = (
    Encounter('1', 10.0, 8.0, 0.0, 180.0, 20.0),
    Encounter('2', 10.0, 1.0, 0.0, 90.0, 10.0),
    Encounter('3', 5.0, 8.0, 45.0, 225.0, 20.0),
    Encounter('4', 25.0, 8.0, 45.0, 225.0, 20.0),
)


def compass(angle: Floats | float) -> Floats:
    """Return the direction (..., 2) of an angle clockwise from north [rad]."""
    return np.stack([np.sin(angle), np.cos(angle)], axis=-1)


def watch(
    encounter: Encounter,
    scans: int,
    runs: int,
    sensor: SensorConfig,
    rng: np.random.Generator,
    rolling: bool = False,
) -> Watched:
    """
    Return what radar, gyro and log of own ship make of an encounter.

    Parameters
    ----------
    encounter : Encounter
        Two ships.
    scans, runs : int
        K and T.
    sensor : SensorConfig
        What the tracker believes of its radar.
    rng : Generator
        Draws all errors; biases of gyro and log have a random sign in each run.
    rolling : bool
        Add the errors of a rolling ship and of a contact 200 m long.

    """
    paths, shape = encounter.paths(scans), (scans, runs)
    gyro = GYRO_BIAS * rng.choice([-1.0, 1.0], runs) + rng.normal(0.0, GYRO, shape)
    log = encounter.own_speed * KNOT + LOG_BIAS * rng.choice([-1.0, 1.0], runs)
    log = log + rng.normal(0.0, LOG, shape)
    sailed = np.cumsum(PERIOD * log[:-1, :, None] * compass(gyro[:-1]), axis=0)
    own = np.concatenate([np.zeros((1, runs, 2)), sailed])
    distance, bearing = _radar(paths, shape, rng, rolling)
    radar = Radar(sensor, 2, is_polar=True)
    position, covariance = np.empty((*shape, 2)), np.empty((*shape, 2, 2))
    for k, time in enumerate(paths.time):
        plots = Plots.polar(np.full(runs, time), distance[k], -bearing[k])
        scan = radar.measure(plots, _pose(own[k], gyro[k]), Coverage(time, time), 1.0)
        position[k], covariance[k] = scan.position, scan.covariance
    return Watched(Measured(position, covariance), own)


def radar_errors(shape: int | tuple[int, int], rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Return errors of the radar alone in range [m] and bearing [rad]."""
    distance = rng.normal(0.0, PULSE, shape) + rng.uniform(-RANGE_QUANTUM, RANGE_QUANTUM, shape)
    bearing = rng.normal(0.0, np.hypot(BEAM, ENCODER), shape)
    bearing = bearing + rng.uniform(-BACKLASH, BACKLASH, shape)
    return distance, bearing + rng.uniform(-QUANTUM, QUANTUM, shape)


def _radar(
    paths: Paths, shape: tuple[int, int], rng: np.random.Generator, rolling: bool
) -> tuple[Floats, Floats]:
    """Return range [m] and bearing from ahead, clockwise [rad], (K, T)."""
    polar = to_polar(paths.other - paths.own)
    true = 0.5 * np.pi - polar[:, 1:]
    noise = radar_errors(shape, rng)
    distance, bearing = polar[:, :1] + noise[0], true + noise[1]
    if rolling:
        phase = rng.uniform(0.0, 2.0 * np.pi, shape[1])
        swing = 1.0 + np.sin(4.0 * np.pi * paths.time[:, None] / ROLL_PERIOD + phase)
        bearing = bearing + ROLL_ERROR * swing * np.sin(2.0 * true)
        aspect = np.arctan2(paths.velocity[:, 1], paths.velocity[:, 0])[:, None] - polar[:, 1:]
        along, across = (rng.normal(0.0, sd, shape) for sd in GLINT)
        c, s = np.cos(aspect), np.sin(aspect)
        distance = distance + c * along - s * across
        bearing = bearing - (s * along + c * across) / polar[:, :1]
    return distance, bearing


def _pose(own: Floats, gyro: Floats) -> PlatformPose:
    """Return own ship (T,) as its odometry tells it."""
    T, half = len(own), 0.25 * np.pi - 0.5 * gyro
    orientation = np.stack([np.zeros(T), np.zeros(T), np.sin(half), np.cos(half)], axis=1)
    flat = np.concatenate([own, np.zeros((T, 1))], axis=1)
    return PlatformPose(
        position=flat,
        orientation=orientation,
        velocity=np.zeros((T, 3)),
        position_covariance=np.zeros((T, 3, 3)),
        yaw_variance=np.full(T, GYRO**2),
        turn_rate=np.zeros((T, 3)),
    )
