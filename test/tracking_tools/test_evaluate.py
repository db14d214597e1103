# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check the figures of tracks that are known, as a user asks for them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import json
from pathlib import Path
import re
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import Columns, from_columns
from tracking_tools.bags import BagWriter, nanoseconds
from tracking_tools.evaluate import main
from tracking_tools.evaluation import evaluate, Yardstick
from tracking_tools.evaluation.units import UNITS
from tracking_tools.replay import replay
from tracking_tools.sensors import SENSORS
from tracking_tools.simulate import main as simulate

SCANS, PERIOD, EPOCH = 40, 4.0, 1000.0
RADAR, SONAR = '/radar_tracker/tracks', '/sonar_tracker/tracks'
CLOUD = 'sensor_msgs/msg/PointCloud2'
MakeBag = Callable[..., Path]


@pytest.fixture
def make_bag(tmp_path: Path) -> MakeBag:
    """Return a function that writes a bag of tables: {topic: {scan: columns}}."""

    def make_bag(
        name: str, topics: Mapping[str, Mapping[int, Columns]], frames: Mapping[str, str] = {}
    ) -> Path:
        with BagWriter(tmp_path / name) as bag:
            for topic, tables in topics.items():
                bag.announce(topic, CLOUD)
                for scan, columns in tables.items():
                    time = EPOCH + PERIOD * scan
                    msg = from_columns(columns, time, frames.get(topic, 'map'), rosbags_types())
                    bag.write(topic, msg, nanoseconds(time))
        return tmp_path / name

    return make_bag


def truth_at(scan: int, places: Mapping[int, tuple[float, float]]) -> Columns:
    """Truth of contacts that fly east with 100 m/s, from these places in scan 0."""
    x, y = np.array(list(places.values()), np.float32).T
    zero = np.zeros_like(x)
    return {
        'id': np.array(list(places), np.uint32), 'x': x + np.float32(100.0 * PERIOD * scan),
        'y': y, 'z': zero, 'vx': zero + 100, 'vy': zero, 'vz': zero,
    }  # fmt: skip


def tracks_at(scan: int, found: Mapping[int, tuple[float, float]], sd: float = 10.0) -> Columns:
    """Tracks that fly east with 100 m/s, from these places in scan 0."""
    columns = truth_at(scan, found) if found else truth_at(scan, {0: (0.0, 0.0)})
    P = sd**2 * np.diag([1.0, 1.0, np.nan, 1.0, 1.0, np.nan])
    n = len(columns['id'])
    columns |= {
        'status': np.ones(n, np.uint8), 'covariance': np.tile(P.reshape(1, 36), (n, 1)),
        'nis': np.full(n, 2, np.float32), 'manoeuvre_probability': np.zeros(n, np.float32),
    }  # fmt: skip
    return columns if found else {name: column[:0] for name, column in columns.items()}


def test_evaluate_of_known_tracks(make_bag: MakeBag) -> None:
    """Contact 1 is held from scan 2 on with a gap and a switch, contact 2 never; 99 is false."""
    real = {1: (0.0, 0.0), 2: (0.0, 9_000.0)}

    def said(k: int) -> Mapping[int, tuple[float, float]]:
        on = {} if k < 2 or k == 20 else {(11 if k < 30 else 12): (3.0, 4.0)}
        return {**on, **({99: (0.0, 50_000.0)} if 5 <= k < 8 else {})}

    tracks = make_bag('tracks', {RADAR: {k: tracks_at(k, said(k)) for k in range(SCANS)}})
    truth = make_bag('truth', {'/truth': {k: truth_at(k, real) for k in range(SCANS)}})
    found = evaluate(tracks, truth)
    held, hours = found.held, SCANS * PERIOD / 3600.0
    assert_allclose(held.coverage, 37.0 / 80.0)
    assert (held.breaks, held.id_switches, held.lasting_switches) == (1, 1, 1)
    assert (held.false_tracks, held.purity) == (1, 1.0)
    assert_allclose(held.false_tracks_per_hour, 1.0 / hours)
    assert_allclose(held.relative_tracking_time, 0.5 * (18 + 9 + 10) / 3 / SCANS)
    assert_allclose(found.accuracy.rmse, 5.0)
    assert_allclose(found.accuracy.velocity_rmse, 0.0, atol=1e-9)
    assert_allclose(found.nees_position.mean, 25.0 / 100.0 / 2.0)
    assert_allclose(found.nis.mean, 1.0)
    assert_allclose(found.timing.time_to_confirm_mean, 8.0)
    assert found.timing.never_confirmed == 1
    assert_allclose((found.gospa.missed_number, found.gospa.false_number), (43 / 40, 3 / 40))
    g = found.gospa
    assert_allclose(g.rms**2, g.localisation**2 + g.missed**2 + g.false**2)
    assert [track.contact for track in found.per_track] == [1, 1, None]
    assert found.per_contact[0].tracks == (11, 12)


def test_evaluate_of_bearings(make_bag: MakeBag, capsys: pytest.CaptureFixture[str]) -> None:
    """A track 0.001 rad beside the true bearing is 0.001 rad off, and half a sd of 0.002."""
    bearing = np.array([np.arctan2(5_000.0, 100.0 * PERIOD * k) for k in range(SCANS)])

    def said(k: int) -> Columns:
        one = np.ones(1, np.float64)
        return {
            'id': one.astype(np.uint32), 'status': one.astype(np.uint8),
            'bearing': one * (bearing[k] + 0.001), 'bearing_rate': 0 * one,
            'bearing_sd': 0.002 * one, 'bearing_rate_sd': 0.001 * one,
        }  # fmt: skip

    tracks = make_bag('tracks', {SONAR: {k: said(k) for k in range(SCANS)}})
    truth = make_bag('truth', {'/truth': {k: truth_at(k, {1: (0.0, 5e3)}) for k in range(SCANS)}})
    found = evaluate(tracks, truth)
    assert found.sensor == 'sonar'
    assert_allclose(found.accuracy.rmse, 0.001, rtol=1e-4)  # truth is in float32
    assert_allclose(found.nees_position.mean, 0.25, rtol=1e-3)
    assert found.held.coverage == 1.0
    for radius, said in (('0.05', '0.00%'), ('0.06', '100.00%')):  # it is 0.0573 deg off
        assert main([str(tracks), '--truth', str(truth), '--radius', radius]) == 0
        out = capsys.readouterr().out
        assert re.search(f'^coverage +{said}', out, re.MULTILINE)
        assert 'nan' not in out


def test_evaluate_command_writes_json_and_a_table(
    make_bag: MakeBag, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The table names what the JSON has; what cannot be known is null."""
    both = {
        RADAR: {k: tracks_at(k, {5: (30.0, 40.0)}) for k in range(SCANS)},
        '/truth': {k: truth_at(k, {1: (0.0, 0.0)}) for k in range(SCANS)},
    }
    bag, file = make_bag('both', both), tmp_path / 'new' / 'figures.json'
    assert main([str(bag), '--json', str(file), '--radius', '60']) == 0
    figures = json.loads(file.read_text())
    assert_allclose(figures['accuracy']['rmse'], 50.0, rtol=1e-6)
    assert figures['timing']['onset_delay_mean'] is None
    assert figures['radius'] == 60.0
    assert '50.0 m' in capsys.readouterr().out
    assert main([str(bag), '--radius', '40']) == 0
    assert 'false tracks: 5' in capsys.readouterr().out


def test_evaluate_of_a_replay_holds_the_flights(
    cut_bag: Callable[[int], Path], tmp_path: Path
) -> None:
    """In the first turns of the demo every flight is held, and the parts of the whole agree."""
    recording = cut_bag(40)
    replay(recording, tmp_path / 'tracks', quiet=True)
    found = evaluate(tmp_path / 'tracks', recording, Yardstick(cutoff=500.0))
    assert found.held.coverage > 0.8
    assert found.held.false_tracks == 0
    rows = sum(contact.accuracy.rows for contact in found.per_contact)
    assert rows == found.accuracy.rows == found.nees_position.samples
    assert found.gospa.cutoff == 500.0
    assert len(found.by_scan.gospa) == found.scans == 40


FINE: dict[str, Any] = {
    RADAR: {k: tracks_at(k, {5: (0.0, 0.0)}) for k in range(3)},
    '/truth': {k: truth_at(k, {1: (0.0, 0.0)}) for k in range(3)},
}
BAD: dict[str, tuple[dict[str, Any], str]] = {
    'no_tracks': ({'/truth': FINE['/truth']}, r'no topic /radar_tracker/tracks or /sonar_tracker'),
    'no_truth': (
        {RADAR: FINE[RADAR]},
        r'no topic /truth .* it has /radar.*--truth BAG.*truth:=/TOPIC',
    ),
    'empty_tracks': ({**FINE, RADAR: {}}, 'no messages'),
    'empty_truth': ({**FINE, '/truth': {}}, '/truth has no rows'),
    'other_time': (
        {**FINE, '/truth': {k: truth_at(k, {1: (0.0, 0.0)}) for k in range(90, 99)}},
        'no time in common',
    ),
    'other_table': ({**FINE, RADAR: FINE['/truth']}, 'no column status, covariance'),
}


@pytest.mark.parametrize('case', BAD)
def test_evaluate_says_what_is_missing(
    case: str, make_bag: MakeBag, capsys: pytest.CaptureFixture[str]
) -> None:
    """A bag that cannot be judged is refused with what it lacks."""
    topics, reason = BAD[case]
    bag = make_bag('bag', topics)
    assert main([str(bag), '--truth', str(bag)]) == 1
    assert capsys.readouterr().err.startswith('evaluate: ')
    with pytest.raises(ValueError, match=reason):
        evaluate(bag, bag)


def test_evaluate_says_that_the_tracks_are_of_another_type(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A rule that leads to own ship ends in one line, which names what the bag has."""
    assert simulate(['sonar_crossing', '--duration', '20', '--output', str(tmp_path / 'bag')]) == 0
    assert main([str(tmp_path / 'bag'), '--remap', 'tracks:=/ownship']) == 1
    assert re.search(
        r'no topic /ownship of type sensor_msgs/msg/PointCloud2; it has .*Odometry',
        capsys.readouterr().err,
    )


@pytest.mark.parametrize(
    ('name', 'why'), [('odm', 'has no topic /odm, to which ownship'), ('bearings', 'expected nav')]
)
def test_evaluate_refuses_an_own_ship_that_is_none(
    name: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without own ship the truth would be seen from the origin, and good tracks be called bad."""
    heard, found = str(tmp_path / 'heard'), str(tmp_path / 'found')
    assert simulate(['sonar_crossing', '--duration', '200', '--output', heard]) == 0
    replay(heard, found, quiet=True, sensor=SENSORS['sonar'])
    assert main([found, '--truth', heard, '--remap', f'ownship:=/{name}']) == 1
    assert why in capsys.readouterr().err


@pytest.mark.parametrize('tables', [{0: {}}, {0: {5: (0.0, 0.0)}}])
def test_evaluate_judges_recordings_without_confirmed_tracks(
    tables: dict[int, Any], make_bag: MakeBag, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whatever rows there are: nothing was held, all contacts were missed."""
    rows = {k: tracks_at(k, places) for k, places in tables.items()}
    for table in rows.values():
        table['status'][:] = 0
    bag = make_bag('bag', {**FINE, RADAR: rows})
    judgement = evaluate(bag, bag)
    assert (judgement.held.coverage, judgement.tracks) == (0.0, 0)
    assert judgement.gospa.missed > 0.0
    assert main([str(bag), '--truth', str(bag)]) == 0
    assert '0 confirmed tracks' in capsys.readouterr().out


def test_evaluate_refuses_another_frame(make_bag: MakeBag) -> None:
    """Places in two frames are not compared; the reason names both."""
    bag = make_bag('bag', FINE, {'/truth': 'utm'})
    with pytest.raises(ValueError, match=r'in frame map, the truth of .* in frame utm'):
        evaluate(bag, bag)


def test_evaluate_without_a_bag_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A path that leads nowhere is named."""
    assert main([str(tmp_path / 'nothing')]) == 1
    assert 'no bag at' in capsys.readouterr().err


@pytest.mark.parametrize(('apart', 'is_doubtful'), [(9_000.0, False), (50.0, True)])
def test_evaluate_says_when_the_match_radius_tells_nothing(
    make_bag: MakeBag, capsys: pytest.CaptureFixture[str], apart: float, is_doubtful: bool
) -> None:
    """Among boats in a harbour any track is within 1000 m of any boat."""
    places = {1: (0.0, 0.0), 2: (0.0, apart)}
    few = range(3)  # 800 m
    tracks = make_bag('tracks', {RADAR: {k: tracks_at(k, places) for k in few}})
    truth = make_bag('truth', {'/truth': {k: truth_at(k, places) for k in few}})
    assert main([str(tracks), '--truth', str(truth)]) == 0
    assert ('set --radius' in capsys.readouterr().out) == is_doubtful
    assert main([str(tracks), '--truth', str(truth), '--radius', '20']) == 0
    assert 'set --radius' not in capsys.readouterr().out


@pytest.mark.parametrize(
    ('far', 'words'), [(0.14159, '0.142 m'), (5.3, '5.30 m'), (83.51, '83.5 m'), (0.0, '0.0 m')]
)
def test_small_errors_have_figures_that_tell(far: float, words: str) -> None:
    """Of a radar of 50 m all errors were 0.1 m."""
    assert UNITS['radar'].far(far) == words
    assert UNITS['radar'].far(float('nan')) == 'none'
