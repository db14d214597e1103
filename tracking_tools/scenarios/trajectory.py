# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where a simulated contact is at any time: the interface, and a spline through samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from tracking_core.batches import Floats

_FEWEST_SAMPLES = 2


class Trajectory(Protocol):
    """Anything that has a place and a velocity at every time."""

    def at(self, time: ArrayLike) -> tuple[Floats, Floats]:
        """
        Evaluate the motion.

        Parameters
        ----------
        time : (...) array
            Times [s], in any order.

        Returns
        -------
        position, velocity : (..., 3) arrays
            East, north, up [m], [m/s].

        """
        ...


@dataclass(frozen=True)
class Sampled:
    """
    Cubic spline through samples; straight and steady before the first and after the last.

    Parameters
    ----------
    time : (K,) array
        Increasing [s], at least two.
    position : (K, 3) array
        East, north, up [m].

    """

    time: Floats
    position: Floats
    _spline: CubicSpline = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        count = len(self.time)
        if count < _FEWEST_SAMPLES or np.shape(self.position) != (count, 3):
            raise ValueError(
                'Sampled needs time (K,) and position (K, 3) with K of 2 and more, got '
                f'{np.shape(self.time)} and {np.shape(self.position)}'
            )
        object.__setattr__(
            self, '_spline', CubicSpline(self.time, self.position, bc_type='natural')
        )

    def at(self, time: ArrayLike) -> tuple[Floats, Floats]:
        """Evaluate the motion, as in ``Trajectory.at``."""
        when = np.asarray(time, dtype=float)
        inside = np.clip(when, self.time[0], self.time[-1])
        velocity = self._spline(inside, 1)
        return self._spline(inside) + velocity * (when - inside)[..., None], velocity
