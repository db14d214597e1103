# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How likely does a contact change its mode between two looks, whatever time lies between?"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from tracking_core.batches import Floats


class Chain(Protocol):
    """What a filter asks about the modes."""

    @property
    def modes(self) -> int:
        """Number of modes J."""
        ...

    @property
    def stationary(self) -> Floats:
        """Mode probabilities (J,) after a long time."""
        ...

    def transition_probability(self, dt: Floats) -> Floats:
        """Return Pi (T, J, J) over the times dt (T,) [s]; entry [t, i, j] is from i to j."""
        ...


@dataclass(frozen=True)
class ModeChain:
    """
    Continuous-time Markov chain of the modes.

    A mode lasts `sojourn_time` on average, then any other mode follows with equal chance. So the
    transition probabilities are right for every time step: Pi(dt) = exp(Q dt).
    """

    sojourn_time: tuple[float, ...]  # one per mode [s]

    @property
    def modes(self) -> int:
        """Number of modes J."""
        return len(self.sojourn_time)

    @staticmethod
    def staying(probability: float, dt: float, modes: int = 2) -> ModeChain:
        """Return the symmetric chain that stays in its mode over `dt` with this probability."""
        share = (modes - 1) / modes
        decay = 1.0 - (1.0 - probability) / share
        if not 0.0 < decay < 1.0:
            raise ValueError(f'staying probability must be in ({1 - share}, 1), got {probability}')
        return ModeChain((-dt / (share * np.log(decay)),) * modes)

    @cached_property
    def stationary(self) -> Floats:
        """Mode probabilities (J,) after a long time."""
        time = np.array(self.sojourn_time)
        return np.asarray(time / time.sum())

    @cached_property
    def _spectrum(self) -> tuple[Floats, Floats]:
        """Return decay rates (k,) and the matrices (k, i, j) that decay with them."""
        # Q is similar to a symmetric matrix, because the chain is reversible.
        rate, root = 1.0 / np.array(self.sojourn_time), np.sqrt(self.stationary)
        generator = np.repeat(rate[:, None] / max(self.modes - 1, 1), self.modes, axis=1)
        np.fill_diagonal(generator, -rate if self.modes > 1 else 0.0)
        values, vectors = np.linalg.eigh(root[:, None] * generator / root[None, :])
        left, right = vectors / root[:, None], vectors.T * root[None, :]
        return np.minimum(values, 0.0), left.T[:, :, None] * right[:, None, :]

    def transition_probability(self, dt: Floats) -> Floats:
        """Return Pi (T, J, J) over the times dt (T,) [s]; entry [t, i, j] is from i to j."""
        rates, parts = self._spectrum
        decay, J = np.exp(rates[:, None] * dt), self.modes  # (k, T)
        product = (parts.reshape(len(rates), -1).T @ decay).reshape(J, J, -1).transpose(2, 0, 1)
        return np.asarray(np.minimum(np.maximum(product, 0.0), 1.0))
