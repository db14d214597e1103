# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Can the page be read where a recording is of a near radar, has a pause, or lasts for hours?"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
import pytest

pytest.importorskip('bokeh', reason='bokeh (extra report) is not installed')

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from tracking_tools.bags import BagWriter, nanoseconds
from tracking_tools.replay_topics import Topics
from tracking_tools.report.material import gather, Sources
from tracking_tools.report.page import write_page
from tracking_tools.report.panels import NOTHING, overview

PATIENCE = 60_000  # on a busy machine [ms]
EPOCH, LIFE = 1000.0, 1800.0
PIECES = """() => ['paths', 'truth_paths'].map((name) => contactTracks.models[name].data.xs.map(
    (xs) => xs.length))"""


def open_page(
    browser: Any,
    folder: Path,
    times: Sequence[float],
    speed: float,
    north: float = 40.0,
    lost: float = -1.0,
) -> Any:
    """Return the page of contacts that go east, one after the other; tracks are perfect."""
    with BagWriter(folder / 'bag') as bag:
        for time in times:
            number = int(time // LIFE)
            east, one = np.array([12.0 + speed * (time % LIFE)]), np.ones(1)
            truth = {'id': np.array([number + 1], np.uint32), 'x': east, 'y': north * one,
                     'z': 0 * one, 'vx': speed * one, 'vy': 0 * one, 'vz': 0 * one}  # fmt: skip
            tracks = {**truth, 'status': np.ones(1, np.uint8), 'p_0': one, 'nis': one,
                      'time': 0 * one, 'covariance': np.eye(6).reshape(1, 36)}  # fmt: skip
            if time == lost:
                tracks['x'] = np.nan * one
            for topic, columns in (('radar_tracker/tracks', tracks), ('truth', truth)):
                msg = from_columns(columns, EPOCH + time, 'map', rosbags_types())
                bag.write(topic, msg, nanoseconds(EPOCH + time))
    sources = Sources('radar', Topics(), folder / 'bag', truth=folder / 'bag')
    write_page(gather(sources), folder / 'page.html')
    tab = browser.new_page(viewport={'width': 1366, 'height': 768})
    tab.goto((folder / 'page.html').as_uri())
    tab.wait_for_selector('body[data-ready=true]', timeout=PATIENCE)
    return tab


def test_page_of_a_near_radar_is_in_metres(browser: Any, tmp_path: Path) -> None:
    """A walk of 28 m fills the plan; places are told to 0.1 m; a line ahead is no longer path."""
    page = open_page(browser, tmp_path, 0.1 * np.arange(200), 1.4)
    page.keyboard.press('Home')
    label = '() => contactTracks.models.stage.below[0].axis_label'
    assert page.evaluate(label) == 'east [m]'
    assert {'12.0 m', '40.0 m'} <= set(page.inner_text('#facts').split('\n'))
    seen = page.evaluate(
        '() => (({start, end}) => end - start)(contactTracks.models.stage.x_range)'
    )
    assert_allclose(seen, 1.08 * 1.4 * 19.9, rtol=0.01)
    ahead = page.evaluate(
        '() => (({x, x1}) => x1[0] - x[0])(contactTracks.models.velocities.data)'
    )
    assert 0.2 < ahead < 0.04 * seen
    assert 'its way in 0.5 s' in page.inner_text('#lead')


def test_nothing_is_drawn_over_a_pause_of_the_recording(browser: Any, tmp_path: Path) -> None:
    """Ten scans, five minutes of nothing, ten scans of the same contact and track."""
    page = open_page(browser, tmp_path, [*range(0, 40, 4), *range(340, 380, 4)], 100.0)
    assert page.evaluate('() => contactTracks.models.stage.below[0].axis_label') == 'east [km]'
    assert page.evaluate(PIECES) == [[10, 10], [10, 10]]
    own = page.evaluate('() => contactTracks.models.own.data.p_0')
    assert (len(own), own[11], own[12]) == (24, 0, 0)
    gospa = page.evaluate(
        """() => {
            const {data} = contactTracks.models.gospa.renderers[0].data_source;
            return [...(data instanceof Map ? data.get('y') : data.y)].map(Number.isFinite);
        }"""
    )
    assert gospa == 2 * [False, *(10 * [True]), False]
    page.evaluate('() => contactTracks.seek(200)')
    assert page.evaluate('() => contactTracks.models.truth.data.x.length') == 0


def test_overview_has_holes_in_pauses_only() -> None:
    """A track of a radar whose scans are one or two seconds apart, and then ten, is a line."""
    stamps = np.array([0.0, 1.0, 2.0, 4.0, 5.0, 7.0, 8.0, 18.0, 19.0])
    table = {name: np.ones(9) for name in ('id', 'existence', 'manoeuvre', 'light')}
    shown = overview({**table, 'stamp': stamps}, 1.0).renderers[0].data_source.data['image'][0]
    assert np.flatnonzero(shown[0] == NOTHING).tolist() == [*range(9, 18)]


def test_hours_show_the_tracks_near_in_time(browser: Any, tmp_path: Path) -> None:
    """Ten contacts of half an hour each come one after the other; two at most are drawn."""
    page = open_page(browser, tmp_path, np.arange(0.0, 10.0 * LIFE, 30.0), 10.0)
    assert page.inner_text('#whole') == 'tracks near in time'
    for time, count in ((0.5 * LIFE, 1), (1.02 * LIFE, 2), (8.5 * LIFE, 1)):
        page.evaluate(f'() => {{ contactTracks.choose(null); contactTracks.seek({time}); }}')
        assert [len(lines) for lines in page.evaluate(PIECES)] == [count, count]
    page.evaluate('() => contactTracks.choose(contactTracks.paths[2])')
    assert [len(lines) for lines in page.evaluate(PIECES)] == [2, 1]


def test_coordinates_of_a_map_are_exact_and_in_figures(browser: Any, tmp_path: Path) -> None:
    """Of 5,500 km, as in UTM, steps were 0.5 m and labels of the axis 5.50001e+6."""
    page = open_page(browser, tmp_path, 0.1 * np.arange(200), 1.4, north=5_500_000.123)
    north = page.evaluate('() => contactTracks.models.paths.data.ys[0][0]')
    assert_allclose(north, 5_500_000.123, atol=1e-4, rtol=0.0)
    assert '5500000.1 m' in page.inner_text('#facts')
    assert not page.evaluate('() => contactTracks.models.stage.left[0].formatter.use_scientific')


def test_row_without_a_place_leaves_the_plan(browser: Any, tmp_path: Path) -> None:
    """One that another tracker did not know where to put, and nothing was drawn at all."""
    page = open_page(browser, tmp_path, np.arange(0.0, 80.0, 4.0), 100.0, lost=8.0)
    assert page.evaluate('() => contactTracks.models.stage.x_range.end') > 7.6
