# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How far off may a new contact be? Mean and sd of 1 over range, which bearings do not tell."""

from __future__ import annotations

import math

_LEAST_SPREAD = 1e-6  # variance over squared mean, if the limits are all but equal


def _even_over_inverse_range(nearest: float, farthest: float) -> tuple[float, float]:
    """Return mean and sd of 1 over range [1/m] if all values between the limits are as likely."""
    near, far = 1.0 / nearest, 1.0 / farthest
    return 0.5 * (near + far), (near - far) / math.sqrt(12.0)


def _even_over_the_sea(nearest: float, farthest: float) -> tuple[float, float]:
    """Return mean and sd of 1 over range [1/m] if all places between the limits are as likely."""
    mean = 2.0 / (nearest + farthest)
    square = 2.0 * math.log(farthest / nearest) / (farthest**2 - nearest**2)
    return mean, math.sqrt(max(square - mean**2, _LEAST_SPREAD * mean**2))


RANGE_PRIORS = {'inverse': _even_over_inverse_range, 'sea': _even_over_the_sea}
