# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the sweep: what is done is kept and believed only if whole; its figures and tables."""

from collections.abc import Callable
import json
import math
from pathlib import Path
import shutil
import tracemalloc
from typing import Any

import numpy as np
import pytest

from tracking_tools.bags import BagWriter, open_bag, POINT_CLOUD
from tracking_tools.evaluate import main as evaluate
from tracking_tools.sweep import main
from tracking_tools.sweeping import crew
from tracking_tools.sweeping.figures import mean_of, SHOWN
from tracking_tools.sweeping.store import Store
from tracking_tools.sweeping.table import Case
from tracking_tools.sweeping.tasks import settings_of, source_of, swept_values, Task
from tracking_tools.sweeping.work import work

CONFIG = Path(__file__).parents[2] / 'config'
TINY = ('crossing', '--duration', '20', '--jobs', '1', '--quiet')
MEGABYTE = 2**20
TWO = ('--runs', '2', '--set', 'sensor.detection_probability=0.7,0.9')


def results(folder: Path) -> dict[str, bytes]:
    """Return all result files by name."""
    return {path.name: path.read_bytes() for path in (folder / 'runs').iterdir()}


@pytest.fixture(scope='module')
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a sweep of two settings and two seeds."""
    folder = tmp_path_factory.mktemp('sweep') / 'done'
    assert main([*TINY, *TWO, '--output', str(folder)]) == 0
    return folder


def test_sweep_keeps_a_file_for_each_run_and_a_summary(finished: Path) -> None:
    """Two settings and two seeds are four files, and two rows that say both runs."""
    assert len(results(finished)) == 4
    summary = json.loads((finished / 'summary.json').read_text())
    assert [row['runs'] for row in summary] == [2, 2]
    assert summary[0]['setting'] == {'sensor.detection_probability': 0.7}
    assert (finished / summary[0]['worst'][0]['file']).exists()


def test_sweep_does_again_what_is_half_or_not_its_own(finished: Path) -> None:
    """A file cut short, an empty one and that of another task are not believed; others are."""
    before = results(finished)
    cut, empty, other, whole = sorted(before)
    runs = finished / 'runs'
    (runs / cut).write_bytes(before[cut][:-40])
    (runs / empty).write_bytes(b'')
    (runs / other).write_bytes(before[whole])
    age = (runs / whole).stat().st_mtime_ns
    assert main([*TINY, *TWO, '--output', str(finished)]) == 0
    assert results(finished) == before
    assert (runs / whole).stat().st_mtime_ns == age


def test_sweep_goes_on_with_more_runs(
    finished: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another seed is one run for each setting; what was there is not done again."""
    for name, data in results(finished).items():
        Store(tmp_path).folder.joinpath('runs', name).write_bytes(data)
    done = []

    def write(self: Store, task: object, text: str) -> None:
        done.append(task.seed)  # type: ignore[attr-defined]
        keep(self, task, text)

    keep: Callable[..., None] = Store.write
    monkeypatch.setattr(Store, 'write', write)
    assert main([*TINY, *TWO, '--runs', '3', '--output', str(tmp_path)]) == 0
    assert done == [3, 3]


def test_sweep_takes_recordings(
    cut_bag: Callable[[int], Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A bag with truth is run once a setting, whatever the number of runs."""
    given = [str(cut_bag(6)), '--jobs', '1', '--quiet', '--runs', '5', '--output', str(tmp_path)]
    assert main([*given, '--picture', str(tmp_path / 'sweep.png')]) == 0
    assert len(results(tmp_path)) == 1
    assert (tmp_path / 'sweep.png').stat().st_size > 5000
    assert 'as it is' in capsys.readouterr().out


def test_evaluate_with_runs_is_a_sweep_without_settings(tmp_path: Path) -> None:
    """Many runs of a scenario, one row."""
    assert evaluate([*TINY, '--runs', '2', '--output', str(tmp_path)]) == 0
    assert len(json.loads((tmp_path / 'summary.json').read_text())) == 1


@pytest.mark.parametrize(
    ('given', 'why'),
    [
        (['crosing'], "did you mean 'crossing'"),
        (['crossing', '--set', 'asociation=jpda'], 'did you mean association'),
        (['crossing', '--set', 'association=jpda,none'], 'must be one of'),
        (['crossing', '--set', 'association'], 'name=value'),
        (['crossing', '--runs', '0'], '--runs: must be a whole number from 1 on, got 0'),
        (['crossing', '--jobs', '0'], '--jobs: must be a whole number from 1 on, got 0'),
        (['crossing', '--duration', 'nan'], '--duration: must be a number above 0, got nan'),
        (['crossing', 'crossing'], 'crossing is there twice'),
        (['crossing', '--set', 'association=jpda,pda,jpda'], 'association has jpda twice'),
        (['crossing', '--set', 'association=pda', '--set', 'association=jpda'], 'once'),
        (['crossing', '--remap', 'points:=/a'], 'FROM one of plots'),
        (['crossing', '--set', 'sensor.range_sd= '], '--set sensor.range_sd has no value'),
        (['crossing', '--gospa-power', '200'], '--gospa-power: must be from 1 to 20, got 200'),
        (['sonar_watch'], 'sonar_watch is a scenario of a sonar: give --sensor sonar'),
        (['crossing', '--sensor', 'sonar'], 'crossing is a scenario of a radar: give --sensor r'),
        (['bags/monday'], 'no recording at bags/monday'),
        (['monday.mcap'], 'no recording at monday.mcap'),
        (['crossing', '--truth', 'ais'], '--truth is of a recording, but crossing is a scenario'),
        (['a', 'b', '--truth', 'ais'], '--truth is of one recording, got 2 sources'),
    ],
)
def test_sweep_refuses_before_the_first_run(
    given: list[str], why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What cannot work is said at once, and no folder is made."""
    with pytest.raises(SystemExit, match='2'):
        main([*given, '--output', str(tmp_path / 'none')])
    assert why in capsys.readouterr().err
    assert not (tmp_path / 'none').exists()


def test_sweep_names_the_runs_that_failed_and_does_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """All that can be done is done and shown; differences are between the runs of both."""

    def fail(task: Task) -> str:
        if task.seed == 2 and dict(task.values)['sensor.detection_probability'] == 0.7:
            raise ValueError('no plots')
        return work(task)

    monkeypatch.setattr(crew, 'work', fail)
    assert main([*TINY, *TWO, '--output', str(tmp_path)]) == 1
    said = capsys.readouterr()
    assert 'crossing, seed 2, sensor.detection_probability=0.7: ValueError: no plots' in said.err
    assert '1 of 4 runs failed; the same command tries them again' in said.err
    assert len(results(tmp_path)) == 3
    summary = json.loads((tmp_path / 'summary.json').read_text())
    assert [row['runs'] for row in summary] == [1, 2]
    assert summary[1]['gospa_less_first']['runs'] == 1


def test_sweep_takes_a_setting_with_which_nothing_is_tracked(tmp_path: Path) -> None:
    """That is a result: nothing is held."""
    bad = ['--set', 'sensor.range_max=1000,40000', '--output', str(tmp_path)]
    assert main([*TINY, *bad]) == 0
    summary = json.loads((tmp_path / 'summary.json').read_text())
    assert summary[0]['means']['held']['mean'] == 0.0


def test_sweep_says_why_a_recording_could_not_be_used(tmp_path: Path, capsys: Any) -> None:
    """Not that the tracks, in a folder that is gone, have no messages."""
    with BagWriter(tmp_path / 'empty') as bag:
        bag.announce('plots', POINT_CLOUD)
    options = ('--jobs', '1', '--quiet', '--output', str(tmp_path / 'out'))
    assert main([str(tmp_path / 'empty'), *options]) == 1
    assert 'no message of /plots could be used: there is none' in capsys.readouterr().err


def test_sweep_knows_a_run_by_its_values_in_any_order_and_form(tmp_path: Path) -> None:
    """What is done is not done again, whether a value is the only one or one of several."""
    one = ['--set', 'sensor.range_max=40000', '--set', 'association=pda']
    assert main([*TINY, *one, '--output', str(tmp_path)]) == 0
    row = json.loads((tmp_path / 'summary.json').read_text())[0]
    assert row['fixed'] == {'association': 'pda', 'sensor.range_max': 40000.0}
    assert 'all with association=pda' in (tmp_path / 'summary.txt').read_text()
    two = ['--set', 'association=pda,jpda', '--set', 'sensor.range_max=40000.0']
    assert main([*TINY, *two, '--output', str(tmp_path)]) == 0
    assert len(results(tmp_path)) == 2


def test_sweep_takes_recordings_with_topics_of_their_own(
    cut_bag: Callable[[int], Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Rules say where plots and truth are; a topic that is not there is named."""
    bag = str(cut_bag(6))
    rules = ['--remap', 'plots:=/plots', '--remap', 'truth:=/truth']
    given = [bag, '--jobs', '1', '--quiet', '--output', str(tmp_path)]
    assert main([*given, *rules]) == 0
    assert main([*given, '--remap', 'plots:=/my_radar/points']) == 1
    assert '/my_radar/points' in capsys.readouterr().err


def test_sweep_refuses_a_recording_that_is_there_twice(
    cut_bag: Callable[[int], Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A copy or its storage file is the same: it would make the interval of the mean too small."""
    bag, copy = cut_bag(6), tmp_path / 'copy'
    shutil.copytree(bag, copy)
    for same in (copy, bag / 'recording.mcap'):
        with pytest.raises(SystemExit, match='2'):
            main([str(bag), str(same), '--output', str(tmp_path / 'none')])
        assert 'are the same recording' in capsys.readouterr().err


def test_source_of_a_large_recording_takes_little_memory(tmp_path: Path) -> None:
    """It is read piece by piece: a day of radar is larger than most memories."""
    file = tmp_path / 'large.mcap'
    with file.open('wb') as content:
        content.truncate(64 * MEGABYTE)
    tracemalloc.start()
    source_of(str(file))
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 8 * MEGABYTE


def test_sweep_takes_a_scenario_of_a_sonar(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its tracks are judged in degrees, beside what really was."""
    params = str(CONFIG / 'passive_linear_array.yaml')
    given = ['sonar_crossing', '--sensor', 'sonar', '--params', params, '--duration', '60']
    assert main([*given, '--runs', '2', '--jobs', '1', '--quiet', '--output', str(tmp_path)]) == 0
    assert 'GOSPA [deg]' in capsys.readouterr().out
    for data in results(tmp_path).values():
        assert json.loads(data)['figures']['held']['coverage'] > 0.8


def test_sweep_takes_a_storage_file_and_the_truth_of_another_bag(
    cut_bag: Callable[[int], Path], tmp_path: Path
) -> None:
    """The figures are those of the bag with its own truth; without any truth the run fails."""
    bare = tmp_path / 'bare'
    with open_bag(cut_bag(6)) as bag, BagWriter(bare) as out:
        for connection, time, raw in bag.messages():
            if connection.topic != '/truth':
                out.write_raw(connection.topic, connection.msgtype, raw, time)
    file = str(next(bare.glob('*.mcap')))
    options = ['--jobs', '1', '--quiet', '--output']
    assert main([file, '--truth', str(cut_bag(6)), *options, str(tmp_path / 'other')]) == 0
    assert main([str(cut_bag(6)), *options, str(tmp_path / 'own')]) == 0
    own, other = (
        json.loads(next(iter(results(tmp_path / name).values()))) for name in ('own', 'other')
    )
    assert other['figures'] == own['figures']
    assert main([file, *options, str(tmp_path / 'none')]) == 1


def test_sweep_does_not_write_into_a_recording(
    cut_bag: Callable[[int], Path], capsys: pytest.CaptureFixture[str]
) -> None:
    """A slip of the hand is told, and the bag is left as it is."""
    before = sorted(cut_bag(6).iterdir())
    with pytest.raises(SystemExit, match='2'):
        main([*TINY, '--output', str(cut_bag(6))])
    assert 'is a recording; give a folder of its own' in capsys.readouterr().err
    assert sorted(cut_bag(6).iterdir()) == before


def test_settings_of_are_all_combinations() -> None:
    """The last parameter changes fastest, and a list in brackets is one value."""
    swept = swept_values(['a=1,2', 'b=[0.5,1.0],[2.0,3.0]'])
    assert [(s['a'], s['b'][0]) for s in settings_of(swept)] == [
        (1, 0.5), (1, 2.0), (2, 0.5), (2, 2.0),
    ]  # fmt: skip


def test_mean_of_covers_the_truth_as_often_as_it_says() -> None:
    """The 95 % interval of five runs holds the true mean in 95 % of 2000 trials."""
    values = np.random.default_rng(1).normal(3.0, 2.0, (2000, 5))
    means = [mean_of(row.tolist()) for row in values]
    share = np.mean([abs(m.mean - 3.0) <= m.half for m in means])
    assert share == pytest.approx(0.95, abs=0.015)  # three standard errors


def test_mean_of_leaves_out_what_is_not_known() -> None:
    """NaN does not count, and a single run has no interval."""
    assert mean_of([2.0, math.nan]).runs == 1
    assert str(mean_of([2.0, math.nan])) == '2'
    assert str(mean_of([math.nan])) == 'none'


def test_worst_are_the_runs_with_the_largest_gospa() -> None:
    """The losing runs come first; one whose figure is not known comes last."""
    runs = [{'sensor': 'radar', 'gospa': {'mean': value}} for value in (3.0, None, 9.0, 5.0)]
    case = Case({}, [], runs)
    assert case.worst() == [2, 3, 0]
    assert SHOWN['gospa'].of(runs[2]) == 9.0
