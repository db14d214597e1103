# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Simulated scenes: contacts that move exactly, seen by a radar or heard by a sonar with its faults.

Read ``trajectory`` and ``legs`` (how contacts move), ``radar`` (what sees them), ``passes``
(when), ``plots`` (what comes out) and ``menu`` (the named scenes) in this order; for a sonar
``array`` (what it hears) and ``listening``. ``broadcast`` is how either goes on the air.
"""

from tracking_tools.scenarios.legs import Leg, Legs
from tracking_tools.scenarios.menu import build, build_any, SCENARIOS, SCENES
from tracking_tools.scenarios.passes import Contact, find_passes, TrueStates
from tracking_tools.scenarios.plots import FALSE_PLOT, plots, Scenario, SimulatedScan
from tracking_tools.scenarios.radar import NORTH, SimulatedRadar
from tracking_tools.scenarios.trajectory import Sampled, Trajectory

__all__ = [
    'FALSE_PLOT',
    'NORTH',
    'SCENARIOS',
    'SCENES',
    'Contact',
    'Leg',
    'Legs',
    'Sampled',
    'Scenario',
    'SimulatedRadar',
    'SimulatedScan',
    'Trajectory',
    'TrueStates',
    'build',
    'build_any',
    'find_passes',
    'plots',
]
