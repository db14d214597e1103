# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Tracks outlive their session, exactly; a file that does not fit is refused and hurts nothing."""

from dataclasses import replace
import os
import tracemalloc

import numpy as np
import pytest

from msg_adapters.table import from_columns
from tracking_core.batches import Coverage, Tracks
from tracking_node.health import Health
from tracking_session.node_config import SnapshotConfig
from tracking_session.snapshots import file as snapshot_file
from tracking_session.snapshots import values
from tracking_session.snapshots.file import BadSnapshot, free_ids, read_snapshot, write_snapshot
from tracking_session.snapshots.keeper import Keeper, RESERVED
from tracking_tools.parameter_file import configure

pytest.importorskip('rosbags')
from benchmarks.healthy_scenes import HEALTHY, PERIOD, START
from benchmarks.siege import TYPES
from tracking_tools.sensors import SENSORS

SCANS = 15


class Lines(list):
    """A log that can be read."""

    info = warning = list.append


class Station:
    """A session with its keeper, and a clock that the test turns."""

    def __init__(self, sensor, path, now=0.0, name='', **parameters):
        kind, self.lines, self.now, self.sensor = SENSORS[sensor], Lines(), now, sensor
        tracker, node = configure(kind.configs, parameters)
        configs = tracker, replace(node, snapshot=SnapshotConfig(file=str(path)))
        self.session = kind.make_session(*configs, TYPES, self.lines)
        self.keeper = Keeper(self.session, configs, name, clock=lambda: self.now)
        self.keeper.open(lambda *_: None, now)

    def scan(self, number):
        """Use one healthy scan; return the bytes of the table."""
        self.now, stamp = PERIOD * number, START + PERIOD * number
        columns = HEALTHY[self.sensor](stamp)
        table = self.session.plots(from_columns(columns, stamp, self.sensor, TYPES), self.now)
        self.keeper.reserve_ids()
        return bytes(table.data)

    def ids(self):
        """Return the ids of all tracks."""
        return set(self.session.tracks.id.tolist())


@pytest.fixture(params=HEALTHY)
def sensor(request):
    """Test both sensors."""
    return request.param


@pytest.fixture
def path(tmp_path):
    """Return where the snapshot is."""
    return tmp_path / 'tracks'


@pytest.fixture
def kept(sensor, path):
    """Return a station whose tracks are in the file."""
    station = Station(sensor, path)
    for number in range(SCANS):
        station.scan(number)
    station.keeper.save()
    return station


def test_restored_session_goes_on_to_the_byte(kept, sensor, path):
    """Antenna, clutter, seeds, ranges and all are there: nothing tells the two apart."""
    other = Station(sensor, path, kept.now + 3.0)
    assert f'{len(kept.ids())} tracks of 3.0 s ago are back' in other.lines[-1]
    for number in range(SCANS, SCANS + 10):
        assert kept.scan(number) == other.scan(number)


def test_what_is_remembered_is_all_and_does_not_change(kept, sensor, path, tmp_path):
    """The restored session remembers what was in the file; a memory is of its moment."""

    def written(memory):
        write_snapshot(tmp_path / 'again', memory)
        return (tmp_path / 'again').read_bytes()

    instrument = Station(sensor, path, kept.now).session.instrument
    recalled, stored = instrument.remember(), read_snapshot(path)['tracker']
    reserved = replace(stored['state'], next_id=recalled['state'].next_id)
    assert written(recalled) == written({**stored, 'state': reserved})
    memory = kept.session.instrument.remember()
    before = written(memory)
    kept.scan(SCANS)
    assert written(memory) == before


def test_restored_three_dimensional_radar_goes_on(path):
    """What kind of radar it is was learnt from its plots, and is in the file too."""
    stations = [Station('radar', path)]
    for number in range(SCANS + 5):
        if number == SCANS:
            stations[0].keeper.save()
            stations.append(Station('radar', path, stations[0].now))
        stamp, columns = START + PERIOD * number, HEALTHY['radar'](START + PERIOD * number)
        columns['elevation'] = np.array([0.1, 0.2, 0.3], np.float32)
        msg = from_columns(columns, stamp, 'radar', TYPES)
        for station in stations:
            station.now = PERIOD * number
        tables = {bytes(s.session.plots(msg, s.now).data) for s in stations}
        assert len(tables) == 1
    assert stations[1].session.instrument.tracker.radar.dimensions == 3


def test_ids_are_reserved_before_they_are_given_away(sensor, path):
    """A session that ends without saving has told no id that the next one gives to another."""
    lost = Station(sensor, path)
    for number in range(SCANS):
        lost.scan(number)
    other = Station(sensor, path, lost.now + 3600.0)  # too old to be used, but for the ids
    assert 'limit 60 s' in other.lines[-1]
    for number in range(1000, 1000 + SCANS):
        other.scan(number)
    assert other.ids()
    assert min(other.ids()) >= RESERVED > max(lost.ids())


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        (lambda data: b'', 'it is no snapshot'),
        (lambda data: data[: len(data) // 2], 'damaged: the checksum is wrong'),
        (lambda data: data[:-1] + bytes([data[-1] ^ 1]), 'damaged: the checksum is wrong'),
        (lambda data: data.replace(b'snapshot 2', b'snapshot 9', 1), 'of version 9, this program'),
    ],
    ids=['empty', 'cut', 'flipped', 'version'],
)
def test_damaged_file_is_refused(kept, sensor, path, change, words):
    """With the reason; the session is as new and works, with ids that nobody has had."""
    path.write_bytes(change(path.read_bytes()))
    other = Station(sensor, path)
    assert words in other.lines[-1]
    assert other.lines[-1].endswith('tracking starts anew')
    for number in range(SCANS):
        other.scan(number)
    assert len(other.ids()) == len(kept.ids())
    if 'no snapshot' not in words:
        assert not other.ids() & kept.ids()


def test_file_of_another_program_version_says_which_ids_are_free(kept, sensor, path, monkeypatch):
    """Whose classes have other fields."""
    monkeypatch.setitem(values.CLASSES, 'Tracks', lambda **_: Tracks(unknown=1))
    other = Station(sensor, path, kept.now)
    assert 'it has contents that are none' in other.lines[-1]
    for number in range(SCANS):
        other.scan(number)
    assert min(other.ids()) > max(kept.ids())


@pytest.mark.parametrize(
    ('parameters', 'later', 'words'),
    [
        ({'estimator': 'finite_memory'}, 0.0, 'parameter estimator was modified_polar, and is '),
        ({'max_tracks': 7}, 0.0, 'parameter max_tracks was 1000, and is 7 now'),
        ({'tracking_frame': 'map'}, 0.0, 'parameter tracking_frame was , and is map now'),
        ({'fields.bearing': 'brg'}, 0.0, 'parameter fields.bearing was , and is brg now'),
        ({}, 61.0, 'it is 61.0 s old, limit 60 s (snapshot.max_age)'),
        ({}, -5.0, 'it is -5.0 s old'),
    ],
)
def test_file_that_does_not_fit_is_refused(path, parameters, later, words):
    """Other parameters by name, too old, or from the future."""
    station = Station('sonar', path)
    station.scan(0)
    station.keeper.save()
    assert words in Station('sonar', path, station.now + later, **parameters).lines[-1]


def test_file_of_another_sensor_is_refused(path):
    """A radar does not take up bearings."""
    station = Station('sonar', path)
    station.scan(0)
    station.keeper.save()
    assert 'hears bearings, this one hears plots' in Station('radar', path).lines[-1]


def test_file_is_of_one_node(path):
    """Of two radars with one parameter file neither takes up the other's tracks; both say why."""
    stations = [Station('radar', path, name=name) for name in ('/bow/radar', '/stern/radar')]
    for number in range(2):
        for station in stations:
            station.scan(number)
            station.keeper.save()
    warning = f'snapshot is written by another node, too: {path}; give each'
    assert all(any(warning in line for line in station.lines) for station in stations)
    said = Station('radar', path, stations[0].now, '/bow/radar').lines[-1]
    assert 'is not used: it is of /stern/radar, this node is /bow/radar' in said


def test_contents_of_another_form_are_refused(kept, sensor, path):
    """A file with a right checksum whose arrays do not belong together."""
    memory = read_snapshot(path)
    state = memory['tracker']['state']
    for tracks in (
        replace(state.tracks, hits=state.tracks.hits[:-1]),
        replace(state.tracks, hits=state.tracks.hits.astype(np.float64)),
        replace(state.tracks, planes=()),
        Coverage(0.0, 1.0),
    ):
        changed = {**memory['tracker'], 'state': replace(state, tracks=tracks)}
        write_snapshot(path, {**memory, 'tracker': changed})
        other = Station(sensor, path, kept.now)
        assert 'it has contents that do not fit' in other.lines[-1]
        other.scan(0)


@pytest.mark.parametrize(('told', 'free'), [(1001, 1001), (2**32 - 1, 2**32 - 1), (2**32, 0)])
def test_free_ids_are_those_that_a_table_can_tell(path, told, free):
    """Of ten digits, too; a number beyond is nobody's."""
    write_snapshot(path, {}, told)
    assert free_ids(path) == free


def test_write_leaves_the_old_file_when_it_fails(path, monkeypatch):
    """A disk that is full in the middle costs the new file only, and leaves nothing behind."""
    write_snapshot(path, {'a': 1})

    def full(number):
        raise OSError('no space left')

    monkeypatch.setattr(os, 'fsync', full)
    with pytest.raises(OSError, match='no space'):
        write_snapshot(path, {'a': 2})
    assert read_snapshot(path) == {'a': 1}
    assert list(path.parent.iterdir()) == [path]


def test_folder_of_the_file_is_made(sensor, tmp_path):
    """A path that nobody has made yet is no mistake."""
    path = tmp_path / 'one' / 'two' / 'tracks'
    station = Station(sensor, path)
    station.scan(0)
    station.keeper.save()
    assert read_snapshot(path)['sensor'] == SENSORS[sensor].topic


def test_file_that_cannot_be_written_is_told_in_log_and_diagnostics(sensor, tmp_path):
    """With its path and the reason; tracking goes on."""
    (tmp_path / 'file').touch()
    path = tmp_path / 'file' / 'tracks'
    station = Station(sensor, path)
    station.scan(0)
    station.keeper.save()
    assert any(f'snapshot cannot be written: {path}: ' in line for line in station.lines)
    health = Health(started=0.0, plots_at=0.0)
    assert health.level(station.session, 1.0) == ('WARN', 'snapshot cannot be written')
    health.told(station.session)
    assert health.level(station.session, 1.0) == ('OK', 'tracking')


@pytest.mark.parametrize(
    'plain',
    [
        '{"dict": {"a": {"array": ["<f8", 1000000000000]}}}',
        '{"dict": {"a": {"array": ["|O", 1]}}}',
        '{"dict": {"a": {"array": ["<f8", -1]}}}',
        '{"dict": {"a": {"class": "Popen", "of": {"args": "ls"}}}}',
        '[' * 100_000,
        '3',
    ],
)
def test_read_takes_no_memory_and_builds_nothing_unknown(path, plain):
    """Sizes are checked against the file, classes against a list, before anything is made."""
    body = len(plain).to_bytes(8, 'little') + plain.encode()
    head = b'contact_tracking snapshot 2 1'
    checksum = snapshot_file.sha256(head + body).hexdigest().encode()
    path.write_bytes(b'\n'.join([head, checksum, body]))
    tracemalloc.start()
    with pytest.raises(BadSnapshot, match='contents that are none'):
        read_snapshot(path)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 20_000_000
