# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does the optimal structure of [ZHUK09] gain over two planes, on Z-0 and on Z-near?

The joint filter uses the covariance of the plots between the planes; far and low it is small.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from studies.figures import Figures
from studies.passes import measure, Measured, run
from studies.z0 import CLIMBS, SD, SEED, SETTLED, Spans, TURNS
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.composition import Plane
from tracking_core.estimators import MarkovJump, MarkovJumpJoint
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import ConstantVelocity
from tracking_tools.scenarios.legs import Legs
from tracking_tools.scenarios.studies import z0_path, z_near_path


@dataclass(frozen=True)
class Scene:
    """One path with its times, and when it manoeuvres."""

    path: Callable[[], Legs]
    period: float  # [s]
    contacts: int
    seed: int
    turns: Spans  # [s]
    climbs: Spans  # [s]

    def truth(self) -> tuple[Floats, Floats]:
        """Return position and velocity (K, 3)."""
        return self.path().at(self.period * np.arange(self.contacts))

    def measured(self, runs: int) -> Measured:
        """Return the plots of all runs; the first ones are the same however many there are."""
        noise = np.random.default_rng(self.seed).standard_normal((runs, self.contacts, 3))
        return measure(self.truth()[0], SD, noise)

    def manoeuvre(self) -> Bools:
        """Return the contacts (K,) of a manoeuvre of either plane, and the 2 after it."""
        k = np.arange(self.contacts)
        inside = [
            (k > start / self.period) & (k <= end / self.period + 2)
            for start, end in self.turns + self.climbs
        ]
        return np.asarray(np.any(inside, axis=0))

    def quiet(self) -> Bools:
        """Return the other contacts (K,), once the filter has settled."""
        return ~self.manoeuvre() & (np.arange(self.contacts) >= SETTLED)


Z_0 = Scene(z0_path, 10.0, 76, SEED, TURNS, CLIMBS)
Z_NEAR = Scene(
    z_near_path, 5.0, 70, 777, ((95, 115), (185, 210), (275, 295)), ((60, 80), (240, 260))
)


def paper_filters(period: float) -> tuple[MarkovJump, MarkovJump]:
    """Return the filters of the two planes, as in the paper, for this period [s]."""
    chain = ModeChain.staying(0.9, period)
    level = tuple(ConstantVelocity(sd) for sd in (3.0, 35.0))
    height = tuple(ConstantVelocity(sd, axes=1) for sd in (3.0, 25.0))
    return MarkovJump(level, chain), MarkovJump(height, chain)


def position_errors(scene: Scene, runs: int, quiet: bool = True) -> dict[str, Floats]:
    """Return the error (K - 2, T, 3) [m] of the mixture: decomposed, joint."""
    level, height = paper_filters(scene.period)
    measured, truth = scene.measured(runs), scene.truth()[0][2:, None]
    planes = {
        'decomposed': (Plane(level, (0, 1)), Plane(height, (2,))),
        'joint': (Plane(MarkovJumpJoint(level, height), (0, 1, 2)),),
    }
    errors = {}
    for name, parts in planes.items():
        steps = run(parts, measured, scene.period, quiet)
        position = [
            np.concatenate([step.updated.moments()[0][:, 0::2] for step in contact], axis=1)
            for contact in zip(*steps, strict=True)
        ]
        errors[name] = np.stack(position) - truth
    return errors


def joint_figures(errors: dict[str, Floats], scene: Scene, runs: Ints) -> Figures:
    """Return RMSE of the joint filter over that of the decomposed one, from these runs."""
    spans = {'manoeuvre': scene.manoeuvre()[2:], 'quiet': scene.quiet()[2:]}
    result = {}
    for span, rows in spans.items():
        joint, parts = (
            np.mean(errors[name][rows][:, runs] ** 2) for name in ('joint', 'decomposed')
        )
        result[f'joint {span}'] = float(np.sqrt(joint / parts))
    return result
