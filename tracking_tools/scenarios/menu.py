# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which scenarios have a name."""

from __future__ import annotations

from collections.abc import Callable
from difflib import get_close_matches

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


def build(name: str) -> Scenario:
    """
    Return the scenario of that name.

    Raises
    ------
    ValueError
        Where there is none; says the nearest name and all others.

    """
    if name in SCENARIOS:
        return SCENARIOS[name]()
    near = get_close_matches(name, SCENARIOS, n=1, cutoff=0.4)
    hint = f"; did you mean '{near[0]}'?" if near else '.'
    raise ValueError(f"no scenario '{name}'{hint} There are: {', '.join(SCENARIOS)}")
