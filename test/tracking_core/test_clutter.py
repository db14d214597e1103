# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The clutter density is learnt from what no track explains."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.sensor import Radar
from tracking_core.batches import Coverage, Floats, Scan
from tracking_core.clutter import Clutter, estimate_density
from tracking_core.clutter_map import ClutterMap, RINGS, SPOKES
from tracking_core.density import expected_density
from tracking_core.space import POINTS

VOLUME = 2.0e5
FARTHEST = 30e3  # [m]
SENSOR = RadarTrackerConfig().sensor
RADAR = Radar(SENSOR, 2, is_polar=True)
HERE = Coverage(0.0, 0.0)
NOTHING = Clutter(ClutterMap.blank(POINTS))


def plots_at(position: Floats) -> Scan:
    """Return a scan of which only places (M, 2) and space are told."""
    none, of_sensor = np.zeros(len(position)), np.zeros((len(position), 3))
    noise, volume = np.zeros((len(position), 2, 2)), float(RADAR.plot_space_volume(FARTHEST))
    return Scan(
        none, position, noise, none, none, none, none, of_sensor, of_sensor, HERE, volume=volume
    )


@pytest.mark.parametrize('share', [1.0, 0.25])
@pytest.mark.parametrize('plots', [4.0, 60.0])
def test_estimate_density_converges_to_the_truth(plots: float, share: float) -> None:
    """Poisson counts of full turns or quarter sectors; the mean of the late estimates is true."""
    rng = np.random.default_rng(1)
    density, looks, late = 0.0, 0.0, []
    for k in range(4000):
        count = rng.poisson(plots * share)
        density, looks = estimate_density(density, looks, count, VOLUME, share)
        late += [density] if k > 100 else []
    assert np.mean(late) * VOLUME == pytest.approx(plots, rel=0.05)
    # Ten looks averaged exponentially: a standard deviation of sqrt(plots / 19).
    assert np.std(late) * VOLUME < 1.5 * np.sqrt(plots / 19.0)


def test_estimate_density_starts_with_the_first_look() -> None:
    """The first full look is taken as it is, the second is averaged with it."""
    density, looks = estimate_density(0.0, 0.0, 10.0, VOLUME, 1.0)
    assert (density * VOLUME, looks) == (pytest.approx(10.0), 1.0)
    density, looks = estimate_density(density, looks, 20.0, VOLUME, 1.0)
    assert (density * VOLUME, looks) == (pytest.approx(15.0), 2.0)


def test_estimate_density_never_says_never() -> None:
    """Half a false plot a look is assumed at least."""
    density, looks = 1e-3, 10.0
    for _ in range(500):
        density, looks = estimate_density(density, looks, 0.0, VOLUME, 1.0)
    assert density == pytest.approx(0.5 / VOLUME)


def sector(first: float, width: float, turns: float = 0.0) -> Coverage:
    """Return a message of an antenna that turns once in 4 s."""
    sweep = width + 2.0 * np.pi * turns
    start = 4.0 * first / (2.0 * np.pi)
    return Coverage(start, start + 4.0 * sweep / (2.0 * np.pi), first, sweep)


def look(known: Clutter, azimuth: Floats, coverage: Coverage, radar: Radar = RADAR) -> Clutter:
    """Return what is known after plots that no track explains, 10 km away."""
    M = len(azimuth)
    position = 10e3 * np.column_stack([np.cos(azimuth), np.sin(azimuth)])
    volume = float(radar.plot_space_volume(FARTHEST))
    scan = replace(plots_at(position), coverage=coverage, volume=volume)
    return known.learn(scan, np.ones(M), np.ones(M, bool), radar)


def plots_a_look(known: Clutter, radar: Radar = RADAR) -> float:
    """Return how many false plots a full look is thought to give."""
    return known.density * float(radar.plot_space_volume(FARTHEST))


def looks_all_around(known: Clutter, count: int, plots: int) -> Clutter:
    """Return what is known after whole turns with evenly spread plots."""
    azimuth = np.linspace(0.0, 2.0 * np.pi, plots, endpoint=False)
    for _ in range(count):
        known = look(known, azimuth, sector(0.0, 2.0 * np.pi))
    return known


def test_jump_is_followed_at_once() -> None:
    """When the sea gets up the old average is void."""
    calm = looks_all_around(NOTHING, 20, 10)
    assert plots_a_look(calm) == pytest.approx(10.0)
    assert plots_a_look(looks_all_around(calm, 1, 200)) == pytest.approx(200.0)


@pytest.mark.parametrize(('plots', 'is_jump'), [(28, False), (40, True)])
def test_jump_in_a_sector_is_known(plots: int, is_jump: bool) -> None:
    """An eighth of a turn with 10 plots usually: twice that and ten more are still chance."""
    calm = looks_all_around(NOTHING, 20, 80)
    after = look(calm, np.linspace(0.01, 0.77, plots), sector(0.0, np.pi / 4.0))
    expected = 8.0 * plots if is_jump else 80.0 + 0.0125 * (8.0 * plots - 80.0)
    assert plots_a_look(after) == pytest.approx(expected)


def test_sector_that_always_has_all_the_rain_is_no_jump() -> None:
    """After each turn the mean is that of a turn."""
    known, eighth = NOTHING, np.pi / 4.0
    for k in range(80):
        rain = np.linspace(2.1 * eighth, 2.9 * eighth, 100 if k % 8 == 2 else 0)
        known = look(known, rain, sector(k % 8 * eighth, eighth))
        if k % 8 == 7:
            assert plots_a_look(known) == pytest.approx(100.0, rel=0.15)


@pytest.mark.parametrize('width', [np.pi / 2.0, 0.13])
@pytest.mark.parametrize('parts', [1, 2, 5])
def test_look_is_at_the_sector_that_the_sensor_sees(parts: int, width: float) -> None:
    """A quarter of the turn or a spoke and a third, with 60 plots a look in a message or more."""
    radar = Radar(replace(SENSOR, sector_width=width), 2, is_polar=True)
    known, part = NOTHING, width / parts
    for k in range(20 * parts):
        first = -0.5 * width + k % parts * part
        seen = replace(sector(first, part), sector_width=width)
        azimuth = first + np.linspace(0.05, 0.95, 60 // parts) * part
        known = look(known, azimuth, seen, radar)
    assert plots_a_look(known, radar) == pytest.approx(60.0, rel=0.02)


def test_message_of_three_turns_is_three_looks() -> None:
    """Their plots come together."""
    azimuth, known = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False), NOTHING
    for _ in range(3):
        known = look(known, azimuth, sector(0.0, 0.0, turns=3.0))
    assert plots_a_look(known) == pytest.approx(20.0)


def test_scan_that_saw_nothing_of_the_sector_teaches_nothing() -> None:
    """An antenna that is blanked there."""
    known = looks_all_around(NOTHING, 3, 20)
    behind = replace(sector(3.0, 0.5), sector_width=1.0)
    assert look(known, np.zeros(0), behind) is known


def test_first_message_is_no_whole_look() -> None:
    """Ten plots in a sixteenth of a turn are 160 in all."""
    scan = replace(plots_at(np.full((10, 2), 10e3)), coverage=sector(0.0, np.pi / 8.0))
    density = expected_density(NOTHING, 0.0, 0.0, scan, RADAR, 1.0)
    assert density.clutter * scan.volume == pytest.approx(160.0)


def test_what_is_taken_back_is_no_more_than_is_remembered() -> None:
    """Of a track that was confirmed after a hundred plots, ten looks' are still in the map."""
    count = np.full((SPOKES, RINGS), 2.0)
    known = Clutter(ClutterMap(count, np.ones_like(count)), 1e-3, 5.0)
    place = np.array([[10e3, 0.0]])
    left = [known.without(place, np.array([hits]), HERE, RADAR) for hits in (4, 10, 100)]
    taken = [count.sum() - after.map.count.sum() for after in left]
    assert taken == pytest.approx([2.8, 7.0, 7.0])
