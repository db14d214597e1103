# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Does the page hold what was recorded, and nothing that could do harm?"""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable
import json
from pathlib import Path
import re
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
import pytest
from rosbags.typesys import get_typestore, Stores

pytest.importorskip('bokeh', reason='bokeh (extra report) is not installed')

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns, to_columns
from tracking_tools.bags import BagWriter, open_bag
from tracking_tools.evaluate import main as evaluate_main
from tracking_tools.replay import main as replay_main
from tracking_tools.replay_topics import Topics
from tracking_tools.report.columns import DARK, ellipses, encode, GREEN, lights, RED
from tracking_tools.report.command import main
from tracking_tools.report.material import gather, Sources
from tracking_tools.report.page import page, safe_json
from tracking_tools.track_table import NEEDED

EVIL = '</script><script>window.hurt = 1</script><img src=x onerror="window.hurt = 2">'


def content_of(html: str) -> Any:
    """Return what the page's script reads."""
    found = re.search(r'<script type="application/json" id="content">(.*?)</script>', html)
    assert found is not None
    return json.loads(found.group(1))


def columns_of(encoded: Any) -> dict[str, Any]:
    """Return encoded columns as arrays."""
    kinds = {
        'Float32Array': '<f4',
        'Float64Array': '<f8',
        'Uint8Array': 'u1',
        'Uint32Array': '<u4',
    }
    return {
        name: np.frombuffer(b64decode(part['data']), kinds[part['type']])
        for name, part in encoded.items()
    }


@pytest.fixture(scope='module')
def replayed(cut_bag: Callable[[int], Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Track a piece of the demo scene and write its page, as a user does; return the folder."""
    folder = tmp_path_factory.mktemp('report')
    arguments = [str(cut_bag(40)), '--sensor', 'radar', '--output', str(folder / 'tracks')]
    assert replay_main([*arguments, '--report', str(folder / 'new' / 'page.html'), '--quiet']) == 0
    return folder


def test_replay_writes_a_page_with_all_rows(
    replayed: Path, cut_bag: Callable[[int], Path]
) -> None:
    """Confirmed rows, plots and truth are in it, with the parameters and the step times."""
    html = (replayed / 'new' / 'page.html').read_text()
    content = content_of(html)
    tracks, plots = columns_of(content['tracks']), columns_of(content['plots'])
    topics = Topics()
    material = gather(Sources('radar', topics, replayed / 'tracks', cut_bag(40), cut_bag(40)))
    assert len(tracks['id']) == len(material.scene.published['id']) > 100
    assert len(plots['time']) == len(material.scene.plots['time'])
    assert_allclose(tracks['x'].max(), material.scene.published['x'].max() / 1000.0, rtol=1e-6)
    assert 'histogram' in content['figures']
    assert 'gospa' in content['figures']
    for name, value in (('sensor.range_sd', '50 m'), ('gate.probability', '0.997')):
        assert f'<td>{name}</td><td>{value}</td>' in html
    assert f'{len(np.unique(tracks["stamp"]))} scans with tracks' in html
    assert 'minutes from 2023-11-14 22:13:20 UTC' in html
    assert np.all(np.diff(tracks['id'].astype(int)) >= 0)


def test_page_asks_nobody_for_anything(replayed: Path) -> None:
    """No script, style, picture or font comes from elsewhere."""
    html = (replayed / 'new' / 'page.html').read_text()
    markup = re.sub(r'<script.*?</script>', '', html, flags=re.DOTALL)
    assert not re.findall(r'(?:src|href)\s*=\s*(?!["\']?data:,)', markup)
    assert not re.findall(r'<script[^>]*\bsrc', html)
    assert '@import' not in markup
    assert 'url(' not in markup


def test_page_takes_nothing_recorded_for_markup(
    replayed: Path, tmp_path: Path, messages: Any
) -> None:
    """A title, a topic and a path that try to end the script stay text."""
    topic = f'/{EVIL}'
    with BagWriter(tmp_path / 'tracks') as out, open_bag(replayed / 'tracks') as bag:
        for connection, time, raw in bag.messages():
            out.write_raw(topic, connection.msgtype, raw, time)
    topics = Topics.remapped([f'tracks:={topic}'])
    html = page(gather(Sources('radar', topics, tmp_path / 'tracks'), title=EVIL))
    assert '<script>window.hurt' not in html
    assert '<img' not in re.sub(r'<script.*?</script>', '', html, flags=re.DOTALL)
    assert '&lt;/script&gt;&lt;script&gt;window.hurt' in html
    assert len(columns_of(content_of(html)['tracks'])['id']) > 100


def test_safe_json_cannot_end_its_script() -> None:
    """Text that ends a script or opens a comment comes back as it was, but never stands there."""
    text = safe_json({'name': f'{EVIL}<!--&'})
    assert not set('<>&') & set(text)
    assert json.loads(text) == {'name': f'{EVIL}<!--&'}


def test_encode_keeps_every_value() -> None:
    """Bytes come back as they were, also of big-endian and of strided columns."""
    columns = {
        'a': np.arange(6, dtype='>f4')[::2],
        'b': np.array([0, 255], np.uint8),
        'c': np.array([1e-300, np.nan]),
    }
    for name, values in columns_of(encode(columns)).items():
        assert_allclose(values, columns[name])


def test_ellipses_hold_95_percent() -> None:
    """Of normal errors with a covariance 95 % fall into its ellipse, half axes along its axes."""
    P = np.array([[[9.0, 4.0], [4.0, 4.0]]])
    major, minor, angle = ellipses(P)
    errors = np.random.default_rng(4).multivariate_normal([0.0, 0.0], P[0], 20_000)
    c, s = np.cos(angle[0]), np.sin(angle[0])
    along, across = errors @ [c, s], errors @ [-s, c]
    inside = (along / major[0]) ** 2 + (across / minor[0]) ** 2 <= 1.0
    assert_allclose(inside.mean(), 0.95, atol=0.005)  # three sigma of the share


def test_lights_are_those_of_the_innovation() -> None:
    """Three dimensions: 5 is usual, 17 is beyond one in a thousand, a missed look is dark."""
    table = {
        'id': np.arange(4), 'nis': np.array([5.0, 17.0, np.nan, 5.0]),
        'coasted': np.array([0, 0, 0, 1]),
    }  # fmt: skip
    assert lights(table, 3).tolist() == [GREEN, RED, DARK, DARK]


def test_report_command_on_tracks_alone(
    replayed: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without plots, truth and parameters the page says so and shows the tracks."""
    output = tmp_path / 'page.html'
    assert main([str(replayed / 'tracks'), '--output', str(output)]) == 0
    assert str(output) in capsys.readouterr().out
    html = output.read_text()
    for what in ('Without a truth', 'The parameters were not given', 'does not tell how long'):
        assert what in html
    assert content_of(html)['plots'] == content_of(html)['truth'] == {}


@pytest.mark.parametrize(
    ('names', 'found'),
    [
        (('somebody',), [0.004]),  # whoever recorded them
        (('radar_tracker', 'ship/radar_tracker', 'sonar_tracker'), [0.004]),
        (('bow', 'stern'), []),  # nobody knows whose tracks these are
    ],
)
def test_gather_finds_the_step_times_of_the_node_whose_tracks_it_shows(
    names: tuple[str, ...], found: list[float], replayed: Path, tmp_path: Path
) -> None:
    """What a live node told in its diagnostics is there, that of others in its graph is not."""
    types = get_typestore(Stores.ROS2_JAZZY).types
    status = types['diagnostic_msgs/msg/DiagnosticStatus']
    value = types['diagnostic_msgs/msg/KeyValue']
    array = types['diagnostic_msgs/msg/DiagnosticArray']
    header = rosbags_types().header(1.0, '')
    with BagWriter(tmp_path / 'tracks') as out, open_bag(replayed / 'tracks') as bag:
        for connection, time, raw in bag.messages():
            out.write_raw(connection.topic, connection.msgtype, raw, time)
        for name, taken in zip(names, ('0.004', '0.006', '0.008'), strict=False):
            values = [value('tracks', '7'), value('step time [s]', taken)]
            who = f'{name}: tracking'
            told = [status(level=0, name=who, message='', hardware_id='', values=values)]
            out.write('diagnostics', array(header=header, status=told), time)
    material = gather(Sources('radar', Topics(), tmp_path / 'tracks'))
    assert material.step_times.tolist() == found


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        (lambda table: {'covariance': table['covariance'][:, :9]}, 'must have 36 values, got 9'),
        (lambda table: {'state': table['status']}, 'has no column status'),
    ],
)
def test_report_command_says_what_a_table_lacks(
    change: Any, words: str, replayed: Path, messages: Any, tmp_path: Path, capsys: Any
) -> None:
    """Of another tracker, without a truth."""
    with BagWriter(tmp_path / 'odd') as out:
        for time, msg in messages(replayed / 'tracks', '/radar_tracker/tracks'):
            table = to_columns(msg, 1000)
            columns = {name: table[name] for name in NEEDED['radar']} | change(table)
            if 'state' in columns:
                del columns['status']
            odd = from_columns(columns, time * 1e-9, 'radar', rosbags_types())
            out.write('/radar_tracker/tracks', odd, time)
    assert main([str(tmp_path / 'odd'), '--output', str(tmp_path / 'page.html')]) == 1
    assert words in capsys.readouterr().err


@pytest.mark.parametrize('bag', ['nothing', 'recording'])
def test_report_command_says_what_is_missing(
    bag: str, cut_bag: Callable[[int], Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """No bag, and a bag without tracks, are refused in one line."""
    path = cut_bag(40) if bag == 'recording' else tmp_path / bag
    assert main([str(path), '--output', str(tmp_path / 'page.html')]) == 1
    assert re.match('report: .*(no bag at|has no topic)', capsys.readouterr().err)


def test_report_command_refuses_plots_that_are_not_there(
    replayed: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A bag of tracks has none: the page would have said where they are, and shown nothing."""
    tracks = str(replayed / 'tracks')
    page = tmp_path / 'page.html'
    assert main([tracks, '--plots', tracks, '--output', str(page)]) == 1
    assert 'has no topic /plots; it has /radar_tracker' in capsys.readouterr().err
    assert not page.exists()


def test_report_command_takes_the_rules_of_one_sensor(
    replayed: Path, cut_bag: Callable[[int], Path], tmp_path: Path
) -> None:
    """The bag says that its tracks are a radar's, so plots:= is known without --sensor."""
    with open_bag(cut_bag(40)) as bag, BagWriter(tmp_path / 'own_names') as out:
        for connection, time, raw in bag.messages():
            out.write_raw(f'/mast{connection.topic}', connection.msgtype, raw, time)
    names = ['--remap', 'plots:=/mast/plots', '--remap', 'truth:=/mast/truth']
    bags = ['--plots', str(tmp_path / 'own_names'), '--truth', str(tmp_path / 'own_names')]
    page = tmp_path / 'page.html'
    assert main([str(replayed / 'tracks'), *bags, *names, '--output', str(page)]) == 0
    same = tmp_path / 'same.html'
    bags = ['--plots', str(cut_bag(40)), '--truth', str(cut_bag(40))]
    assert main([str(replayed / 'tracks'), *bags, '--output', str(same)]) == 0
    for part in ('plots', 'truth'):
        assert content_of(page.read_text())[part] == content_of(same.read_text())[part] != {}


def test_page_has_the_figures_of_evaluate(
    replayed: Path, cut_bag: Callable[[int], Path], tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    """Judged with the same yardstick, of which the page says the match radius."""
    given = [str(replayed / 'tracks'), '--truth', str(cut_bag(40)), '--radius', '200']
    given += ['--cutoff', '300', '--turning', '2']
    assert evaluate_main(given) == 0
    told = capsys.readouterr().out.splitlines()
    assert main([*given, '--output', str(tmp_path / 'page.html')]) == 0
    html = (tmp_path / 'page.html').read_text()
    assert f'<p>{told[0]}</p>' in html
    assert 'matched within 200.0 m' in told[0]
    cells = [' '.join(row) for row in re.findall('<td>(.*?)</td><td>(.*?)</td><td>(.*?)<', html)]
    table = told[told.index('') + 1 : told.index('', 2)]
    assert [' '.join(line.split()) for line in table] == [cell.strip() for cell in cells[:17]]


def test_report_command_takes_a_table_with_the_least_columns(
    replayed: Path, messages: Any, tmp_path: Path
) -> None:
    """Of a tracker that tells neither modes nor existence; what is not known is not shown."""
    with BagWriter(tmp_path / 'bare') as out:
        for time, msg in messages(replayed / 'tracks', '/radar_tracker/tracks'):
            table = to_columns(msg, 1000)
            columns = {name: table[name] for name in NEEDED['radar']}
            bare = from_columns(columns, time * 1e-9, 'radar', rosbags_types())
            out.write('/radar_tracker/tracks', bare, time)
    page = tmp_path / 'page.html'
    assert main([str(tmp_path / 'bare'), '--output', str(page)]) == 0
    full = content_of((replayed / 'new' / 'page.html').read_text())['tracks']
    assert (
        columns_of(content_of(page.read_text())['tracks'])['x'].size == columns_of(full)['x'].size
    )
