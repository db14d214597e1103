# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a node publishes of its contacts beside table and markers, while somebody subscribes."""

from __future__ import annotations

from typing import Any
from uuid import uuid4

from nav_msgs.msg import Odometry

from msg_adapters.message_types import MessageTypes
from msg_adapters.odometry import to_odometry
from msg_adapters.radar_tracks import radar_classes, RUN, to_radar_tracks
from tracking_node.openings import Openings
from tracking_session.instrument import Instrument


class BodyTopics:
    """
    `~/odometry` and, if the user wants them, `~/radar_tracks`.

    Parameters
    ----------
    openings : Openings
        Of the node; they close the topics.
    output_type : str
        '' or radar_msgs/RadarTracks; ValueError if that is not installed.
    types : MessageTypes
        Classes of the messages.

    """

    def __init__(self, openings: Openings, output_type: str, types: MessageTypes) -> None:
        self._types, self._run = types, uuid4().bytes[:RUN]
        self._odometry, self._radar_tracks = openings.tell(Odometry, '~/odometry'), None
        if output_type:
            self._classes = radar_classes()
            self._radar_tracks = openings.tell(self._classes.RadarTracks, '~/radar_tracks')

    def publish(self, instrument: Instrument, header: Any) -> None:
        """Publish the confirmed contacts, as far as somebody listens."""
        wants_odometry = self._odometry.get_subscription_count()
        tracks = self._radar_tracks
        wants_tracks = tracks is not None and tracks.get_subscription_count()
        if not (wants_odometry or wants_tracks):
            return
        bodies = instrument.to_bodies()
        if wants_odometry:
            for msg in to_odometry(bodies, header.frame_id, self._types):
                self._odometry.publish(msg)
        if tracks is not None and wants_tracks:
            tracks.publish(to_radar_tracks(bodies, self._run, header, self._types, self._classes))
