# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Heights above the sea become elevations; by hand from the standard's bits."""

from collections import Counter

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import to_columns
from tracking_tools.asterix.__main__ import main
from tracking_tools.asterix.blocks import read_reports
from tracking_tools.asterix.heights import EARTH, LEVEL_SD
from tracking_tools.feeds.feed import Feed

pytest.importorskip('asterix.generated')
RANGE = 40.0 * 1852.0  # m
WITH_LEVEL, WITH_HEIGHT = b'\xf4', b'\xf1\x01\x08'  # FSPEC: 010, 140, 020, 040 and 090, or 110


def data_block(fields, items):
    """Return a block of one record, 40 NM to the north at 1 s."""
    record = fields + bytes([25, 201, 0, 0, 128, 0x20, 40, 0, 0, 0]) + items
    return bytes([48, 0, len(record) + 3]) + record


def level(quarters, validated=True, garbled=False):
    """Return a block with a flight level in quarters."""
    word = (not validated) << 15 | garbled << 14 | quarters & 0x3FFF
    return data_block(WITH_LEVEL, word.to_bytes(2, 'big'))


def place(height, site):
    """Return elevation of what is so high above the sea [rad], by places on a sphere."""
    angles = np.linspace(0.0, 0.02, 2_000_001)  # at the centre of the earth
    across = (EARTH + height) * np.sin(angles)
    up = (EARTH + height) * np.cos(angles) - EARTH - site
    nearest = np.argmin(np.abs(np.hypot(across, up) - RANGE))
    return np.arctan2(up[nearest], across[nearest])


@pytest.mark.parametrize('site', [0.0, 850.0])
@pytest.mark.parametrize(('quarters', 'height'), [(1400, 10_668.0), (-40, -304.8), (1, 7.62)])
def test_flight_levels_are_elevations(quarters, height, site):
    """FL 350, FL -10, and the smallest step; the earth curves away by 430 m in 40 NM."""
    (report,) = read_reports(level(quarters), Counter(), site)
    assert report.elevation == pytest.approx(place(height, site), abs=2e-6)
    ground = RANGE * np.cos(report.elevation)
    assert report.elevation_sd == pytest.approx(LEVEL_SD / ground)


def test_height_of_a_3d_radar_counts_where_no_level_does():
    """In steps of 25 feet, bits 14 to 1; nobody says how good it is."""
    told = data_block(WITH_HEIGHT, (400).to_bytes(2, 'big'))
    (report,) = read_reports(told, Counter(), 0.0)
    assert report.elevation == pytest.approx(place(3048.0, 0.0), abs=2e-6)
    assert np.isnan(report.elevation_sd)


@pytest.mark.parametrize(
    ('data', 'site'),
    [
        (level(1400, validated=False), 0.0),
        (level(1400, garbled=True), 0.0),
        (data_block(b'\xf0', b''), 0.0),
        (level(1400), -80_000.0),
        (level(1400), None),
    ],
)
def test_heights_that_tell_nothing_are_not_used(data, site):
    """Not validated, garbled, none, higher than it is far; or the radar's height is not known."""
    (report,) = read_reports(data, Counter(), site)
    assert np.isnan([report.elevation, report.elevation_sd]).all()
    assert report.range == RANGE


def test_plots_with_and_without_height_share_a_message():
    """What has none is NaN, for the tracker to know."""
    feed = Feed(
        lambda data, counts: read_reports(data, counts, 0.0), rosbags_types(), 'radar', 0.0,
        with_height=True,
    )  # fmt: skip
    _, msg = feed.take(level(1400) + data_block(b'\xf0', b''))
    columns = to_columns(msg, 9)
    assert np.isfinite(columns['elevation']).tolist() == [True, False]
    assert np.isfinite(columns['elevation_sd']).tolist() == [True, False]


def test_height_that_is_no_number_is_told(capsys):
    """In words."""
    with pytest.raises(SystemExit):
        main(['night.ast', '--height', 'nan'])
    assert 'must be a number, got nan' in capsys.readouterr().err
