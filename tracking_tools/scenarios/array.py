# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does a passive linear array hear? A fan of beams in noise, and the marks on its peaks.

Two contacts in one beam make one peak: marks merge by themselves, there is no rule for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
import math

import numpy as np

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.linalg import nearest_turn

_OCTAVE = np.exp2(np.linspace(-0.5, 0.5, 33))  # frequencies over the middle one
_REFERENCE_RANGE = 5000.0  # [m]
_PEAK_CURVATURE = 2.337  # of the lobe's top, as in the reported sd
_SD_FACTOR = 1.5


@dataclass(frozen=True)
class LinearArray:
    """
    A cosine-shaded line array; bearings are angles from its axis, 0 ahead to pi astern.

    References
    ----------
    The array of scenario V-0: METHODS of [VORONINA19].

    """

    beam_width: float = math.radians(1.6)
    """Half-power width at broadside; it grows as 1 / sin(bearing) [rad]."""
    beams_per_width: float = 5.0
    limits: tuple[float, float] = (math.radians(10.0), math.radians(170.0))
    """First and last beam [rad]."""
    threshold: float = 3.0
    """Least height of a mark, in sds of the noise of a beam."""
    height: float = 45.0
    """Of the peak of a contact of level 0 dB at 5 km, in sds of the noise."""
    fluctuation: float = 2.0
    """Sd of the levels from cycle to cycle [dB]."""
    period: float = 2.0
    """Of a cycle [s]."""
    side: float = -1.0
    """-1: contacts are heard as to starboard, 1: to port; the array cannot tell."""

    @cached_property
    def cosines(self) -> Floats:
        """Directions of the beams, (B,) even in the cosine of the bearing."""
        first, last = math.cos(self.limits[0]), math.cos(self.limits[1])
        step = self.beam_width / self.beams_per_width
        return np.linspace(first, last, round((first - last) / step) + 1)

    def pattern(self, offset: Floats) -> Floats:
        """Return the power pattern at offsets in the cosine, averaged over an octave."""
        return _octave_pattern(offset * (2.0 * _half_power_offset() / self.beam_width))

    @cached_property
    def _mixing(self) -> Floats:
        """Root (B, B) of the covariance of the noise, which is that of the pattern."""
        apart = self.cosines[:, None] - self.cosines[None, :]
        values, vectors = np.linalg.eigh(self.pattern(apart))
        return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))

    def lobes(self, bearing: Floats) -> Floats:
        """Return what contacts at bearings (K, C) of height 1 give in the beams (C, K, B)."""
        offset = self.cosines[None, None] - np.cos(bearing.T)[..., None]
        return np.stack([self.pattern(one) for one in offset]) if len(offset) else offset

    def listen(self, lobes: Floats, height: Floats, rng: np.random.Generator) -> Floats:
        """
        Return the outputs of all beams.

        Parameters
        ----------
        lobes : (C, K, B) array
            Of C contacts in K cycles, see `lobes`.
        height : (K, C) array
            Of their peaks.
        rng : Generator
            For the noise.

        Returns
        -------
        (K, B) array

        """
        output = rng.standard_normal((len(height), len(self.cosines))) @ self._mixing.T
        for column, lobe in enumerate(lobes):  # contacts: few
            output += height[:, column, None] * lobe
        return output

    def heights(self, distance: Floats, level: Floats, rng: np.random.Generator) -> Floats:
        """Return the peaks (K, C) of contacts at distances (K, C) [m] with levels (C,) [dB]."""
        decibel = level + self.fluctuation * rng.standard_normal(distance.shape)
        return self.height * 10.0 ** (decibel / 10.0) * (_REFERENCE_RANGE / distance) ** 2

    def marks(self, output: Floats) -> tuple[Ints, Floats, Floats]:
        """
        Find the peaks.

        Parameters
        ----------
        output : (K, B) array
            Of the beams.

        Returns
        -------
        cycle, bearing, snr : (M,) arrays
            In order of the cycle; bearing from the axis [rad], height of the peak.

        """
        cycle, beam = np.nonzero(self._is_peak(output))
        beam = beam + 1
        before, top, after = (output[cycle, beam + step] for step in (-1, 0, 1))
        bend = before - 2.0 * top + after
        shift = 0.5 * (before - after) / bend
        step = self.cosines[1] - self.cosines[0]
        cosine = self.cosines[beam] + shift * step
        return cycle, np.arccos(cosine), top - 0.25 * (before - after) * shift

    def _is_peak(self, output: Floats) -> Bools:
        inner = output[:, 1:-1]
        higher = (inner > output[:, :-2]) & (inner >= output[:, 2:])
        return np.asarray(higher & (inner > self.threshold))

    def reported_sd(self, bearing: Floats, snr: Floats) -> Floats:
        """Return the sd that the array reports for its marks [rad]."""
        return np.asarray(_SD_FACTOR * self.beam_width / (_PEAK_CURVATURE * snr * np.sin(bearing)))

    def from_axis(self, relative: Floats) -> Floats:
        """Return the angle from the axis [rad] of bearings in sensor axes, either side."""
        return np.abs(nearest_turn(relative, np.zeros(1)))


def _octave_pattern(x: Floats) -> Floats:
    """Return the mean power over an octave of a cosine-shaded line; x in wave lengths."""
    flat = np.asarray(x)[..., None] * _OCTAVE
    pole = np.abs(np.abs(flat) - 0.5) < 1e-6
    safe = np.where(pole, 0.0, flat)
    amplitude = np.where(pole, 0.25 * np.pi, np.cos(np.pi * safe) / (1.0 - 4.0 * safe**2))
    return np.asarray((amplitude**2).mean(axis=-1))


def _half_power_offset() -> float:
    """Return the x at which the pattern is half its top."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _octave_pattern(np.array(middle)) > 0.5 else (low, middle)
    return 0.5 * (low + high)
