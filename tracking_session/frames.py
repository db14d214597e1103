# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which frame tracks are in, and whether a message can be brought there.

Nothing is guessed: data in the tracking frame are used as they are, a sensor on a platform needs
the platform's odometry, everything else is refused with both names and the ways out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from msg_adapters.bad_message import BadMessage, shown
from tracking_session.newcomer import AGREEING, Newcomer

WAYS_OUT = (
    'give the odometry of the platform on the topic ownship, or say with sensor.mount.* where the '
    'sensor stands in the tracking frame, or set tracking_frame to the frame of the data, or set '
    'use_tf'
)
ONE_SENSOR = 'one node tracks with one sensor; if it is the same under another name, call ~/reset'
_REMEMBERED = ('name', 'sensor', 'has_ship', 'polar', 'learnt')


@dataclass
class TrackingFrame:
    """
    Remember the tracking frame, however it became known.

    Parameters
    ----------
    name : str
        As the user set it; '' means that the first message says it.
    mounted : bool
        Whether the user said where the sensor stands.
    announce : callable
        Takes the one line that says which frame it became.

    """

    name: str
    mounted: bool
    announce: Callable[[str], object]
    sensor: str | None = None  # frame of the plots, from the first message
    by_tree: bool = False  # tf2 tells where frames are, and nobody where own ship is
    has_ship: bool = False  # own ship is known
    polar: bool = False  # plots are directions from the sensor, not places
    learnt: bool = False  # the name came from a message
    newcomer: Newcomer = field(default_factory=Newcomer)

    @property
    def is_known(self) -> bool:
        """Whether there is a tracking frame, which a driver may have left without a name."""
        return bool(self.name) or self.learnt

    def copy(self) -> TrackingFrame:
        """Return another one that knows the same."""
        return replace(self)

    def remember(self) -> dict[str, Any]:
        """Return what became known, for a restart."""
        return {name: getattr(self, name) for name in _REMEMBERED}

    def recall(self, memory: Mapping[str, Any]) -> None:
        """Go on from what was remembered."""
        for name in _REMEMBERED:
            setattr(self, name, memory[name])

    @property
    def needs_platform(self) -> bool:
        """
        Whether the plots are told from a platform that moves in the tracking frame.

        Those in the tracking frame itself are: places need none, directions are from own ship.
        """
        return self.moving and (self.is_from_ship or not self.is_true)

    @property
    def is_from_ship(self) -> bool:
        """Whether plots are directions from own ship."""
        return self.polar and self.has_ship

    @property
    def moving(self) -> bool:
        """Whether the sensor's platform may move."""
        return self.has_ship or self.by_tree

    @property
    def is_true(self) -> bool:
        """Whether plots are told in the axes of the tracking frame itself."""
        return self.sensor == self.name

    @property
    def has_places(self) -> bool:
        """Whether plots are places in the tracking frame, from a ship that moves in it."""
        return self.has_ship and self.is_true and not self.polar

    def tells_true(self, reference: str) -> bool:
        """Return whether own ship's heading is in the directions, by `azimuth_reference` too."""
        return reference == 'tracking_frame' or (self.is_true and self.needs_platform)

    def check_plots(self, frame: str, polar: bool = False) -> None:
        """
        Accept plots in this frame, places or directions from own ship, or raise BadMessage.

        With no tracking frame set and no own ship the sensor is stationary, and its own frame
        becomes the tracking frame.
        """
        if not self.is_known and not self.moving:
            if self.mounted:
                raise BadMessage(
                    'wrong frame',
                    f"header.frame_id is '{frame}' and sensor.mount is set: set tracking_frame to "
                    'the frame in which the mount is given, or give own ship',
                )
            self._learn(frame, 'that of the sensor: no own ship, so it stands still')
        if self.sensor is None and (frame == self.name or self.moving or self.mounted):
            self.sensor = frame
        if frame != self.sensor:
            ways = WAYS_OUT if self.sensor is None else ONE_SENSOR
            raise BadMessage(
                'wrong frame',
                f"header.frame_id is '{frame}', expected '{self.sensor or self.name}': {ways}",
            )
        self.polar |= polar

    def check_ownship(self, frame: str, time: float) -> bool:
        """
        Accept odometry in this frame and of this time [s], or raise BadMessage.

        Where a sensor has been tracked with that stands still, one odometry is not believed: it
        would end all tracks.

        Returns
        -------
        bool
            Whether tracking must start anew, because the sensor was taken to stand still.

        """
        stands_still = self.sensor is not None and not self.moving
        if stands_still and not self.newcomer.is_believed(frame, time):
            raise BadMessage(
                'not believed yet',
                f"own ship in frame '{frame}' is new: believed from message {AGREEING} on, "
                'nothing is wrong if it goes on',
            )
        if not self.is_known or (self.learnt and not self.moving and frame != self.name):
            self.sensor = None
            self._learn(frame, "that of own ship's odometry")
        if frame != self.name:
            raise BadMessage(
                'wrong frame',
                f"ownship header.frame_id is '{frame}', the tracking frame is '{self.name}': "
                'publish the odometry in the tracking frame, or set tracking_frame',
            )
        self.has_ship = True
        return stands_still and self.needs_platform

    def _learn(self, frame: str, why: str) -> None:
        self.name, self.learnt = frame, True
        hint = '' if frame else '. So is header.frame_id: viewers show nothing that has no frame'
        self.announce(
            f"the tracking frame is '{shown(frame)}', {why} (tracking_frame is empty){hint}"
        )

    def check_point(self, frame: str) -> None:
        """Accept a position that a user points at, or raise BadMessage."""
        if frame != self.name:
            raise BadMessage(
                'wrong frame',
                f"acquire header.frame_id is '{frame}', the tracking frame is '{self.name}': "
                'point in the tracking frame',
            )
