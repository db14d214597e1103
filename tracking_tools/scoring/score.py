# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""All measures of one recording at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tracking_core.rows import take
from tracking_tools.scoring.accuracy import Accuracy, plot_error, track_error
from tracking_tools.scoring.continuity import Continuity, continuity
from tracking_tools.scoring.matching import candidates, choose_pairs
from tracking_tools.scoring.records import PlotRows, TrackRows, Truth
from tracking_tools.scoring.stretches import Stretches


@dataclass(frozen=True)
class Score:
    """How well one recording was tracked."""

    continuity: Continuity
    tracks: Accuracy
    plots: Accuracy

    @property
    def gain(self) -> float:
        """Position error of the tracks per position error of the plots."""
        return self.tracks.rmse / self.plots.rmse


def score(
    rows: TrackRows,
    truth: Truth,
    plots: PlotRows,
    stretches: Stretches,
    radius: float,
    slack: float = 0.0,
    has_velocity: bool = True,
) -> Score:
    """
    Compare tracks with truth.

    Parameters
    ----------
    rows : TrackRows
        Confirmed tracks, scan by scan.
    truth : Truth
        Where the contacts were.
    plots : PlotRows
        What the tracker got, for comparison.
    stretches : Stretches
        What ought to be held, and when.
    radius : float
        Match radius [m].
    slack : float
        For so long beyond its samples a contact goes straight on [s].
    has_velocity : bool
        Whether the truth tells velocities that can be compared.

    """
    near = candidates(rows, truth, radius, slack)
    matches = choose_pairs(near, radius)
    wanted = take(matches, stretches.wanted(matches.contact, matches.scan))
    return Score(
        continuity(rows, matches, np.unique(near.track), stretches),
        track_error(rows, wanted, has_velocity),
        plot_error(plots, truth),
    )
