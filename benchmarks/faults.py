# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does a user see when something around the radar node fails, and when are the tracks back?

``python -m benchmarks.faults`` plays each fault to live nodes in real time, four scans a second,
and prints a Markdown table; ``--output docs/reliability.md`` puts it between the marks there.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
import re
import sys
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.fault_outcome import Fault, play, repeat
from benchmarks.faults_of_messages import MESSAGE_FAULTS
from benchmarks.faults_of_processes import KILLS, PROCESS_FAULTS

BEGIN, END = '<!-- faults: begin -->', '<!-- faults: end -->'
HEAD = '| fault | what the diagnostics say | tracks | back after | ids |\n' + '|---' * 5 + '|'


def kill(fault: Fault, times: int, folder: Path) -> str:
    """Kill a process again and again; return how long it took until the tracks were back."""
    scans, seconds = repeat(fault, times, folder).T
    return (
        f'{fault.name}, {times} times: back after {scans.min():.0f} / {np.median(scans):.0f} / '
        f'{scans.max():.0f} scans, {seconds.min():.1f} / {np.median(seconds):.1f} / '
        f'{seconds.max():.1f} s (least, median, most)'
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table, and put it where it is wanted."""
    parser = argparse.ArgumentParser(description='Faults around the live radar node.')
    parser.add_argument('--only', default='', help='faults with this text in their name')
    parser.add_argument('--kill', type=int, default=0, help='kill each process so often first')
    parser.add_argument('--output', type=Path, help='page with marks for the table')
    given = parser.parse_args(arguments)
    rows = [HEAD]
    with TemporaryDirectory() as folder:
        for number, fault in enumerate(KILLS if given.kill else ()):
            print(kill(fault, given.kill, Path(folder, f'kill_{number}')), flush=True)
        print(HEAD, flush=True)
        for number, fault in enumerate((*PROCESS_FAULTS, *MESSAGE_FAULTS)):
            if given.only in fault.name:
                rows.append(play(fault, Path(folder, str(number))).row(fault.name))
                print(rows[-1], flush=True)
    if given.output:
        page = given.output.read_text()
        table = '\n'.join([BEGIN, '', *rows, '', END])
        given.output.write_text(re.sub(f'{BEGIN}.*{END}', lambda _: table, page, flags=re.S))
    return 0


if __name__ == '__main__':
    sys.exit(main())
