# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What came out of a sweep: a row for each setting, and the runs in which it did worst."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
import json
import math
from typing import Any

from tracking_tools.evaluation.text import plain
from tracking_tools.sweeping.figures import Mean, mean_of, SHOWN, Shown
from tracking_tools.sweeping.store import Figures
from tracking_tools.sweeping.tasks import Task, Values

WORST = 3  # runs of each setting that are named


@dataclass(frozen=True)
class Case:
    """All runs of one setting."""

    setting: Values
    tasks: Sequence[Task]
    figures: Sequence[Figures]

    @property
    def name(self) -> str:
        """What is different in it."""
        return ', '.join(f'{name}={value}' for name, value in self.setting.items()) or 'as it is'

    def values(self, shown: Shown) -> list[float]:
        """Return the figure of every run."""
        return [shown.of(figures) for figures in self.figures]

    def means(self) -> dict[str, Mean]:
        """Return every figure over the runs."""
        return {name: mean_of(self.values(shown)) for name, shown in SHOWN.items()}

    def beside(self, other: Case) -> Mean:
        """Return the GOSPA less that of another setting in the same runs."""
        mine, theirs = self._gospas(), other._gospas()
        return mean_of([mine[run] - theirs[run] for run in mine if run in theirs])

    def _gospas(self) -> dict[tuple[str, int], float]:
        runs = [(task.source.name, task.seed) for task in self.tasks]
        return dict(zip(runs, self.values(SHOWN['gospa']), strict=True))

    @property
    def fixed(self) -> dict[str, Any]:
        """What is set in it besides, as in all others."""
        return {name: v for name, v in self.tasks[0].values if name not in self.setting}

    def worst(self) -> list[int]:
        """Return which runs have the largest GOSPA, the worst first."""
        values = [(-math.inf if math.isnan(v) else v, k)
                  for k, v in enumerate(self.values(SHOWN['gospa']))]  # fmt: skip
        return [k for _, k in sorted(values, key=lambda pair: (-pair[0], pair[1]))[:WORST]]


def cases_of(results: Sequence[tuple[Values, Task, Figures]]) -> list[Case]:
    """Put the runs of each setting together, in order."""
    grouped: dict[str, tuple[Values, list[Task], list[Figures]]] = {}
    for setting, task, figures in results:
        case = grouped.setdefault(json.dumps(setting), (setting, [], []))
        case[1].append(task)
        case[2].append(figures)
    return [Case(*parts) for parts in grouped.values()]


def to_text(cases: Sequence[Case]) -> str:
    """Return means with 95 % intervals, then the losing runs."""
    sensor = cases[0].figures[0]['sensor']
    head = ['setting', 'runs', *(shown.named(sensor) for shown in SHOWN.values())]
    head += ['GOSPA less the first'] if len(cases) > 1 else []
    lines = [head]
    for case in cases:
        line = [case.name, str(len(case.tasks)), *map(str, case.means().values())]
        lines.append(line + ([str(case.beside(cases[0]))] if len(cases) > 1 else []))
    losses = [['worst runs of', 'source', 'seed',
               *(shown.named(sensor) for shown in SHOWN.values())]]  # fmt: skip
    losses += [line for case in cases for line in _losses(case)]
    note = 'means with the 95 % interval of the mean; differences run by run'
    fixed = [f'all with {name}={value}' for name, value in cases[0].fixed.items()]
    return '\n'.join([*fixed, *_aligned(lines), note, '', *_aligned(losses)])


def _losses(case: Case) -> Iterator[list[str]]:
    for k in case.worst():
        task, figures = case.tasks[k], case.figures[k]
        values = (f'{shown.of(figures):.4g}' for shown in SHOWN.values())
        yield [case.name, task.source.name, str(task.seed or '-'), *values]


def _aligned(lines: Sequence[Sequence[str]]) -> list[str]:
    width = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return [
        '  '.join(
            cell.ljust(w) if k == 0 else cell.rjust(w)
            for k, (cell, w) in enumerate(zip(line, width, strict=True))
        ).rstrip()
        for line in lines
    ]


def to_json(cases: Sequence[Case]) -> str:
    """Return the same for programs; distances in the units of the table."""
    rows: list[dict[str, Any]] = [
        {
            'setting': dict(case.setting),
            'fixed': case.fixed,
            'runs': len(case.tasks),
            'means': {name: asdict(mean) for name, mean in case.means().items()},
            'gospa_less_first': asdict(case.beside(cases[0])),
            'worst': [
                {'source': case.tasks[k].source.name, 'seed': case.tasks[k].seed,
                 'file': f'runs/{case.tasks[k].key}.json'}
                for k in case.worst()
            ],
        }
        for case in cases
    ]  # fmt: skip
    return json.dumps(plain(rows), indent=1, allow_nan=False) + '\n'
