# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where was the sensor's platform? From own ship's odometry, or from whoever knows transforms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from msg_adapters.row_checks import MAX_OFFSET
from tracking_core.batches import Floats
from tracking_core.platform import Platform
from tracking_session.doubts import Doubt
from tracking_session.frames import TrackingFrame
from tracking_session.leap_guard import LeapGuard
from tracking_session.node_config import NodeConfig
from tracking_session.stamp_guard import StampGuard
from tracking_session.twist_check import TwistCheck

NEAREST = 0.007  # s between two samples that are kept; odometry up to 125 Hz is kept whole


class NotYet(Exception):  # noqa: N818 (a state rather than an error)
    """Where the sensor was at the time of these plots is not known yet; says what is missing."""


class Transforms(Protocol):
    """Whoever knows where frames are."""

    def sensor(self, frame: str, into: str, times: Floats) -> Platform:
        """
        Return where the sensor's frame was in another one, from the first to the last time [s].

        Raises
        ------
        NotYet
            If that is not known, or not yet.

        """


class Whereabouts:
    """
    The platform's path.

    Parameters
    ----------
    node_config : NodeConfig
        Limits of times.

    """

    def __init__(self, node_config: NodeConfig) -> None:
        self._config, self.transforms = node_config, None
        self._guard = StampGuard(node_config.time_jump_threshold)
        self._leaps = LeapGuard(node_config.ownship_leap, node_config.ownship_timeout)
        self._twist = TwistCheck(node_config.ownship_timeout)
        self.reset()

    transforms: Transforms | None

    def reset(self) -> None:
        """Forget the path."""
        self._guard.reset()
        self._leaps.reset()
        self._twist.reset()
        self.platform = Platform.empty(self._config.ownship_timeout)

    def clock_moved(self) -> None:
        """Take note that the ROS clock went back: the next odometry that did so is believed."""
        self._guard.clock_moved()

    def take(self, sample: Platform, received: float) -> bool:
        """Add one odometry; return whether own ship leapt. BadMessage if it cannot be true."""
        has_jumped = self._guard.accept(float(sample.time[0]), received)
        if has_jumped:
            self._leaps.reset()
        has_leapt = self._leaps.accept(sample)
        if has_jumped or has_leapt:
            self.platform = Platform.empty(self._config.ownship_timeout)
            self._twist.reset()
        self._twist.take(sample)
        if not (sample.time - self.platform.time[-1:] < NEAREST).any():
            self.platform = self.platform.add(sample, span=MAX_OFFSET)
        return has_leapt

    def doubts(self) -> Iterator[Doubt]:
        """Yield what own ship says against itself."""
        return self._twist.doubts()

    def covering(self, times: Floats, frame: TrackingFrame) -> Platform | None:
        """
        Return a path of the sensor's platform that covers these times (K,) [s], if one is needed.

        Raises
        ------
        StalePlatform, NotYet
            Where there is none.

        """
        if not frame.needs_platform:
            return None
        if self.transforms is not None:
            samples = self.transforms.sensor(str(frame.sensor), frame.name, times)
            newest = self.platform.time[-1:]
            if (newest - samples.time[0] > self._config.time_jump_threshold).any():
                self.platform = Platform.empty(self._config.ownship_timeout)
            self.platform = self.platform.add(samples, span=MAX_OFFSET)
        self.platform.at(times)  # raises where they are not covered
        return self.platform
