# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How is a figure of a study stated? With its 95 % interval, beside what was claimed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
import re
import textwrap

import numpy as np

from tracking_core.batches import Floats, Ints

Figures = Mapping[str, float]


def rms(values: Floats) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(values**2)))


@dataclass(frozen=True)
class Claim:
    """What a figure should be."""

    name: str  # of the figure
    low: float
    high: float
    meaning: str
    paper: str = ''  # what the paper says, where it gives a figure

    def holds(self, value: float) -> bool:
        """Return whether the figure is inside the limits."""
        return self.low <= value <= self.high

    @property
    def limits(self) -> str:
        """The limits as text."""
        if np.isinf(self.high):
            return f'>= {self.low:g}'
        if np.isinf(self.low):
            return f'<= {self.high:g}'
        return f'{0.5 * (self.low + self.high):.4g} +- {0.5 * (self.high - self.low):.2g}'


def about(name: str, value: float, tolerance: float, meaning: str, paper: str = '') -> Claim:
    """Return the claim value +- tolerance."""
    return Claim(name, value - tolerance, value + tolerance, meaning, paper)


def at_least(name: str, value: float, meaning: str, paper: str = '') -> Claim:
    """Return a lower bound."""
    return Claim(name, value, np.inf, meaning, paper)


def at_most(name: str, value: float, meaning: str, paper: str = '') -> Claim:
    """Return an upper bound."""
    return Claim(name, -np.inf, value, meaning, paper)


def intervals(
    figures: Callable[[Ints], Figures], runs: int, rng: np.random.Generator, resamples: int = 200
) -> dict[str, Floats]:
    """
    Return 95 % intervals [low, high] of all figures: bootstrap over whole runs.

    Parameters
    ----------
    figures : callable
        Takes the rows of the runs to look at.
    runs : int
        Number of runs there are.
    rng : Generator
        For the resampling.
    resamples : int
        More make the interval's own noise smaller.

    """
    drawn = [figures(rng.integers(0, runs, runs)) for _ in range(resamples)]
    return {
        name: np.quantile([values[name] for values in drawn], [0.025, 0.975]) for name in drawn[0]
    }


def table(claims: tuple[Claim, ...], values: Figures, bounds: Mapping[str, Floats]) -> str:
    """
    Return a Markdown table: figure, paper, expected, ours with interval, verdict.

    A figure without bounds is one that runs do not scatter, such as a place on a grid.
    """
    lines = [
        '| figure | paper | expected | ours | 95 % interval | verdict |',
        '|---|---|---|---|---|---|',
    ]
    for claim in claims:
        limits = bounds.get(claim.name, ())
        span = ' to '.join(f'{limit:.4g}' for limit in limits)
        verdict = 'holds' if claim.holds(values[claim.name]) else '**does not hold**'
        lines.append(
            f'| {claim.meaning} | {claim.paper} | {claim.limits} | {values[claim.name]:.4g} '
            f'| {span} | {verdict} |'
        )
    return '\n'.join(lines)


def template(name: str) -> str:
    """Return the text of a report with the names of figures in braces."""
    return (Path(__file__).parent / 'templates' / f'{name}.md').read_text(encoding='utf-8')


def wrapped(report: str, width: int = 100) -> str:
    """Return a report with its paragraphs and list items broken anew, figures filled in."""
    blocks = re.split(r'(\n\n+|\n(?=[-|#!]))', report)
    return ''.join(
        block if block[:1] in '|#!\n' else textwrap.fill(
            re.sub(r'\s*\n\s*', ' ', block), width, break_long_words=False,
            break_on_hyphens=False, subsequent_indent='  ' if block.startswith('- ') else '',
        )
        for block in blocks
    ).rstrip() + '\n'  # fmt: skip
