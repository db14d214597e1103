# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What does the command of a study do? It writes and prints the report."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from studies.figures import wrapped

RESULTS = Path(__file__).parent.parent / 'docs' / 'results'


def write_report(title: str, name: str, runs: int, describe: Callable[[int, Path], str]) -> None:
    """
    Write and print the report that the command line asks for.

    Parameters
    ----------
    title : str
        What the study is of.
    name : str
        Of the report's file, without its ending.
    runs : int
        So many unless the user says otherwise.
    describe : callable
        Takes the number of runs and the folder for figures, returns the report as Markdown.

    """
    parser = argparse.ArgumentParser(description=title)
    parser.add_argument('--runs', type=int, default=runs)
    parser.add_argument('--output', type=Path, default=RESULTS / f'{name}.md')
    given = parser.parse_args()
    given.output.parent.mkdir(parents=True, exist_ok=True)
    report = describe(given.runs, given.output.parent)
    given.output.write_text(wrapped(report))
    print(report)
