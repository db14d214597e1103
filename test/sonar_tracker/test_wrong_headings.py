# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A heading that is wrong for a while shows in no residual: a range must stand it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from sonar_tracker.bearing_history import PastMarks
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.ranging import Ranging
from sonar_tracker.ranging_config import RangingConfig
from sonar_tracker.ranging_fit import fit
from sonar_tracker.ranging_heading import with_wandering
from sonar_tracker.ranging_model import Legs, legs_of
from sonar_tracker.ranging_verdict import judge, Verdict
from sonar_tracker.tracker import SonarTracker
from tracking_core.batches import Bearings
from tracking_core.config import with_values
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform

DEGREE = np.pi / 180.0
SD = 0.1 * DEGREE
WANDERING, MEMORY = 0.005, 30.0  # [rad], [s]
PLACE = (3000.0, 4000.0)  # of a contact [m]


def turn_of_own_ship():
    """Return time, course (K,) and places (K, 2) of a ship of 4 m/s that turns by 60 degrees."""
    time = np.arange(0.0, 1600.0, 2.0)
    course = np.where(time < 600.0, 0.0, 60.0 * DEGREE)
    steps = 8.0 * np.stack([np.cos(course), np.sin(course)], axis=1)
    return time, course, np.cumsum(steps, axis=0)


def misheard(noise: float = 0.0, turn: float = 0.0) -> Legs:
    """
    Return one contact's marks 400 times, own ship's heading wandering differently in each.

    The marks err by `noise` [rad] beside; the contact goes 5 m/s and turns by `turn` [rad] at
    1000 s, or stands still if it does not turn.
    """
    time, _, own = turn_of_own_ship()
    time, own = time[::5], own[::5]  # marks are 10 s apart
    kept, shape = np.exp(-10.0 / MEMORY), (400, len(time))
    off = WANDERING * np.random.default_rng(8).standard_normal(shape)
    for k in range(1, len(time)):
        off[:, k] = kept * off[:, k - 1] + np.sqrt(1.0 - kept**2) * off[:, k]
    course = np.where(time < 1000.0, 0.0, turn)
    way = 5.0 * 10.0 * np.cumsum([np.cos(course), np.sin(course)], axis=1).T
    x, y = (np.array(PLACE) + (way if turn else 0.0) - own).T
    off += noise * np.random.default_rng(9).standard_normal(shape)
    return legs_of(
        PastMarks(
            np.broadcast_to(time, shape), np.arctan2(y, x) + off, np.full(shape, SD**-2),
            np.broadcast_to(own, (*shape, 2)), np.full(400, len(time)),
        )
    )  # fmt: skip


@pytest.mark.parametrize(('factor', 'few', 'most'), [(0.75, 0.0, 0.2), (1.3, 0.8, 1.0)])
def test_verdict_stands_headings_that_wander(factor: float, few: float, most: float) -> None:
    """What it adds to the error of 1 / range is what 400 wandering headings show."""
    legs = misheard()
    best = fit(legs, 50.0, 1e5)
    limit = factor * best.state[:, 3].std() / best.state[:, 3].mean()
    best = replace(best, chi_square=np.zeros(400), serial=np.zeros(400))
    sure = RangingConfig(relative_sd=limit, velocity_noise=0.0, heading_noise=0.0)
    assert judge(best, legs, sure).observable.all()
    as_set = judge(best, legs, replace(sure, heading_noise=WANDERING))
    assert few <= as_set.observable.mean() <= most
    as_told = judge(best, legs, sure, heading_sd=WANDERING)
    assert few <= as_told.observable.mean() <= most


def explained_by_heading(legs: Legs, **values: float) -> Verdict:
    """Return the verdict on fits that know how far the heading wanders."""
    legs = with_wandering(legs, WANDERING)
    return judge(fit(legs, 50.0, 1e5), legs, RangingConfig(**values), WANDERING)


def test_heading_that_wanders_makes_no_bend() -> None:
    """It is taken for what it is, and the range has its true sd."""
    found = explained_by_heading(misheard(noise=SD), velocity_noise=0.0)
    assert found.observable.mean() > 0.95
    off = found.state - [*PLACE, 0.0, 0.0]
    square = np.einsum('tx,txy,ty->t', off, np.linalg.inv(found.covariance), off)
    assert square[found.observable].mean() == pytest.approx(4.0, abs=0.4)


@pytest.mark.parametrize('turn', [40.0, 90.0, 170.0])  # the last two: farthest fits best
def test_heading_that_may_be_wrong_hides_no_turn(turn: float) -> None:
    """A contact that turns far is on no straight course, whatever the heading does."""
    found = explained_by_heading(misheard(noise=SD, turn=turn * DEGREE))
    assert found.bent.mean() > 0.95


@pytest.mark.parametrize(
    ('wandering', 'turn', 'turning'),
    [(0.2, 0.0, 0), (0.0, 20.0, 1), (0.0, 20.0, 2), (0.0, 0.0, 0)],
)
def test_heading_is_wrong_where_most_contacts_seem_to_turn(
    wandering: float, turn: float, turning: int
) -> None:
    """One or two of six that turn are not most, and no reason to doubt the heading."""
    time, _, own = turn_of_own_ship()
    rng, contacts = np.random.default_rng(2), 6
    course = np.where(time < 1000.0, 0.0, turn * DEGREE)
    way = 5.0 * 2.0 * np.cumsum([np.cos(course), np.sin(course)], axis=1).T
    line = rng.uniform(3e3, 6e3, (contacts, 1, 2)) - own
    line[:turning] += way
    wander = wandering * DEGREE * lfilter([np.sqrt(2.0 * 2.0 / MEMORY)], [1.0, 2.0 / MEMORY - 1.0],
                                          rng.standard_normal(len(time)))  # fmt: skip
    marks = np.arctan2(line[..., 1], line[..., 0]) + wander
    marks = wrap_angle(marks + SD * rng.standard_normal(marks.shape))
    ranging, ids, doubted, bent = Ranging(RangingConfig()), np.arange(contacts), 0, 0
    for k, now in enumerate(time):
        at, here = np.full(contacts, now), np.tile(own[k], (contacts, 1))
        ranging.hear(ids, at, marks[:, k], np.full(contacts, SD**-2), here)
        ranging.fit_in_turn()
        bent += ranging.courses.are_bent(now).any()
        doubted += ranging.courses.doubt_heading(now)
    assert (bent > 0) == (wandering > 0.0 or turn > 0.0)
    assert (doubted > 0) == (wandering > 0.0)
    found = ranging.at(ids, at, here)
    assert found.observable[turning:].mean() > 0.7
    off = (found.range / np.hypot(*line[:, -1].T) - 1.0)[found.observable]
    assert (np.abs(off) < 0.3).all()


def test_compass_that_deviates_makes_no_wrong_ranges() -> None:
    """The heading is off by 0.3 degree times the sine of the course."""
    time, course, own = turn_of_own_ship()
    rng, contacts = np.random.default_rng(1), 60
    start = rng.uniform(-10e3, 10e3, (contacts, 1, 2))
    line = start + rng.uniform(-5.0, 5.0, (contacts, 1, 2)) * time[:, None] - own
    marks = np.arctan2(line[..., 1], line[..., 0]) + 0.3 * DEGREE * np.sin(course)
    marks = wrap_angle(marks + SD * rng.standard_normal(marks.shape))
    ranging, ids = Ranging(RangingConfig(tracks_per_cycle=contacts)), np.arange(contacts)
    told, wrong = 0, 0
    for k, now in enumerate(time):
        at, here = np.full(contacts, now), np.tile(own[k], (contacts, 1))
        ranging.hear(ids, at, marks[:, k], np.full(contacts, SD**-2), here)
        if k % 20 == 19:
            ranging.fit_in_turn()
            found = ranging.at(ids, at, here)
            off = found.range / np.hypot(*line[:, k].T) - 1.0
            told += found.observable.sum()
            wrong += (np.abs(off[found.observable]) > 0.3).sum()
    assert told > 100
    assert wrong == 0, f'{wrong} of {told}'


@pytest.mark.parametrize(('heading_sd', 'is_told'), [(0.0, True), (0.5 * DEGREE, False)])
def test_tracker_hears_how_wrong_the_heading_may_be(heading_sd: float, is_told: bool) -> None:
    """The variance in own ship's orientation is not the noise of each mark alone."""
    time, course, own = turn_of_own_ship()
    none = np.zeros_like(time)
    ship = Platform(
        time, np.column_stack([own, none]),
        np.stack([none, none, np.sin(0.5 * course), np.cos(0.5 * course)], axis=1),
        np.column_stack([np.gradient(own, time, axis=0), none]), np.zeros((len(time), 3, 3)),
        np.full(len(time), heading_sd**2),
    )  # fmt: skip
    tracker = SonarTracker(with_values(SonarTrackerConfig(), {'sensor.bearing_sd': SD}))
    rng = np.random.default_rng(3)
    for k in range(len(time)):
        line = np.array([3000.0, 5000.0]) + 3.0 * time[k] * np.array([0.0, 1.0]) - own[k]
        bearing = np.arctan2(line[1], line[0]) - course[k] + SD * rng.standard_normal()
        tracker.track(Bearings.of(time[k : k + 1], wrap_angle(np.array([bearing]))), ship)
    assert tracker.ranges().observable.any() == is_told
