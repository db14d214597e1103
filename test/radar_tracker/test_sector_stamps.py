# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of sectors that say more, or less, than when the sector was seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from radar_tracker.config import ScanConfig
from radar_tracker.sector_clock import SectorClock
from tracking_core.batches import Plots

PERIOD, SECTORS = 2.4, 8


def sector(number, pause=0.0):
    """Return five plots of this sector of an antenna that turns anticlockwise, without times."""
    width = 2.0 * np.pi / SECTORS
    azimuth = width * (number + np.random.default_rng(number).uniform(0.0, 1.0, 5))
    stamp = PERIOD / SECTORS * number + pause
    return replace(Plots.polar(np.full(5, stamp), np.full(5, 5e3), azimuth), stamp=stamp)


@pytest.mark.parametrize(
    ('reference', 'first', 'last'), [('start', 7.0, 11.0), ('middle', 5.0, 9.0), ('end', 3.0, 7.0)]
)
def test_own_ship_is_asked_for_where_the_plots_were(reference, first, last):
    """Not only at the stamp: transforms would know nothing of the rest."""
    plots = replace(Plots.polar(np.full(2, 7.0), np.ones(2), np.ones(2)), stamp=7.0)
    span = SectorClock(ScanConfig(period=4.0, time_reference=reference)).span(plots)
    assert (span.min(), span.max()) == (first, last)
    assert set(SectorClock(ScanConfig(assembly='sector')).span(plots)) == {7.0}


@pytest.mark.parametrize(('pause', 'is_known'), [(10.0 * PERIOD, True), (40.0 * PERIOD, False)])
def test_after_a_minute_nobody_knows_where_the_antenna_points(pause, is_known):
    """It may have been switched off; a shorter pause is whole sectors that were lost."""
    clock = SectorClock(ScanConfig(assembly='sector', period=PERIOD))
    for number in range(40):
        try:
            clock.times(sector(number))
        except BadMessage:
            assert number < 30
    later = sector(40, pause)
    if is_known:
        assert (np.abs(clock.times(later) - later.stamp - 0.15) <= 0.15).all()
    else:
        with pytest.raises(BadMessage, match='not known yet'):
            clock.times(later)


@pytest.mark.filterwarnings('error')
def test_stamps_without_a_rhythm_are_no_error():
    """Between a step of 0.1 s and those of 10 s lies none that is usual; no time is NaN for it."""
    clock = SectorClock(ScanConfig(assembly='sector'))
    for stamp in 1.7e9 + np.cumsum([0.0, 0.1, 10.0, 10.1, 10.2]):
        one = replace(Plots.polar(np.full(1, stamp), np.full(1, 5e3), np.ones(1)), stamp=stamp)
        try:
            clock.times(one)
        except BadMessage:
            assert np.isfinite(clock.span(one)).all()
