# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a scenario is played to a tracker: no message before the last one has been answered."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from nav_msgs.msg import Odometry

from msg_adapters.message_types import seconds
from tracking_tools.node_process import DEADLINE
from tracking_tools.scenarios.messages import Sent
from tracking_tools.testing.probe import TrackerProbe

OWNSHIP = 'ownship'


def play(
    probe: TrackerProbe, messages: Iterable[Sequence[Sent]], deadline: float = DEADLINE
) -> list[Any]:
    """
    Publish a scenario, each scan when the one before has been answered.

    Parameters
    ----------
    probe : TrackerProbe
        Which has met the tracker.
    messages : iterable
        What is sent together, as ``scenarios.messages.send`` and ``scenarios.listening.listen``
        yield it: plots, own ship (Odometry). The truth is not sent.
    deadline : float
        For each answer [s].

    Returns
    -------
    list of PointCloud2
        The track tables, one for each scan.

    """
    tables: list[Any] = []
    ownship: Any = None
    for together in messages:
        own = [sent.msg for sent in together if sent.topic == OWNSHIP]
        if own and ownship is None:
            ownship = probe.tell(Odometry, OWNSHIP)
            probe.peer.wait_until_matched(ownship, deadline=deadline)
        for sent in together:
            if sent.topic == probe.sensor.topic:
                tables.append(_ask(probe, sent.msg, ownship, own, deadline))
    return tables


def _ask(
    probe: TrackerProbe, plots: Any, ownship: Any, own: Sequence[Any], deadline: float
) -> Any:
    """Publish own ship and plots; return the track table that answers."""
    stamp = seconds(plots.header.stamp)

    def send(_: int) -> None:
        for msg in own:
            ownship.publish(msg)
        probe.plots.publish(plots)

    probe.peer.ask(send, lambda: probe.is_answered(stamp), f'tracks of {stamp}', deadline=deadline)
    probe.stamp = stamp
    return probe.tables[-1]
