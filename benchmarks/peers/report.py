# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The tables, the losing cases first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
import math

from benchmarks.peers.entrants import OURS, VARIANTS
from benchmarks.peers.summary import ACCURACY, Row

WANTED = {'en_route_10': 20, 'en_route_50': 60, 'en_route_200': 100, 'en_route_1000': 150,
          'formations': 60}  # fmt: skip
KILO = 1e3
_RIVALS = ('stone_soup', 'stone_soup_tree')  # that the wanted ratios are about
_WORDS = {'gospa': 'GOSPA', 'held': 'held', 'rmse': 'RMSE', 'switches': 'switches',
          'cpu': 'CPU [ms]'}  # fmt: skip


@dataclass(frozen=True)
class Result:
    """All trackers on one scene."""

    title: str
    contacts: float  # a scan
    plots: float  # a scan
    unit: str  # of GOSPA and RMSE
    scale: float  # from SI to that unit
    rows: Mapping[str, Row]
    wanted: int  # runs
    made: str  # when, on what and with what


Results = Mapping[str, Result]


def table(head: str, lines: list[str]) -> str:
    """Return a Markdown table."""
    names = head.split(' | ')
    return '\n'.join([f'| {head} |', '|' + '---|' * len(names), *(f'| {x} |' for x in lines)])


def where_better(results: Results) -> str:
    """Return where another tracker is better than our default."""
    lines = []
    for result in results.values():
        own, others = result.rows[OURS], {k: v for k, v in result.rows.items() if k != OURS}
        for name, row in sorted(others.items(), key=lambda item: item[0] in VARIANTS):
            found = [*_better_figures(row, result, ACCURACY)]
            if name not in VARIANTS:  # of our own, only what is better is news
                found += [*_better_figures(row, result, {'cpu': -1.0}), *_less_memory(row, own)]
            lines += [f'{result.title} | {row.title} | {line}' for line in found]
    head = 'scene | tracker | measure | theirs | ours | difference (standard error)'
    return table(head, lines) if lines else 'Nowhere in this run.'


def _better_figures(row: Row, result: Result, senses: Mapping[str, float]) -> Iterator[str]:
    for measure, figure in row.figures.items():
        if measure in senses and figure.is_better(senses[measure]):
            scale = result.scale if measure in {'gospa', 'rmse'} else 1.0
            own, error = (figure.mean - figure.margin) * scale, figure.error * scale
            sure = 'one run' if math.isnan(error) else f'+- {error:.3g}'
            yield (
                f'{_WORDS[measure]} | {figure.mean * scale:.4g} | {own:.4g} '
                f'| {figure.margin * scale:+.3g} ({sure})'
            )


def _less_memory(row: Row, own: Row) -> Iterator[str]:
    if row.memory is None or own.memory is None:
        return
    if row.memory.held < 0.95 * own.memory.held:
        theirs, ours = row.memory.held / KILO, own.memory.held / KILO
        yield f'kB a track | {theirs:.1f} | {ours:.1f} | {theirs - ours:+.1f} (one run)'


def ratios(results: Results) -> str:
    """Return the CPU of Stone Soup by ours beside what is wanted, at their accuracies."""
    lines = []
    for name, wanted in WANTED.items():
        for rival in _RIVALS:
            row = results[name].rows.get(rival) if name in results else None
            if row is None:
                continue
            if not row.figures:
                lines.append(
                    f'{results[name].title} | {row.title} | >= {wanted} | {row.ratio:.0f} in its '
                    f'scan {row.scans} | | not judged, out of time '
                    f'| {_yes(row.ratio >= wanted)}, the speed'
                )
                continue
            gospa = row.figures['gospa']
            no_worse = gospa.margin >= -1e-9
            holds = row.ratio >= wanted and no_worse
            lines.append(
                f'{results[name].title} | {row.title} | >= {wanted} | {row.ratio:.0f} '
                f'| {"" if math.isnan(row.stretched) else f"{row.stretched:.0f}"} '
                f'| {gospa.mean - gospa.margin:.0f} / {gospa.mean:.0f} m '
                f'| {_yes(holds)}'
            )
    head = 'scene | against | wanted | measured | in a row | GOSPA ours / theirs | holds'
    return table(head, lines)


def _yes(holds: bool) -> str:
    return 'yes' if holds else '**no**'


def scene_table(result: Result) -> str:
    """Return all columns of one scene."""
    u = result.unit
    head = (
        f'tracker | CPU a scan [ms] | by ours | GOSPA [{u}] | less ours | missed | false '
        f'| RMSE [{u}] | held | switches | kB a track | peak [MB]'
    )
    return table(head, [_line(row, result.scale) for row in result.rows.values()])


def _line(row: Row, scale: float) -> str:
    memory = ('' if row.memory is None else f'{row.memory.held / KILO:.1f} '
              f'| {row.memory.peak / 1e6:.1f}') or ' | '  # fmt: skip
    if not row.figures:
        return (
            f'{row.title} | did {row.scans} of {row.wanted} scans in its time'
            + ' | ' * 9
            + (f'| {memory}')
        )
    f = row.figures
    late = '' if row.finished else f' ({row.scans} of {row.wanted} scans)'
    error = '' if math.isnan(f['gospa'].error) else f' +- {f["gospa"].error * scale:.2g}'
    return (
        f'{row.title}{late} | {f["cpu"].mean:.1f} | {row.ratio:.1f} '
        f'| {f["gospa"].mean * scale:.4g} | {f["gospa"].margin * scale:+.3g}{error} '
        f'| {f["missed"].mean:.2f} | {f["false"].mean:.2f} | {f["rmse"].mean * scale:.4g} '
        f'| {f["held"].mean:.3f} | {f["switches"].mean:.1f} | {memory}'
    )


def growing(results: Results) -> list[str]:
    """Return the names of the scenes that differ in the number of contacts only."""
    return [name for name in WANTED if name.startswith('en_route') and name in results]


def growth(results: Results) -> str:
    """Return the CPU by number of contacts."""
    sizes = growing(results)
    rows: dict[str, list[str]] = {}
    for name in sizes:
        for row in results[name].rows.values():
            ms = (
                f'{row.figures["cpu"].mean:.1f}' if row.figures else f'{row.last:.0f}, out of time'
            )
            rows.setdefault(row.title, []).append(ms)
    head = ' | '.join(['CPU a scan [ms]', *(f'{results[s].contacts:.0f} contacts' for s in sizes)])
    return table(head, [' | '.join([title, *cells]) for title, cells in rows.items()])


def sections(results: Results) -> Iterator[tuple[str, str]]:
    """Yield title and text of each part."""
    yield 'Where another is better than our default', where_better(results)
    yield 'The wanted ratios to Stone Soup', ratios(results)
    if len(growing(results)) > 1:
        yield 'Growth', growth(results)
    for result in results.values():
        yield result.title[0].upper() + result.title[1:], _scene(result, origins(results))


def _scene(result: Result, known: list[str]) -> str:
    row = next(iter(result.rows.values()))
    runs = f'{row.runs}' if row.runs == result.wanted else f'{row.runs} of {result.wanted}'
    origin = f' From origin {known.index(result.made) + 1}.' if len(known) > 1 else ''
    return (
        f'{result.contacts:.0f} contacts and {result.plots:.0f} plots a scan, '
        f'{row.wanted} scans, {runs} run{"s" * (result.wanted > 1)}.{origin}\n\n'
        f'{scene_table(result)}'
    )


def origin_text(results: Results) -> str:
    """Return when, on what and with what the page was made; warn if not all in one run."""
    known = origins(results)
    if len(known) == 1:
        return f'{known[0]}.'
    told = ''.join(f'\n{number}. {made}.' for number, made in enumerate(known, 1))
    return f'**not in one go**; each scene says of which of these it is:\n{told}\n'


def origins(results: Results) -> list[str]:
    """Return when, on what and with what the results were made, each once."""
    return list(dict.fromkeys(result.made for result in results.values()))
