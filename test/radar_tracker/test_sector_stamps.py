# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps of sectors that say more, or less, than when the sector was seen."""

from __future__ import annotations

import contextlib
from dataclasses import replace

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from radar_tracker.config import ScanConfig
from radar_tracker.sector_clock import SectorClock
from tracking_core.batches import Plots

PERIOD, SECTORS = 2.4, 8
STEP = PERIOD / SECTORS


def sector(number, pause=0.0, pace=1.0):
    """Return 20 plots of this sector of an antenna that turns anticlockwise, without times."""
    part = np.random.default_rng(number).uniform(0.0, 1.0, 20)
    azimuth, stamp = 2.0 * np.pi / SECTORS * (number + part) * pace, STEP * number + pause
    return replace(Plots.polar(np.full(20, stamp), np.full(20, 5e3), azimuth), stamp=stamp), part


def learnt(pace=1.0):
    """Return a clock that knows how the antenna turns."""
    clock = SectorClock(ScanConfig(assembly='sector', period=PERIOD))
    for number in range(40):
        with contextlib.suppress(BadMessage):
            clock.times(sector(number, pace=pace)[0])
    assert clock.beam is not None
    return clock


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
    clock, (later, part) = learnt(), sector(40, pause)
    if is_known:
        np.testing.assert_allclose(clock.times(later), later.stamp + STEP * part, atol=0.1 * STEP)
    else:
        with pytest.raises(BadMessage, match='not known yet'):
            clock.times(later)


@pytest.mark.parametrize('pace', [0.995, 1.005])
def test_sectors_that_wander_are_followed(pace):
    """An antenna a little slower or faster than its sectors: after 400 of them as at first."""
    clock = learnt(pace)
    for number in range(40, 440):
        plots, part = sector(number, pace=pace)
        off = clock.times(plots) - plots.stamp - STEP * part
        assert np.abs(off).max() < 0.2 * STEP


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
