# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which frame tracks are in, and whether a message can be brought there.

Nothing is guessed: data in the tracking frame are used as they are, a sensor on a platform needs
the platform's odometry, everything else is refused with both names and the ways out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from msg_adapters.bad_message import BadMessage, shown
from msg_adapters.newcomer import AGREEING, Newcomer

WAYS_OUT = (
    'give the odometry of the platform on the topic ownship, or say with sensor.mount.* where the '
    'sensor stands in the tracking frame, or set tracking_frame to the frame of the data, or set '
    'use_tf'
)


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
    moving: bool = False  # own ship is known
    learnt: bool = False  # the name came from a message
    newcomer: Newcomer = field(default_factory=Newcomer)

    @property
    def needs_platform(self) -> bool:
        """Whether the plots come from a sensor on a platform that moves in the tracking frame."""
        return self.moving and self.sensor != self.name

    def check_plots(self, frame: str) -> None:
        """
        Accept plots in this frame, or raise BadMessage.

        With no tracking frame set and no own ship the sensor is stationary, and its own frame
        becomes the tracking frame.
        """
        if not self.name and not self.moving:
            if self.mounted:
                raise BadMessage(
                    'wrong frame',
                    f"header.frame_id is '{frame}' and sensor.mount is set: set tracking_frame to "
                    'the frame in which the mount is given, or give own ship',
                )
            self._learn(frame, 'that of the plots: no own ship, so the sensor stands still')
        if self.sensor is None and (frame == self.name or self.moving or self.mounted):
            self.sensor = frame
        if frame != self.sensor:
            ways = WAYS_OUT if self.sensor is None else 'one node tracks with one sensor'
            raise BadMessage(
                'wrong frame',
                f"header.frame_id is '{frame}', expected '{self.sensor or self.name}': {ways}",
            )

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
                f"own ship in frame '{frame}' is new, believed from message {AGREEING} on",
            )
        anew = False
        if not self.name or (self.learnt and not self.moving and frame != self.name):
            anew = self.sensor is not None
            self.sensor = None
            self._learn(frame, "that of own ship's odometry")
        if frame != self.name:
            raise BadMessage(
                'wrong frame',
                f"ownship header.frame_id is '{frame}', the tracking frame is '{self.name}': "
                'publish the odometry in the tracking frame, or set tracking_frame',
            )
        self.moving = True
        return anew

    def _learn(self, frame: str, why: str) -> None:
        self.name, self.learnt = frame, True
        self.announce(f"the tracking frame is '{shown(frame)}', {why} (tracking_frame is empty)")

    def check_point(self, frame: str) -> None:
        """Accept a position that a user points at, or raise BadMessage."""
        if frame != self.name:
            raise BadMessage(
                'wrong frame',
                f"acquire header.frame_id is '{frame}', the tracking frame is '{self.name}': "
                'point in the tracking frame',
            )
