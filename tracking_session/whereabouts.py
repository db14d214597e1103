# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where was the sensor's platform? From own ship's odometry, or from whoever knows transforms."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from itertools import pairwise
from typing import Protocol

import numpy as np

from msg_adapters.bad_message import BadMessage
from msg_adapters.row_checks import MAX_OFFSET
from tracking_core.batches import Floats
from tracking_core.platform import Platform
from tracking_core.rows import take
from tracking_session.doubts import Doubt
from tracking_session.frames import TrackingFrame
from tracking_session.leap_guard import LeapGuard
from tracking_session.node_config import NodeConfig
from tracking_session.stamp_guard import StampGuard
from tracking_session.twist_check import TwistCheck

NEAREST = 0.007  # s between two samples that are kept; odometry up to 125 Hz is kept whole
SILENT = 0.25  # of the patience, beyond twice the longest gap but one between odometries
ARRIVALS = 40  # of odometry, the last ones, that count for it
SHORT = 0.05  # s beyond the newest odometry for which own ship goes on as it moved


class NotYet(Exception):  # noqa: N818 (a state rather than an error)
    """
    Where the sensor was at the time of these plots is not known yet; says what is missing.

    `wanted` is the time of the odometry that is waited for [s]; -inf: nobody knows.
    """

    def __init__(self, what: str, wanted: float = -np.inf) -> None:
        super().__init__(what)
        self.wanted = wanted


class Transforms(Protocol):
    """Whoever knows where frames are."""

    def sensor(self, frame: str, into: str, times: Floats) -> Platform:
        """
        Return where the sensor's frame was in another one, all through these times (K,) [s].

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
        self._config = node_config
        self.transforms: Transforms | None = None  # None: own ship's odometry tells
        self._guard = StampGuard(node_config.time_jump_threshold)
        self._leaps = LeapGuard(node_config.ownship_leap, node_config.ownship_timeout)
        self._twist = TwistCheck(node_config.ownship_timeout)
        self.reset()

    def reset(self) -> None:
        """Forget the path."""
        self._guard.reset()
        self._leaps.reset()
        self._twist.reset()
        self.platform = Platform.empty(self._config.ownship_timeout)
        self._has_leapt = False
        self._heard: deque[float] = deque(maxlen=ARRIVALS)  # when odometry came [s]

    def clock_moved(self) -> None:
        """Take note that the ROS clock went back: the next odometry that did so is believed."""
        self._guard.clock_moved()

    def take(self, sample: Platform, received: float) -> bool:
        """Add one odometry; return whether own ship leapt. BadMessage if it cannot be true."""
        has_jumped = self._guard.accept(float(sample.time[0]), received)
        self._heard.append(received)
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

    @property
    def newest(self) -> float:
        """The time of the newest odometry [s], -inf before there is any."""
        return float(self.platform.time[-1]) if len(self.platform) else -np.inf

    def is_silent(self, now: float, patience: float) -> bool:
        """Return whether odometry that came should long have come again now [s]."""
        gaps = sorted(after - before for before, after in pairwise(self._heard))
        if len(gaps) < 2:
            return False
        return now - self._heard[-1] > SILENT * patience + 2.0 * gaps[-2]

    def goes_on(self, stamp: float) -> bool:
        """Return whether an odometry of this time [s] is of the path that is known."""
        time = self.platform.time
        is_near = np.abs(stamp - time[-1:]) <= self._config.time_jump_threshold
        return bool((is_near & (stamp > time[:1])).all())

    def covering(
        self, times: Floats, frame: TrackingFrame, patience: float = 0.0
    ) -> Platform | None:
        """
        Return a path of the sensor's platform that covers these times (K,) [s], if one is needed.

        Parameters
        ----------
        times : (K,) array
            When the plots were seen [s].
        frame : TrackingFrame
            Of plots and tracks.
        patience : float
            Plots may wait so long [s]; they should, where odometry of their time can come by then.

        Raises
        ------
        StalePlatform, BadMessage, NotYet
            Where there is none; NotYet if there is patience.

        """
        if not frame.needs_platform:
            return None
        if self.transforms is not None:
            self._ask(self.transforms, frame, times, patience)
        else:
            self._await(float(times.max()), patience)
        self.platform.check(times)
        return self.platform

    def _ask(
        self, transforms: Transforms, frame: TrackingFrame, times: Floats, patience: float
    ) -> None:
        try:
            self._follow(transforms.sensor(str(frame.sensor), frame.name, times))
        except NotYet as reason:
            if patience:
                raise
            raise BadMessage('no transform', str(reason)) from reason

    def _await(self, time: float, patience: float) -> None:
        """Raise NotYet where odometry of this time [s] is missed, and not for long."""
        behind = time - self.newest
        if SHORT < behind <= patience and (np.diff(self.platform.time[-2:]) <= patience).all():
            raise NotYet(f'own ship is known up to {behind:.2g} s before', time - SHORT)

    def _follow(self, samples: Platform) -> None:
        """Take what the transforms tell of a message; what is newer than all before may leap."""
        newest = self.platform.time[-1:]
        if (newest - samples.time[0] > self._config.time_jump_threshold).any():
            self.platform, newest = Platform.empty(self._config.ownship_timeout), newest[:0]
            self._leaps.reset()
        fresh = samples.time > newest.max(initial=-np.inf)
        leapt = [row for row in fresh.nonzero()[0].tolist() if self._leaps_at(samples, row)]
        if leapt:
            self.platform = Platform.empty(self._config.ownship_timeout)
            samples, self._has_leapt = take(samples, slice(leapt[-1], None)), True
        self.platform = self.platform.add(samples, span=MAX_OFFSET)

    def _leaps_at(self, samples: Platform, row: int) -> bool:
        try:
            return self._leaps.accept(take(samples, slice(row, row + 1)))
        except BadMessage:  # it may lead back: then it was none
            return False

    def has_leapt(self) -> bool:
        """Return whether the sensor has leapt since this was asked last, by its transforms."""
        has_leapt, self._has_leapt = self._has_leapt, False
        return has_leapt
