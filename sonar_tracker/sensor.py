# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does the sonar measure, where does it listen, and how sure is it?"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sonar_tracker.levelling import from_horizon, to_horizon
from sonar_tracker.sensor_config import SensorConfig
from tracking_core.batches import Bearings, Coverage, Floats, Scan
from tracking_core.linalg import wrap_angle
from tracking_core.platform_pose import PlatformPose
from tracking_core.rows import take
from tracking_core.space import ANGLES, Space

_LEAST_SINE = 0.05  # a linear array hears nothing of use nearer to its axis than 3 degrees


@dataclass(frozen=True)
class Sonar:
    """Measurement model of one sonar; plots are bearings in tracking axes."""

    config: SensorConfig
    usual_sd: float = 0.0  # that marks tell, 0: as configured [rad]
    heading_sd: float = 0.0  # of own ship, at most [rad]
    raised: float = 1.0  # sds of marks over those told, as they are found to be

    @property
    def dimensions(self) -> int:
        """One: the bearing."""
        return 1

    @property
    def space(self) -> Space:
        """Bearings are angles."""
        return ANGLES

    @property
    def detection_probability(self) -> float:
        """P_D."""
        return self.config.detection_probability

    @property
    def range_rate_density(self) -> float:
        """1: a sonar has no range rates."""
        return 1.0

    def noise(self, position: Floats, coverage: Coverage) -> Floats:
        """Return the variance (T, 1, 1) expected at bearings (T, 1) [rad^2]."""
        sd = np.full(position.shape, self.usual_sd)
        if not self.usual_sd:
            sd = self.raised * self.config.bearing_sd * self._blur(position - self._axis(coverage))
        return np.asarray(sd[:, :, None] ** 2 + self.heading_sd**2)

    def plot_space_volume(self, range_max: Floats) -> Floats:
        """Return the sector (K,) [rad], which is at no distance, for distances (K,) above 0."""
        return np.where(range_max > 0.0, self.config.sector_width, 0.0)

    def clutter_volume(self, position: Floats, coverage: Coverage) -> Floats:
        """Return 1 (T,): plots are bearings already."""
        return np.ones(len(position))

    def separation(self, first: Floats, second: Floats, coverage: Coverage) -> Floats:
        """
        Return how far contacts are apart in units of the resolution limit (P, 1).

        Parameters
        ----------
        first, second : (P, 1) arrays
            Bearings [rad].
        coverage : Coverage
            Of the look, whose sector is about the broadside of a linear array.

        """
        apart = wrap_angle(second - first)
        if self._is_linear:
            middle = first + 0.5 * apart - self._axis(coverage)
            # The difference of the cosines, 2 sin(middle) sin(apart / 2).
            apart = 2.0 * np.abs(np.sin(middle)) * np.sin(0.5 * apart)
        return np.asarray(apart / self.config.bearing_resolution)

    def reach(self, position: Floats, coverage: Coverage) -> Floats:
        """Return from what distance (T, 1) on nothing is one mark with a contact here [rad]."""
        return self.config.bearing_resolution * self._blur(position - self._axis(coverage))

    def _blur(self, bearing: Floats) -> Floats:
        """Return how much wider a beam is at these angles from the axis than at broadside."""
        if not self._is_linear:
            return np.ones_like(bearing)
        return np.asarray(1.0 / np.maximum(np.abs(np.sin(bearing)), _LEAST_SINE))

    def _axis(self, coverage: Coverage) -> float:
        return coverage.sector_centre - self.config.sector_centre

    @property
    def _is_linear(self) -> bool:
        return self.config.array == 'linear'

    def in_sensor_axes(self, marks: Bearings, pose: PlatformPose) -> Bearings:
        """Return marks whose bearings are those on the horizon, in tracking axes."""
        yaw = self.config.mount.yaw
        return replace(marks, bearing=from_horizon(marks.bearing, pose, yaw, self._is_linear))

    def measure(self, marks: Bearings, pose: PlatformPose, coverage: Coverage) -> Scan:
        """
        Bring marks from sensor axes into tracking axes.

        Parameters
        ----------
        marks : Bearings
            M marks.
        pose : PlatformPose
            Platform at the times of the marks.
        coverage : Coverage
            What the cycle listened to.

        """
        M = len(marks)
        bearing = to_horizon(marks.bearing, pose, self.config.mount.yaw, self._is_linear)
        variance = self.mark_sd(marks) ** 2 + pose.yaw_variance
        position = bearing[:, None]
        unsure = variance - self.noise(position, coverage)[:, 0, 0]
        return Scan(
            time=marks.time,
            position=position,
            covariance=variance[:, None, None],
            range_rate=np.full(M, np.nan),
            range_rate_variance=np.ones(M),
            snr=marks.snr,
            clutter_volume=np.ones(M),
            sensor_position=pose.position,
            sensor_velocity=pose.velocity,
            coverage=coverage,
            volume=self.config.sector_width,
            excess=(float(unsure.max(initial=0.0)), 0.0, 0.0),
            raised=(self.raised, 1.0, 1.0),
        )

    def listen(self, pose: PlatformPose, start: float, end: float) -> Coverage:
        """
        Return what a cycle listens to, in the tracking frame.

        Parameters
        ----------
        pose : PlatformPose
            One, in the middle of the cycle.
        start, end : float
            Times of its first and last mark [s].

        """
        sensor, mount = self.config, self.config.mount
        (heading,), ((x, y, z),) = pose.yaw.tolist(), pose.position.tolist()
        cos, sin = np.cos(heading), np.sin(heading)
        return Coverage(
            start_time=start,
            end_time=end,
            sensor_position=(
                float(x + cos * mount.x - sin * mount.y),
                float(y + sin * mount.x + cos * mount.y),
                z,
            ),
            sensor_velocity=tuple(pose.velocity[0].tolist()),
            sector_centre=heading + mount.yaw + sensor.sector_centre,
            sector_width=sensor.sector_width,
        )

    def heard(self, marks: Bearings) -> Bearings:
        """Return the marks, on both sides of the axis if they count there."""
        if not self.config.both_sides:
            return marks
        twice = take(marks, np.arange(len(marks)).repeat(2))
        side = np.tile([1.0, -1.0], len(marks))
        return replace(twice, bearing=side * twice.bearing)

    def mark_sd(self, marks: Bearings) -> Floats:
        """
        Return the sd of each mark (M,) [rad].

        As it tells, or else by the parameter, and raised where contacts' marks are scattered more.
        """
        told = np.isfinite(marks.bearing_sd) & (marks.bearing_sd > 0.0)
        sd = np.where(told, marks.bearing_sd, self.config.bearing_sd * self._blur(marks.bearing))
        return self.raised * np.maximum(sd, self.config.bearing_sd_min)
