# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Do stamps and clock have anything to do with each other? Said once if not."""

from __future__ import annotations

import time
from typing import Any

from msg_adapters.message_types import NANOSECONDS, seconds
from tracking_node.clocks import has_no_clock, NO_CLOCK

PATIENCE = 5.0  # s for simulated time to begin
CLOCK_OFF = 10.0  # s between stamps and clock that are worth a word


class ClockCheck:
    """Compare stamps with the node's clock."""

    def __init__(self, node: Any, topic: str) -> None:
        self._node, self._topic, self._is_told = node, topic, False
        self._begun: float | None = None  # when the first stamp came [s]

    def compare(self, stamp: Any) -> None:
        """Say once when a stamp is far from now, or simulated time does not begin."""
        if has_no_clock(self._node):
            self._miss()
            return
        off = seconds(stamp) - self._node.get_clock().now().nanoseconds / NANOSECONDS
        if abs(off) > CLOCK_OFF and not self._is_told:
            self._is_told = True
            side = 'ahead of' if off > 0.0 else 'behind'
            self._node.get_logger().warning(
                f'header.stamp of {self._topic} is {abs(off):.0f} s {side} the clock: '
                'use_sim_time? Tracking goes by the stamps'
            )

    def _miss(self) -> None:
        now = time.monotonic()
        self._begun = now if self._begun is None else self._begun
        if now - self._begun > PATIENCE and not self._is_told:
            self._is_told = True
            self._node.get_logger().warning(f'{NO_CLOCK}; tracking goes by the stamps')
