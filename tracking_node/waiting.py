# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Messages that wait, in order and for a bounded time, for the transform of their moment."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
import time
from typing import Any

from tracking_session.whereabouts import NotYet

MOST = 50  # messages; then the oldest goes


class Waiting:
    """
    A queue that is empty unless somebody must wait.

    Parameters
    ----------
    use : callable
        Takes a message and its info; raises NotYet if it cannot be used yet.
    give_up : callable
        Takes the reason for which a message is dropped.
    patience : float
        How long a message may wait [s].

    """

    def __init__(
        self,
        use: Callable[[Any, Any], object],
        give_up: Callable[[NotYet], object],
        patience: float,
    ) -> None:
        self._use, self._give_up, self._patience = use, give_up, patience
        self._queue: deque[tuple[float, Any, Any]] = deque()

    def take(self, msg: Any, info: Any) -> None:
        """Use a message, after those that wait."""
        self._queue.append((time.monotonic(), msg, info))
        self.retry()

    def retry(self) -> None:
        """Use those that can be used by now; drop those that cannot for too long."""
        while self._queue:
            came, msg, info = self._queue[0]
            try:
                self._use(msg, info)
            except NotYet as reason:
                is_late = time.monotonic() - came > self._patience
                if not is_late and len(self._queue) <= MOST:
                    return
                self._give_up(reason)
            self._queue.popleft()

    def clear(self) -> None:
        """Forget all that wait."""
        self._queue.clear()
