# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What users of well-known nodes complain of: resets that are none, gaps, sure tracks, ghosts."""

import logging

import numpy as np
import pytest

from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from tracking_core.config import with_values

pytest.importorskip('rosbags')
TYPES = pytest.importorskip('msg_adapters.message_types').rosbags_types()
PERIOD, NOISE = 4.0, 20.0  # s, m
PARAMETERS = {'sensor.range_sd': NOISE, 'sensor.azimuth_sd': 0.001}


def session(**values):
    """Return a session of a radar with little noise."""
    config = with_values(RadarTrackerConfig(), {**PARAMETERS, **values})
    return radar_session(config, radar_node_config(), TYPES, logging.getLogger('long lives'))


def look(radar, time, places):
    """Return the track table after a scan that sees contacts at these places (K, 2)."""
    rng = np.random.default_rng(int(time))
    places = np.asarray(places, float).reshape(-1, 2)
    azimuth = np.arctan2(places[:, 1], places[:, 0]) + 1e-3 * rng.standard_normal(len(places))
    distance = np.hypot(*places.T) + NOISE * rng.standard_normal(len(places))
    order = np.argsort(azimuth % (2.0 * np.pi))
    columns = {'range': distance[order], 'azimuth': azimuth[order]}
    return to_columns(radar.plots(from_columns(columns, 1000.0 + time, 'radar', TYPES), time), 100)


def straight(time):
    """Return where two aircraft are that fly straight."""
    return [[20e3 + 100.0 * time, 10e3], [-15e3, 5e3 - 80.0 * time]]


def test_reset_equals_a_fresh_start_to_the_bit():
    """But for the ids, which are never given twice."""
    used, fresh = session(), session()
    for scan in range(15):
        before = look(used, PERIOD * scan, straight(PERIOD * scan))
    used.reset()
    for scan in range(15):
        one = look(used, PERIOD * scan, straight(PERIOD * scan))
        other = look(fresh, PERIOD * scan, straight(PERIOD * scan))
        kept = one['status'] != 2  # the old tracks are told as deleted, once
        assert kept.all() or scan == 0
        for name in set(one) - {'id'}:
            np.testing.assert_array_equal(one[name][kept], other[name], name)
    assert one['id'].min() > before['id'].max()


@pytest.mark.parametrize('missed', [1, 10, 100, 1000])
def test_gap_of_many_scans_blows_nothing_up(missed):
    """Nothing came for so many scans: what is published is finite, and all is found again."""
    radar = session()
    for scan in range(15):
        look(radar, PERIOD * scan, straight(PERIOD * scan))
    later = PERIOD * (15 + missed)
    for scan in range(15):
        time = later + PERIOD * scan
        table = look(radar, time, straight(PERIOD * (15 + scan)))
        covariance = table['covariance'].reshape(-1, 6, 6)[:, :2, :2]
        assert np.isfinite(covariance).all()
        assert (np.linalg.eigvalsh(covariance) > 0.0).all()
        assert np.isfinite([table['x'], table['y'], table['existence_probability']]).all()
    assert (table['status'] == 1).sum() == 2


def test_sure_track_does_not_gate_out_its_own_contact():
    """After four hundred scans straight on, a hard turn is followed under the same id."""
    radar = session()
    place, course = np.array([50e3, -40e3]), 2.0
    for scan in range(400):
        place = place + 20.0 * PERIOD * np.array([np.cos(course), np.sin(course)])
        table = look(radar, PERIOD * scan, place)
    (before,) = table['id'][table['status'] == 1]
    assert np.sqrt(table['covariance'][0, 0]) > 1.0  # m: the noise of motion is its floor
    assert np.isfinite(table['nis']).all()
    for scan in range(400, 430):
        course += 0.2  # 3 degrees a second
        place = place + 20.0 * PERIOD * np.array([np.cos(course), np.sin(course)])
        table = look(radar, PERIOD * scan, place)
    assert list(table['id'][table['status'] == 1]) == [before]
    assert np.hypot(table['x'][0] - place[0], table['y'][0] - place[1]) < 5.0 * NOISE


def test_ghost_beside_a_living_track_dies_without_own_plots():
    """Two fly together, one lands: its existence falls scan by scan, the other's does not."""
    radar, existence = session(), []
    for scan in range(40):
        time = PERIOD * scan
        x = 20e3 + 100.0 * time
        places = [[x, 10e3], [x, 10.6e3]][: 2 if scan < 20 else 1]
        table = look(radar, time, places)
        rows = {int(i): k for k, i in enumerate(table['id']) if table['status'][k] != 2}
        existence.append({i: float(table['existence_probability'][k]) for i, k in rows.items()})
    together, alone = existence[19], existence[-1]
    assert len(together) == 2
    (living,) = alone
    (ghost,) = set(together) - {living}
    left = [each[ghost] for each in existence[20:] if ghost in each]
    assert len(left) < 10
    assert (np.diff([together[ghost], *left]) < 0.0).all()
    assert alone[living] > 0.98
