# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a tracker remember from scan to scan, and what does it tell of the last one?"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from tracking_core.batches import Floats, Ints, Scan, Seeds, Tracks
from tracking_core.clutter import Clutter
from tracking_core.scatter import Scatter


@dataclass(frozen=True)
class StepReport:
    """What the last step did, for diagnostics."""

    plots: int = 0  # used in this step
    held: int = 0  # kept for the next scan: their antenna pass is not over
    pairs: int = 0
    approximate: int = 0  # tracks in clusters too large for exact marginals
    started: int = 0
    merged: int = 0
    refused: int = 0  # new tracks that did not fit in max_tracks
    broken: int = 0  # tracks dropped because a covariance was not positive definite
    silent: int = 0  # tracks and first plots that nobody looked at for too long (longest_pause)
    clutter_density: float = 0.0  # per unit of plot space, as used; the mean
    densest_clutter: float = 0.0  # where plots are that no track claims, as used
    deleted: Ints = field(default_factory=lambda: np.zeros(0, np.int64))  # (D,) ids


@dataclass(frozen=True)
class State:
    """All that a tracker remembers; saving it saves the tracker."""

    tracks: Tracks
    seeds: Seeds
    clutter: Clutter
    scatter: Scatter
    held: Scan | None = None  # plots whose antenna pass was not over
    next_id: int = 1
    leniency: float = 1.0  # tentative tracks may be so much less likely than usual
    time: float = -np.inf  # end of the last scan [s]
    steps: Floats = field(default_factory=lambda: np.zeros(0))  # (N,) of the last scans [s]
    report: StepReport = field(default_factory=StepReport)
