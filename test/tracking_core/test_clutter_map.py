# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where clutter is dense is learnt from what no track explains, cell by cell."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.testing import assert_allclose
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.sensor import Radar
from tracking_core.batches import Coverage, Scan
from tracking_core.clutter import Clutter
from tracking_core.clutter_map import (
    cells,
    ClutterMap,
    looks_at_spokes,
    RING_EDGES,
    RINGS,
    SPOKES,
)
from tracking_core.clutter_pattern import Pattern
from tracking_core.density import Density, expected_density
from tracking_core.faint_starts import share_of_faint
from tracking_core.space import ANGLES, POINTS

HERE = (0.0, 0.0, 0.0)
FARTHEST = 30e3  # [m]
DEPTH = np.diff(np.minimum(RING_EDGES, FARTHEST)) * 2.0 * np.pi / SPOKES  # plot space of cells
ONCE = np.ones(SPOKES)
SPACE = FARTHEST * 2.0 * np.pi  # of all [m rad]


def places(distance, azimuth):
    """Return points at these polar places."""
    return np.column_stack([distance * np.cos(azimuth), distance * np.sin(azimuth)])


def even(rng, plots: float):
    """Return false plots spread evenly over the plot space."""
    count = rng.poisson(plots)
    return places(rng.uniform(0.0, FARTHEST, count), rng.uniform(-np.pi, np.pi, count))


def learnt(looks) -> ClutterMap:
    """Return the map after whole looks with these plots."""
    known = ClutterMap.blank(POINTS)
    for plots in looks:
        known = known.add(cells(POINTS, HERE, plots), np.ones(len(plots)), ONCE, 1.0)
    return known


def at(known: ClutterMap, distance: float, azimuth: float, mean: float) -> float:
    """Return the density at a place."""
    place = places(np.array([distance]), np.array([azimuth]))
    return mean * float(Pattern(known, mean, POINTS, HERE, 0, DEPTH).relief(place)[0])


def test_cells_are_spokes_and_rings() -> None:
    """A cell goes by distance and azimuth from the sensor; what is too far is in the last ring."""
    origin = (100.0, -50.0, 7.0)
    distance, azimuth = np.array([1.0, 5.1, 700.0, 700.0, 9e6]), np.array([0.0, 0.0, 1.0, -1.0, 3])
    cell = cells(POINTS, origin, places(distance, azimuth) + origin[:2])
    spoke, ring = np.divmod(cell, RINGS)
    assert ring.tolist() == [0, 0, *2 * [RING_EDGES.searchsorted(700.0) - 1], RINGS - 1]
    assert spoke.tolist() == [0, 0, 10, 53, 30]
    assert cells(ANGLES, origin, np.array([[1.0], [-1.0], [7.0]])).tolist() == [10, 53, 7]


def test_even_clutter_makes_a_flat_map() -> None:
    """Without a pattern the density is the mean, but for chance."""
    rng = np.random.default_rng(1)
    known, mean = learnt(even(rng, 60.0) for _ in range(40)), 60.0 / SPACE
    relief = Pattern(known, mean, POINTS, HERE, 0, DEPTH).relief(even(rng, 3000.0))
    assert abs(relief.mean() - 1.0) < 0.1
    assert relief.std() < 0.35


def test_rain_is_found_where_it_is() -> None:
    """A hundred plots in 4 km by 0.5 rad: the density there, and the little elsewhere."""
    rng = np.random.default_rng(2)

    def rain():
        count = rng.poisson(100.0)
        return places(rng.uniform(8e3, 12e3, count), rng.uniform(0.2, 0.7, count))

    known = learnt(np.concatenate([even(rng, 5.0), rain()]) for _ in range(30))
    mean, there = 105.0 / SPACE, 100.0 / (4e3 * 0.5)
    assert at(known, 10e3, 0.45, mean) == pytest.approx(there, rel=0.25)
    assert at(known, 10e3, -2.0, mean) < 0.3 * mean
    assert at(known, 1e3, 0.45, mean) < 0.5 * mean


def test_contact_does_not_take_itself_for_clutter() -> None:
    """Plots of one cell tell of the cells around, not of their own."""
    ring = int(RING_EDGES.searchsorted(10e3)) - 1
    middle = np.array([0.5 * (RING_EDGES[ring] + RING_EDGES[ring + 1])])
    spoke = 2.0 * np.pi / SPOKES
    looks = [places(middle, np.array([20.5 * spoke]))] * 40
    rng, mean = np.random.default_rng(3), 30.0 / SPACE
    alone = learnt(even(rng, 30.0) for _ in range(40))
    rng = np.random.default_rng(3)
    beside = learnt(np.concatenate([plots, even(rng, 30.0)]) for plots in looks)
    here = (float(middle[0]), 20.5 * spoke, mean)
    assert at(beside, *here) == pytest.approx(at(alone, *here))
    there = (float(middle[0]), 21.5 * spoke, mean)
    assert at(beside, *there) > 2.0 * at(alone, *there)


def test_map_goes_on_past_a_whole_turn() -> None:
    """North, where the spokes begin, is not the edge of anything."""
    rng, looks = np.random.default_rng(4), []
    for _ in range(30):
        count = rng.poisson(60.0)
        looks.append(places(rng.uniform(8e3, 12e3, count), rng.uniform(-0.3, 0.3, count)))
    known, mean = learnt(looks), 60.0 / SPACE
    inside = [at(known, 10e3, azimuth, mean) for azimuth in (-0.15, -0.01, 0.01, 0.15)]
    assert_allclose(inside, 60.0 / (4e3 * 0.6), rtol=0.3)


def test_relief_turns_with_the_world() -> None:
    """A map turned by some spokes has the same relief in places that are turned as well."""
    rng = np.random.default_rng(6)
    count, looks = rng.poisson(2.0, (SPOKES, RINGS)) * 1.0, rng.uniform(1.0, 9.0, (SPOKES, RINGS))
    distance, azimuth = rng.uniform(0.0, FARTHEST, 400), rng.uniform(0.0, 2.0 * np.pi, 400)
    reliefs = [
        Pattern(
            ClutterMap(np.roll(count, turned, axis=0), np.roll(looks, turned, axis=0)),
            1e-3, POINTS, HERE, 0, DEPTH,
        ).relief(places(distance, azimuth + 2.0 * np.pi * turned / SPOKES))
        for turned in (0, 5, 32, -5)
    ]  # fmt: skip
    for other in reliefs[1:]:
        assert_allclose(other, reliefs[0], rtol=1e-9)


@pytest.mark.parametrize(('nearest', 'farthest'), [(0.0, 20e3), (700.0, 20e3), (700.0, 5e3)])
def test_pattern_knows_the_space_that_the_radar_sees(nearest: float, farthest: float) -> None:
    """Its cells are all of it; nearer and farther places are as the nearest and farthest ring."""
    sensor = RadarTrackerConfig().sensor
    radar = Radar(replace(sensor, range_min=nearest, sector_width=2.0), 2, is_polar=True)
    M, coverage = 1, Coverage(0.0, 0.0, sensor_position=(50.0, 60.0, 0.0), sector_width=2.0)
    scan = Scan(
        np.zeros(M), np.zeros((M, 2)), np.zeros((M, 2, 2)), np.zeros(M), np.zeros(M), np.zeros(M),
        np.zeros(M), np.zeros((M, 3)), np.zeros((M, 3)), coverage,
        volume=radar.plot_space_volume(farthest),
    )  # fmt: skip
    rng = np.random.default_rng(7)
    known = ClutterMap(rng.poisson(2.0, (SPOKES, RINGS)) * 1.0, np.ones((SPOKES, RINGS)))
    pattern = Pattern.of(known, 1e-3, scan, radar)
    cells_a_ring = SPOKES * 2.0 / (2.0 * np.pi)
    assert pattern.depth.sum() * cells_a_ring == pytest.approx(scan.volume, rel=1e-3)
    assert (pattern.depth > 0.0).all()
    edges = RING_EDGES[pattern.first :][: len(pattern.depth) + 1]
    assert edges[0] <= nearest < edges[1]
    assert edges[-2] < farthest <= edges[-1]
    distance = np.array([1e-3, 0.5 * (edges[0] + edges[1]), farthest, 1e7])
    relief = pattern.relief(places(distance, 0.5) + np.array([50.0, 60.0]))
    assert_allclose(relief[[0, 3]], relief[[1, 2]])
    assert abs(relief[1] / relief[2] - 1.0) > 0.1


def test_radar_that_sees_a_metre_has_no_pattern() -> None:
    """Its whole space is within the depth that is assumed at least."""
    radar, volume = Radar(RadarTrackerConfig().sensor, 2, is_polar=True), 2.0 * np.pi
    none, plot = np.zeros(1), np.array([[0.5, 0.1]])
    scan = Scan(
        none, plot, np.zeros((1, 2, 2)), none, none, none, none, np.zeros((1, 3)),
        np.zeros((1, 3)), Coverage(0.0, 0.0), volume=volume,
    )  # fmt: skip
    count = np.full((SPOKES, RINGS), 2.0)
    known = Clutter(ClutterMap(count, np.ones_like(count)), 3.0, 9.0)
    density = expected_density(known, 0.0, 1.0, scan, radar, 1.0)
    assert density.pattern is None
    assert_allclose(density.relief(plot), 1.0)


def test_only_blocks_with_a_jump_forget() -> None:
    """Eight spokes by eight rings; for a sonar, eight spokes."""
    for space, size in ((POINTS, 8), (ANGLES, 1)):
        rings = RINGS if space is POINTS else 1
        old = ClutterMap(np.ones((SPOKES, rings)), np.full((SPOKES, rings), 5.0))
        plots, spoke, ring = 200.0, 20, 43 % rings
        new = old.add(np.array([spoke * rings + ring]), np.array([plots]), ONCE, 1.0)
        forgotten = np.zeros((SPOKES, rings), bool)
        forgotten[16:24, ring // 8 * 8 : ring // 8 * 8 + size] = True
        assert_allclose(new.looks, np.where(forgotten, 1.0, 1.0 + 5.0 * np.exp(-0.1)))


def test_turns_of_clutter_go_from_none_to_all() -> None:
    """By hand: a quarter of the plots in the first spoke, the rest in the last one."""
    count = np.zeros((SPOKES, 1))
    count[0], count[-1] = 1.0, 3.0
    known, spoke = ClutterMap(count, count), 2.0 * np.pi / SPOKES
    turns = [known.turns_of_clutter(k * spoke) for k in (0.0, 0.5, 1.0, 63.0, 63.5, 64.5, -1.0)]
    assert_allclose(turns, [0.0, 0.125, 0.25, 0.25, 0.625, 1.125, -0.75])


def test_rain_that_sets_in_is_believed_at_once() -> None:
    """Where there are suddenly many plots, the calm before is void, but only there."""
    rng = np.random.default_rng(5)
    known, mean = learnt(even(rng, 40.0) for _ in range(30)), 40.0 / SPACE
    calm = at(known, 10e3, -2.0, mean)
    rain = places(rng.uniform(8e3, 12e3, 100), rng.uniform(0.2, 0.7, 100))
    after = known.add(cells(POINTS, HERE, rain), np.ones(100), ONCE, 1.0)
    assert at(after, 10e3, 0.45, mean) > 0.35 * 100.0 / (4e3 * 0.5)
    assert at(after, 10e3, -2.0, mean) == pytest.approx(calm, rel=0.15)


def test_few_plots_make_no_pattern() -> None:
    """Eight plots in one place may be anything; in the first looks so may 24: all is new."""
    assert ClutterMap.blank(ANGLES).is_flat
    plots = places(np.full(8, 1e3), np.linspace(0.0, 0.1, 8))
    assert learnt([plots]).is_flat
    assert learnt([plots] * 3).is_flat
    assert not learnt([np.repeat(plots, 5, axis=0)]).is_flat
    later = ClutterMap.blank(POINTS).add(cells(POINTS, HERE, plots), np.ones(8), 5.0 * ONCE, 1.0)
    assert later.is_flat
    assert not later.add(cells(POINTS, HERE, plots), np.ones(8), ONCE, 1.0).is_flat


def test_plots_of_contacts_are_taken_back() -> None:
    """In and beside their cells, by how many are there; never more than there are."""
    count = np.zeros((SPOKES, RINGS))
    count[0, 40], count[63, 41], count[2, 40], count[30, 0] = 6.0, 3.0, 5.0, 1.0
    known = ClutterMap(count, np.ones((SPOKES, RINGS)))
    left = known.without(np.array([0 * RINGS + 40, 30 * RINGS]), np.array([3, 4]))
    assert_allclose(left.count[[0, 63, 2, 30], [40, 41, 40, 0]], [4.0, 2.0, 5.0, 0.0])
    assert left.count.sum() == pytest.approx(11.0)
    angles = ClutterMap(np.full((SPOKES, 1), 2.0), np.ones((SPOKES, 1)))
    left = angles.without(np.array([63]), np.array([3]))
    assert_allclose(left.count[[61, 62, 63, 0, 1], 0], [2.0, 1.0, 1.0, 1.0, 2.0])
    assert_allclose(known.without(np.zeros(0, int), np.zeros(0, int)).count, count)


@pytest.mark.parametrize('direction', [1.0, -1.0])
@pytest.mark.parametrize('begin', [0.0, 2.0, -9.0])
def test_sectors_of_a_turn_are_one_look(begin: float, direction: float) -> None:
    """However a turn is cut, every spoke is looked at once."""
    cuts = begin + direction * np.array([0.0, 0.3, 1.0, 4.0, 2.0 * np.pi])
    parts = [
        looks_at_spokes(Coverage(0.0, 1.0, float(start), float(end - start)))
        for start, end in pairwise(cuts)
    ]
    assert_allclose(np.sum(parts, axis=0), 1.0)
    assert all((part >= 0.0).all() for part in parts)
    assert parts[0].sum() == pytest.approx(0.3 / (2.0 * np.pi) * SPOKES)


def test_spokes_beside_the_sector_are_not_looked_at() -> None:
    """A sensor that stares into a sector across north."""
    looks = looks_at_spokes(Coverage(0.0, 0.0, sector_centre=0.0, sector_width=np.pi / 2.0))
    assert_allclose(looks, np.r_[np.ones(8), np.zeros(48), np.ones(8)], atol=1e-12)
    assert_allclose(looks_at_spokes(Coverage(0.0, 0.0)), 1.0)


def test_marks_of_a_turn_go_by_its_clutter() -> None:
    """A sector with all the rain has nearly all of the faint starts, the others share the rest."""
    rng, looks = np.random.default_rng(6), []
    for _ in range(20):
        count = rng.poisson(90.0)
        rain = places(rng.uniform(8e3, 12e3, count), rng.uniform(0.1, 0.7, count))
        looks.append(np.concatenate([rain, even(rng, 10.0)]))
    pattern = Pattern(learnt(looks), 100.0 / SPACE, POINTS, HERE, 0, DEPTH)
    density, eighth = Density(1e-9, 1e-9, pattern=pattern), np.pi / 4.0
    shares = [
        share_of_faint(30, Coverage(0.5 * k, 0.5 * k + 0.5, k * eighth, eighth), density)
        for k in range(8)
    ]
    assert 26 <= shares[0] <= 29
    assert sum(shares) == 30
    back = [
        share_of_faint(30, Coverage(0.5 * k, 0.5 * k + 0.5, -k * eighth, -eighth), density)
        for k in range(8)
    ]
    assert 26 <= back[7] <= 29
    assert sum(back) == 30
    assert share_of_faint(30, Coverage(0.0, 6.0, 0.0, 3.0 * np.pi), density) == 30


def test_existence_is_likelier_where_the_clutter_is_thin() -> None:
    """The same new contacts come everywhere; false plots do not."""
    density = Density(clutter=4e-6, new_contacts=1e-6)
    assert_allclose(density.total(np.array([0.0, 1.0, 10.0])), [1e-6, 5e-6, 41e-6])
    assert_allclose(density.existence(np.array([0.0, 1.0])), [1.0, 0.2])
    assert density.relief(np.zeros((3, 2))).tolist() == [1.0, 1.0, 1.0]
