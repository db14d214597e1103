# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a user orders of a session: a track to start, a track to drop."""

from __future__ import annotations

from typing import Any

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import frame_of, seconds
from msg_adapters.points import to_position
from tracking_session.session import Session


def acquire(session: Session, msg: Any) -> None:
    """Start a track where a user points, as a PointStamped says."""
    instrument = session.instrument
    tracker = instrument.tracker
    try:
        if session.stamp is None or not tracker.is_ready:
            raise BadMessage('no scan yet', f'no {instrument.topic} have come yet')
        session.frame.check_point(frame_of(msg))
        position = to_position(msg, tracker.sensor_position, instrument.reach)
        if len(session.tracks) >= (most := tracker.config.max_tracks):
            raise BadMessage('no room', f'there are {most} tracks already (max_tracks)')
        track_id = tracker.start_track(position, seconds(session.stamp))
        session.settle()
        session.log.info(f'track {track_id} started at {position} m')
    except BadMessage as error:
        session.ledger.refuse('acquire', error.reason, error)


def cancel(session: Session, msg: Any) -> None:
    """Drop one track, as a UInt32 says."""
    if session.instrument.tracker.drop_track(msg.data):
        session.settle()
        session.log.info(f'track {msg.data} dropped')
    else:
        session.ledger.warn('cancel', f'cancel: there is no track {msg.data}')
