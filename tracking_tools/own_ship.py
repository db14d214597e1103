# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where was own ship all through a recording?"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from msg_adapters.bad_message import BadMessage
from msg_adapters.ownship import to_platform
from tracking_core.platform import Platform
from tracking_tools.bags import open_bag

_UNLIMITED = 1e9  # s, and samples


def read_platform(recording: Path | str, topic: str) -> Platform | None:
    """Return own ship all through the recording, None without."""
    samples = []
    with open_bag(recording) as bag:
        chosen = [connection for connection in bag.connections if connection.topic == topic]
        for connection, _, raw in bag.messages(chosen) if chosen else ():
            msg: Any = bag.deserialize(raw, connection.msgtype)
            try:
                samples.append(to_platform(msg))
            except BadMessage:
                continue
    platform = Platform.empty(_UNLIMITED, int(_UNLIMITED)).add(*samples)
    return platform if samples else None
