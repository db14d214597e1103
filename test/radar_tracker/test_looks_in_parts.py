# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A look everywhere that comes in several messages, as one plot each, is tracked as in one."""

from __future__ import annotations

from dataclasses import replace
import logging

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.rows import take

typesys = pytest.importorskip('rosbags.typesys')
STORE = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
message_types = pytest.importorskip('msg_adapters.message_types')
TYPES = message_types.rosbags_types()
PERIOD, LOOKS, CONTACTS, SD = 1.0, 40, 4, 1.0  # [s], [m]
SITE = {
    'scan.assembly': 'snapshot', 'sensor.position_sd': SD, 'sensor.range_max': 1000.0,
    'sensor.dimensions': 2, 'initiation.speed_max': 20.0,
}  # fmt: skip


def whole(look: int) -> Plots:
    """Return what a look sees: most of four contacts that drift apart."""
    rng = np.random.default_rng(look)
    place = np.array([[100.0, 50.0, 0.0], [-80.0, 90.0, 0.0], [-60.0, -120.0, 0.0], [90, -70, 0]])
    place = place * (1.0 + 0.01 * look) + SD * rng.standard_normal(place.shape)
    seen, stamp = rng.random(CONTACTS) < 0.95, 1000.0 + PERIOD * look
    plots = Plots.cartesian(np.full(CONTACTS, stamp), place)
    return replace(take(plots, seen), stamp=stamp)


def parts(plots: Plots, step: float) -> list[Plots]:
    """Return messages of one plot each, a step of time apart [s]."""
    single = [take(plots, slice(k, k + 1)) for k in range(len(plots))]
    return [replace(one, stamp=one.stamp + step * k) for k, one in enumerate(single)]


def tracker(period: float = 0.0) -> RadarTracker:
    """Return a tracker whose looks come in parts, or whole."""
    return RadarTracker(with_values(RadarTrackerConfig(), {**SITE, 'scan.period': period}))


def test_looks_of_one_plot_each_have_the_tracks_of_whole_ones() -> None:
    """Taken for looks of their own they would have none; a look is used when the next begins."""
    one, other = tracker(), tracker(0.9 * PERIOD)
    for look in range(LOOKS):
        if look < LOOKS - 1:
            one.track(whole(look))
        for part in parts(whole(look), 0.1):
            other.track(part)
    assert one.tracks.confirmed.sum() == CONTACTS
    assert_array_equal(other.tracks.id, one.tracks.id)
    found, expected = (t.tracks.planes[0].estimate('mmse')[0] for t in (other, one))
    assert_allclose(found, expected, atol=0.1)


def test_going_back_takes_back_parts() -> None:
    """What was collected after a moment that is gone back to is not there."""
    late = tracker(0.9 * PERIOD)
    first, second, *_ = parts(whole(0), 0.1)
    late.track(first)
    memory = late.save()
    late.track(second)
    late.restore(memory)
    late.track(whole(1))
    assert late.state.report.plots == 1


def position(place: np.ndarray, stamp: float):
    """Return the message of one plot."""
    x, y, z = place.tolist()
    turn = TYPES.Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    pose = TYPES.Pose(position=TYPES.Point(x=x, y=y, z=z), orientation=turn)
    return STORE.types['geometry_msgs/msg/PoseWithCovarianceStamped'](
        header=TYPES.header(stamp, 'radar'),
        pose=TYPES.PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
    )


@pytest.mark.parametrize('period', [0.0, 0.9 * PERIOD])
def test_single_plots_of_one_stamp_are_one_look_or_said_to_need_a_period(period, caplog) -> None:
    """Several contacts one by one have no track without it, which is told."""
    config = with_values(RadarTrackerConfig(), {**SITE, 'scan.period': period})
    radar = radar_session(config, radar_node_config(), TYPES, logging.getLogger('session'))
    stamps = []
    for look in range(LOOKS):
        for place in whole(look).position:
            table = radar.plots(position(place, 1000.0 + PERIOD * look), 0.0)
            stamps += [table.header.stamp.sec] if table is not None else []
    is_set = period > 0.0
    assert (radar.tracks.confirmed.sum() == CONTACTS) == is_set
    assert bool(radar.counts['plots'].refused) != is_set
    assert ('set scan.assembly to snapshot and scan.period' in caplog.text) != is_set
    assert (np.diff(stamps) > 0).all()
