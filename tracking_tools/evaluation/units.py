# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""In which units figures are shown to people."""

from __future__ import annotations

from dataclasses import dataclass
import math

TELLING = 3  # figures, and at most as many after the point


@dataclass(frozen=True)
class Unit:
    """Of a distance and of how fast it changes."""

    place: str
    motion: str
    scale: float
    far_unit: str
    fast_unit: str
    digits: int

    def far(self, value: float) -> str:
        """Return a distance with its unit."""
        return _telling(value * self.scale, self.digits, self.far_unit)

    def fast(self, value: float) -> str:
        """Return a speed with its unit."""
        return _telling(value * self.scale, self.digits + 1, self.fast_unit)


def _telling(value: float, digits: int, unit: str) -> str:
    """Return a figure with three that tell, or with `digits` after the point, if that is more."""
    small = math.isfinite(value) and value != 0.0
    telling = TELLING - 1 - math.floor(math.log10(abs(value))) if small else 0
    return in_words(value, max(digits, min(TELLING, telling)), unit)


def in_words(value: float, digits: int, unit: str) -> str:
    """Return a figure with its unit, or that there is none."""
    return f'{value:.{digits}f} {unit}' if math.isfinite(value) else 'none'


def percent(share: float, digits: int) -> str:
    """Return a share in percent, or that there is none."""
    return f'{share:.{digits}%}' if math.isfinite(share) else 'none'


UNITS = {
    'radar': Unit('position', 'velocity', 1.0, 'm', 'm/s', 1),
    'sonar': Unit('bearing', 'bearing rate', math.degrees(1.0), 'deg', 'deg/s', 3),
}
