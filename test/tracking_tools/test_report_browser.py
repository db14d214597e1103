# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is the page usable in a real browser? Click, play, keys, and how soon it is there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import Columns, from_columns
from tracking_tools.bags import BagWriter, nanoseconds
from tracking_tools.replay import main as replay_main
from tracking_tools.replay_topics import Topics
from tracking_tools.report.material import gather, Sources
from tracking_tools.sensors import SENSORS

pytest.importorskip('bokeh', reason='bokeh (extra report) is not installed')

from tracking_tools.report.page import write_page

PATIENCE = 60_000  # on a busy machine [ms]
EVIL = '</script><script>window.hurt = 1</script>'
OPENS = (
    2.0  # of the browser's main thread [s]; wall time says more of the machine than of the page
)


@pytest.fixture(scope='module')
def html(cut_bag: Callable[[int], Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the page of a piece of the demo scene, under a title that attacks it."""
    folder, recording = tmp_path_factory.mktemp('page'), cut_bag(60)
    arguments = [str(recording), '--sensor', 'radar', '--output', str(folder / 'tracks')]
    assert replay_main([*arguments, '--quiet']) == 0
    sources = Sources('radar', Topics(), folder / 'tracks', recording, recording)
    write_page(gather(sources, step_times=[0.01] * 60, title=EVIL), folder / 'page.html')
    return folder / 'page.html'


def open_page(browser: Any, html: Path) -> Any:
    """Return an open page, with what it complains about and what it asks the network for."""
    tab = browser.new_page(viewport={'width': 1366, 'height': 768})
    tab.wrong = []
    tab.on('pageerror', lambda error: tab.wrong.append(str(error)))
    tab.on('console', lambda line: tab.wrong.append(line.text) if line.type == 'error' else None)
    tab.on('request', lambda asked: None if asked.url.startswith(('file:', 'data:', 'blob:'))
           else tab.wrong.append(asked.url))  # fmt: skip
    measure = tab.context.new_cdp_session(tab)
    measure.send('Performance.enable', {'timeDomain': 'threadTicks'})
    tab.goto(html.as_uri())
    tab.wait_for_selector('body[data-ready=true]', timeout=PATIENCE)
    values = measure.send('Performance.getMetrics')['metrics']
    tab.main_thread = {value['name']: value['value'] for value in values}['TaskDuration']
    tab.begin_with = tab.evaluate('() => document.activeElement.id')
    return tab


@pytest.fixture(scope='module')
def opened(browser: Any, html: Path) -> Iterator[Any]:
    """Yield the open page of the demo scene."""
    tab = open_page(browser, html)
    yield tab
    tab.close()


@pytest.fixture
def page(opened: Any) -> Iterator[Any]:
    """Yield the page as it is at the beginning; an error or a request fails the test."""
    opened.evaluate('() => document.getElementById("play").focus()')
    opened.keyboard.press('Home')
    opened.keyboard.press('Shift+ArrowRight')
    yield opened
    assert not opened.wrong


def state(page: Any, name: str) -> Any:
    """Return a part of the page's state."""
    return page.evaluate(f'() => {{ const s = contactTracks.state; return {name}; }}')


def test_page_opens_soon_and_unharmed(page: Any) -> None:
    """Everything is drawn, the title is text, and the browser has not worked long."""
    assert page.main_thread < OPENS
    assert page.inner_text('h1') == EVIL
    assert page.evaluate('() => window.hurt') is None
    sizes = page.evaluate(
        """() => ['stage', 'own', 'overview', 'gospa', 'histogram'].map((id) => {
            const canvas = Bokeh.documents.length && document.getElementById(id);
            return Math.min(canvas.clientWidth, canvas.clientHeight);
        })"""
    )
    assert min(sizes) > 100


def test_a_click_on_a_track_chooses_it(page: Any) -> None:
    """The card tells of the track that was clicked; a click on nothing chooses none."""
    where = """() => {
        const {models: {stage, now}} = contactTracks, view = Bokeh.index.find_one_by_id(stage.id);
        const box = view.el.getBoundingClientRect(), frame = view.frame.bbox, k = 0;
        const x = view.frame.x_scale.compute(now.data.x[k]);
        const y = view.frame.y_scale.compute(now.data.y[k]);
        return {label: now.data.label[k], x: box.x + frame.left + x, y: box.y + frame.top + y};
    }"""
    page.keyboard.press('Escape')
    assert page.inner_text('#name') == 'No track chosen'
    spot = page.evaluate(where)
    page.mouse.click(spot['x'], spot['y'])
    page.wait_for_function('() => contactTracks.state.chosen', timeout=PATIENCE)
    assert page.inner_text('#name') == f'Track {spot["label"]}'
    assert 'km' in page.inner_text('#facts')
    assert page.evaluate('() => contactTracks.models.own.data.t.length') > 10
    assert page.get_attribute('#list tbody tr[aria-selected=true]', 'data-id') == spot['label']


def test_keys_step_choose_and_play(page: Any) -> None:
    """Arrows step scans and tracks, space plays and pauses, Home and End are the ends."""
    page.keyboard.press('ArrowDown')
    page.keyboard.press('Home')
    first = state(page, 's.time')
    page.keyboard.press('ArrowRight')
    assert state(page, 's.time') == pytest.approx(first + 4.0, abs=0.01)
    page.keyboard.press('Shift+ArrowRight')
    assert state(page, 's.time') == pytest.approx(first + 44.0, abs=0.01)
    one = state(page, 's.chosen.id')
    page.keyboard.press('ArrowDown')
    assert state(page, 's.chosen.id') != one
    page.keyboard.press('Space')
    assert state(page, 's.playing')
    page.wait_for_function(f'() => contactTracks.state.time > {first + 60.0}', timeout=PATIENCE)
    page.keyboard.press('Space')
    assert not state(page, 's.playing')
    shown = page.evaluate('() => contactTracks.models.cursor_overview.location')
    assert shown == pytest.approx(state(page, 's.time') / 60.0)
    page.keyboard.press('End')
    assert float(page.input_value('#time')) == pytest.approx(
        float(page.get_attribute('#time', 'max'))
    )


def test_tab_reaches_every_control(page: Any) -> None:
    """Play, time, speed, layers, the choice of colours and the list come one after the other."""
    assert page.begin_with == 'play'
    seen = []
    for _ in range(20):
        page.keyboard.press('Tab')
        seen.append(page.evaluate(
            """() => {
                const e = document.activeElement;
                return e.id || e.dataset.layer || e.name || e.tagName;
            }"""
        ))  # fmt: skip
    wanted = ['time', 'rate', 'plots', 'paths', 'gates', 'ellipses', 'truth', 'follow', 'shown']
    assert [name for name in seen if name in wanted] == wanted
    assert 'TR' in seen
    page.keyboard.press('Enter')
    assert state(page, 's.chosen.id') == int(
        page.evaluate('() => document.activeElement.dataset.id')
    )


def test_layers_and_colours_can_be_chosen(page: Any) -> None:
    """A layer without its tick is empty; one of three maps of all tracks is shown."""
    gates = '() => contactTracks.models.gates.data.x.length'
    assert page.evaluate(gates) > 0
    page.uncheck('[data-layer=gates]')
    assert page.evaluate(gates) == 0
    page.check('[data-layer=all_plots]')
    assert page.evaluate('() => contactTracks.models.all_plots.data.x.length') > 1000
    page.check('[name=shown][value=light]')
    maps = """() => ['existence', 'manoeuvre', 'light'].map(
        (name) => contactTracks.models[`overview_${name}`].visible)"""
    assert page.evaluate(maps) == [False, False, True]


def bearings_at(k: int) -> tuple[Columns, Columns]:
    """Return the track table and the marks of a cycle: two contacts that cross."""
    bearing = np.array([1.0 - 0.01 * k, 0.8 + 0.01 * k])
    one = np.ones(2, np.float32)
    common = {'existence_probability': one, 'manoeuvre_probability': 0 * one, 'nis': one,
              'p_0': one, 'gate': 0.02 * one, 'time': 0 * one}  # fmt: skip
    tracks = {
        'id': np.array([1, 2], np.uint32), 'status': np.ones(2, np.uint8), 'bearing': bearing,
        'bearing_rate': 0 * one, 'bearing_sd': 0.01 * one, 'bearing_rate_sd': one,
        'coasted': np.zeros(2, np.uint8), 'range': one * np.nan, 'range_sd': one * np.nan,
        **common,
    }  # fmt: skip
    return tracks, {'bearing': bearing.astype(np.float32)}


def test_page_of_a_sonar_is_a_record_of_bearings(browser: Any, tmp_path: Path) -> None:
    """Time runs down, marks are there from the beginning, tracks can be chosen, time goes by."""
    with BagWriter(tmp_path / 'bag') as bag:
        for k in range(20):
            for topic, columns in zip(('sonar_tracker/tracks', 'bearings'), bearings_at(k),
                                      strict=True):  # fmt: skip
                msg = from_columns(columns, 100.0 + 2.0 * k, 'map', rosbags_types())
                bag.write(topic, msg, nanoseconds(100.0 + 2.0 * k))
    topics = Topics.of(SENSORS['sonar'])
    sources = Sources('sonar', topics, tmp_path / 'bag', tmp_path / 'bag')
    write_page(gather(sources), tmp_path / 'page.html')
    page = open_page(browser, tmp_path / 'page.html')
    ends = '() => (({start, end}) => start > end)(contactTracks.models.stage.y_range)'
    assert page.evaluate(ends)
    assert page.evaluate('() => contactTracks.models.all_plots.data.x.length') == 40
    page.keyboard.press('ArrowDown')
    page.keyboard.press('End')
    page.keyboard.press('ArrowLeft')
    assert state(page, 's.time') == pytest.approx(36.0)
    shown = page.evaluate('() => contactTracks.models.now.data')
    degrees = [90.0 - np.degrees(1.0 - 0.18), 90.0 - np.degrees(0.8 + 0.18)]
    assert shown['x'] == pytest.approx(degrees, abs=1e-3)
    assert 'deg' in page.inner_text('#facts')
    assert not page.wrong
    page.close()


def test_keys_zoom_and_move_the_map(page: Any) -> None:
    """Plus and minus about the middle, letters by a tenth, 0 back to all of it."""
    there = """(() => {
        const {x_range: x, y_range: y} = contactTracks.models.stage;
        return [x.start, x.end, y.start, y.end];
    })()"""

    def seen() -> list[float]:
        return list(page.evaluate(there))

    west, east, south, north = all_of_it = seen()
    page.keyboard.press('+')
    assert seen()[1] - seen()[0] == pytest.approx(0.8 * (east - west))
    assert sum(seen()[:2]) == pytest.approx(west + east)
    page.keyboard.press('-')
    assert seen() == pytest.approx(all_of_it)
    page.keyboard.press('d')
    page.keyboard.press('w')
    shift = 0.1 * (east - west), 0.1 * (north - south)
    assert seen()[::2] == pytest.approx([west + shift[0], south + shift[1]])
    page.keyboard.press('0')
    page.wait_for_function(f'() => Math.abs({there}[0] - {west}) < 1', timeout=PATIENCE)
