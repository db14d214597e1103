# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does a bearing do that is seen from a moving platform? Modified polar coordinates.

The state is bearing, bearing rate, range rate over range, and 1 over range. Straight relative
motion moves the first three without the fourth, so that they are known without a manoeuvre of
the own ship; the fourth is learnt from such a manoeuvre.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.estimators.markov_jump import mix
from tracking_core.kalman import condition, innovate
from tracking_core.linalg import symmetrise
from tracking_core.mode_chain import ModeChain

_STATES = 4


@dataclass(frozen=True)
class ModifiedPolar:
    """
    Contacts on straight courses, seen from a platform whose motion is known.

    The prediction is exact for straight relative motion; covariances are linearised. The modes
    differ in how much the relative course drifts. `Mixture.memory` holds position and velocity
    (x, y, vx, vy) of the sensor at the time of the state.

    References
    ----------
    [AIDALA83]

    """

    bearing_noise: tuple[float, ...]  # one per mode [rad/sqrt(s)]
    rate_noise: tuple[float, ...]  # of bearing rate and of range rate over range [1/s/sqrt(s)]
    chain: ModeChain
    closing_sd: float  # of range rate over range of new contacts [1/s]
    inverse_range: float  # of new contacts, mean [1/m]
    inverse_range_sd: float  # [1/m]

    @property
    def axes(self) -> int:
        """One: the bearing."""
        return 1

    def start(self, mean: Floats, covariance: Floats) -> Mixture:
        """Return new tracks from bearing and rate (T, 2) and their covariances (T, 2, 2)."""
        T, J = len(mean), self.chain.modes
        state, P = np.zeros((T, _STATES)), np.zeros((T, _STATES, _STATES))
        state[:, :2], state[:, 3] = mean, self.inverse_range
        P[:, :2, :2] = covariance
        P[:, 2, 2], P[:, 3, 3] = self.closing_sd**2, self.inverse_range_sd**2
        return Mixture(
            mean=np.repeat(state[:, None], J, axis=1),
            covariance=np.repeat(P[:, None], J, axis=1),
            mode_probability=np.repeat(self.chain.stationary[None], T, axis=0),
            memory=np.full((T, 4), np.nan),
        )

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Mix the modes and let contact and sensor go on straight over the times dt (T,) [s]."""
        mixed = mix(mixture, self.chain.transition_probability(dt))
        mean, F = go_straight(mixed.mean, dt[:, None])
        covariance = F @ mixed.covariance @ np.swapaxes(F, -1, -2) + self._noise(dt)
        memory = mixture.memory.copy()
        memory[:, :2] += memory[:, 2:] * dt[:, None]
        return Mixture(mean, symmetrise(covariance), mixed.mode_probability, memory)

    def move_sensor(self, mixture: Mixture, sensor: Floats) -> Mixture:
        """
        Return the plane seen from where the sensor really is, if it did not go on straight.

        Parameters
        ----------
        mixture : Mixture
            Predicted, or new.
        sensor : (T, 4) array
            Position and velocity x, y, vx, vy at the time of the state [m, m/s].

        """
        input_ = np.where(np.isnan(mixture.memory), 0.0, sensor - mixture.memory)
        if not input_.any():
            return replace(mixture, memory=sensor)
        mean, F = step_aside(mixture.mean, input_[:, None])
        covariance = symmetrise(F @ mixture.covariance @ np.swapaxes(F, -1, -2))
        return replace(mixture, mean=mean, covariance=covariance, memory=sensor)

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs of the tracks (P,) with the predicted plane."""
        matrix = np.zeros((*measurement.matrix.shape[:2], _STATES))
        matrix[..., :2] = measurement.matrix
        return innovate(mixture, track, replace(measurement, matrix=matrix))

    def update(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Mixture:
        """Return the plane after the plots, each weighted by its association probability."""
        return condition(mixture, track, innovations, association)

    def _noise(self, dt: Floats) -> Floats:
        """Return Q (T, J, 4, 4)."""
        dt, q = np.abs(dt)[:, None], np.array(self.rate_noise) ** 2
        Q = np.zeros((len(dt), self.chain.modes, _STATES, _STATES))
        Q[..., 0, 0] = np.array(self.bearing_noise) ** 2 * dt + q * dt**3 / 3.0
        Q[..., 0, 1] = Q[..., 1, 0] = 0.5 * q * dt**2
        Q[..., 1, 1] = Q[..., 2, 2] = q * dt
        return Q


def go_straight(state: Floats, dt: Floats) -> tuple[Floats, Floats]:
    """
    Move states (..., 4) over the times dt (...) [s], contact and sensor both on straight courses.

    Returns
    -------
    state : (..., 4) array
    jacobian : (..., 4, 4) array

    """
    rate, closing = state[..., 1], state[..., 2]
    slope = np.zeros((*state.shape, _STATES))  # of (along, across, velocities) by the state
    slope[..., 0, 2] = slope[..., 1, 1] = dt
    slope[..., 2, 2] = slope[..., 3, 1] = 1.0
    return _polar(state, (1.0 + closing * dt, rate * dt, closing, rate), slope)


def step_aside(state: Floats, step: Floats) -> tuple[Floats, Floats]:
    """
    Return states (..., 4) as seen from elsewhere, with their Jacobians (..., 4, 4).

    `step` (..., 4) is by how much position [m] and velocity [m/s] of the sensor are other ones.
    """
    cos, sin = np.cos(state[..., 0]), np.sin(state[..., 0])
    along, across = (
        cos * step[..., 0] + sin * step[..., 1],
        cos * step[..., 1] - sin * step[..., 0],
    )
    v_along, v_across = (
        cos * step[..., 2] + sin * step[..., 3],
        cos * step[..., 3] - sin * step[..., 2],
    )
    rate, closing, s = state[..., 1], state[..., 2], state[..., 3]
    slope = np.zeros((*state.shape, _STATES))
    slope[..., 0, 0], slope[..., 1, 0] = -s * across, s * along
    slope[..., 2, 0], slope[..., 3, 0] = -s * v_across, s * v_along
    slope[..., 0, 3], slope[..., 1, 3] = -along, -across
    slope[..., 2, 3], slope[..., 3, 3] = -v_along, -v_across
    slope[..., 2, 2] = slope[..., 3, 1] = 1.0
    place = (1.0 - s * along, -s * across, closing - s * v_along, rate - s * v_across)
    return _polar(state, place, slope)


def _polar(
    state: Floats, place: tuple[Floats, Floats, Floats, Floats], slope: Floats
) -> tuple[Floats, Floats]:
    """
    Return to polar coordinates.

    `place` is position and velocity over the old range, along and across the old line of sight;
    `slope` (..., 4, 4) its derivative by the old state.
    """
    along, across, v_along, v_across = place
    square = along**2 + across**2
    rate = (v_across * along - v_along * across) / square
    closing = (v_along * along + v_across * across) / square
    shrink = 1.0 / np.sqrt(square)
    s = state[..., 3] * shrink
    new = np.stack([state[..., 0] + np.arctan2(across, along), rate, closing, s], axis=-1)
    a, c = along / square, across / square
    zero = np.zeros_like(a)
    rows = (
        (-c, a, zero, zero),
        (v_across / square - 2.0 * a * rate, -v_along / square - 2.0 * c * rate, -c, a),
        (v_along / square - 2.0 * a * closing, v_across / square - 2.0 * c * closing, a, c),
        (-s * a, -s * c, zero, zero),
    )
    outer = np.stack([np.stack(np.broadcast_arrays(*row), axis=-1) for row in rows], axis=-2)
    jacobian = outer @ slope
    jacobian[..., 0, 0] += 1.0
    jacobian[..., 3, 3] += shrink
    return new, jacobian
