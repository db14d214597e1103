# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Sectors that are missing: nobody is missed where the antenna was not followed."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.gaps import is_missing, usual_step
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from radar_tracker.tracker import RadarTracker
from tracking_core.batches import Plots
from tracking_core.config import with_values

pytest.importorskip('rosbags')
TYPES = pytest.importorskip('msg_adapters.message_types').rosbags_types()
PERIOD, SECTORS = 4.0, 8  # of the antenna [s], in a turn
STEP = PERIOD / SECTORS
AZIMUTH = 2.0 * np.pi * (np.arange(24) + 0.5) / 24.0  # of contacts at rest, three in a sector


def config_of(**values):
    """Return parameters of a radar that collects sectors, if not told otherwise."""
    usual = {'scan.period': PERIOD, 'scan.assembly': 'rotation'}
    return with_values(RadarTrackerConfig(), {**usual, **values})


def session(**values):
    """Return a session that takes sectors."""
    return radar_session(
        config_of(**values), radar_node_config(), TYPES, logging.getLogger('gaps')
    )


def sector(number, gone=0):
    """Return the plots of one sector, stamped at its beginning; the first contacts are gone."""
    begin = 2.0 * np.pi * (number % SECTORS) / SECTORS
    ahead = (AZIMUTH - begin) % (2.0 * np.pi)
    seen = (ahead < 2.0 * np.pi / SECTORS) & (np.arange(len(AZIMUTH)) >= gone)
    rng, count = np.random.default_rng(number), int(seen.sum())
    columns = {
        'range': np.linspace(1e4, 4e4, len(AZIMUTH))[seen] + rng.normal(0.0, 30.0, count),
        'azimuth': AZIMUTH[seen] + rng.normal(0.0, 1e-3, count),
        'time': ahead[seen] / (2.0 * np.pi) * PERIOD,
    }
    return from_columns(columns, 1000.0 + STEP * number, 'radar', TYPES)


def follow(radar, numbers):
    """Feed sectors; return the most misses that each track has had meanwhile, by its id."""
    misses = {}
    for number in numbers:
        radar.plots(sector(number), STEP * number)
        for name, count in zip(radar.tracks.id, radar.tracks.misses, strict=True):
            misses[int(name)] = max(int(count), misses.get(int(name), 0))
    return misses


def test_is_missing_knows_regular_sectors():
    """One of eight is missing after the first turn; none is where stamps jitter by a fifth."""
    stamps = STEP * (np.arange(40) + np.random.default_rng(1).uniform(-0.2, 0.2, 40))
    assert usual_step(stamps, PERIOD) == pytest.approx(STEP, rel=0.4)
    assert not any(is_missing(stamps[:n], PERIOD) for n in range(41))
    assert is_missing(np.append(stamps[:20], stamps[21]), PERIOD)
    assert is_missing(np.append(stamps[:20], stamps[28]), PERIOD)
    assert not is_missing(stamps[[0, 3]], 0.0)


def test_is_missing_lets_sectors_be_of_any_length():
    """One that is three times as long as the others has always been so."""
    stamps = np.cumsum(np.tile([0.3, 0.3, 0.9, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.4], 4))
    assert not any(is_missing(stamps[:n], PERIOD) for n in range(45))
    assert is_missing(np.delete(stamps, slice(25, 30))[:26], PERIOD)


def test_is_missing_takes_a_place_that_is_silent_twice_for_empty():
    """A radar may send no sector where it sees nothing; the first such turn is not believed."""
    number = np.arange(60)
    stamps = STEP * number[(number < 20) | (number % SECTORS != 3)]
    answers = [is_missing(stamps[:n], PERIOD) for n in range(len(stamps) + 1)]
    assert np.diff(stamps).max() == 2.0 * STEP
    assert np.sum(answers) == 1


@pytest.mark.parametrize('lost', [1, 3, 6, 12, 20, 36, 44, 60])
def test_pause_amid_a_collected_turn_ends_no_track(lost):
    """The sectors before it are no turn with those after it, and nobody is missed for it."""
    radar = session()
    begin = SECTORS * 10 + 3
    follow(radar, range(begin))
    before = radar.tracks.id.tolist()
    assert len(before) == len(AZIMUTH)
    assert radar.tracks.confirmed.all()
    follow(radar, range(begin + lost, begin + lost + 3 * SECTORS))
    assert radar.tracks.id.tolist() == before
    assert radar.tracks.misses.max() == 0


def test_turn_that_never_ends_takes_no_more_memory():
    """Stamps go on by a microsecond only: a turn has `max_plots` at most."""
    turns, kept = RadarTracker(config_of(max_plots=100)).turns, []
    for number in range(200):
        time = np.full(7, 1000.0 + 1e-6 * number)
        plots = replace(Plots.polar(time, np.ones(7), np.ones(7)), stamp=time[0])
        turn = turns.add(plots, 2.0 * np.pi / PERIOD)
        kept.append(0 if turn is None else len(turn))
    assert set(kept) == {0, 98}
    assert sum(kept) > 1200


@pytest.mark.parametrize('step', [0.3, 0.7])
def test_turn_is_whole_with_its_last_sector(step):
    """Though the stamps of this century, rounded as they are, do not quite make up its time."""
    turns, found = RadarTracker(config_of(**{'scan.period': SECTORS * step})).turns, []
    for number in range(10 * SECTORS):
        time = np.full(1, 1_700_000_000.0 + step * number)
        plots = replace(Plots.polar(time, np.ones(1), np.ones(1)), stamp=time[0])
        found.append(turns.add(plots, 0.0))
    assert [turn is not None for turn in found[SECTORS:]] == 9 * (7 * [False] + [True])
    assert all(len(turn) == SECTORS for turn in found[SECTORS:] if turn is not None)


def test_turns_with_more_plots_than_a_message_may_have_end_no_track():
    """They come in parts."""
    radar = session(max_plots=10)
    follow(radar, range(SECTORS * 6))
    before = radar.tracks.id.tolist()
    assert len(before) == len(AZIMUTH)
    misses = follow(radar, range(SECTORS * 6, SECTORS * 16))
    assert misses == dict.fromkeys(before, 0)


@pytest.mark.parametrize('lost', [1, 2, 4, 6, 7, 8, 12, 20])
def test_nobody_is_missed_in_sectors_that_are_lost(lost):
    """Neither by the first sector after them nor by the second, which looks back a little."""
    radar = session(**{'scan.assembly': 'sector'})
    begin = SECTORS * 10 + 3
    follow(radar, range(begin))
    misses = follow(radar, range(begin + lost, begin + lost + 3))
    assert misses == dict.fromkeys(radar.tracks.id.tolist(), 0)


@pytest.mark.parametrize('lost', [2, 20])
def test_sector_without_plots_after_a_gap_is_no_look_everywhere(lost):
    """What it swept nobody knows, but no more than a sector."""
    radar = session(**{'scan.assembly': 'sector'})
    begin = SECTORS * 10 + 3
    follow(radar, range(begin))
    empty = from_columns(
        {'range': np.zeros(0), 'azimuth': np.zeros(0)},
        1000.0 + STEP * (begin + lost),
        'radar',
        TYPES,
    )
    radar.plots(empty, STEP * (begin + lost))
    assert (radar.tracks.misses == 0).all()


def test_contacts_that_are_gone_are_missed_where_empty_sectors_are_not_sent():
    """A sector that is silent for the second time is empty, not lost; so it costs one turn."""
    ended = []
    for is_sent in (True, False):
        radar, number = session(**{'scan.assembly': 'sector'}), SECTORS * 10
        follow(radar, range(number))
        assert radar.tracks.confirmed.sum() == len(AZIMUTH)
        while len(radar.tracks) > len(AZIMUTH) - 3:  # nobody is left in the first sector
            if is_sent or number % SECTORS:
                radar.plots(sector(number, gone=3), STEP * number)
            number += 1
        assert (radar.tracks.misses == 0).all()
        ended.append(number)
    assert ended[1] <= ended[0] + SECTORS
