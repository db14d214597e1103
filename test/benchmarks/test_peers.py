# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the comparison with other trackers: ours alone, all that are installed, and its judge."""

from itertools import permutations
import json
from pathlib import Path

import numpy as np
import pytest

from benchmarks.peers.__main__ import main
from benchmarks.peers.entrants import ENTRANTS
from benchmarks.peers.judge import judge
from benchmarks.peers.menu import MENU
from benchmarks.peers.race import Lap, race
from benchmarks.peers.report import Result, where_better
from benchmarks.peers.scenes import Scene
from benchmarks.peers.summary import compare, cost_ratio


def scene(name: str = 'one_that_turns', scans: int = 20) -> Scene:
    """Return the beginning of a scene."""
    return MENU[name].make(scans, 1)


def exact(seen: Scene, offset: float = 0.0) -> Lap:
    """Return what a tracker says that knows the truth, as far off on the first axis."""
    lap = Lap()
    for time in seen.times:
        now = seen.truth.time == time
        lap.rows.append((seen.truth.id[now], seen.truth.position[now] + [offset, 0.0]))
        lap.cpu.append(1e-3)
    return lap


def test_main_reports_ours_where_nothing_else_is_asked(tmp_path: Path) -> None:
    """Our tracker alone gives a page with its figures and their growth, and a picture."""
    page = tmp_path / 'peers.md'
    few = ['--scans', '12', '--runs', '2', '--budget', '0', '--output', str(page)]
    assert main(['--only', 'en_route_10', 'en_route_50', 'sonar', '--peers', 'ours', *few]) == 0
    text = page.read_text(encoding='utf-8')
    assert text.count('| contact_tracking |') == 4
    assert text.count('12 scans, 1 of 2 runs.') == 3
    assert '{' not in text
    assert '| in a row |' in text
    assert page.with_suffix('.png').stat().st_size > 1000


def test_main_says_which_results_are_of_another_run(tmp_path: Path) -> None:
    """Kept results are on the page, each scene with its own date once dates differ."""
    few = ['--peers', 'ours', '--scans', '10', '--runs', '1', '--keep', str(tmp_path)]
    page = tmp_path / 'peers.md'
    assert main(['--only', 'sonar', *few, '--output', str(page)]) == 0
    assert 'not in one go' not in page.read_text(encoding='utf-8')
    kept = tmp_path / 'sonar.json'
    kept.write_text(json.dumps(json.loads(kept.read_text()) | {'made': 'long ago'}))
    assert main(['--only', 'one_that_turns', *few, '--output', str(page)]) == 0
    text = page.read_text(encoding='utf-8')
    assert 'not in one go' in text
    assert '\n2. long ago.' in text
    assert text.count('From origin 2.') == 1


@pytest.mark.parametrize('name', [name for name in ENTRANTS if not name.startswith('ours')])
def test_peer_follows_a_contact_and_a_bearing(name: str) -> None:
    """Each peer that is installed holds what is easy to hold."""
    if not ENTRANTS[name].is_installed:
        pytest.skip(f'{ENTRANTS[name].title} is not installed')
    for seen in (scene(), scene('sonar')):
        verdict = judge(seen, race(seen, {name: ENTRANTS[name]}, 60.0)[name], 20)
        assert verdict.held > 0.9


def test_judge_has_nothing_to_say_against_the_truth() -> None:
    """Tracks on the contacts have no error, and all contacts are held."""
    seen = scene('crossings')
    verdict = judge(seen, exact(seen), 20)
    assert verdict.gospa == pytest.approx(0.0, abs=1e-6)  # rounding of the interpolated truth
    assert verdict.held == 1.0
    assert verdict.false == verdict.missed == verdict.switches == 0


def test_judge_ignores_tracks_beyond_the_region() -> None:
    """A track outside of what is looked at is not a false one."""
    seen = scene()
    lap = exact(seen)
    beyond = np.array([[2.0 * seen.knowledge.region, 0.0]])
    lap.rows = [(np.append(ids, 99), np.concatenate([at, beyond])) for ids, at in lap.rows]
    assert judge(seen, lap, 20).false == 0.0


def test_race_stops_who_is_over_the_limit() -> None:
    """A tracker without time left gets no scans, and the row says so instead of figures."""
    seen = scene(scans=10)
    lap = race(seen, {'ours': ENTRANTS['ours']}, 0.0)['ours']
    row = compare('slow', [seen], [lap], [exact(seen)])
    assert (row.scans, row.wanted, row.finished, row.figures) == (0, 10, False, {})


def test_race_gives_every_tracker_every_place() -> None:
    """Nobody always comes after the same one, whose data fill the caches."""
    told: list[str] = []
    race(scene(scans=30), dict.fromkeys('abc', ENTRANTS['ours']), 1e9, told.append)
    assert {''.join(told[k : k + 3]) for k in range(0, 90, 3)} == {
        ''.join(order) for order in permutations('abc')
    }


def test_race_in_stretches_gives_each_tracker_some_scans_in_a_row() -> None:
    """All scans are done, five by one tracker before the next has its turn."""
    told: list[str] = []
    laps = race(scene(scans=12), dict.fromkeys('ab', ENTRANTS['ours']), 1e9, told.append, 5)
    assert [lap.scans for lap in laps.values()] == [12, 12]
    text = ''.join(told)
    assert {text[k : k + 5] for k in (0, 5, 10, 15)} == {'aaaaa', 'bbbbb'}
    assert sorted(text[20:]) == ['a', 'a', 'b', 'b']


def test_ratio_of_costs_is_over_the_scans_that_both_did() -> None:
    """The others are of no account, and too few give no ratio."""
    slow, own = Lap(cpu=[9.0] * 5 + [4.0] * 10), Lap(cpu=[9.0] * 5 + [2.0] * 10 + [100.0] * 30)
    slow.rows, own.rows = [None] * 15, [None] * 45
    assert cost_ratio(slow, own) == 2.0
    few = Lap([None] * 4, [1.0] * 4)
    assert np.isnan(cost_ratio(few, own))


def test_where_better_names_the_better_tracker_only() -> None:
    """The table of losses has who is nearer than ours, not who is farther off."""
    seen = scene('crossings')
    ours, near, far = exact(seen, 50.0), exact(seen, 10.0), exact(seen, 90.0)
    rows = {
        name: compare(name, [seen, seen], [lap, lap], [ours, ours])
        for name, lap in {'ours': ours, 'near': near, 'far': far}.items()
    }
    text = where_better({'x': Result('x', 2.0, 2.0, 'm', 1.0, rows, 2, 'today')})
    assert '| near | GOSPA |' in text
    assert 'far' not in text
