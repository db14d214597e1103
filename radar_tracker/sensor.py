# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does the radar measure, where does it look, and how sure is it?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from radar_tracker import mounting
from radar_tracker.conversion import to_cartesian, to_polar
from radar_tracker.platform_doubt import platform_noise, PlatformDoubt
from radar_tracker.plot_space import of_plots, space_per_metre
from radar_tracker.resolving import limits, reach
from radar_tracker.sensor_config import SensorConfig
from radar_tracker.told import excess, NOTHING, sd_or, tell_noise
from tracking_core.batches import Coverage, Floats, Plots, Scan
from tracking_core.linalg import wrap_angle
from tracking_core.platform_pose import PlatformPose
from tracking_core.space import POINTS, Space

_LEAST_DEPTH = 1.0  # m, of plot space: the only plot so far may lie at `range_min`


@dataclass(frozen=True)
class Radar:
    """Measurement model of one radar, in the tracking frame."""

    config: SensorConfig
    dimensions: int  # 2 or 3
    is_polar: bool
    doubt: PlatformDoubt | None = None  # of the platform, in the message at hand
    raised: tuple[float, float, float] = (1.0, 1.0, 1.0)  # sds of range, azimuth, ... over told
    coarsest: float = np.inf  # no parameter can tell more noise in range or position [m]

    @staticmethod
    def for_plots(config: SensorConfig, plots: Plots) -> Radar:
        """Return the radar that these plots come from, by the columns that they have."""
        is_polar = bool(np.isfinite(plots.range).any())
        height = plots.elevation if is_polar else plots.position[:, 2]
        dimensions = config.dimensions or (3 if np.isfinite(height).any() else 2)
        return Radar(config, dimensions, is_polar)

    @property
    def space(self) -> Space:
        """Plots are points."""
        return POINTS

    @property
    def detection_probability(self) -> float:
        """P_D."""
        return self.config.detection_probability

    @property
    def range_rate_density(self) -> float:
        """Density of the range rates of false plots [s/m]."""
        return 1.0 / (self.config.range_rate_interval or 2.0 * self.config.range_rate_max)

    def plot_space_volume(self, range_max: Floats | float) -> Any:
        """Return the volume of plot space out to a range [m]: m rad, m rad^2, m^2 or m^3."""
        c = self.config
        range_max = np.maximum(range_max, c.range_min + _LEAST_DEPTH)
        depth = range_max - c.range_min
        height = c.elevation_span if self.dimensions == 3 else 1.0
        if self.is_polar:
            return depth * c.sector_width * height
        power = self.dimensions
        return c.sector_width * height * (range_max**power - c.range_min**power) / power

    def noise(self, position: Floats, coverage: Coverage) -> Floats:
        """Return the plot covariance (T, d, d) expected at positions (T, d) [m^2]."""
        offset = position - np.array(coverage.sensor_position)[: self.dimensions]
        own = self._own_noise(offset)
        return own if self.doubt is None else own + self.doubt.noise(offset)

    def _own_noise(self, offset: Floats) -> Floats:
        """Return what the radar itself does not know (T, d, d) at offsets (T, d) from it [m^2]."""
        d, c = self.dimensions, self.config
        if not self.is_polar:
            R = (self.raised[0] * min(c.position_sd, self.coarsest)) ** 2 * np.eye(d)
            return np.broadcast_to(R, (len(offset), d, d))
        range_sd = min(c.range_sd, self.coarsest)
        usual = np.array(self.raised) * [range_sd, c.azimuth_sd, c.elevation_sd]
        sd = np.broadcast_to(usual[:d], offset.shape)
        return to_cartesian(to_polar(offset), sd)[1]

    def clutter_volume(self, position: Floats, coverage: Coverage) -> Floats:
        """Return plot space per m^d (T,) at positions (T, d): 1/r, 1/(r^2 cos elevation) or 1."""
        offset = position - np.array(coverage.sensor_position)[: self.dimensions]
        return space_per_metre(offset, self.is_polar)

    def separation(self, first: Floats, second: Floats, coverage: Coverage) -> Floats:
        """
        Return how far contacts are apart in units of the resolution limit (P, d).

        Parameters
        ----------
        first, second : (P, d) arrays
            Positions [m]; a height that is not known, NaN, keeps nobody apart.
        coverage : Coverage
            Of the look, with the place of the sensor.

        """
        origin = np.array(coverage.sensor_position)[: self.dimensions]
        one, other = to_polar(first - origin), to_polar(_or_like(second, first) - origin)
        apart = other - one
        apart[:, 1] = wrap_angle(apart[:, 1])
        return np.asarray(apart / limits(self.config, one))

    def reach(self, position: Floats, coverage: Coverage) -> Floats:
        """Return half size (T, d) [m] of the box of all that may be one plot with a contact."""
        polar = to_polar(position - np.array(coverage.sensor_position)[: self.dimensions])
        return reach(self.config, polar)

    def measure(self, plots: Plots, pose: PlatformPose, coverage: Coverage, volume: float) -> Scan:
        """
        Bring plots from sensor axes into the tracking frame.

        Parameters
        ----------
        plots : Plots
            M plots.
        pose : PlatformPose
            Platform at the times of the plots.
        coverage : Coverage
            What the message looked at.
        volume : float
            Plot space of the whole coverage.

        """
        d = self.dimensions
        local, covariance = self._local(plots)
        rotation, origin = mounting.sensor_pose(pose, self.config.mount)
        offset = local
        if rotation is not None:
            rotation = rotation if d == 3 else mounting.levelled(rotation, local)
            offset = np.einsum('mij,mj->mi', rotation, local, order='F')
            covariance = rotation @ covariance @ np.swapaxes(rotation, 1, 2)
        position = offset + origin
        covariance = covariance + platform_noise(pose, offset)
        unknown = np.zeros(len(plots), bool)
        if d == 3:
            unknown = np.isnan(plots.elevation if self.is_polar else plots.position[:, 2])
            position[unknown, 2] = np.nan
        position, covariance = position[:, :d], covariance[:, :d, :d]
        told = tell_noise(plots, self.is_polar)
        return Scan(
            time=plots.time,
            position=position,
            covariance=covariance,
            range_rate=plots.range_rate,
            range_rate_variance=sd_or(plots.range_rate_sd, self.config.range_rate_sd) ** 2,
            snr=plots.snr,
            clutter_volume=of_plots(
                local[:, :d], unknown, self.is_polar, self.config.elevation_span
            ),
            sensor_position=origin,
            sensor_velocity=pose.velocity + mounting.arm_velocity(pose, self.config.mount),
            coverage=coverage,
            volume=volume,
            range_rate_interval=self.config.range_rate_interval,
            excess=excess(covariance, self.noise(position, coverage)) if told else NOTHING,
            raised=self.raised,
            is_slant=self.is_polar and d == 3,
        )

    def _local(self, plots: Plots) -> tuple[Floats, Floats]:
        """Return position (M, 3) and covariance (M, 3, 3) in sensor axes."""
        c, M, d = self.config, len(plots), self.dimensions
        if not self.is_polar:
            usual = min(c.position_sd, self.coarsest) ** 2 * np.eye(3)
            covariance = self.raised[0] ** 2 * _or_like(plots.position_covariance, usual)
            return _or_like(plots.position, np.zeros(3)), covariance
        polar = np.stack([plots.range, plots.azimuth, np.nan_to_num(plots.elevation)], axis=1)
        sd = np.empty((M, 3))
        sd[:, 0] = sd_or(plots.range_sd, min(c.range_sd, self.coarsest))
        sd[:, 1] = sd_or(plots.azimuth_sd, c.azimuth_sd)
        sd[:, 2] = sd_or(plots.elevation_sd, c.elevation_sd)
        sd *= self.raised
        position, covariance = np.zeros((M, 3), order='F'), np.zeros((M, 3, 3), order='F')
        covariance[:, 2, 2] = 1.0
        position[:, :d], covariance[:, :d, :d] = to_cartesian(polar[:, :d], sd[:, :d])
        return position, covariance


def _or_like(values: Floats, others: Floats) -> Floats:
    """Return the values, those of the others where there are none."""
    return np.where(np.isnan(values), others, values)
