# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is known of where contacts are, in the form that every reader of messages expects."""

from __future__ import annotations

from dataclasses import dataclass

from tracking_core.batches import Floats, Ints


@dataclass(frozen=True)
class Bodies:
    """Contacts with position and velocity."""

    id: Ints  # (T,)
    time: Floats  # (T,) of the state [s]
    state: Floats  # (T, 6) x, y, z, vx, vy, vz
    covariance: Floats  # (T, 6, 6) the same order; NaN: not estimated

    def __len__(self) -> int:
        return len(self.id)
