# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Does the marine preset keep what IMO's resolution A.823(19) asks? The report."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from tqdm import tqdm

from radar_tracker.config import RadarTrackerConfig
from studies.figures import template, wrapped
from studies.marine_errors import A823_LIMITS, follow, MINUTE, msc192_limits, quantile, QUANTITIES
from studies.marine_scenes import A823, Encounter, PERIOD
from studies.marine_traffic import AFTER, passing, PASSINGS, seldom_seen
from tracking_core.batches import Floats
from tracking_core.config import with_values
from tracking_tools.parameter_file import read_parameter_file

ROOT = Path(__file__).parents[1]
RESULT = ROOT / 'docs' / 'results' / 'marine_standard.md'
SEED = 823
OLD, NEW = 'A.823(19)', 'MSC.192(79)'
TURN, TURN_AT, MINUTES = 45.0, 180.0, 3  # deg, s, watched after the turn
SCENES = 10  # of 12 pairs
COARSER = 1.5
BEFORE = {
    'sensor.range_sd': 20.0,
    'motion.horizontal.acceleration_sd': (0.02, 0.4),
    'motion.horizontal.sojourn_time': (300.0, 60.0),
}


@dataclass(frozen=True)
class Cell:
    """One quantity of one scenario: what a standard asks, and what came out."""

    where: str
    standard: str
    limit: float  # NaN: it asks nothing
    value: float
    errors: str = 'still'

    @property
    def is_lost(self) -> bool:
        """Whether the error is above the limit."""
        return self.value > self.limit

    def __str__(self) -> str:
        return (
            f'scenario {self.where}: {self.value:.2f}, {self.standard} has {self.limit:.2f} '
            f'({self.errors})'
        )


def preset() -> RadarTrackerConfig:
    """Return the tracker of the marine preset."""
    values = read_parameter_file(ROOT / 'config' / 'marine_radar.yaml', '/radar_tracker')
    return with_values(RadarTrackerConfig(), values)


def steady(runs: int, config: RadarTrackerConfig) -> tuple[str, list[Cell]]:
    """Return the table of all scenarios without a turn, and its cells."""
    rows = ['| scenario | after | error | A.823(19) | still | rolling | MSC.192(79) |',
            '|---|---|---|---|---|---|---|']  # fmt: skip
    cells: list[Cell] = []
    for encounter in A823:
        errors = [
            follow(encounter, 3 * MINUTE + 1, runs, config, SEED, is_rolling)
            for is_rolling in (False, True)
        ]
        for minutes, q in product((1, 3), range(len(QUANTITIES))):
            where = f'{encounter.name}, {minutes} min, {QUANTITIES[q]}'
            still, rolling = (
                tuple(float(end) for end in quantile(e[minutes * MINUTE - 2, q])) for e in errors
            )
            old = A823_LIMITS[encounter.name, minutes][q]
            new = float(msc192_limits(encounter, minutes)[q])
            cells += _cells(where, {OLD: old, NEW: new}, still[0], rolling[0])
            rows.append(
                f'| {" | ".join(where.split(", "))} | {_number(old)} | {_shown(still, old)} '
                f'| {_shown(rolling, old)} | {_bold(new, still[0] > new)} |'
            )
    return '\n'.join(rows), cells


def _cells(where: str, limits: dict[str, float], still: float, rolling: float) -> list[Cell]:
    return [
        Cell(where, standard, limit, value, errors)
        for errors, value in (('still', still), ('rolling', rolling))
        for standard, limit in limits.items()
    ]


def _shown(value: tuple[float, ...], limit: float) -> str:
    return f'{_bold(value[0], value[0] > limit)} ({value[1]:.2f} to {value[2]:.2f})'


def _bold(value: float, is_bold: bool) -> str:
    if np.isnan(value):
        return ''
    return f'**{value:.2f}**' if is_bold else f'{value:.2f}'


def _number(limit: float) -> str:
    return '' if np.isnan(limit) else f'{limit:g}'


def turned(runs: int, config: RadarTrackerConfig) -> tuple[str, list[Cell]]:
    """Return the table of all scenarios after a turn, and its cells 3 minutes after."""
    rows = ['| scenario | error | A.823(19) | 1 min | 2 min | 3 min | back after [s] |',
            '|---|---|---|---|---|---|---|']  # fmt: skip
    cells = []
    for encounter in A823:
        end, quantiles = after_turn(encounter, runs, config)
        for q, quantity in enumerate(QUANTITIES):
            limit = A823_LIMITS[encounter.name, 3][q]
            if np.isnan(limit):
                continue
            series = quantiles[end:, q]
            values = [float(series[m * MINUTE]) for m in (1, 2, 3)]
            over = np.flatnonzero(series > limit)
            back = 0.0 if len(over) == 0 else PERIOD * (over[-1] + 1)
            text = f'{back:.0f}' if over.size == 0 or over[-1] + 1 < len(series) else '**not yet**'
            where = f'{encounter.name}, {MINUTES} min after the turn, {quantity}'
            cells.append(Cell(where, OLD, limit, values[2]))
            shown = ' | '.join(_bold(value, value > limit) for value in values)
            rows.append(f'| {encounter.name} | {quantity} | {limit:g} | {shown} | {text} |')
    return '\n'.join(rows), cells


def after_turn(encounter: Encounter, runs: int, config: RadarTrackerConfig) -> tuple[int, Floats]:
    """Return the row at which the turn is over, and the 95 % errors (K - 2, 6)."""
    end = int(np.ceil((TURN_AT + TURN / encounter.turn_rate) / PERIOD))
    turning = replace(encounter, turn=TURN, turn_at=TURN_AT)
    errors = follow(turning, end + MINUTES * MINUTE + 1, runs, config, SEED + 1)
    return end - 2, quantile(errors)[0]


def close_passing(scenes: int, config: RadarTrackerConfig, quiet: bool) -> tuple[str, list[str]]:
    """Return the table of pairs that pass closely, and what of it went wrong."""
    rows = ['| passing | apart [m] | cell | swapped | lost | pairs |', '|---|---|---|---|---|---|']
    wrong = []
    cases = [(kind, apart, c) for kind in PASSINGS for apart in (0, 50, 100)
             for c in (1.0, COARSER)]  # fmt: skip
    for kind, apart, coarseness in tqdm(cases, desc='passing', disable=quiet, leave=False):
        share = passing(config, kind, apart, scenes, coarseness=coarseness)
        cell = 'as told' if coarseness == 1.0 else 'coarser'
        if share['swapped'] or share['lost']:
            wrong.append(f'{kind} at {apart} m, cell {cell}: {share["swapped"]:.1%} of the pairs '
                         f'swapped, {share["lost"]:.1%} lost an id')  # fmt: skip
        rows.append(f'| {kind} | {apart} | {cell} | {share["swapped"]:.1%} | {share["lost"]:.1%} '
                    f'| {share["pairs"]:.0f} |')  # fmt: skip
    return '\n'.join(rows), wrong


def describe(runs: int, scenes: int = SCENES, quiet: bool = True) -> str:
    """Run the study and return the report as Markdown."""
    config = preset()
    straight, cells = steady(runs, config)
    turns, later = turned(runs, config)
    passed, wrong = close_passing(scenes, config, quiet)
    kept = seldom_seen(config, quiet=quiet)
    before = [
        cell for cell in steady(runs, with_values(config, BEFORE))[1]
        if cell.standard == OLD and cell.errors == 'still' and not np.isnan(cell.limit)
    ]  # fmt: skip
    lost = [str(cell) for cell in [*cells, *later] if cell.is_lost] + wrong
    values: dict[str, Any] = {
        'runs': runs, 'seed': SEED, 'steady': straight, 'turned': turns, 'passing': passed,
        'ships': kept.size, 'patterns': len(kept), 'kept': kept.mean(),
        'after': AFTER * PERIOD / 60.0, 'before': sum(cell.is_lost for cell in before),
        'cells': len(before), 'lost': '\n'.join(f'- {text}' for text in lost),
    }  # fmt: skip
    return template('marine_standard').format_map(values)


def main() -> None:
    """Print and write the report."""
    parser = argparse.ArgumentParser(description='Scenarios of IMO A.823(19).')
    parser.add_argument('--runs', type=int, default=2000)
    parser.add_argument('--scenes', type=int, default=SCENES, help='of 12 pairs that pass')
    parser.add_argument('--output', type=Path, default=RESULT)
    given = parser.parse_args()
    report = describe(given.runs, given.scenes, quiet=False)
    given.output.write_text(wrapped(report))
    print(report)


if __name__ == '__main__':
    main()
