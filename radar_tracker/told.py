# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What noise do plots tell, and how much less sure are they than the parameters say?"""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Plots

NOTHING = (0.0, 0.0, 0.0)
MOST = 100.0  # times the expected variance; a plot that tells more opens no gate for others


def tell_noise(plots: Plots, is_polar: bool) -> bool:
    """Return whether any plot, polar or Cartesian, tells its own noise."""
    polar = (plots.range_sd, plots.azimuth_sd, plots.elevation_sd)
    told = polar if is_polar else (plots.position_covariance,)
    return any(np.isfinite(values).any() for values in told)


def sd_or(sd: Floats, usual: float) -> Floats:
    """Return the sds (M,) that plots tell, the usual one where they tell none that can be true."""
    return np.where(np.isfinite(sd) & (sd > 0.0), sd, usual)


def excess(covariance: Floats, expected: Floats) -> tuple[float, float, float]:
    """
    Return by how much variances exceed those expected at most, on each axis [m^2].

    Parameters
    ----------
    covariance, expected : (M, d, d) arrays
        Of plots, as they tell it and as the sensor's parameters have it [m^2].

    """
    usual = np.einsum('mdd->md', expected)
    more = np.minimum(np.einsum('mdd->md', covariance), MOST * usual) - usual
    most = np.zeros(3)
    most[: more.shape[1]] = np.fmax.reduce(more, axis=0, initial=0.0)
    x, y, z = most.tolist()
    return x, y, z
