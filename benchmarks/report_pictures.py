# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does the page of a recording look like? The pictures of it in the documents.

``python -m benchmarks.report_pictures --output docs/images`` tracks the demo scenes, opens their
pages in a browser without a window, and takes the pictures: ``report`` (plan view of a radar),
``report_figures`` (what is below it) and ``report_bearings`` (record of a sonar).
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

WIDTH, HEIGHT, BELOW = 1280, 760, 1675  # [pixels]


def write_pages(folder: Path) -> dict[str, Path]:
    """Track the scenes of the demos and write their pages."""
    record(folder / 'array')
    scenes = {
        'radar': (PROJECT / 'demo' / 'terminal_area', 'terminal_radar.yaml'),
        'sonar': (folder / 'array', 'passive_linear_array.yaml'),
    }
    pages = {}
    for sensor, (recording, parameters) in scenes.items():
        pages[sensor], settings = folder / f'{sensor}.html', PROJECT / 'config' / parameters
        replay([str(recording), '--sensor', sensor, '--params', str(settings), '--quiet',
                '--output', str(folder / sensor), '--report', str(pages[sensor])])  # fmt: skip
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
        browser.close()
    return 0


if __name__ == '__main__':
    sys.exit(main())
