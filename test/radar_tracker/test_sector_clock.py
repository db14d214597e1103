# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots without times of their own: sectors tell them, by how they follow each other."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig, ScanConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.sector_clock import SectorClock
from radar_tracker.session import radar_session
from studies.scenes import messages
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_session.snapshots.file import read_snapshot, write_snapshot
from tracking_tools.scenarios import Contact, Legs, Scenario, SimulatedRadar

PERIOD, EPOCH = 2.5, 1_700_000_000.0
SMALL = {
    'sensor.range_sd': 20.0, 'sensor.azimuth_sd': 0.003, 'sensor.range_max': 2e4,
    'motion.horizontal.acceleration_sd': [0.05, 0.5], 'initiation.speed_max': 30.0,
}  # fmt: skip
RADAR = SimulatedRadar(
    period=PERIOD, rotation='clockwise', range_sd=20.0, azimuth_sd=0.003,
    detection_probability=0.95, range_limits=(500.0, 20_000.0),
)  # fmt: skip
FEW = tuple(
    Contact(k + 1, Legs((r * np.cos(a), r * np.sin(a), 0.0), 8.0, 1.3 * k))
    for k, (a, r) in enumerate([(0.3, 4e3), (2.0, 6e3), (-2.2, 3e3), (-0.9, 5e3)])
)


def sensed(radar, sectors, turns, contacts=FEW):
    """Return the plots of each sector, with the times that they have."""
    scene = Scenario(radar, contacts, turns * radar.period)
    found = [plots for plots, _ in messages(scene, np.random.default_rng(3), sectors)]
    return [replace(p, time=p.time + EPOCH, stamp=p.stamp + EPOCH) for p in found]


def untimed(plots, ahead=0.0):
    """Return plots as if only their message had a time, so far after its beginning [s]."""
    stamp = plots.stamp + ahead
    return replace(plots, time=np.full(len(plots), stamp), stamp=stamp)


def told(clock, plots):
    """Return the times of the plots, None as long as nobody knows."""
    try:
        return clock.times(plots)
    except BadMessage:
        return None


@pytest.mark.parametrize('rotation', ['clockwise', 'anticlockwise'])
@pytest.mark.parametrize('sectors', [4, 8, 32])
@pytest.mark.parametrize('period', [0.0, PERIOD], ids=['learnt', 'told'])
def test_times_are_those_of_the_antenna(rotation, sectors, period):
    """In false plots from everywhere: after some turns to a hundredth of a turn."""
    radar = replace(RADAR, rotation=rotation, clutter_per_turn=30.0)
    clock, off = SectorClock(ScanConfig(assembly='sector', period=period)), []
    for number, plots in enumerate(sensed(radar, sectors, 30)):
        times = told(clock, untimed(plots))
        if number >= 10 * sectors:
            off.append(times - plots.time)
    assert np.abs(np.concatenate(off)).max() < 0.01 * PERIOD
    sense = 1.0 if rotation == 'anticlockwise' else -1.0
    assert clock.beam.rate == pytest.approx(sense * 2.0 * np.pi / PERIOD, rel=1e-6)


@pytest.mark.parametrize(('reference', 'share'), [('start', 0.0), ('middle', 0.5), ('end', 1.0)])
def test_stamp_means_what_the_user_says(reference, share):
    """The times are the same, whatever moment of a sector its stamp is."""
    clock = SectorClock(ScanConfig(assembly='sector', time_reference=reference))
    radar, ahead = replace(RADAR, clutter_per_turn=30.0), share * PERIOD / 8
    for plots in sensed(radar, 8, 20):
        times = told(clock, untimed(plots, ahead))
    np.testing.assert_allclose(times, plots.time, rtol=0.0, atol=0.01 * PERIOD)


def test_lone_contact_needs_a_period_and_is_taken_to_be_turned_to_clockwise():
    """It fits many rates; a sector is short, so that the sense matters little."""
    found = [untimed(p) for p in sensed(RADAR, 8, 20, FEW[:1])]
    clock = SectorClock(ScanConfig(assembly='sector'))
    assert all(told(clock, plots) is None for plots in found if len(plots))
    clock = SectorClock(ScanConfig(assembly='sector', period=PERIOD))
    for plots in found:
        told(clock, plots)
    assert clock.beam.rate == pytest.approx(-2.0 * np.pi / PERIOD, rel=1e-6)


def test_antenna_that_turns_otherwise_is_learnt_anew():
    """From 8 to 12 sectors a turn: the old times are given up, not used for ever."""
    clock = SectorClock(ScanConfig(assembly='sector'))
    radar = replace(RADAR, clutter_per_turn=30.0)
    for plots in sensed(radar, 8, 10):
        told(clock, untimed(plots))
    later = sensed(replace(radar, period=1.5 * PERIOD), 12, 30)
    for plots in later:
        shifted = replace(plots, time=plots.time + 30.0, stamp=plots.stamp + 30.0)
        times = told(clock, untimed(shifted))
    np.testing.assert_allclose(times, shifted.time, rtol=0.0, atol=0.01 * PERIOD)


@pytest.mark.parametrize('assembly', ['sector', 'rotation', 'message', 'snapshot'])
def test_plots_with_times_keep_them(assembly):
    """Nobody knows better than the driver."""
    clock = SectorClock(ScanConfig(assembly=assembly, period=PERIOD))
    for plots in sensed(RADAR, 8, 6):
        np.testing.assert_array_equal(clock.times(plots), plots.time)
        if len(plots):
            assert clock.beam is None


def test_full_turns_without_times_are_taken_at_their_middle_if_the_period_is_told():
    """Without a period a message may be a look everywhere at once, and stays as it is."""
    plots = replace(Plots.polar(np.full(2, 7.0), np.ones(2), np.ones(2)), stamp=7.0)
    for values, ahead in (
        ({'period': 4.0}, 2.0), ({'period': 4.0, 'time_reference': 'middle'}, 0.0),
        ({'period': 4.0, 'time_reference': 'end'}, -2.0), ({}, 0.0),
    ):  # fmt: skip
        np.testing.assert_allclose(SectorClock(ScanConfig(**values)).times(plots), 7.0 + ahead)


@pytest.mark.parametrize('assembly', ['sector', 'rotation'])
@pytest.mark.parametrize('has_times', [True, False], ids=['timed', 'untimed'])
def test_few_contacts_are_held_in_sectors(assembly, has_times):
    """The same ids to the end, also where a contact lies on a cut, and no others."""
    radar = session_of({'scan.assembly': assembly})
    ids, held = set(), []
    for number, plots in enumerate(sensed(RADAR, 8, 80)):
        columns = {'range': plots.range, 'azimuth': plots.azimuth}
        if has_times:
            columns['time'] = plots.time - plots.stamp
        msg = from_columns(columns, plots.stamp, 'radar', rosbags_types())
        table = radar.plots(msg, 0.0)
        if table is None or number < 8 * 20:
            continue
        rows = to_columns(table, 100)
        ids |= set(rows['id'][rows['status'] == 1].tolist())
        held.append(int((rows['status'] == 1).sum()))
    assert len(ids) == len(FEW)
    assert np.mean(held) > 0.98 * len(FEW)


def session_of(values=()):
    """Return a session for untimed sectors."""
    config = with_values(
        RadarTrackerConfig(), {**SMALL, 'scan.assembly': 'sector', **dict(values)}
    )
    types = rosbags_types()
    return radar_session(config, radar_node_config(), types, logging.getLogger('sectors'))


def send(radar, plots):
    """Send a sector without times; return its table or None."""
    columns = {'range': plots.range, 'azimuth': plots.azimuth}
    return radar.plots(from_columns(columns, plots.stamp, 'radar', rosbags_types()), 0.0)


def ids_of(radar):
    """Return the ids of the confirmed tracks."""
    return set(radar.tracks.id[radar.tracks.confirmed].tolist())


def test_sectors_that_change_places_are_used_as_if_they_had_not():
    """Late ones are used at their own time: the clock, too, goes back and follows once more."""
    found, straight, swapped = sensed(RADAR, 8, 60), session_of(), session_of()
    for plots in found:
        send(straight, plots)
    known = 201  # by then the clock has learnt
    order = [n + 1 if n % 2 else n - 1 for n in range(known, len(found) - 1)]
    for plots in (*found[:known], *(found[n] for n in order)):
        send(swapped, plots)
    assert ids_of(straight) == ids_of(swapped)
    assert len(ids_of(swapped)) == len(FEW)


def test_restart_knows_how_the_antenna_turns(tmp_path):
    """No sector is refused after it, and no track is lost."""
    found, before, after = sensed(RADAR, 8, 60), session_of(), session_of()
    for plots in found[:320]:
        send(before, plots)
    write_snapshot(tmp_path / 'snapshot', before.instrument.remember())
    after.instrument.recall(read_snapshot(tmp_path / 'snapshot'))
    for plots in found[322:]:
        send(after, plots)
    assert after.counts['plots'].refused == {}
    assert ids_of(after) == ids_of(before)
    assert len(ids_of(after)) == len(FEW)


def test_one_message_with_times_changes_nothing_and_several_do():
    """A fault is no other driver."""
    clock = SectorClock(ScanConfig(assembly='sector'))
    found = [p for p in sensed(replace(RADAR, clutter_per_turn=30.0), 8, 30) if len(p)]
    for number, plots in enumerate(found):
        if number == 150:
            clock.times(replace(untimed(plots), time=plots.time))
        else:
            times = told(clock, untimed(plots))
    np.testing.assert_allclose(times, found[-1].time, rtol=0.0, atol=0.01 * PERIOD)
    for plots in found:
        shifted = replace(plots, time=plots.time + 75.0, stamp=plots.stamp + 75.0)
        times = clock.times(shifted)
    np.testing.assert_array_equal(times, shifted.time)


def shifted(plots, seconds):
    """Return plots so much later [s]."""
    return replace(plots, time=plots.time + seconds, stamp=plots.stamp + seconds)


@pytest.mark.parametrize('odd', [1, 2])
@pytest.mark.parametrize('clutter', [0.0, 30.0])
def test_first_message_with_a_time_does_not_hide_that_others_have_none(odd, clutter):
    """It keeps its own; the turn is learnt from those after it, be they of one plot each."""
    clock = SectorClock(ScanConfig(assembly='sector', period=PERIOD))
    found = [p for p in sensed(replace(RADAR, clutter_per_turn=clutter), 8, 40) if len(p)]
    for number, plots in enumerate(found):
        if number < odd:
            wrong = replace(untimed(plots), time=np.full(len(plots), plots.stamp + 0.01))
            np.testing.assert_array_equal(clock.times(wrong), wrong.time)
        else:
            times = told(clock, untimed(plots))
    assert clock.beam.rate == pytest.approx(-2.0 * np.pi / PERIOD, rel=1e-6)
    if clutter:
        np.testing.assert_allclose(times, found[-1].time, rtol=0.0, atol=0.01 * PERIOD)


def test_times_are_learnt_again_where_the_driver_tells_none_any_more():
    """As after its restart; then it tells them again."""
    clock = SectorClock(ScanConfig(assembly='sector'))
    found = [p for p in sensed(replace(RADAR, clutter_per_turn=30.0), 8, 30) if len(p)]
    for number, kind in enumerate((untimed, shifted, untimed, shifted)):
        for plots in found:
            times = told(clock, kind(shifted(plots, 75.0 * number), 0.0))
        atol = 0.01 * PERIOD * (kind is untimed)
        np.testing.assert_allclose(times, plots.time + 75.0 * number, rtol=0.0, atol=atol)


def test_full_turns_with_times_keep_them_from_the_first_on():
    """Though a period is told; a lone plot beside the stamp is no sign that others have none."""
    clock = SectorClock(ScanConfig(period=PERIOD))
    for number in range(40):
        time = PERIOD * number + np.array([0.0, 0.5, 0.9])[: 1 if number >= 5 else 3]
        plots = replace(Plots.polar(time, 1e4 + time, time), stamp=PERIOD * number)
        np.testing.assert_array_equal(clock.times(plots), time)


def test_lost_sectors_are_counted():
    """Two in five are missing; the times of the others are right."""
    rng, clock, off = np.random.default_rng(2), SectorClock(ScanConfig(assembly='sector')), []
    for number, plots in enumerate(sensed(replace(RADAR, clutter_per_turn=30.0), 8, 60)):
        if rng.random() < 0.6:
            times = told(clock, untimed(plots))
            if number > 200:
                off.append(times - plots.time)
    assert np.abs(np.concatenate(off)).max() < 0.01 * PERIOD


def test_reset_forgets_how_the_antenna_turned():
    """As after a start."""
    radar = session_of()
    for plots in sensed(RADAR, 8, 20):
        send(radar, plots)
    assert radar.instrument.tracker.sectors.beam is not None
    radar.reset()
    assert radar.instrument.tracker.sectors.beam is None
