# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The rotation of an antenna is learnt from its plots, and what each message swept."""

from __future__ import annotations

from dataclasses import replace
import tracemalloc

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.antenna import Antenna
from radar_tracker.sweep import Sweep
from studies.scenes import messages
from tracking_core.batches import Plots
from tracking_core.linalg import TURN, wrap_angle
from tracking_tools.scenarios import Contact, Legs, Scenario, SimulatedRadar

CONTACTS = tuple(
    Contact(k + 1, Legs((r * np.cos(a), r * np.sin(a), 0.0), 120.0, 1.3 * k))
    for k, (a, r) in enumerate([(0.3, 9e3), (2.0, 14e3), (-2.2, 20e3), (-0.9, 11e3)])
)


def sensed(period: float, rotation: str, turns: int, sectors: int = 1, clutter: float = 6.0):
    """Messages of a scene."""
    radar = SimulatedRadar(
        period=period, range_sd=30.0, azimuth_sd=0.003, clutter_per_turn=clutter,
        rotation=rotation, range_limits=(500.0, 60_000.0),
    )  # fmt: skip
    scene = Scenario(radar, CONTACTS, turns * period)
    return [plots for plots, _ in messages(scene, np.random.default_rng(3), sectors)]


def follow(antenna: Antenna, plots: list[Plots]) -> list[Sweep]:
    """Return what each message swept."""
    return [antenna.follow(message, message.azimuth) for message in plots]


@pytest.mark.parametrize('rotation', ['clockwise', 'anticlockwise'])
@pytest.mark.parametrize('period', [1.3, 2.5, 4.0, 10.0, 12.0])
@pytest.mark.parametrize('sectors', [1, 8])
def test_follow_learns_the_rotation(rotation: str, period: float, sectors: int) -> None:
    """Rate to 1e-4, direction too, from full turns and from sectors."""
    antenna = Antenna(0.0, sectors == 1, 'start')
    follow(antenna, sensed(period, rotation, 12, sectors))
    sense = 1.0 if rotation == 'anticlockwise' else -1.0
    assert antenna.rotation_rate == pytest.approx(sense * 2.0 * np.pi / period, rel=1e-4)


def test_follow_takes_the_period_that_is_told() -> None:
    """A known period still leaves the direction to be learnt, and is refined."""
    antenna = Antenna(4.02, True, 'start')
    follow(antenna, sensed(4.0, 'clockwise', 6))
    assert antenna.rotation_rate == pytest.approx(-np.pi / 2.0, rel=1e-4)


@pytest.mark.parametrize('sectors', [1, 8])
def test_follow_says_where_the_antenna_points(sectors: int) -> None:
    """At the times of the plots the sweep points at them; sweeps join without gaps."""
    antenna = Antenna(0.0, sectors == 1, 'start')
    plots = sensed(4.0, 'clockwise', 10, sectors)
    sweeps = follow(antenna, plots)
    for before, sweep, message in list(zip(sweeps, sweeps[1:], plots[1:], strict=False))[-5:]:
        assert sweep.gaps[-1][1] <= before.start_time
        assert sweep.start_time == before.end_time
        rate = sweep.angle / (sweep.end_time - sweep.start_time)
        off = message.azimuth - sweep.start_azimuth - rate * (message.time - sweep.start_time)
        assert_allclose(np.angle(np.exp(1j * off)), 0.0, atol=0.02)
    turned = sum(sweep.angle for sweep in sweeps[-sectors:])
    assert turned == pytest.approx(-2.0 * np.pi, rel=0.05)


def test_follow_keeps_pace_with_an_antenna_whose_speed_drifts() -> None:
    """Faster and slower by 1 % within a minute: no plot is far from where it points."""
    antenna, off = Antenna(0.0, True, 'start'), []
    for plots in sensed(4.0, 'clockwise', 45):
        late = (10.0 / 90.0) * np.sin(TURN * plots.time / 60.0)  # by 10 degrees at most [s]
        drifting = replace(plots, time=plots.time + late)
        sweep = antenna.follow(drifting, drifting.azimuth)
        rate = sweep.angle / (sweep.end_time - sweep.start_time)
        pointed = sweep.start_azimuth + rate * (drifting.time - sweep.start_time)
        off.append(np.abs(wrap_angle(drifting.azimuth - pointed)).max())
    assert np.degrees(max(off[5:])) < 2.5  # 13 with all that are remembered


def test_follow_knows_a_sensor_that_stares() -> None:
    """Plots of one moment from all directions: no rotation, a look everywhere at once."""
    antenna = Antenna(0.0, True, 'start')
    sweeps = follow(antenna, sensed(4.0, 'staring', 12))
    assert antenna.rotation_rate == 0.0
    assert all(sweep.angle == 0.0 for sweep in sweeps)


@pytest.mark.parametrize('period', [0.0, 4.0], ids=['learnt', 'told'])
@pytest.mark.parametrize('odd', [1, 2, 10])
def test_follow_learns_the_rotation_after_plots_of_one_moment(period: float, odd: int) -> None:
    """A driver that told no times at first, or a faulty message: later plots know better."""
    antenna, turns = Antenna(period, True, 'start'), sensed(4.0, 'clockwise', 20)
    for number, plots in enumerate(turns):
        untimed = replace(plots, time=np.full(len(plots), plots.stamp))
        antenna.follow(untimed if number < odd else plots, plots.azimuth)
    assert antenna.rotation_rate == pytest.approx(-np.pi / 2.0, rel=1e-4)


@pytest.mark.parametrize('period', [0.0, 4.0], ids=['learnt', 'told'])
def test_one_message_with_times_makes_no_sensor_turn(period: float) -> None:
    """The next one shows that it does not: all others see everything at once."""
    antenna, turns = Antenna(period, True, 'start'), sensed(4.0, 'clockwise', 40)
    for number, plots in enumerate(turns):
        untimed = replace(plots, time=np.full(len(plots), plots.stamp))
        antenna.follow(plots if number == 20 else untimed, plots.azimuth)
        assert antenna.rotation_rate == 0.0 or number == 20


def test_follow_is_not_fooled_by_random_directions() -> None:
    """Times and azimuths that have nothing to do with each other are no rotation."""
    rng, antenna = np.random.default_rng(5), Antenna(0.0, True, 'start')
    for k in range(30):
        time = np.sort(rng.uniform(4.0 * k, 4.0 * k + 4.0, 20))
        plots = replace(
            Plots.polar(time, np.ones(20), rng.uniform(-np.pi, np.pi, 20)), stamp=4.0 * k
        )
        antenna.follow(plots, plots.azimuth)
    assert antenna.rotation_rate == 0.0


def test_follow_forgets_a_rotation_that_changes() -> None:
    """From 4 s to 2.5 s a turn: the old rate is dropped and the new one is found."""
    antenna = Antenna(0.0, True, 'start')
    follow(antenna, sensed(4.0, 'clockwise', 8))
    later = [
        replace(p, time=p.time + 32.0, stamp=p.stamp + 32.0) for p in sensed(2.5, 'clockwise', 60)
    ]
    follow(antenna, later)
    assert antenna.rotation_rate == pytest.approx(-2.0 * np.pi / 2.5, rel=1e-3)


def test_follow_takes_empty_messages() -> None:
    """Turns without a plot still sweep once the rotation is known, and nothing before."""
    nothing = Plots.polar(np.zeros(0), np.zeros(0), np.zeros(0))
    antenna = Antenna(0.0, True, 'start')
    assert antenna.follow(nothing, nothing.azimuth).angle == 0.0
    plots = sensed(4.0, 'anticlockwise', 8)
    follow(antenna, plots)
    sweep = antenna.follow(replace(nothing, stamp=32.0), nothing.azimuth)
    assert sweep.angle == pytest.approx(2.0 * np.pi, rel=0.01)
    assert sweep.gaps[-1][1] < sweep.start_time
    gap = antenna.follow(replace(nothing, stamp=60.0), nothing.azimuth)
    assert gap.gaps[-1] == (sweep.end_time, gap.start_time)


@pytest.mark.parametrize(('reference', 'ahead'), [('start', 4.0), ('middle', 2.0), ('end', 0.0)])
def test_follow_heeds_what_the_stamp_means(reference: str, ahead: float) -> None:
    """A message stamped at its start, middle or end reaches so far beyond its stamp."""
    antenna = Antenna(4.0, True, reference)
    follow(antenna, [replace(p, stamp=p.stamp + 4.0 - ahead) for p in sensed(4.0, 'clockwise', 8)])
    nothing = Plots.polar(np.zeros(0), np.zeros(0), np.zeros(0))
    sweep = antenna.follow(replace(nothing, stamp=36.0 - ahead), nothing.azimuth)
    assert sweep.end_time == pytest.approx(36.0, abs=0.01)


@pytest.mark.parametrize('reference', ['start', 'middle', 'end'])
@pytest.mark.parametrize('ahead', [4.0, 2.0, 0.0, -1.0])
def test_follow_believes_plot_times_rather_than_what_the_stamp_should_mean(
    reference: str, ahead: float
) -> None:
    """Turns of 4 s go on where the last one ended, whatever is said of their stamps."""
    antenna = Antenna(4.0, True, reference)
    turns = [replace(p, stamp=p.stamp + 4.0 - ahead) for p in sensed(4.0, 'clockwise', 12)]
    sweeps = follow(antenna, turns)[-5:]
    ends, starts = np.array([(sweep.end_time, sweep.start_time) for sweep in sweeps]).T
    assert_allclose(ends, 32.0 + 4.0 * np.arange(5), atol=0.8)  # plots need not fill the turn
    assert (starts[1:] < ends[:-1] + 0.08).all()
    wrong = replace(turns[-1], time=turns[-1].time + 44.0, stamp=turns[-1].stamp + 4.0)
    antenna.follow(wrong, wrong.azimuth)  # of one message nothing is believed
    nothing = replace(Plots.polar(np.zeros(0), np.zeros(0), np.zeros(0)), stamp=56.0 - ahead)
    assert antenna.follow(nothing, nothing.azimuth).end_time == pytest.approx(56.0, abs=0.8)


@pytest.mark.parametrize('rotation', ['staring', 'clockwise', 'anticlockwise'])
def test_follow_makes_up_no_rotation_from_one_contact(rotation: str) -> None:
    """One contact once in 4 s fits 4 s a turn, 2 s, 1 s ...: better no rate than a wrong one."""
    radar = SimulatedRadar(
        period=4.0, range_sd=30.0, azimuth_sd=0.002, detection_probability=0.8, rotation=rotation
    )
    for contact in CONTACTS:
        antenna = Antenna(0.0, True, 'start')
        scene = Scenario(radar, (contact,), 200.0)
        follow(antenna, [plots for plots, _ in messages(scene, np.random.default_rng(3))])
        assert antenna.rotation_rate == 0.0


@pytest.mark.parametrize(
    'bearings', [(29, 209), (29, 119), (29, 149, -91), (0, 72, 144, 216, 288)]
)
@pytest.mark.parametrize('period', [2.5, 4.0, 10.0])
def test_few_contacts_at_rest_teach_no_wrong_rotation(
    bearings: tuple[float, ...], period: float
) -> None:
    """Whole turns may lie between their plots, either way round: the right rate, or none."""
    antenna, azimuth = Antenna(0.0, True, 'start'), np.radians(np.array(bearings, np.float64))
    azimuth = np.sort((azimuth + np.pi) % (2.0 * np.pi) - np.pi)[::-1]  # clockwise from behind
    rng = np.random.default_rng(1)
    for turn in range(60):
        time = period * (turn + (np.pi - azimuth) / (2.0 * np.pi))
        seen = rng.random(len(azimuth)) < 0.9
        noisy = azimuth[seen] + rng.normal(0.0, 0.002, seen.sum())
        plots = Plots.polar(time[seen], np.full(seen.sum(), 1e4), noisy)
        antenna.follow(replace(plots, stamp=period * turn), noisy)
    right = -2.0 * np.pi / period
    assert antenna.rotation_rate in (0.0, pytest.approx(right, rel=1e-3))


@pytest.mark.parametrize('each', [10.0, 300.0])
def test_follow_looks_for_a_rate_in_bounded_memory(each: float) -> None:
    """A sensor that stares, a message now and then all night long: no rate, and no 100 MB."""
    antenna, rng = Antenna(0.0, True, 'start'), np.random.default_rng(5)
    tracemalloc.start()
    try:
        for number in range(402):
            time = each * number + np.sort(rng.uniform(0.0, 1.0, 2))
            plots = Plots.polar(time, np.full(2, 1e4), rng.uniform(-np.pi, np.pi, 2))
            antenna.follow(replace(plots, stamp=each * number), plots.azimuth)
        assert tracemalloc.get_traced_memory()[1] < 20e6
    finally:
        tracemalloc.stop()
    assert antenna.rotation_rate == 0.0
