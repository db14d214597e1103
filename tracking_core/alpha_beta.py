# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What do all filters with given gains have in common? Prediction, update, and an honest covariance.

An alpha-beta filter corrects position by alpha times the innovation and velocity by beta / T times
it, T being the time since the last plot. The covariance follows the gain that is used (Joseph
form), so that gates, association and existence work as with a Kalman filter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tracking_core.batches import Association, Floats, Innovations, Ints, Measurement, Mixture
from tracking_core.gains import gain_matrix, on_axes, steady_noise
from tracking_core.kalman import condition, innovate, kalman_gain
from tracking_core.lag import excess_of_innovations, lag_covariance, lag_of_range_rates
from tracking_core.linalg import sum_by_track, symmetrise
from tracking_core.motion.constant_velocity import ConstantVelocity

READINGS = ('steady_state', 'recursion')
# Of `Mixture.memory`: time since the last plot [s], chance that the velocity is a prior; R by rows
_INTERVAL, _UNTOLD, _NOISE = 0, 1, 2


@dataclass(frozen=True)
class GainFilter:
    """
    Alpha-beta filters of the modes of one plane; the gains of an update are an argument.

    The covariance is read in one of two ways. `recursion`: measurement noise alone, as the gains
    pass it on. `steady_state`: such process noise is added that the gains `alpha` are Kalman's,
    so that S = R / (1 - alpha) once the filter has settled.

    Gains of a settled filter find a velocity that no plot has told far too late: after a start at
    rest, with a velocity independent of the position, the first plot has Kalman's gain.

    References
    ----------
    [BAKULEV] does not give the covariance; both readings are ours. [BENEDICT62] for beta.

    """

    alpha: tuple[float, ...]  # of each mode
    axes: int
    reading: str = 'steady_state'

    def __post_init__(self) -> None:
        if not self.alpha or not all(0.0 < alpha < 1.0 for alpha in self.alpha):
            raise ValueError(f'alpha must be in (0, 1), one per mode, got {self.alpha}')
        if self.reading not in READINGS:
            raise ValueError(f'covariance must be one of {READINGS}, got {self.reading!r}')

    @property
    def columns(self) -> int:
        """Columns of memory that the filter itself has; those of a control come after."""
        return _NOISE + self.axes**2

    def start(self, mean: Floats, covariance: Floats, extra: int = 0) -> Mixture:
        """Return new tracks, equal in all modes, with so many extra columns of memory."""
        T, J = len(mean), len(self.alpha)
        memory = np.zeros((T, self.columns + extra))
        is_at_rest = (mean[:, 1::2] == 0.0).all(axis=1)
        memory[:, _UNTOLD] = is_at_rest & (covariance[:, 0::2, 1::2] == 0.0).all(axis=(1, 2))
        memory[:, _NOISE : self.columns] = covariance[:, 0::2, 0::2].reshape(T, self.axes**2)
        return Mixture(
            mean=np.repeat(mean[:, None], J, axis=1),
            covariance=np.repeat(covariance[:, None], J, axis=1),
            mode_probability=np.full((T, J), 1.0 / J),
            memory=memory,
        )

    def predict(self, mixture: Mixture, dt: Floats) -> Mixture:
        """Move every mode straight on over the times dt (T,) [s]."""
        F = ConstantVelocity(0.0, self.axes).transition(dt)[:, None]
        covariance = F @ mixture.covariance @ np.swapaxes(F, -1, -2)
        if self.reading == 'steady_state':
            shape = np.stack([steady_noise(alpha) for alpha in self.alpha])
            covariance = covariance + on_axes(self.plot_noise(mixture), shape, dt)
        memory = mixture.memory.copy()
        memory[:, _INTERVAL] += dt
        return replace(
            mixture,
            mean=(F @ mixture.mean[..., None])[..., 0],
            covariance=symmetrise(covariance),
            memory=memory,
        )

    def innovate(self, mixture: Mixture, track: Ints, measurement: Measurement) -> Innovations:
        """Compare the pairs with every mode."""
        interval = self.interval(mixture)
        return innovate(mixture, track, lag_of_range_rates(mixture, track, measurement, interval))

    def update(
        self,
        mixture: Mixture,
        track: Ints,
        innovations: Innovations,
        association: Association,
        alpha: Floats,
    ) -> Mixture:
        """
        Correct every mode with its gain.

        Parameters
        ----------
        mixture : Mixture
            Predicted plane, T tracks.
        track, innovations, association
            As `kalman.condition` takes them.
        alpha : (T, J) array
            Gains to use; beta belongs to them.

        """
        association = heard(association, track, innovations, self.axes)
        gain = self._gain(alpha, mixture, track, innovations)
        after = condition(mixture, track, innovations, association, gain)
        memory = mixture.memory.copy()
        memory[:, [_INTERVAL, _UNTOLD]] *= association.miss[:, None]
        noise = self._heard_noise(mixture, track, innovations, association)
        memory[:, _NOISE : self.columns] = noise.reshape(len(memory), self.axes**2)
        return replace(after, memory=memory)

    def admit_lag(
        self,
        after: Mixture,
        predicted: Mixture,
        track: Ints,
        innovations: Innovations,
        association: Association,
        alpha: Floats,
    ) -> Mixture:
        """
        Return the update with what its innovations betray of a lag in the covariance.

        With `recursion` that is nothing: there the covariance is that of the plots' noise alone.
        `predicted` is the plane before the update, the others are those of `update`.
        """
        if self.reading == 'recursion' or len(track) == 0:
            return after
        heard_only = heard(association, track, innovations, self.axes)
        busy = int(np.argmax(self.alpha))
        excess = excess_of_innovations(innovations, busy, track, heard_only, self.axes)
        added = lag_covariance(excess, alpha[:, busy], self.interval(predicted))
        covariance = after.covariance.copy()
        covariance[:, busy] += added
        return replace(after, covariance=covariance)

    def interval(self, mixture: Mixture) -> Floats:
        """Return the time since the last plot (T,) [s]."""
        return mixture.memory[:, _INTERVAL]

    def plot_noise(self, mixture: Mixture) -> Floats:
        """Return the covariance of the last plot (T, a, a)."""
        rows = mixture.memory[:, _NOISE : self.columns]
        return rows.reshape(len(rows), self.axes, self.axes)

    def noise_of_pairs(self, mixture: Mixture, track: Ints, innovations: Innovations) -> Floats:
        """
        Return R (P, a, a) of the plots.

        An axis that a plot does not have gets the noise of the track's last plot.
        """
        a = self.axes
        has = (innovations.cross_covariance[:, 0, :, :a] != 0.0).any(axis=1)
        R = innovations.noise[:, :a, :a]
        return np.where(has[:, :, None] & has[:, None, :], R, self.plot_noise(mixture)[track])

    def _gain(
        self, alpha: Floats, mixture: Mixture, track: Ints, innovations: Innovations
    ) -> Floats:
        """Return (P, J, n, d): Kalman's as far as no plot has told the velocity yet."""
        cross = innovations.cross_covariance
        gain = gain_matrix(alpha, self.interval(mixture), track, cross)
        untold = mixture.memory[track, _UNTOLD, None, None, None]
        return gain + untold * (kalman_gain(innovations) - gain) if untold.any() else gain

    def _heard_noise(
        self, mixture: Mixture, track: Ints, innovations: Innovations, association: Association
    ) -> Floats:
        """Return R (T, a, a) of the plots, the last one where there is none."""
        old, R = self.plot_noise(mixture), self.noise_of_pairs(mixture, track, innovations)
        share = association.probability[:, None, None]
        return sum_by_track(share * R, track, len(old)) + association.miss[:, None, None] * old


def heard(
    association: Association, track: Ints, innovations: Innovations, axes: int
) -> Association:
    """Return the association with plots that measure nothing of the plane counted as misses."""
    has = (innovations.cross_covariance[:, 0, :, :axes] != 0.0).any(axis=(1, 2))
    if has.all():
        return association
    share = np.where(has, association.probability, 0.0)
    mute = sum_by_track(association.probability - share, track, len(association.miss))
    return Association(share, association.miss + mute, association.approximate)
