# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the simulated scenes: antenna passes, noise, misses, false plots, the seam."""

from dataclasses import replace
import math

import numpy as np
import pytest
from scipy.stats import binom, kstest, poisson

from tracking_core.linalg import wrap_angle
from tracking_tools.scenarios import (
    build,
    Contact,
    FALSE_PLOT,
    find_passes,
    Leg,
    Legs,
    NORTH,
    plots,
    Sampled,
    Scenario,
    SCENARIOS,
    SimulatedRadar,
)
from tracking_tools.scenarios.passes import place
from tracking_tools.scenarios.traffic import en_route

ROTATING = [name for name in SCENARIOS if not build(name).radar.is_staring]


def played(scenario, seed=7, sectors=1):
    """All plots and identities of a scenario."""
    scans = list(plots(scenario, np.random.default_rng(seed), sectors))
    names = scans[0].columns
    columns = {name: np.concatenate([scan.columns[name] for scan in scans]) for name in names}
    return scans, columns, np.concatenate([scan.contact for scan in scans])


@pytest.mark.parametrize('name', ROTATING)
def test_antenna_points_at_each_contact_when_it_is_passed(name):
    """The true azimuth at the time of a plot is the antenna's, to 1e-9 rad."""
    scenario = build(name)
    truth = find_passes(scenario.radar, scenario.contacts, scenario.duration)
    exact = place(scenario.radar, truth)['azimuth']
    off = wrap_angle(scenario.radar.antenna_azimuth(truth.time) - exact)
    assert len(truth) > 100
    assert np.max(np.abs(off)) < 1e-9


@pytest.mark.parametrize('rotation', ['clockwise', 'anticlockwise'])
def test_each_turn_passes_a_contact_once(rotation):
    """Between passes the antenna turns once and by what the contact moved, never less or more."""
    radar = replace(build('seam').radar, rotation=rotation)
    for contact in build('seam').contacts:
        truth = find_passes(radar, (contact,), 600.0)
        moved = np.diff(np.unwrap(place(radar, truth)['azimuth']))
        np.testing.assert_allclose(
            radar.antenna_rate * np.diff(truth.time) - moved,
            math.copysign(2.0 * math.pi, radar.antenna_rate),
            atol=1e-8,
        )


def test_moving_platform_sees_contacts_from_where_it_is():
    """Azimuth and range rate are relative to the platform's motion."""
    radar = SimulatedRadar(
        period=2.0,
        range_sd=0.0,
        azimuth_sd=0.0,
        range_rate_sd=0.0,
        platform=Legs((500.0, 0.0, 0.0), 10.0, NORTH),
    )
    contact = Contact(1, Legs((500.0, 3_000.0, 0.0), 4.0, NORTH))
    _, columns, _ = played(Scenario(replace(radar, detection_probability=1.0), (contact,), 60.0))
    np.testing.assert_allclose(columns['azimuth'], NORTH, atol=1e-12)
    np.testing.assert_allclose(radar.antenna_azimuth(columns['time']), NORTH, atol=1e-9)
    np.testing.assert_allclose(columns['range_rate'], -6.0, atol=1e-9)
    np.testing.assert_allclose(columns['range'], 3_000.0 - 6.0 * columns['time'], atol=1e-6)


def test_detections_are_binomial():
    """The number detected lies in the central 99.9 % of the binomial distribution."""
    scenario = en_route(count=200, duration=400.0)
    scans, _, contact = played(scenario)
    passes = sum(len(scan.truth) for scan in scans)
    low, high = binom.interval(0.999, passes, scenario.radar.detection_probability)
    assert passes > 5_000
    assert low <= np.sum(contact != FALSE_PLOT) <= high


def test_false_plots_are_poisson_and_uniform():
    """Numbers per turn have the mean and variance asked for; range and azimuth are uniform."""
    radar = SimulatedRadar(
        2.0, 50.0, 0.002, clutter_per_turn=30.0, range_limits=(1_000.0, 50_000.0)
    )
    scans, columns, contact = played(Scenario(radar, (), 4_000.0))
    numbers = np.array([len(scan.contact) for scan in scans])
    assert len(numbers) == 2_000
    assert np.all(contact == FALSE_PLOT)
    low, high = poisson.interval(0.999, 30.0 * 2_000)
    assert low <= numbers.sum() <= high
    assert numbers.var() == pytest.approx(30.0, rel=0.12)  # 3.8 sd of a variance of 2000
    assert kstest(columns['range'], 'uniform', (1_000.0, 49_000.0)).pvalue > 1e-3
    assert kstest(columns['azimuth'], 'uniform', (-np.pi, 2 * np.pi)).pvalue > 1e-3
    off = wrap_angle(radar.antenna_azimuth(columns['time']) - columns['azimuth'])
    assert np.max(np.abs(off)) < 1e-9


def test_noise_has_the_sds_of_the_radar():
    """Errors of range, azimuth, elevation and range rate: mean 0 and their sd, within 4 sigma."""
    radar = replace(
        build('terminal').radar,
        range_rate_sd=2.0,
        detection_probability=1.0,
        clutter_per_turn=0.0,
    )
    scenario = replace(build('terminal'), radar=radar)
    scans, columns, _ = played(scenario)
    truth = find_passes(radar, scenario.contacts, scenario.duration)
    exact = place(radar, truth)
    count = len(truth)
    assert count == sum(len(scan.contact) for scan in scans) > 2_000
    for name, sd in [
        ('range', 50.0),
        ('azimuth', math.radians(0.1)),
        ('elevation', math.radians(0.15)),
        ('range_rate', 2.0),
    ]:
        error = columns[name] - exact[name]
        error = wrap_angle(error) if name == 'azimuth' else error
        assert abs(error.mean()) < 4.0 * sd / math.sqrt(count)
        assert error.std() == pytest.approx(sd, rel=4.0 / math.sqrt(2.0 * count))


def test_seam_has_contacts_twice_and_not_at_all_in_one_message():
    """Around north a turn's message holds a contact 0, 1 or 2 times; elsewhere once."""
    scenario = build('seam')
    scenario = replace(scenario, radar=replace(scenario.radar, detection_probability=1.0))
    scans, _, _ = played(scenario)
    times = np.array([[np.sum(scan.contact == c.id) for c in scenario.contacts] for scan in scans])
    assert set(np.unique(times)) == {0, 1, 2}
    assert np.sum(times == 2) >= 3
    assert np.sum(times[:100] == 0) >= 3
    from_east, from_west = times[:, 1], times[:, 0]  # the antenna turns from west to east
    assert from_east.max() == 2
    assert from_west[:100].min() == 0
    away = replace(scenario, radar=replace(scenario.radar, azimuth_start=-NORTH))
    counts = {int(np.sum(s.contact == 1)) for s in played(away)[0][:100]}
    assert counts == {1}


@pytest.mark.parametrize('name', SCENARIOS)
def test_plots_are_in_order_of_time_within_their_scan(name):
    """Every scan covers its own time, the scans all of it without a gap."""
    scenario = build(name)
    scans, _, _ = played(scenario)
    assert scans[0].start == 0.0
    assert scans[-1].end == pytest.approx(scenario.duration)
    for scan, following in zip(scans, [*scans[1:], None], strict=True):
        time = scan.columns['time']
        assert np.all(np.diff(time) >= 0.0)
        assert np.all((scan.start <= time) & (time < scan.end))
        assert following is None or following.start == scan.end


@pytest.mark.parametrize('name', SCENARIOS)
def test_same_seed_gives_the_same_plots(name):
    """Twice the same numbers; another seed gives others."""
    _, first, whose = played(build(name), seed=3)
    _, again, same = played(build(name), seed=3)
    _, other, _ = played(build(name), seed=4)
    np.testing.assert_array_equal(whose, same)
    for column, value in first.items():
        np.testing.assert_array_equal(value, again[column])
    assert not np.array_equal(first['snr'], other['snr'])


def test_sectors_cut_the_same_plots_finer():
    """Eight messages in a turn hold together what one message holds."""
    scans, whole, _ = played(build('seam'))
    sectors, cut, _ = played(build('seam'), sectors=8)
    assert len(sectors) == 8 * len(scans)
    for name, value in whole.items():
        np.testing.assert_array_equal(value, cut[name])


def test_duration_may_end_within_a_turn():
    """The last message is short then, and nothing comes after the end."""
    scans, columns, _ = played(replace(build('turns'), duration=10.0), sectors=2)
    assert [scan.end for scan in scans] == [2.0, 4.0, 6.0, 8.0, 10.0]
    assert columns['time'].max() < 10.0


def test_azimuth_coverage_limits_true_and_false_plots():
    """A sector radar sees nothing outside its sector, and all its false plots inside."""
    scenario = build('turns')
    radar = replace(scenario.radar, azimuth_coverage=(0.5, 1.0), azimuth_sd=0.0)
    _, columns, contact = played(replace(scenario, radar=radar))
    assert np.all((columns['azimuth'] >= 0.5) & (columns['azimuth'] <= 1.5))
    assert set(np.unique(contact)) == {FALSE_PLOT, 1}
    assert np.sum(contact == FALSE_PLOT) == pytest.approx(15.0 * 150, rel=0.1)


@pytest.mark.parametrize(('apart', 'expected'), [(120.0, 1), (180.0, 2)])
def test_plots_in_one_resolution_cell_become_one(apart, expected):
    """Two contacts closer than the resolution give their mean, across the cut at west too."""
    radar = SimulatedRadar(
        4.0,
        range_sd=0.0,
        azimuth_sd=0.0,
        detection_probability=1.0,
        range_resolution=150.0,
        azimuth_resolution=0.02,
        rotation='anticlockwise',
    )
    pair = (
        Contact(1, Legs((-20_000.0, -100.0, 0.0), 0.0, 0.0)),
        Contact(2, Legs((-20_000.0 - apart, 100.0, 0.0), 0.0, 0.0)),
    )
    scans, columns, _ = played(Scenario(radar, pair, 40.0))
    assert [len(scan.contact) for scan in scans] == [expected] * 10
    if expected == 1:
        np.testing.assert_allclose(columns['range'], 20_000.25 + apart / 2.0, atol=0.1)
        np.testing.assert_allclose(np.abs(columns['azimuth']), math.pi, atol=1e-4)


def test_crossing_is_the_scene_of_the_issue():
    """Mirrored paths, 100 scans, 4.9 false plots a scan, closest 250 m apart."""
    scenario = build('crossing')
    left, right = (contact.trajectory for contact in scenario.contacts)
    time = np.linspace(0.0, 495.0, 400)
    (here, velocity), (there, opposite) = left.at(time), right.at(time)
    np.testing.assert_allclose(here[:, 0] + there[:, 0], 6_500.0, atol=1e-6)
    np.testing.assert_allclose(here[:, 1], there[:, 1], atol=1e-6)
    np.testing.assert_allclose(velocity * [-1.0, 1.0, 1.0], opposite, atol=1e-9)
    assert scenario.radar.clutter_per_turn == pytest.approx(4.90, abs=0.01)
    assert len(played(scenario)[0]) == 100
    np.testing.assert_allclose(here[0], (25_000.0, 10_000.0, 0.0))


def test_two_mode_plots_are_cartesian():
    """Errors of x and y have sd 100 m: mean square within 4 sigma over many runs."""
    scenario = build('two_mode')
    exact, _ = scenario.contacts[0].trajectory.at(5.0 * np.arange(100))
    runs = [played(scenario, seed)[1] for seed in range(50)]
    error = np.array([[run['x'], run['y']] for run in runs]) - exact.T[:2]
    assert error.std() == pytest.approx(100.0, rel=4.0 / math.sqrt(2.0 * error.size))


@pytest.mark.parametrize('count', [50, 800])
def test_en_route_keeps_its_density(count):
    """About one aircraft on 15 km x 15 km, however many there are."""
    scenario = en_route(count, duration=8.0)
    place = np.array([contact.trajectory.at(0.0)[0] for contact in scenario.contacts])
    radius = np.hypot(*place[:, :2].T).max()
    assert count * 15_000.0**2 / (math.pi * radius**2) == pytest.approx(1.0, rel=0.1)


def test_unknown_scenario_names_the_nearest():
    """A slip of the finger is answered with the right word."""
    with pytest.raises(ValueError, match=r"no scenario 'crosing'; did you mean 'crossing'\?"):
        build('crosing')


@pytest.mark.parametrize(
    ('make', 'message'),
    [
        (lambda: Leg(0.0) and Legs((0.0, 0.0, 0.0), 1.0, 0.0, (Leg(0.0),)), 'above 0 s, got 0.0'),
        (lambda: Sampled(np.zeros(1), np.zeros((1, 3))), r'K of 2 and more, got \(1,\)'),
        (lambda: SimulatedRadar(0.0, 1.0, 1.0), r'period must be above 0 s, got 0\.0'),
        (
            lambda: SimulatedRadar(1.0, 1.0, 1.0, detection_probability=1.2),
            r'in \[0, 1\], got 1\.2',
        ),
        (lambda: replace(build('z0'), duration=-1.0), r'duration must be above 0 s, got -1\.0'),
        (lambda: replace(build('z0'), contacts=build('z0').contacts * 2), r'different ids'),
        (lambda: played(build('z0'), sectors=2), 'must be 1 for a staring radar'),
        (lambda: played(build('turns'), sectors=0), 'at least 1, got 0'),
    ],
)
def test_wrong_construction_is_refused(make, message):
    """The message says field, limit and value."""
    with pytest.raises(ValueError, match=message):
        make()
