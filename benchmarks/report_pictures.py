# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does the page of a recording look like? The pictures of it in the documents.

``python -m benchmarks.report_pictures --output docs/images`` tracks the demo scenes, opens their
pages in a browser without a window, and takes the pictures: ``report`` (plan view of a radar),
``report_figures`` (what is below it), ``report_bearings`` (record of a sonar), and the orbits of
``docs/tutorial.md``: ``tutorial_first``, ``tutorial_mine``.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
import shutil
import sys
from tempfile import TemporaryDirectory
from typing import Any

from PIL import Image

from benchmarks.recordings import PROJECT
from benchmarks.report_page import FLAGS
from tracking_tools.demo_sonar import record
from tracking_tools.replay import main as replay

WIDTH, HEIGHT, BELOW, BRIEF = 1280, 760, 1675, 700  # [pixels]
TERMINAL = PROJECT / 'demo' / 'terminal_area'
TURNS = (
    'motion.horizontal.acceleration_sd=[0.5, 2.0, 2.0]',
    'motion.vertical.acceleration_sd=[0.3, 1.5]',
    'motion.horizontal.turn_rate=[0.0, 0.035, -0.035]',
    'motion.horizontal.sojourn_time=[90.0, 60.0, 60.0]',
)
ORBITS = (38.4, 42.0, 9.0)  # middle and width [km]


def write_pages(folder: Path) -> dict[str, Path]:
    """Track the scenes of the demos and write their pages."""
    record(folder / 'array')
    settings = [word for setting in TURNS for word in ('--set', setting)]
    scenes = {
        'radar': (TERMINAL, 'radar', ['--params', 'terminal_radar']),
        'sonar': (folder / 'array', 'sonar', ['--params', 'passive_linear_array']),
        'tutorial_first': (TERMINAL, 'radar', []),
        'tutorial_mine': (TERMINAL, 'radar', settings),
    }
    pages = {}
    for name, (recording, sensor, parameters) in scenes.items():
        pages[name] = folder / f'{name}.html'
        replay([str(recording), '--sensor', sensor, *parameters, '--quiet',
                '--output', str(folder / name), '--report', str(pages[name])])  # fmt: skip
    return pages


def open_at(browser: Any, page: Path, time: float, track: int) -> Any:
    """Return the page, opened at a time after the beginning [s] with a track chosen."""
    tab = browser.new_page(viewport={'width': WIDTH, 'height': HEIGHT})
    tab.goto(page.as_uri())
    tab.wait_for_selector('body[data-ready=true]', timeout=120_000)
    tab.keyboard.press('Home')
    tab.evaluate(
        """([time, track]) => {
            const {seek, choose, paths, state} = contactTracks;
            seek(state.time + time);
            choose(paths.find(({id}) => id === track));
        }""",
        [time, track],
    )
    tab.wait_for_timeout(500)  # until the browser has drawn it
    return tab


def look_at(tab: Any, east: float, north: float, width: float) -> None:
    """Zoom to a part of the plan [km]."""
    tab.evaluate(
        """([east, north, width]) => {
            const stage = contactTracks.models.stage, {x_range: xs, y_range: ys} = stage;
            const height = width * stage.inner_height / stage.inner_width;
            xs.setv({start: east - width / 2, end: east + width / 2});
            ys.setv({start: north - height / 2, end: north + height / 2});
        }""",
        [east, north, width],
    )
    tab.wait_for_timeout(500)


def save(png: bytes, path: Path, top: int = 0) -> None:
    """Write a picture without what is above a line, with as few colours as show it well."""
    shot = Image.open(BytesIO(png)).convert('RGB')
    shot = shot.crop((0, top, shot.width, min(shot.height, top + BELOW)))
    shot.quantize(200).save(path, optimize=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 (an extra)

    parser = argparse.ArgumentParser(description=__doc__.split('\n', 2)[1])
    parser.add_argument('--output', type=Path, required=True, metavar='DIR')
    output = parser.parse_args(arguments).output
    path = shutil.which('chromium') or shutil.which('google-chrome')
    with TemporaryDirectory() as folder, sync_playwright() as driver:
        pages = write_pages(Path(folder))
        browser = driver.chromium.launch(executable_path=path, args=list(FLAGS))
        plan = open_at(browser, pages['radar'], 1040.0, 5)
        save(plan.screenshot(), output / 'report.png')
        save(plan.screenshot(full_page=True), output / 'report_figures.png', HEIGHT)
        record_of_bearings = open_at(browser, pages['sonar'], 1500.0, 1)
        save(record_of_bearings.screenshot(), output / 'report_bearings.png')
        for name in ('tutorial_first', 'tutorial_mine'):
            orbits = open_at(browser, pages[name], 635.0, 8)
            look_at(orbits, *ORBITS)
            clip = {'x': 0, 'y': 0, 'width': WIDTH, 'height': BRIEF}
            save(orbits.screenshot(clip=clip), output / f'{name}.png')
        browser.close()
    return 0


if __name__ == '__main__':
    sys.exit(main())
