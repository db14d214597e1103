# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does the tracker work on? Structs of arrays, one row per plot, track or pair.

Axis letters: T tracks, J modes of one plane, M plots, P gated pairs, n state, d coordinates of a
plot. Empty batches are legal everywhere. All arrays are float64 in SI units and ENU axes unless a
comment says otherwise. Read ``tracker.py`` next: what becomes of one scan.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Gaps = tuple[tuple[float, float], ...]  # from when to when nobody looked [s], the last ones
NO_GAPS: Gaps = 8 * ((-np.inf, -np.inf),)
NO_SWING = 33 * (0.0,)


@dataclass(frozen=True)
class Plots:
    """
    Radar plots of one message as the sensor reports them: sensor axes, angles anticlockwise.

    Either polar (`range`, `azimuth`, perhaps `elevation`) or Cartesian (`position`); what the
    sensor does not measure is NaN in every row, and so is a noise that the sensor does not tell.
    """

    time: Floats  # (M,) of each plot [s]
    range: Floats  # (M,) slant range, ground range for a sensor without elevation [m]
    azimuth: Floats  # (M,) [rad]
    elevation: Floats  # (M,) [rad], NaN: not measured
    position: Floats  # (M, 3) Cartesian plots [m]; NaN for polar ones, z NaN: not measured
    position_covariance: Floats  # (M, 3, 3) of Cartesian plots [m^2], NaN: not told
    range_rate: Floats  # (M,) positive receding [m/s]
    snr: Floats  # (M,) [dB]
    range_sd: Floats  # (M,) [m]
    azimuth_sd: Floats  # (M,) [rad]
    elevation_sd: Floats  # (M,) [rad]
    range_rate_sd: Floats  # (M,) [m/s]
    stamp: float = 0.0  # of the message [s]
    frame: str = ''

    @staticmethod
    def polar(time: Floats, distance: Floats, azimuth: Floats, **columns: Floats) -> Plots:
        """Return polar plots; `columns` are further fields by name, the rest is NaN."""
        return Plots._of(len(time), time=time, range=distance, azimuth=azimuth, **columns)

    @staticmethod
    def cartesian(time: Floats, position: Floats, **columns: Floats) -> Plots:
        """Return Cartesian plots from positions (M, 2) or (M, 3) [m]; the rest is NaN."""
        full = np.full((len(time), 3), np.nan)
        full[:, : position.shape[1]] = position
        return Plots._of(len(time), time=time, position=full, **columns)

    @staticmethod
    def _of(rows: int, **columns: Floats) -> Plots:
        absent = dict(zip(_MEASURED, np.full((len(_MEASURED), rows), np.nan), strict=True))
        absent['position'] = np.full((rows, 3), np.nan)
        absent['position_covariance'] = np.full((rows, 3, 3), np.nan)
        return Plots(**{**absent, **columns})  # type: ignore[arg-type]

    def __len__(self) -> int:
        return len(self.time)


_MEASURED = tuple(f.name for f in fields(Plots) if f.name not in ('stamp', 'frame'))


@dataclass(frozen=True)
class Bearings:
    """Marks of one cycle as the sonar reports them: sensor axes, anticlockwise."""

    time: Floats  # (M,) of each mark [s]
    bearing: Floats  # (M,) [rad]
    bearing_sd: Floats  # (M,) [rad], NaN: the sensor does not tell
    snr: Floats  # (M,) [dB], NaN: not measured
    stamp: float = 0.0  # of the message [s]
    frame: str = ''

    @staticmethod
    def of(time: Floats, bearing: Floats, **columns: Floats) -> Bearings:
        """Return marks; `columns` are further fields by name, the rest is NaN."""
        absent = {name: np.full(len(time), np.nan) for name in ('bearing_sd', 'snr')}
        return Bearings(time, bearing, **{**absent, **columns})  # type: ignore[arg-type]

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True)
class Coverage:
    """
    Where and when a scan looked.

    A rotating antenna points at `start_azimuth` at `start_time` and turns by `sweep` until
    `end_time`, evenly but for what its platform swings meanwhile. A `sweep` of 0 is a sensor that
    looks everywhere at once.
    """

    start_time: float  # [s]
    end_time: float  # [s]
    start_azimuth: float = 0.0  # tracking axes [rad]
    sweep: float = 0.0  # signed, anticlockwise positive [rad]
    gaps: Gaps = NO_GAPS  # during which the sensor was not followed
    unevenness: float = 0.0  # by how much the antenna may point elsewhere [rad]
    sensor_position: tuple[float, float, float] = (0.0, 0.0, 0.0)  # in the middle of it [m]
    sensor_velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [m/s]
    range_min: float = 0.0  # [m]
    range_max: float = np.inf  # [m]
    sector_centre: float = 0.0  # what the sensor can see at all [rad]
    sector_width: float = 2.0 * np.pi  # [rad]
    tilt: float = 0.0  # of the antenna's axis from the vertical, at most [rad]
    swing: tuple[float, ...] = NO_SWING  # ahead of an even turn, in even steps of the time [rad]

    def sensor_at(self, time: Floats) -> Floats:
        """Return x, y, vx, vy (T, 4) of the sensor, which goes on straight about the middle."""
        since = np.asarray(time) - 0.5 * (self.start_time + self.end_time)
        state = np.empty((len(since), 4))
        state[:, 2:] = self.sensor_velocity[:2]
        state[:, :2] = self.sensor_position[:2] + state[:, 2:] * since[:, None]
        return state

    def azimuth_at(self, time: Floats) -> Floats:
        """Return where the antenna points (T,) [rad], without the turns that it has made."""
        even = self.start_azimuth + self.rotation_rate * (time - self.start_time)
        if not any(self.swing):
            return np.asarray(even)
        moments = np.linspace(self.start_time, self.end_time, len(self.swing))
        return np.asarray(even + np.interp(time, moments, self.swing))

    @property
    def rotation_rate(self) -> float:
        """Antenna rate [rad/s], anticlockwise positive; 0 for a staring sensor."""
        duration = self.end_time - self.start_time
        return self.sweep / duration if self.sweep and duration > 0.0 else 0.0


@dataclass(frozen=True)
class Scan:
    """Plots in the tracking frame with their covariances, and what the sensor looked at."""

    time: Floats  # (M,) of each plot [s]
    position: Floats  # (M, d) [m]; sonar: bearing [rad]
    covariance: Floats  # (M, d, d)
    range_rate: Floats  # (M,) positive receding [m/s], NaN: not measured
    range_rate_variance: Floats  # (M,) [m^2/s^2]
    snr: Floats  # (M,) [dB], NaN: not measured
    clutter_volume: Floats  # (M,) plot-space volume of one unit of what is known of `position`
    sensor_position: Floats  # (M, 3) [m]
    sensor_velocity: Floats  # (M, 3) [m/s]
    coverage: Coverage
    volume: float  # plot space of the whole coverage, what the clutter density is per
    excess: tuple[float, float, float] = (0.0, 0.0, 0.0)  # by axis, of variances over the usual
    range_rate_interval: float = 0.0  # after which range rates come again [m/s], 0: they do not
    raised: tuple[float, float, float] = (1.0, 1.0, 1.0)  # sds over those told, by axis of sight
    is_slant: bool = False  # plots without height stand at their slant range

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True)
class Mixture:
    """One plane of every track: a Gaussian for each mode, and how likely each mode is."""

    mean: Floats  # (T, J, n)
    covariance: Floats  # (T, J, n, n)
    mode_probability: Floats  # (T, J)
    memory: Floats  # (T, k) what an estimator keeps beside; k = 0 for most

    @cached_property
    def average(self) -> Floats:
        """Mean (T, n) of the mixture."""
        return np.asarray(np.einsum('tj,tjn->tn', self.mode_probability, self.mean))

    @cached_property
    def _total_covariance(self) -> Floats:
        spread = self.mean - self.average[:, None]
        total = self.covariance + np.einsum('tjn,tjm->tjnm', spread, spread)
        return np.asarray(np.einsum('tj,tjnm->tnm', self.mode_probability, total))

    def moments(self) -> tuple[Floats, Floats]:
        """Return mean (T, n) and covariance (T, n, n) of the mixture, spread of means included."""
        return self.average, self._total_covariance

    def most_probable(self) -> tuple[Floats, Floats]:
        """Return mean (T, n) and covariance (T, n, n) of the most probable mode."""
        rows, best = np.arange(len(self.mean)), np.argmax(self.mode_probability, axis=1)
        return self.mean[rows, best], self.covariance[rows, best]

    def estimate(self, output: str) -> tuple[Floats, Floats]:
        """Return `moments` for the output 'mmse', `most_probable` for 'map'."""
        return self.moments() if output == 'mmse' else self.most_probable()


@dataclass(frozen=True)
class Tracks:
    """Every track: identity, planes, existence and what its last gate looked like."""

    id: Ints  # (T,) never reused
    time: Floats  # (T,) of the state: when the sensor last looked there [s]
    birth_time: Floats  # (T,) [s]
    planes: tuple[Mixture, ...]  # horizontal (x, vx, y, vy), vertical (z, vz); sonar: one
    existence_probability: Floats  # (T,)
    confirmed: Bools  # (T,)
    hits: Ints  # (T,) looks with a plot
    misses: Ints  # (T,) looks without one since the last one
    outside: Ints  # (T,) looks outside the coverage since the last plot, which are no misses
    history: Ints  # (T,) the last looks as bits, newest lowest, 1 = plot; none from outside
    gate_size: Floats  # (T, d) half size of the 3-sigma gate of the last look
    gate_volume: Floats  # (T,) of the chi-square gate of the last look
    nis: Floats  # (T,) normalised innovation squared of the last look, NaN: none
    doubled: Ints  # (T,) looks in a row in which it looked like a second track of a contact
    level: Floats  # (T,) usual snr of its plots [dB], NaN: not known

    def __len__(self) -> int:
        return len(self.id)

    @property
    def coasted(self) -> Ints:
        """Looks in a row without a plot (T,), whether or not the sensor could see there."""
        return self.misses + self.outside


@dataclass(frozen=True)
class Pairs:
    """Track-plot pairs inside a gate, sorted by track, then plot."""

    track: Ints  # (P,) row of the track
    plot: Ints  # (P,) row of the plot
    lag: Floats  # (P,) time of the plot after the time of the predicted track [s]

    def __len__(self) -> int:
        return len(self.track)


@dataclass(frozen=True)
class Measurement:
    """What the pairs measure of one plane: z = H x + noise."""

    value: Floats  # (P, d)
    matrix: Floats  # (P, d, n), H with the motion between track time and plot time in it
    covariance: Floats  # (P, d, d)
    absent: Ints  # (P,) number of components that this plot does not have (rows of zeros)


@dataclass(frozen=True)
class Innovations:
    """How far the pairs of one plane are from their prediction, mode by mode."""

    innovation: Floats  # (P, J, d)
    covariance: Floats  # (P, J, d, d)
    distance: Floats  # (P, J) Mahalanobis squared
    log_likelihood: Floats  # (P, J) of the plot given track and mode
    cross_covariance: Floats  # (P, J, n, d) of state and plot, P H^T
    noise: Floats  # (P, d, d) covariance R of the plot itself


@dataclass(frozen=True)
class Association:
    """How the plots are shared among the tracks."""

    probability: Floats  # (P,) posterior that this pair is right
    miss: Floats  # (T,) posterior that no plot is the track's; with its pairs it sums to 1
    approximate: Bools  # (T,) whose cluster was too large for exact marginals


@dataclass(frozen=True)
class Seeds:
    """Plots that no track claimed: the first points of tracks to come."""

    time: Floats  # (S,) [s]
    position: Floats  # (S, d)
    covariance: Floats  # (S, d, d)
    free: Floats  # (S,) chance that no known contact made the plot
    clutter_volume: Floats  # (S,) plot space in a unit of position space at the plot
    relief: Floats  # (S,) clutter density there over its mean

    def __len__(self) -> int:
        return len(self.time)
