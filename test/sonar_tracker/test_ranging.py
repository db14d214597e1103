# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Range from bearings: the bound is reached, and nothing is told where nothing is known."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from sonar_tracker.ranging import Ranging
from sonar_tracker.ranging_config import RangingConfig
from studies import ranging as study
from studies.figures import Claim
from studies.v0_ranging import Case, end_figures, play, scene, SD
from tracking_core.linalg import wrap_angle

RUNS = 200
DEGREE = np.pi / 180.0


@pytest.fixture(scope='module')
def figures() -> dict[str, float]:
    """Figures of the study."""
    straight = play(Case(turn=0.0), RUNS)
    values = end_figures(play(Case(), RUNS), np.arange(RUNS))
    return {**values, 'silent': float(straight.observable.sum())}


@pytest.mark.parametrize('claim', study.CLAIMS, ids=[claim.name for claim in study.CLAIMS])
def test_figures_are_as_expected(figures: dict[str, float], claim: Claim) -> None:
    """METHODS: error over bound in 0.85..1.25; without a manoeuvre no range in 200 runs."""
    value = figures[claim.name]
    assert claim.holds(value), f'{value:.4g}, not {claim.limits}'


def followed(own, line, sd=SD, times=None, seed=1, config=None, turn=0.0, every=1):
    """Return `Ranging` and its estimates at the end, contact at `line` (K, 2) from own (K, 2)."""
    rng, ranging = np.random.default_rng(seed), Ranging(config or RangingConfig())
    times = 2.0 * np.arange(len(own)) if times is None else times
    cos, sin = np.cos(turn), np.sin(turn)
    world = np.array([[cos, -sin], [sin, cos]])
    one = np.array([7])
    for k in range(len(own)):
        x, y = world @ line[k]
        mark = wrap_angle(np.arctan2([y], [x]) + sd * rng.standard_normal(1))
        here = (world @ own[k])[None]
        ranging.hear(one, times[k : k + 1], mark, np.array([sd**-2]), here)
        if k % every == 0 or k == len(own) - 1:
            ranging.fit_in_turn()
    return ranging, ranging.at(one, times[k : k + 1], here)


def v0(case=None):
    """Own ship and line to object 1 (K, 2)."""
    _, own, objects = scene(case or Case())
    return own[:, :2], objects[0, :, :2] - own[:, :2]


def test_wrap_makes_no_difference() -> None:
    """A contact whose bearing passes +-pi has the range it has in any other direction."""
    own, line = v0()
    answers = []
    for turn in (0.0, np.pi - 0.01 - np.arctan2(*line[600, ::-1])):
        _, found = followed(own, line, turn=turn, every=1000)
        answers.append((found.range[0], found.range_sd[0], found.speed[0]))
        assert found.observable[0]
    assert_allclose(answers[1], answers[0], rtol=1e-5)
    world = np.arctan2(*line[:, ::-1].T) + turn
    assert np.abs(np.diff(wrap_angle(world))).max() > 6.0  # it does pass the wrap


def test_course_and_speed_are_over_ground() -> None:
    """The contact goes north at 10 knots, whatever own ship does."""
    own, line = v0()
    _, found = followed(own, line, every=1000)
    assert found.speed[0] == pytest.approx(5.144, rel=0.01)
    assert found.course[0] == pytest.approx(0.5 * np.pi, abs=0.02)
    assert_allclose(found.state[0, :2], own[-1] + line[-1], atol=5.0 * found.range_sd[0])


def test_course_goes_on_between_fits() -> None:
    """Later the contact is farther on, less surely so."""
    own, line = v0()
    ranging, found = followed(own, line, every=1000)
    one, here = np.array([7]), own[-1:]
    later = ranging.at(one, np.array([1850.0 + 100.0]), here)
    step = 100.0 * found.state[0, 2:]
    assert_allclose(later.state[0, :2], found.state[0, :2] + step, atol=1e-6)
    assert later.range[0] == pytest.approx(np.hypot(*(found.state[0, :2] + step - here[0])))
    assert later.range_sd[0] > found.range_sd[0]


@pytest.mark.parametrize('speed', [0.0, 5.0])
def test_even_own_ship_tells_nothing(speed: float) -> None:
    """Own ship at rest, or going evenly: no range, whatever the contact does."""
    time = 2.0 * np.arange(900)[:, None]
    own = time * np.array([[speed, 0.0]])
    contact = np.array([[500.0, 1500.0]]) + time * np.array([[-3.0, 1.0]])
    _, found = followed(own, contact - own, every=50)
    assert not found.observable[0]
    for values in (found.range, found.range_sd, found.speed, found.course, found.state):
        assert np.isnan(values).all()
    assert np.isnan(found.covariance).all()


@pytest.mark.parametrize(
    ('limit', 'factor', 'is_told'),
    [
        ('range_max', 1.002, True), ('range_max', 0.998, False),
        ('range_min', 0.998, True), ('range_min', 1.002, False),
    ],
)  # fmt: skip
def test_contact_a_little_outside_the_limits_is_not_at_the_limit(limit, factor, is_told) -> None:
    """The fit stops there, nearly as good as where it would go; nothing is told of it."""
    own, line = v0()
    _, free = followed(own, line, every=1000)
    config = RangingConfig(**{limit: factor * float(free.range[0])})
    _, found = followed(own, line, every=1000, config=config)
    assert found.observable[0] == is_told


def test_jitter_of_own_ship_is_no_manoeuvre() -> None:
    """Five metres of noise in own ship's position make no range."""
    own, line = v0(Case(turn=0.0))
    noisy = own + 5.0 * np.random.default_rng(3).standard_normal(own.shape)
    ranging, time = Ranging(RangingConfig()), 2.0 * np.arange(len(own))
    told = 0
    for k in range(len(own)):
        mark = np.arctan2(line[k, 1:], line[k, :1])
        ranging.hear(np.array([1]), time[k : k + 1], mark, np.array([SD**-2]), noisy[k : k + 1])
        if k % 20 == 0:
            ranging.fit_in_turn()
            told += ranging.at(np.array([1]), time[k : k + 1], own[k : k + 1]).observable.sum()
    assert told == 0


def test_turning_contact_is_not_observable_and_found_again() -> None:
    """The turn of a contact takes its range away; another manoeuvre of own ship brings it back."""
    time = 2.0 * np.arange(1400)
    course = np.select([time < 600.0, time < 1900.0], [0.0, 60.0 * DEGREE], -60.0 * DEGREE)
    own = np.cumsum(5.0 * 2.0 * np.stack([np.cos(course), np.sin(course)], axis=1), axis=0)
    bent = np.where(time < 1200.0, 90.0 * DEGREE, 140.0 * DEGREE)
    steps = 4.0 * 2.0 * np.stack([np.cos(bent), np.sin(bent)], axis=1)
    line = np.array([4000.0, -2000.0]) + np.cumsum(steps, axis=0) - own
    told = {}
    for end in (580, 700, 1400):
        told[end] = followed(own[:end], line[:end], every=10)[1]
    assert [bool(told[end].observable[0]) for end in told] == [True, False, True]
    true = np.hypot(*line[-1])
    assert told[1400].range[0] == pytest.approx(true, abs=5.0 * told[1400].range_sd[0])


def test_few_marks_tell_nothing() -> None:
    """One mark, or fewer than asked for, however precise, give no range and no error."""
    own, line = v0()
    few = np.linspace(0, len(own) - 1, 12).astype(int)
    times = 2.0 * few
    for number in (1, 2, 11):
        chosen = few[-number:]
        _, found = followed(own[chosen], line[chosen], sd=1e-6, times=times[-number:])
        assert np.isnan(found.range[0])
    _, found = followed(own[few], line[few], sd=1e-4, times=times)
    assert found.observable[0]


def test_mark_is_heard_once() -> None:
    """A track that has left the sector keeps its last look, cycle by cycle: that is no new one."""
    ranging, one = Ranging(RangingConfig()), np.ones(1)
    for time in (2.0, 4.0, 4.0, 4.0):
        ranging.hear(np.array([7]), time * one, 0.3 * one, one / SD**2, np.zeros((1, 2)))
    assert ranging.history.read(np.array([0])).count.tolist() == [2]


def test_no_tracks_are_legal() -> None:
    """Nothing is followed: nothing is told, and unknown ids are not observable."""
    ranging, nothing = Ranging(RangingConfig()), np.zeros(0)
    ranging.hear(np.zeros(0, int), nothing, nothing, nothing, np.zeros((0, 2)))
    ranging.fit_in_turn()
    assert len(ranging.at(np.zeros(0, int), nothing, np.zeros((0, 2)))) == 0
    found = ranging.at(np.array([3, 1]), np.zeros(2), np.zeros((2, 2)))
    assert_array_equal(found.observable, [False, False])


def test_tracks_are_fitted_in_turn() -> None:
    """Each cycle fits as many tracks as it may, those that waited longest first."""
    ranging = Ranging(RangingConfig(tracks_per_cycle=2))
    ids, fitted = np.arange(5), []
    for k in range(5):
        own = np.zeros((5, 2))
        ranging.hear(ids, np.full(5, float(k)), np.zeros(5), np.ones(5), own)
        before = ranging.courses.time.copy()
        ranging.fit_in_turn()
        fitted += [set(np.flatnonzero(ranging.courses.time != before).tolist())]
    assert fitted == [{0, 1}, {2, 3}, {0, 4}, {1, 2}, {0, 3}]


def test_tracks_that_hear_nothing_keep_no_other_from_its_fit() -> None:
    """Two are silent after their first fit: the other two are fitted in every cycle."""
    ranging = Ranging(RangingConfig(tracks_per_cycle=2))
    for k in range(6):
        heard = np.array([k < 2, k < 2, True, True]).astype(float)
        ranging.hear(np.arange(4), np.full(4, float(k)), np.zeros(4), heard, np.zeros((4, 2)))
        ranging.fit_in_turn()
    assert ranging.courses.time[2:].tolist() == [5.0, 5.0]


def test_tracks_keep_their_own_ranges() -> None:
    """Ids that come and go do not mix histories."""
    own, line = v0()
    ranging, sd = Ranging(RangingConfig()), 1e-4
    for k in range(len(own)):
        ids = np.array([2, 5, 9]) if k % 3 else np.array([2, 9])
        scale = {2: 0.5, 5: 3.0, 9: 1.0}
        lines = np.stack([scale[i] * line[-1] + line[k] - line[-1] for i in ids.tolist()])
        mark = np.arctan2(lines[:, 1], lines[:, 0])
        time, here = np.full(len(ids), 2.0 * k), np.tile(own[k], (len(ids), 1))
        ranging.hear(ids, time, mark, np.full(len(ids), sd**-2), here)
    ranging.fit_rows(np.arange(len(ids)))
    found = ranging.at(np.array([9, 5, 2]), np.full(3, 2.0 * k), np.tile(own[k], (3, 1)))
    true = np.hypot(*line[-1])
    assert_array_equal(found.observable, [True, False, True])  # 5 was always forgotten
    assert_allclose(found.range[[0, 2]], [true, 0.5 * true], rtol=0.02)


def test_report_is_written_with_its_picture(tmp_path) -> None:
    """Few runs: Markdown with all tables, the picture beside it."""
    report = study.describe(3, tmp_path)
    assert report.count('| holds |') + report.count('**does not hold**') == len(study.CLAIMS)
    assert (tmp_path / 'ranging_errors.png').stat().st_size > 3_000
