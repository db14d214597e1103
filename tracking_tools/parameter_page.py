# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Write docs/parameters.md from the config dataclasses, so that no number stands twice.

Run ``python -m tracking_tools.parameter_page > docs/parameters.md``.
"""

from __future__ import annotations

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
    return f'{value:.6g}' if isinstance(value, float) else (str(value) or "''")


def _range(p: Parameter) -> str:
    if p.choices:
        return ', '.join(p.choices)
    if p.low is None and p.high is None:
        return ''
    if p.high is None:
        return f'from {p.low:g}'
    return f'up to {p.high:g}' if p.low is None else f'{p.low:g} to {p.high:g}'


if __name__ == '__main__':
    print(page(), end='')
