# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How many false plots does a look give? Counted among the plots that no track explains."""

from __future__ import annotations

_MEMORY = 10.0  # looks over which the estimate is averaged
_LEAST_PLOTS = 0.5  # false plots of a look that are assumed at least: none seen is not none ever
_JUMP, _JUMP_PLOTS = 2.0, 10.0  # times the usual plus so many plots: a jump, not chance


def estimate_density(
    old: float, looks: float, unexplained: float, volume: float, share: float
) -> tuple[float, float]:
    """
    Return the clutter density after one more scan, and from how many looks it is.

    Parameters
    ----------
    old, looks : float
        Estimate so far, and from how many full looks it is.
    unexplained : float
        Sum over the plots of the chance that no track made them.
    volume : float
        Of the whole coverage in plot space.
    share : float
        Part of a full look that this scan was, in (0, 1].

    """
    usual = old * volume * share
    if unexplained > _JUMP * usual + _JUMP_PLOTS:
        looks = 0.0  # the sea got up, or a jammer went on: what was learnt is void
    looks = min(looks + share, _MEMORY)
    new = old + min(share / looks, 1.0) * (unexplained / (volume * share) - old)
    return max(new, _LEAST_PLOTS / volume), looks
