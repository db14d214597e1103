# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots of a look that are within the size of a contact become one."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core import several_plots
from tracking_core.batches import Coverage, Floats, Scan
from tracking_core.rows import take
from tracking_core.several_plots import Extent, ONE_PLOT
from tracking_core.space import POINTS

SIZE, INTERVAL = 50.0, 2.0
EXTENT = Extent(size=SIZE, speed_max=20.0)


def scan_of(position: Floats, time: float | Floats = 0.0, rate: float | Floats = np.nan) -> Scan:
    """Return plots at these places (M, d), from a radar in the origin."""
    M, d = position.shape
    return Scan(
        time=np.zeros(M) + time, position=position, covariance=np.tile(9.0 * np.eye(d), (M, 1, 1)),
        range_rate=np.zeros(M) + rate, range_rate_variance=np.ones(M), snr=np.full(M, np.nan),
        clutter_volume=np.ones(M), sensor_position=np.zeros((M, 3)),
        sensor_velocity=np.zeros((M, 3)), coverage=Coverage(0.0, 0.0), volume=1.0,
    )  # fmt: skip


def gathered(scan: Scan, held: Scan | None = None) -> Scan:
    """Return the scan with one plot a contact."""
    return EXTENT.gather(held, scan, INTERVAL, POINTS)


def test_gather_leaves_plots_alone_where_contacts_give_one() -> None:
    """The very same scan."""
    scan = scan_of(np.zeros((3, 2)))
    assert ONE_PLOT.gather(None, scan, INTERVAL, POINTS) is scan


def test_gather_returns_the_mean_no_surer_than_a_plot() -> None:
    """Three along a hull, and one elsewhere, in the order of their first plots."""
    place = np.array([[1000.0, 0.0], [3000.0, 0.0], [1020.0, 9.0], [1040.0, 0.0]])
    one = gathered(scan_of(place, np.array([0.0, 0.1, 0.2, 0.4])))
    assert_allclose(one.position, [[1020.0, 3.0], [3000.0, 0.0]])
    assert_allclose(one.time, [0.2, 0.1])
    assert_allclose(one.covariance, np.tile(9.0 * np.eye(2), (2, 1, 1)))


def test_gather_makes_contacts_as_large_as_can_be_and_no_larger() -> None:
    """No box about the plots of one is larger, no two of them fit into one; many at once."""
    rng = np.random.default_rng(1)
    place = rng.uniform(0.0, 400.0, (60, 2))
    contact = EXTENT._contacts(scan_of(place), 1.0, POINTS)
    boxes = [place[contact == k] for k in range(contact.max() + 1)]
    assert 5 < len(boxes) < 60
    assert max(np.hypot(*np.ptp(box, axis=0)) for box in boxes) <= SIZE
    for one, other in combinations(boxes, 2):
        assert np.hypot(*np.ptp(np.concatenate([one, other]), axis=0)) > SIZE


def test_gather_goes_by_no_order_of_the_plots() -> None:
    """Permuted plots give the same contacts."""
    rng = np.random.default_rng(2)
    scan = scan_of(rng.uniform(0.0, 400.0, (60, 2)))
    one, other = gathered(scan), gathered(take(scan, rng.permutation(60)))
    assert_allclose(*(np.sort(s.position, axis=0) for s in (one, other)), atol=1e-9)


def test_gather_keeps_looks_and_range_rates_apart() -> None:
    """A pass later, or far faster than a contact seen askew can be: another plot."""
    place = np.array([[1000.0, 0.0], [1010.0, 0.0]])
    assert len(gathered(scan_of(place, np.array([0.0, 1.9])))) == 2
    assert len(gathered(scan_of(place, np.array([0.0, 0.1])))) == 1
    assert len(gathered(scan_of(place, rate=np.array([0.0, 10.0])))) == 2
    assert len(gathered(scan_of(place, rate=np.array([0.0, 3.0])))) == 1  # noise of both 1.4
    assert len(gathered(scan_of(place, rate=np.array([0.0, np.nan])))) == 1


def test_ambiguous_range_rates_of_a_contact_may_lie_at_both_ends() -> None:
    """Of 20 m/s in all, 9.9 and -9.6 are 0.5 apart; three are one and have their mean."""
    place = np.array([[1000.0, 0.0], [1010.0, 0.0], [1020.0, 0.0], [1030.0, 0.0]])
    scan = scan_of(place, rate=np.array([9.9, -9.6, 9.4, 0.0]))
    one = gathered(replace(scan, range_rate_interval=20.0))
    assert_allclose(one.range_rate, [9.9, 0.0], atol=0.01)
    assert len(gathered(scan)) == 3


def test_plot_without_a_range_rate_does_not_make_one_of_two_contacts() -> None:
    """Of three side by side the first does not tell; 0 and 20 m/s stay two, of 100 in all."""
    scan = scan_of(np.array([[1000.0, 0.0], [1001.0, 0.0], [1003.0, 0.0]]), 0.0)
    scan = replace(scan, range_rate=np.array([np.nan, 0.0, 20.0]))
    for interval in (0.0, 100.0):
        two = gathered(replace(scan, range_rate_interval=interval))
        assert_allclose(two.range_rate, [0.0, 20.0], atol=1e-9)


def test_plots_with_and_without_height_are_one_among_those_with() -> None:
    """False plots are counted per m^3 where the height is known, per m^2 elsewhere."""
    scan = scan_of(np.array([[1000.0, 0.0, np.nan], [1010.0, 0.0, 10.0], [3000.0, 0.0, np.nan]]))
    one = gathered(replace(scan, clutter_volume=np.array([1e-3, 1e-6, 2e-3])))
    assert_allclose(one.clutter_volume, [1e-6, 2e-3])


def test_range_rates_of_a_contact_near_by_differ_more() -> None:
    """At 30 m a car 5 m wide that drives across shows ends that come and go: 20 m/s times 1/6."""
    near, far = np.array([[30.0, -2.5], [30.0, 2.5]]), np.array([[300.0, -2.5], [300.0, 2.5]])
    rate = np.array([-3.5, 3.5])
    assert len(gathered(scan_of(near, rate=rate))) == 1
    assert len(gathered(scan_of(far, rate=rate))) == 2


def test_gather_takes_what_waited_and_what_is_not_measured() -> None:
    """Half a ship in the last sector, half in this one, of which one plot has no height."""
    held = scan_of(np.array([[1000.0, 0.0, 8.0]]))
    scan = scan_of(np.array([[1010.0, 20.0, np.nan], [1010.0, 30.0, 10.0]]), 0.1)
    one = gathered(scan, replace(held, coverage=Coverage(-1.0, 0.0)))
    assert_allclose(one.position, [[3020.0 / 3.0, 50.0 / 3.0, 9.0]])
    assert one.coverage == scan.coverage


def test_no_plot_is_no_contact() -> None:
    """An empty scan stays as it is."""
    nothing = scan_of(np.zeros((0, 2)))
    assert gathered(nothing) is nothing


def test_range_rates_differ_by_noise_and_by_how_askew_a_contact_is_seen() -> None:
    """By hand: 3 sqrt(2) sd, and speeds of both times 10 m over 100 m of range."""
    place = np.array([[100.0, 0.0], [100.0, 10.0]])
    for sd, ship in ((1.0, 0.0), (2.0, 0.0), (1.0, 30.0)):
        limit = 3.0 * np.sqrt(2.0) * sd + (20.0 + ship) * 0.1
        for part, contacts in ((0.99, 1), (1.01, 2)):
            scan = replace(
                scan_of(place + np.array([500.0, -300.0]), rate=np.array([0.0, part * limit])),
                range_rate_variance=np.full(2, sd**2),
                sensor_position=np.tile([500.0, -300.0, 0.0], (2, 1)),
                sensor_velocity=np.tile([0.6 * ship, 0.8 * ship, 5.0], (2, 1)),
            )
            assert len(gathered(scan)) == contacts


def test_plots_of_half_the_interval_apart_are_of_two_looks() -> None:
    """Less than that is one look."""
    place = np.array([[1000.0, 0.0], [1010.0, 0.0]])
    for time, contacts in ((0.49 * INTERVAL, 1), (0.5 * INTERVAL, 2)):
        assert len(gathered(scan_of(place, np.array([0.0, time])))) == contacts


@pytest.mark.parametrize('step', [0.0, 20.0], ids=['the same', 'in a row'])
def test_gather_takes_few_rounds_where_plots_are_equally_near(step: float, monkeypatch) -> None:
    """Rows that fill up a message, cells of a map: pairs are made everywhere at once."""
    rounds, pair_up = [], several_plots._nearest_of_each_other

    def counted(*pairs):
        rounds.append(len(pairs[0]))
        return pair_up(*pairs)

    monkeypatch.setattr(several_plots, '_nearest_of_each_other', counted)
    place = np.column_stack([step * np.arange(1000.0), np.full(1000, 500.0)])
    one = gathered(scan_of(place, rate=np.where(np.arange(1000) % 2, np.nan, 3.0)))
    assert len(rounds) < 20
    assert_allclose(one.position[:, 1], 500.0)
    assert (len(one) == 1) == (step == 0.0)
