# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does the mixed-Markov filter do what [ZHUK09] says? The table of scenario Z-0.

Run ``python -m studies.zhuk_2009``; it prints the table and writes docs/results/zhuk_2009.md.
Read ``z0.py`` for what the figures are.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from studies.figures import about, at_least, at_most, intervals, table
from studies.z0 import figures, play, SEED, SETTLED

RESULT = Path(__file__).parent.parent / 'docs' / 'results' / 'zhuk_2009.md'

CLAIMS = (
    at_least('horizontal onset found', 0.98, 'horizontal onset found within 3 contacts'),
    about('horizontal onset delay', 1.60, 0.10, 'its mean delay [contacts]'),
    at_least('horizontal release found', 0.96, 'horizontal release found within 3 contacts'),
    about('horizontal release delay', 2.25, 0.12, 'its mean delay [contacts]'),
    at_least('vertical onset found', 0.96, 'vertical onset found within 3 contacts'),
    about('vertical onset delay', 1.73, 0.15, 'its mean delay [contacts]'),
    about('vertical release found', 0.765, 0.06, 'vertical release found within 3 contacts'),
    at_most('horizontal false decisions', 0.003, 'false horizontal decisions per quiet contact'),
    at_most('vertical false decisions', 0.010, 'false vertical decisions per quiet contact'),
    about('map growth x', 3.97, 0.15, 'growth of forecast sd, winning mode, x', '3 to 4'),
    about('map growth y', 3.97, 0.15, 'the same, y', '3 to 4'),
    about('map growth z', 2.63, 0.20, 'the same, z', '3 to 4'),
    about('mmse growth x', 2.14, 0.12, 'growth of forecast sd, mixture, x'),
    about('mmse growth y', 2.20, 0.12, 'the same, y'),
    about('mmse growth z', 1.47, 0.12, 'the same, z'),
    about('map error manoeuvre', 0.944, 0.02, '3-D RMSE over plot RMSE, MAP, manoeuvre'),
    about('map error quiet', 0.821, 0.02, 'the same, MAP, quiet'),
    about('mmse error manoeuvre', 0.938, 0.02, 'the same, MMSE, manoeuvre'),
    about('mmse error quiet', 0.831, 0.02, 'the same, MMSE, quiet'),
    about('map first contact x', 1.14, 0.08, 'RMSE over plot RMSE, first contact of a turn, x'),
    about('map first contact y', 1.14, 0.08, 'the same, y'),
    about('map first contact z', 1.23, 0.08, 'the same, first contact of a climb, z'),
    at_least('gate manoeuvre x', 0.91, 'plots in the causal 3-sigma gate, manoeuvre, x'),
    at_least('gate manoeuvre y', 0.97, 'the same, y'),
    at_least('gate manoeuvre z', 0.98, 'the same, z'),
    at_least('gate all', 0.985, 'the same, all contacts, worst axis'),
)

REPORT = """# [ZHUK09] Mixed-Markov filter, scenario Z-0

`python -m studies.zhuk_2009 --runs {runs}`: {runs} runs as one batch, seed {seed}. 95 % intervals
are bootstrapped over runs. *Paper* is what the paper says, where it gives a figure; *expected* is
from an independent implementation.

## What does not hold

- At the first contact of a manoeuvre the filter is worse than the plots alone. Error ratio of the
  winning mode: {map first contact x:.2f} (x), {map first contact y:.2f} (y),
  {map first contact z:.2f} (z); of the mixture: {mmse first contact x:.2f},
  {mmse first contact y:.2f}, {mmse first contact z:.2f}.
- The forecast sd of the vertical plane grows {map growth z:.2f} times, not 3 to 4 times.
- The end of a climb is found within 3 contacts in {vertical release found:.1%} of the cases only.
  Such late releases hold the vertical manoeuvre mode in {vertical manoeuvre while quiet:.2%} of
  the quiet contacts, although it is newly chosen in {vertical false decisions:.2%} of them.
- A gate that knows only the past holds {gate manoeuvre x:.1%} (x), {gate manoeuvre y:.1%} (y) and
  {gate manoeuvre z:.1%} (z) of the plots of a manoeuvre, not the 99.7 % of 3 sigma.
- During manoeuvres the error is only {saving:.1%} below that of the plots (mixture).

## Figures

{table}

## What the figures are

- Manoeuvre: contacts whose preceding interval overlaps a manoeuvre of either plane, and the 2
  after them. Quiet: the rest from contact {settled} on.
- Found: the probability of the manoeuvre mode crosses 0.5 at most 3 contacts after the change. The
  delay is the mean over all changes that are found at all. A decision is false when the
  probability comes to exceed 0.5 at a quiet contact.
- Growth: RMS of the predicted sd from the second contact of a plane's manoeuvres to one after
  their end, over that of the plane's quiet contacts; *winning mode* is the mode most probable
  after the contact. Over which contacts the expected figures were taken is not known; over all
  contacts of the manoeuvre and the 2 after it they are 5 to 13 % lower.
- Gate: distance of the plot from the predicted mixture at most 3 sd of mixture plus plot noise, on
  each axis.
"""


def describe(runs: int, quiet: bool = True) -> str:
    """Run the study and return its report as Markdown."""
    record = play(runs, quiet)
    values = figures(record, np.arange(runs))
    bounds = intervals(lambda rows: figures(record, rows), runs, np.random.default_rng(SEED))
    return REPORT.format_map(
        {
            **values,
            'runs': runs,
            'seed': SEED,
            'settled': SETTLED,
            'saving': 1.0 - values['mmse error manoeuvre'],
            'table': table(CLAIMS, values, bounds),
        }
    )


def main() -> None:
    """Print and write the table."""
    parser = argparse.ArgumentParser(description='Table of [ZHUK09] on scenario Z-0.')
    parser.add_argument('--runs', type=int, default=500)
    parser.add_argument('--output', type=Path, default=RESULT)
    arguments = parser.parse_args()
    report = describe(arguments.runs, quiet=False)
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    arguments.output.write_text(report)
    print(report)


if __name__ == '__main__':
    main()
