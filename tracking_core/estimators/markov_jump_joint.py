# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The mixed-Markov filter of all axes at once: modes in pairs, one state, the full R."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tracking_core.batches import Floats
from tracking_core.estimators.markov_jump import MarkovJump
from tracking_core.mode_chain import Chain
from tracking_core.motion import Motion


class MarkovJumpJoint(MarkovJump):
    """
    Two independent chains of modes as one chain of all pairs, the vertical mode counting fastest.

    It differs from two filters beside each other in using the covariance of the plots between
    the planes; without that it gives the same.

    References
    ----------
    [ZHUK09] eq. 4 to 7, each hypothesis Gaussian.

    """

    def __init__(self, horizontal: MarkovJump, vertical: MarkovJump) -> None:
        super().__init__(
            tuple(StackedMotion(g, b) for g in horizontal.motions for b in vertical.motions),
            ProductChain(horizontal.chain, vertical.chain),
            tuple(np.kron(_initial(horizontal), _initial(vertical))),
        )


@dataclass(frozen=True)
class ProductChain:
    """Two independent chains as one: Pi is the Kronecker product of theirs."""

    first: Chain
    second: Chain

    @property
    def modes(self) -> int:
        """Number of pairs of modes."""
        return self.first.modes * self.second.modes

    @cached_property
    def stationary(self) -> Floats:
        """Probabilities (J,) of the pairs after a long time."""
        return np.asarray(np.kron(self.first.stationary, self.second.stationary))

    def transition_probability(self, dt: Floats) -> Floats:
        """Return Pi (T, J, J) over the times dt (T,) [s]; entry [t, i, j] is from i to j."""
        one, other = (c.transition_probability(dt) for c in (self.first, self.second))
        product = np.einsum('tij,tkl->tikjl', one, other)
        return np.asarray(product.reshape(len(product), self.modes, self.modes))


@dataclass(frozen=True)
class StackedMotion:
    """Two motions that do not touch each other, as one of all their axes."""

    first: Motion
    second: Motion

    @property
    def axes(self) -> int:
        """Number of axes."""
        return self.first.axes + self.second.axes

    def transition(self, dt: Floats) -> Floats:
        """Return F (T, n, n) over the times dt (T,) [s]."""
        return _blocks(self.first.transition(dt), self.second.transition(dt))

    def process_noise(self, dt: Floats) -> Floats:
        """Return Q (T, n, n) over the times dt (T,) [s]."""
        return _blocks(self.first.process_noise(dt), self.second.process_noise(dt))


def _initial(plane: MarkovJump) -> Floats:
    return np.array(plane.initial_probability or plane.chain.stationary)


def _blocks(first: Floats, second: Floats) -> Floats:
    T, n = first.shape[:2]
    full = np.zeros((T, n + second.shape[1], n + second.shape[1]))
    full[:, :n, :n], full[:, n:, n:] = first, second
    return full
