# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a session know beside its tracker? Stamps, frames and fields, for a restart."""

from __future__ import annotations

from typing import Any

from tracking_session.session import Session


def remember(session: Session) -> dict[str, Any]:
    """Return all that is known, as numbers, texts, and lists and dictionaries of them."""
    stamp = session.stamp
    return {
        'stamp': None if stamp is None else (stamp.sec, stamp.nanosec),
        'guard': session.guard.remember(),
        'frame': session.frame.remember(),
        'fields': [list(pair) for pair in session.mapping.items()],
    }


def recall(session: Session, memory: dict[str, Any], received: float) -> None:
    """
    Go on from what was remembered, after the tracker has done so.

    Parameters
    ----------
    session : Session
        Just begun.
    memory : dict
        Of the form that `remember` returns.
    received : float
        When the last message came, by the clock of this session [s].

    """
    session.published = session.tracks
    session.guard.recall(memory['guard'], received)
    session.frame.recall(memory['frame'])
    session.mapping = {str(ours): str(theirs) for ours, theirs in memory['fields']}
    if memory['stamp'] is not None:
        sec, nanosec = memory['stamp']
        session.stamp = session.types.Time(sec=sec, nanosec=nanosec)
