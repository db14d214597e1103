# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots of one contact are found among others, however wrong their noise is told."""

from __future__ import annotations

import numpy as np
import pytest

from tracking_core.chains import chains
from tracking_core.space import POINTS

LOOKS, PERIOD, SIDE, SPEED = 9, 4.0, 100e3, 300.0  # [s], [m], [m/s]


def scene(contacts, false, noise=1000.0, told=100.0, seed=1, side=SIDE):
    """Return the chain and the contact, -1 where it is false, of all plots of some looks."""
    rng = np.random.default_rng(seed)
    time, place, who = np.zeros(0), np.zeros((0, 2)), np.zeros(0, int)
    start, velocity = (
        rng.uniform(0.0, side, (contacts, 2)),
        rng.uniform(-150.0, 150.0, (contacts, 2)),
    )
    for look in range(LOOKS):
        seen = np.flatnonzero(rng.random(contacts) < 0.9)
        real = (
            start[seen] + PERIOD * look * velocity[seen] + rng.normal(0.0, noise, (len(seen), 2))
        )
        clutter = rng.uniform(0.0, side, (rng.poisson(false), 2))
        place = np.concatenate([place, real, clutter])
        who = np.concatenate([who, seen, np.full(len(clutter), -1)])
        time = np.append(time, np.full(len(real) + len(clutter), PERIOD * look))
    variance = np.full_like(place, told**2)
    return chains(time, place, variance, PERIOD, SPEED, POINTS), who


def test_plots_of_a_contact_are_in_a_chain():
    """Noise ten times as large as told parts none; nearly all in chains are of contacts."""
    chain, who = scene(contacts=12, false=8)
    assert (chain > 0)[who >= 0].mean() > 0.6
    assert (who[chain > 0] >= 0).mean() > 0.9
    assert len(np.unique(chain[chain > 0])) < 36  # each goes on until its contact is missed


def test_two_contacts_are_believed_nothing():
    """They may turn all the time; three are enough."""
    assert not scene(contacts=2, false=5)[0].any()
    assert scene(contacts=4, false=5)[0].any()


@pytest.mark.parametrize('false', [5, 20, 60, 200])
def test_false_plots_make_no_chains(false):
    """However many: what two looks have near each other by chance one look has as well."""
    assert not any(scene(contacts=0, false=false, seed=seed)[0].any() for seed in range(20))


def test_a_crowd_makes_no_chains():
    """Where each may be followed by several nothing can be told."""
    assert not scene(contacts=20, false=0, side=10e3)[0].any()


def test_no_plots_are_in_no_chain():
    """Nor is there anything to divide by."""
    nothing = np.zeros((0, 2))
    assert len(chains(nothing[:, 0], nothing, nothing, PERIOD, SPEED, POINTS)) == 0
