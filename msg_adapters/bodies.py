# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is known of where contacts are, in the form that every reader of messages expects."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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

    def at(self, time: float) -> Bodies:
        """Return the contacts as they are at one time [s], if each goes on evenly."""
        dt = (time - self.time)[:, None]
        state, covariance = self.state.copy(), self.covariance.copy()
        state[:, :3] += dt * state[:, 3:]
        dt = dt[:, :, None]
        covariance[:, :3] += dt * self.covariance[:, 3:]
        covariance[:, :, :3] += dt * covariance[:, :, 3:]
        return Bodies(self.id, np.full(len(self), time), state, covariance)
