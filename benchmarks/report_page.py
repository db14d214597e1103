# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How soon is the page of an hour of terminal traffic there, and how smoothly does it play?

Run ``python -m benchmarks.report_page [--opens N]``. The hour is the demo scene twice, one after
the other. Times of the browser are those of its main thread's CPU, and of the wall clock, which
says more of the machine than of the page when others work on it.
"""

from __future__ import annotations

import argparse
from pathlib import Path
import shutil
import sys
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import numpy as np

from benchmarks.recordings import PROJECT
from msg_adapters.message_types import NANOSECONDS, rosbags_types
from msg_adapters.table import from_columns_under, to_columns
from tracking_tools.bags import BagWriter, open_bag
from tracking_tools.replay import read_configs, replay
from tracking_tools.replay_topics import Topics
from tracking_tools.report import load_page
from tracking_tools.sensors import SENSORS

HALF_HOUR = 1800
FRAMES = 60
FLAGS = ('--headless', '--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-sync')
PLAY = """(frames) => new Promise((done) => {
    const {seek} = contactTracks, begin = performance.now();
    let k = 0;
    const tick = () => { seek(600 + k); k++ < frames ? requestAnimationFrame(tick)
        : done((performance.now() - begin) / frames); };
    requestAnimationFrame(tick);
})"""


def main() -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 2)[1])
    parser.add_argument('--opens', type=int, default=5, metavar='N', help='default 5')
    chosen = parser.parse_args()
    browser = shutil.which('chromium') or shutil.which('google-chrome')
    if browser is None:
        print('report_page: no chromium on this machine', file=sys.stderr)
        return 1
    with TemporaryDirectory() as folder:
        page = write_hour(Path(folder))
        measure(page, browser, chosen.opens)
    return 0


def write_hour(folder: Path) -> Path:
    """Track an hour and write its page."""
    record_hour(folder / 'hour')
    sensor, topics = SENSORS['radar'], Topics()
    configs = read_configs(PROJECT / 'config' / 'terminal_radar.yaml', {}, sensor)
    summary = replay(folder / 'hour', folder / 'tracks', configs, topics, quiet=True)
    began = process_time()
    where = ('radar', topics, folder / 'hour', folder / 'tracks')
    load_page().report_replay(where, configs, summary.step_times, folder / 'page.html')
    size = (folder / 'page.html').stat().st_size / 1e6
    print(
        f'an hour: {summary.tables} scans, {summary.plots.rows} plots, '
        f'{len(summary.confirmed)} tracks; page {size:.1f} MB, written in '
        f'{process_time() - began:.1f} s of CPU'
    )
    return folder / 'page.html'


def record_hour(path: Path) -> None:
    """Write the demo scene twice, the second time half an hour later with other contacts."""
    types = rosbags_types()
    with open_bag(PROJECT / 'demo' / 'terminal_area') as bag, BagWriter(path) as out:
        for again in (0, 1):
            for connection, time, raw in bag.messages():
                msg: Any = bag.deserialize(raw, connection.msgtype)
                columns, header = to_columns(msg, 1_000_000), msg.header
                header.stamp.sec += again * HALF_HOUR
                if 'id' in columns:
                    columns['id'] = columns['id'] + np.uint32(100 * again)
                later = time + again * HALF_HOUR * NANOSECONDS
                out.write(connection.topic, from_columns_under(header, columns, types), later)


def measure(page: Path, browser: str, opens: int) -> None:
    """Open the page some times and play a minute of it."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 (an extra)

    results = []
    with sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=browser, args=list(FLAGS))
        for _ in range(opens):
            tab = running.new_page(viewport={'width': 1440, 'height': 900})
            meter = tab.context.new_cdp_session(tab)
            meter.send('Performance.enable', {'timeDomain': 'threadTicks'})
            tab.goto(page.as_uri())
            tab.wait_for_selector('body[data-ready]', timeout=120_000)
            opened = tab.evaluate('() => Number(document.body.dataset.after)')
            before = _busy(meter)
            frame = tab.evaluate(PLAY, FRAMES)
            cpu = (_busy(meter) - before) / FRAMES
            results.append((opened / 1e3, before, frame, 1e3 * cpu))
            tab.close()
        running.close()
    names = ('open, wall [s]', 'open, CPU [s]', 'frame, wall [ms]', 'frame, CPU [ms]')
    for name, values in zip(names, np.array(results).T, strict=True):
        print(
            f'{name:18} median {np.median(values):6.2f}, {values.min():.2f} to {values.max():.2f}'
        )


def _busy(meter: Any) -> float:
    """Return how long the main thread has worked [s of CPU]."""
    values = meter.send('Performance.getMetrics')['metrics']
    return float({value['name']: value['value'] for value in values}['TaskDuration'])


if __name__ == '__main__':
    sys.exit(main())
