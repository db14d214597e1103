# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How likely is a plot of a contact that gives fewer than usual?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.detection import detection_probability, lengths, ones

USUAL, INTERVAL, SD = 0.9, 4.0, 50.0  # [1], [s], [m]
SITE = {
    'scan.assembly': 'snapshot', 'sensor.position_sd': SD, 'sensor.detection_probability': USUAL,
    'sensor.range_max': 50e3, 'motion.horizontal.acceleration_sd': [0.5, 5.0],
    'initiation.speed_max': 300.0, 'existence.new_contacts': 1.0,
}  # fmt: skip


def play(detection: float, looks: int, seed: int) -> tuple[list[int], int]:
    """Return the ids that one straight contact had, and for how many looks one outlived it."""
    rng, ids = np.random.default_rng(seed), []
    tracker = RadarTracker(with_values(RadarTrackerConfig(), SITE))
    for look in range(looks + 60):
        chance = 1.0 if look < 6 else detection
        seen = look < looks and rng.random() < chance
        own = np.array([[150.0 * INTERVAL * look - 20e3, 8e3]])[: int(seen)]
        position = own + rng.normal(0.0, SD, own.shape)
        plots = Plots.cartesian(np.full(len(own), INTERVAL * look), position)
        tracks = tracker.track(replace(plots, stamp=INTERVAL * look))
        ids.extend(tracks.id[tracks.confirmed].tolist())
        if look >= looks and not tracks.confirmed.any():
            return sorted(set(ids)), look - looks
    raise AssertionError('it is followed for ever')


def test_weak_contact_keeps_its_track() -> None:
    """Seen in half of the looks, told 0.9: five misses in a row come once in a minute or two."""
    ids = [play(0.5, 60, seed)[0] for seed in range(10)]
    assert np.mean([len(of_run) == 1 for of_run in ids]) >= 0.8


def test_contact_that_was_seen_as_usual_is_let_go_as_soon_as_usual() -> None:
    """What is learnt of a contact takes looks: a track whose contact is gone does not live on."""
    assert max(play(0.95, 50, seed)[1] for seed in range(5)) <= 6


def test_detection_probability_follows_from_the_looks_that_are_remembered() -> None:
    """One miss says nothing yet, four of six do; within two thirds of usual and usual."""
    start = RadarTracker(with_values(RadarTrackerConfig(), SITE)).tracks
    history = [0b11, 0b110000, (1 << 60) - 1, 0b1010101010]
    tracks = replace(start, history=np.array(history), hits=np.array([2, 2, 70, 40]))
    usual, nothing = np.full(4, USUAL), np.zeros(4)
    found = detection_probability(tracks, usual, nothing)
    assert_allclose(found, [0.9, 12.0 / 16.0, 0.9, 0.6])  # the last one is full
    assert_allclose(detection_probability(tracks, nothing, nothing), 0.0)  # outside the coverage


def test_looks_count_little_among_strange_plots() -> None:
    """Two of six, with no strange plots in the gate, a tenth of one, and many."""
    start = RadarTracker(with_values(RadarTrackerConfig(), SITE)).tracks
    tracks = replace(start, history=np.full(3, 0b110000), hits=np.full(3, 2))
    found = detection_probability(tracks, np.full(3, USUAL), np.array([0.0, 0.1, 1e9]))
    assert_allclose(found, [12.0 / 16.0, 11.0 / 13.0, 0.9])


@pytest.mark.parametrize('bits', [0, 1, 0b1011, (1 << 60) - 1])
def test_ones_counts_set_bits(bits: int) -> None:
    """One by one, whichever row of the memory they are in."""
    assert_array_equal(ones(np.array([bits, 1, bits])), [bits.bit_count(), 1, bits.bit_count()])


@pytest.mark.parametrize('bits', [0, 1, 0b1011, (1 << 54) - 1, (1 << 60) - 1, 1 << 59])
def test_lengths_counts_from_the_first_set_bit(bits: int) -> None:
    """Also where a number has more bits than a float."""
    assert_array_equal(lengths(np.array([bits, 1])), [bits.bit_length(), 1])
