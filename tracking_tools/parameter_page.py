# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Write docs/parameters.md from the config dataclasses, so that no number stands twice.

Run ``python -m tracking_tools.parameter_page > docs/parameters.md``.
"""

from __future__ import annotations

from decimal import Context, ROUND_DOWN
from typing import Any

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from tracking_core.config import Parameter, parameters

NODES: dict[str, tuple[Any, ...]] = {
    'radar_tracker': (RadarTrackerConfig(), radar_node_config()),
    'sonar_tracker': (SonarTrackerConfig(), sonar_node_config()),
}
HEAD = '| parameter | default | unit | range | meaning | live |'
INTRODUCTION = """# Parameters

Made by `python -m tracking_tools.parameter_page > docs/parameters.md`; do not edit. *Live* ones
may change while the node runs and take effect at the next message, the others are read-only. An
integer is accepted for a number. `ros2 param describe /radar_tracker NAME` shows the same words.
"""


def page() -> str:
    """Return the page as Markdown."""
    return '\n'.join([INTRODUCTION, *(_table(name, NODES[name]) for name in NODES)])


def _table(name: str, configs: tuple[Any, ...]) -> str:
    rows = [_row(p) for config in configs for p in parameters(config)]
    head = [HEAD, '|---' * HEAD.count('| ') + '|']
    return '\n'.join([f'## {name}', '', *head, *rows, ''])


def _row(p: Parameter) -> str:
    cells = (f'`{p.name}`', _value(p.value), p.unit, _range(p), p.doc, 'yes' if p.live else '')
    return '| ' + ' | '.join(cell.replace('|', r'\|') for cell in cells) + ' |'


def _value(value: Any) -> str:
    if isinstance(value, (tuple, list)):
        return '[' + ', '.join(_value(item) for item in value) + ']'
    if isinstance(value, bool):
        return str(value).lower()
    return _number(value) if isinstance(value, float) else (str(value) or "''")


def _number(value: float) -> str:
    """Return six digits, rounded towards zero: a limit may be typed as it is printed."""
    text = f'{value:.6g}'
    if abs(float(text)) <= abs(value):
        return text
    return str(Context(prec=6, rounding=ROUND_DOWN).create_decimal_from_float(value))


def _range(p: Parameter) -> str:
    if p.choices:
        return ', '.join(p.choices)
    low, high = ('' if limit is None else _number(limit) for limit in (p.low, p.high))
    if low and high:
        return f'{low} to {high}'
    return f'from {low}' if low else high and f'up to {high}'


if __name__ == '__main__':
    print(page(), end='')
