# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Does tracking by bearings do what [VORONINA19] says, and what does it take to get past a crossing?

Run ``python -m studies.voronina_2019``; it writes docs/results/voronina_2019.md with its
pictures. Read ``v0_crossing.py`` for the two trackers and what is counted, ``v0_scenes.py`` for
the scenes.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from benchmarks.sonar_data import preset
from studies import v0_pictures as pictures
from studies.figures import about, at_least, at_most, intervals, table, template, wrapped
from studies.v0_crossing import OURS, PAPER, RESOLUTION, runs, SEED, segments, Values
from studies.v0_figures import crossing_figures, quiet_figures, wilson
from studies.v0_scenes import DEGREE, TURNS
from tracking_core.batches import Floats

RESULT = Path(__file__).parent.parent / 'docs' / 'results' / 'voronina_2019.md'
QUIET_END = 1000.0  # before the marks merge [s]
EVEN = 0.05  # of all marks, where computed sds are compared [deg]
HAND = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5)  # sd of marks set by hand [deg]
UNMERGED: Values = {**OURS, 'sensor.bearing_resolution': 0.0}
KALMAN: Values = {
    **OURS,
    'estimator': 'kalman',
    'motion.bearing_noise': PAPER['motion.bearing_noise'],
    'motion.rate_noise': PAPER['motion.rate_noise'],
}
TURNING: Values = {
    **OURS,
    'motion.bearing_noise': [1e-6, 1e-6],
    'motion.rate_noise': [1e-8, 3e-5],
    'motion.sojourn_time': [2e4, 300.0],
}
TRACKERS = {
    "the paper's (Kalman, gate 2.5)": PAPER,
    "the paper's (finite memory 15)": {**PAPER, 'estimator': 'finite_memory'},
    'modified polar, marks resolved always': UNMERGED,
    'Kalman, unresolved marks': KALMAN,
    'modified polar, unresolved marks': OURS,
    'the same, and a mode for turns': TURNING,
    'the preset `passive_linear_array`': preset('passive_linear_array'),
    'one mode, limit 25 % too small': {**OURS, 'sensor.bearing_resolution': 0.75 * RESOLUTION},
    'one mode, limit 25 % too large': {**OURS, 'sensor.bearing_resolution': 1.25 * RESOLUTION},
}
SCENES = ('nominal', 'fluct', *TURNS)
SURE = 'modified polar, unresolved marks'
IN_WORDS = {  # whose figures the text names, and under which names
    SURE: '',
    'the same, and a mode for turns': 'turner ',
    'the preset `passive_linear_array`': 'preset ',
}

QUIET_CLAIMS = (
    at_least('tracking time 1', 0.93, 'tracking time (16), stronger', '0.93 to 0.98'),
    at_least('tracking time 2', 0.93, 'the same, weaker', ''),
    at_least('coverage 1', 0.985, 'coverage, stronger'),
    at_least('coverage 2', 0.985, 'the same, weaker'),
    at_most('error 1', 0.009, 'real error, stronger [deg]'),
    about('error 2', 0.017, 0.005, 'the same, weaker [deg]'),
    at_most('false', 0.0, 'false tracks, all runs'),
    about('ratio 15', 1.43, 0.10, "sd for marks of 0.05 deg, finite memory over Kalman, K' = 15"),
    about('ratio 8', 1.84, 0.12, "the same, K' = 8"),
)
CROSSING_CLAIMS = (
    at_least('nominal kept', 0.95, 'both ids kept, NOMINAL', 'neither'),
    at_most('nominal swaps', 0.02, 'swaps, NOMINAL'),
    at_least('fluct kept', 0.95, 'both ids kept, FLUCT', 'neither'),
    at_most('fluct swaps', 0.02, 'swaps, FLUCT'),
)


def compare(counts: dict[str, int], jobs: int) -> tuple[str, dict[str, float]]:
    """Return the table of all trackers at the crossing, and the figures of ours."""
    lines = [
        '| tracker | scene | runs | both ids kept | 95 % | stronger | weaker | swaps | false |',
        '|---|---|---|---|---|---|---|---|---|',
    ]
    ours = {}
    for tracker, values in TRACKERS.items():
        for name in SCENES:
            count = counts['ours' if tracker == SURE and name not in TURNS else 'others']
            found = crossing_figures(runs(name, count, values, jobs))(np.arange(count))
            lines.append(
                f'| {tracker} | {name} | {count} | {found["kept"]:.0%} '
                f'| {wilson(found["kept"], count)} | {found["stronger"]:.0%} '
                f'| {found["weaker"]:.0%} | {found["swaps"]:.0%} | {found["false"]:.2f} |'
            )
            print(lines[-1], flush=True)
            if tracker in IN_WORDS:
                who = IN_WORDS[tracker]
                ours |= {f'{who}{name} {figure}': value for figure, value in found.items()}
    return '\n'.join(lines), ours


def by_hand(count: int, jobs: int) -> dict[float, tuple[Floats, Floats]]:
    """Return Table 2: tracking time and breaks of the contacts (C,) by the marks' sd [deg]."""
    rows = {}
    for sd in HAND:
        found = [segments(one.id) for one in runs('nominal', count, PAPER, jobs, QUIET_END,
                                                  sd * DEGREE)]  # fmt: skip
        share, breaks = (np.mean([part[k] for part in found], axis=0) for k in (0, 1))
        rows[sd] = (share, breaks)
    return rows


def hand_table(rows: dict[float, tuple[Floats, Floats]]) -> str:
    """Return Table 2 as Markdown."""
    lines = [
        '| mark sd [deg] | tracking time, stronger | weaker | breaks, stronger | weaker |',
        '|---|---|---|---|---|',
    ]
    for sd, (share, breaks) in rows.items():
        lines.append(f'| {sd:g} | {share[0]:.3f} | {share[1]:.3f} | {breaks[0]:.2f} '
                     f'| {breaks[1]:.2f} |')  # fmt: skip
    return '\n'.join(lines)


def sd_ratio(memory: int, count: int, jobs: int, kalman: float) -> float:
    """Return the computed sd of the finite-memory filter over that of Kalman's."""
    values = {**PAPER, 'estimator': 'finite_memory', 'motion.memory': memory}
    return computed_sd(values, count, jobs) / kalman


def computed_sd(values: Values, count: int, jobs: int) -> float:
    """Return the usual computed sd [rad] for marks of one sd."""
    found = runs('nominal', count, values, jobs, QUIET_END, EVEN * DEGREE)
    return float(np.mean([one.sd for one in found]))


def describe(count: int, others: int, jobs: int, output: Path) -> str:
    """Run the study, draw its pictures beside the output and return its report as Markdown."""
    quiet = runs('nominal', min(count, 40), PAPER, jobs, QUIET_END)
    memory = runs('nominal', min(count, 40), pictures.FINITE_MEMORY, jobs, QUIET_END)
    figures = quiet_figures(quiet)
    values, rng = figures(np.arange(len(quiet))), np.random.default_rng(SEED)
    bounds = intervals(figures, len(quiet), rng)
    sd = computed_sd(PAPER, min(others, 10), jobs)
    values |= {f'ratio {k}': sd_ratio(k, min(others, 10), jobs, sd) for k in (15, 8)}
    print(table(QUIET_CLAIMS, values, bounds), flush=True)
    hand = by_hand(min(others, 20), jobs)
    print(hand_table(hand), flush=True)
    comparison, ours = compare({'ours': count, 'others': others}, jobs)

    def beside(name: str) -> Path:
        return output.with_name(f'{output.stem}_{name}.png')

    return wrapped(
        template('voronina_2019').format_map({
            'runs': count, 'quiet_runs': len(quiet), 'others': others, 'seed': SEED,
            'quiet': table(QUIET_CLAIMS, values, bounds),
            'hand': hand_table(hand), 'hand_runs': min(others, 20),
            'crossing': table(CROSSING_CLAIMS, ours, {}),
            'comparison': comparison,
            'record': pictures.record(beside('record')),
            'tracks': pictures.tracks(beside('tracks')),
            'errors': pictures.errors(beside('errors'), quiet, memory),
            'hand_picture': pictures.by_hand(beside('hand'), hand),
            **{name.replace(' ', '_'): value for name, value in ours.items()},
        })
    )  # fmt: skip


def main() -> None:
    """Print and write the tables."""
    parser = argparse.ArgumentParser(description='Tables of [VORONINA19] on scenario V-0.')
    parser.add_argument('--runs', type=int, default=100, help='of our tracker at the crossing')
    parser.add_argument('--others', type=int, default=40, help='runs of all others')
    parser.add_argument('--jobs', type=int, default=2, help='processes')
    parser.add_argument('--output', type=Path, default=RESULT)
    arguments = parser.parse_args()
    report = describe(arguments.runs, arguments.others, arguments.jobs, arguments.output)
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    arguments.output.write_text(report, encoding='utf-8')


if __name__ == '__main__':
    main()
