# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which scenarios have a name: those of radars, and of sonars."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from difflib import get_close_matches
from typing import TypeVar

from tracking_tools.scenarios.broadcast import Scene
from tracking_tools.scenarios.listening import Watch
from tracking_tools.scenarios.plots import Scenario
from tracking_tools.scenarios.studies import (
    crossing,
    crossing_rotating,
    two_mode,
    z0,
    z_near,
)
from tracking_tools.scenarios.terminal import terminal
from tracking_tools.scenarios.traffic import en_route, formation, seam, turns
from tracking_tools.scenarios.watches import long_watch, v0

S = TypeVar('S')

SCENARIOS: dict[str, Callable[[], Scenario]] = {
    'crossing': crossing,
    'crossing_rotating': crossing_rotating,
    'en_route': en_route,
    'formation': formation,
    'seam': seam,
    'terminal': terminal,
    'turns': turns,
    'two_mode': two_mode,
    'z0': z0,
    'z_near': z_near,
}

WATCHES: dict[str, Callable[[], Watch]] = {'sonar_crossing': v0, 'sonar_watch': long_watch}
SCENES: dict[str, Callable[[], Scene]] = {**SCENARIOS, **WATCHES}


def build(name: str) -> Scenario:
    """
    Return the scenario of a radar of that name.

    Raises
    ------
    ValueError
        Where there is none; says the nearest name and all others.

    """
    return _made(name, SCENARIOS)


def build_any(name: str) -> Scene:
    """Return the scenario of that name, of a radar or of a sonar; raises as `build`."""
    return _made(name, SCENES)


def _made(name: str, menu: Mapping[str, Callable[[], S]]) -> S:
    if name in menu:
        return menu[name]()
    near = get_close_matches(name, menu, n=1, cutoff=0.4)
    hint = f"; did you mean '{near[0]}'?" if near else '.'
    raise ValueError(f"no scenario '{name}'{hint} There are: {', '.join(menu)}")
