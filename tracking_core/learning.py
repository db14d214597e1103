# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does a scan teach about clutter? Its plots that no track explains are false ones."""

from __future__ import annotations

import numpy as np

from tracking_core.batches import Floats, Scan, Tracks
from tracking_core.clutter import Clutter
from tracking_core.composition import Setup
from tracking_core.rows import take
from tracking_core.state import State
from tracking_core.unresolved.sets import places_of
from tracking_core.update import Look


def learn_clutter(
    state: State, scan: Scan, seen: Look, used: Floats, kept: Tracks, setup: Setup
) -> Clutter:
    """
    Return what is known of false plots after a scan.

    Parameters
    ----------
    state : State
        Before the scan.
    scan : Scan
        M plots.
    seen : Look
        What became of them.
    used : (M,) array
        Chance of each that a new track explains it.
    kept : Tracks
        That live on.
    setup : Setup
        Of the tracker. If it tells the density, nothing is learnt.

    """
    if setup.clutter_density:
        return state.clutter
    unexplained = ((1.0 - seen.claimed).clip(0.0) - used).clip(0.0)
    clutter = state.clutter.learn(scan, unexplained, ~seen.waiting, setup.sensor)
    sure_before = np.isin(kept.id, state.tracks.id[state.tracks.confirmed])
    new = kept.confirmed & ~sure_before
    if not new.any():
        return clutter
    found = take(kept, new)
    places = places_of(setup.planes, found.planes, setup.sensor.dimensions).mean
    return clutter.without(places, found.hits, scan.coverage, setup.sensor)
