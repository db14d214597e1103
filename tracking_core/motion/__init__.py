# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does a contact move between two looks? One file per linear model."""

from __future__ import annotations

from typing import Protocol

from tracking_core.batches import Floats
from tracking_core.motion.constant_velocity import ConstantVelocity
from tracking_core.motion.coordinated_turn import CoordinatedTurn
from tracking_core.motion.random_walk import RandomWalk

__all__ = ['ConstantVelocity', 'CoordinatedTurn', 'Motion', 'RandomWalk']


class Motion(Protocol):
    """A linear model of one plane; the state is (position, velocity) for each axis in turn."""

    @property
    def axes(self) -> int:
        """Number of axes; the state has twice as many components."""
        ...

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, n, n) over the times dt (T,) [s]."""
        ...

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q (T, n, n) over the times dt (T,) [s]."""
        ...
