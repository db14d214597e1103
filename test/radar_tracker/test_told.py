# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots that tell more noise than the parameters say keep their tracks, and hurt no other."""

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.told import excess, MOST
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

CONTACTS = np.array([[5000.0, 1000.0], [-4000.0, 3000.0], [2000.0, -6000.0], [-3000.0, -3000.0]])
VALUES = {
    'sensor.range_sd': 10.0, 'sensor.azimuth_sd': 0.001, 'scan.assembly': 'snapshot',
    'motion.horizontal.acceleration_sd': [0.05, 1.0],
}  # fmt: skip


def test_plots_that_tell_ten_times_the_noise_keep_their_tracks():
    """The range sd is ten times the parameter, and told: no look is lost, nobody starts anew."""
    rng, radar = np.random.default_rng(1), RadarTracker(with_values(RadarTrackerConfig(), VALUES))
    azimuth, misses = np.arctan2(CONTACTS[:, 1], CONTACTS[:, 0]), []
    for scan in range(150):
        plots = Plots.polar(
            np.full(4, 2.5 * scan),
            np.hypot(*CONTACTS.T) + rng.normal(0.0, 100.0, 4),
            azimuth + rng.normal(0.0, 1e-3, 4),
            range_sd=np.full(4, 100.0),
        )
        tracks = radar.track(plots)
        if scan >= 30:
            misses.append(tracks.misses[tracks.confirmed] > 0)
    assert tracks.id.max() == 4  # 17 with boxes for the parameter's noise
    assert np.concatenate(misses).mean() < 0.01  # 12 % with these


@pytest.mark.parametrize(
    ('told', 'more'),
    [(1.0, 0.0), (0.25, 0.0), (4.0, 3.0), (1e30, MOST - 1.0), (np.inf, MOST - 1.0)],
)
def test_excess_is_what_is_told_beyond_the_usual_and_bounded(told, more):
    """Less is no excess, absurd noise opens no gate without end, an unknown height counts not."""
    usual = np.tile(np.diag([100.0, 400.0, 25.0]), (3, 1, 1))
    covariance = usual.copy()
    covariance[1, 0, 0] *= told
    usual[2, 2, 2] = np.nan
    assert excess(covariance, usual) == pytest.approx((100.0 * more, 0.0, 0.0))
    assert excess(covariance[:0], usual[:0]) == (0.0, 0.0, 0.0)
