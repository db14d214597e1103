# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Where the sensor's platform was at the time of each plot.

Samples are kept in order of time and in bounded number; between them positions are linear and
orientations turn evenly, beyond the last one they go on for a bounded time.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from tracking_core.batches import Floats, Ints
from tracking_core.platform_pose import PlatformPose

_RATE_SPAN = 0.5  # s, between the samples that a rate is taken from
_SHORTEST = 1e-6  # s, between two samples


class StalePlatform(ValueError):  # noqa: N818 (it is the platform's data that are stale)
    """No sample of the platform is near enough to the wanted time; says age and limit."""

    reason = 'own ship stale'  # to count by


@dataclass(frozen=True)
class Platform:
    """Samples of a moving platform, oldest first."""

    time: Floats  # (K,) [s]
    position: Floats  # (K, 3) tracking frame [m]
    orientation: Floats  # (K, 4) quaternion x y z w, platform axes to tracking axes
    velocity: Floats  # (K, 3) tracking frame [m/s]
    position_covariance: Floats  # (K, 3, 3) [m^2]
    yaw_variance: Floats  # (K,) [rad^2]
    max_extrapolation: float = 2.0  # beyond the newest or oldest sample [s]
    capacity: int = 2000  # samples kept

    @staticmethod
    def empty(max_extrapolation: float = 2.0, capacity: int = 2000) -> Platform:
        """Return a platform of which nothing is known yet."""
        return Platform(
            np.zeros(0), np.zeros((0, 3)), np.zeros((0, 4)), np.zeros((0, 3)),
            np.zeros((0, 3, 3)), np.zeros(0), max_extrapolation, capacity,
        )  # fmt: skip

    def __len__(self) -> int:
        return len(self.time)

    def add(self, *samples: Platform, span: float = 0.0) -> Platform:
        """
        Return the platform with these samples, the oldest dropped beyond the capacity.

        Samples may come late; of two at one time the later of the arguments wins. Those of the
        last `span` [s] are kept, however many they are.
        """
        parts = (self, *samples)
        joined = {name: np.concatenate([getattr(p, name) for p in parts]) for name in _ARRAYS}
        if not (np.diff(joined['time']) > 0.0).all():
            order = _in_order(joined['time'])
            joined = {name: values[order] for name, values in joined.items()}
        time = joined['time']
        most = max(self.capacity, int(np.count_nonzero(time >= time[-1:] - span)))
        kept = {name: values[-most:] for name, values in joined.items()}
        return Platform(**kept, max_extrapolation=self.max_extrapolation, capacity=self.capacity)

    def since(self, time: float) -> Platform:
        """Return a copy of the samples from the last one before this time [s] on."""
        first = max(int(np.searchsorted(self.time, time)) - 1, 0)
        kept = {name: getattr(self, name)[first:].copy() for name in _ARRAYS}
        return replace(self, **kept)

    def at(self, times: Floats) -> PlatformPose:
        """
        Return the platform at these times (M,) [s].

        Raises
        ------
        StalePlatform
            If a time is further than `max_extrapolation` from the samples.

        """
        times = np.asarray(times, np.float64)
        self.check(times)
        if len(times) == 0:
            return PlatformPose(
                np.zeros((0, 3)), np.zeros((0, 4)), np.zeros((0, 3)), np.zeros((0, 3, 3)),
                np.zeros(0), np.zeros((0, 3)),
            )  # fmt: skip
        after = np.clip(np.searchsorted(self.time, times), 1, max(len(self) - 1, 1))
        before, after = after - 1, np.minimum(after, len(self) - 1)
        span = self.time[after] - self.time[before]
        share = np.divide(
            times - self.time[before], span, out=np.zeros(len(times)), where=span > 0.0
        )
        inner = np.clip(share, 0.0, 1.0)
        # Beyond the samples the platform goes on as its nearest sample moves, and as it turns.
        beyond = times - np.clip(times, self.time[0], self.time[-1])
        turn_rate = self._turn_rate(times)
        orientation = _turn(self.orientation, before, after, inner)
        if beyond.any():
            on = Rotation.from_rotvec(beyond[:, None] * turn_rate)
            orientation = (Rotation.from_quat(orientation) * on).as_quat()
        velocity = _between(self.velocity, before, after, inner)
        position = _between(self.position, before, after, inner)
        return PlatformPose(
            position=position + beyond[:, None] * velocity,
            orientation=orientation,
            velocity=velocity,
            position_covariance=_between(self.position_covariance, before, after, inner),
            yaw_variance=_between(self.yaw_variance, before, after, inner),
            turn_rate=turn_rate,
        )

    def check(self, times: Floats) -> None:
        """
        Do nothing where `at` knows the platform at these times (M,) [s].

        Raises
        ------
        StalePlatform
            If a time is further than `max_extrapolation` from the samples.

        """
        if len(times) and not len(self):
            raise StalePlatform('no sample of the platform has come yet')
        if len(times):
            age = max(times.max() - self.time[-1], self.time[0] - times.min())
            if age > self.max_extrapolation:
                raise StalePlatform(
                    f'plots are {age:.3g} s away from the samples of the platform, '
                    f'limit {self.max_extrapolation:g} s'
                )

    def _turn_rate(self, times: Floats) -> Floats:
        """
        Return how fast the platform turns (M, 3), from samples at least `_RATE_SPAN` apart.

        The rate of two samples that follow each other at once is their noise.
        """
        first, last = self.time[0], self.time[-1]
        begin = np.clip(times - 0.5 * _RATE_SPAN, first, max(last - _RATE_SPAN, first))
        one = np.searchsorted(self.time, begin, side='right') - 1
        other = np.minimum(np.searchsorted(self.time, begin + _RATE_SPAN), len(self) - 1)
        start = Rotation.from_quat(self.orientation[one])
        turn = (start.inv() * Rotation.from_quat(self.orientation[other])).as_rotvec()
        span = np.maximum(self.time[other] - self.time[one], _SHORTEST)
        return np.asarray(turn / span[:, None])


def pose_at(platform: Platform | None, times: Floats) -> PlatformPose:
    """Return own ship at these times (M,) [s], at rest at the origin if there is none."""
    if platform is not None:
        return platform.at(times)
    M = len(times)
    orientation = np.zeros((M, 4))
    orientation[:, 3] = 1.0
    return PlatformPose(
        position=np.zeros((M, 3)),
        orientation=orientation,
        velocity=np.zeros((M, 3)),
        position_covariance=np.zeros((M, 3, 3)),
        yaw_variance=np.zeros(M),
        turn_rate=np.zeros((M, 3)),
    )


_ARRAYS = tuple(
    f.name for f in fields(Platform) if f.name not in ('max_extrapolation', 'capacity')
)


def _in_order(time: Floats) -> Ints:
    """Return the rows in order of time, of two at one time the later row."""
    _, last = np.unique(time[::-1], return_index=True)
    return np.asarray(len(time) - 1 - last)


def _between(values: Floats, before: Any, after: Any, share: Floats) -> Floats:
    weight = share.reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values[before] * (1.0 - weight) + values[after] * weight)


def _turn(orientation: Floats, before: Any, after: Any, share: Floats) -> Floats:
    """Turn evenly from one sample to the next."""
    start = Rotation.from_quat(orientation[before])
    turn = (start.inv() * Rotation.from_quat(orientation[after])).as_rotvec()
    return np.asarray((start * Rotation.from_rotvec(share[:, None] * turn)).as_quat())
