# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""On which paths of one contact are the estimators compared, and with which parameters?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from studies import b0, k0
from studies.passes import Measured
from studies.z_scenes import Scene, Z_0, Z_NEAR
from tracking_core.batches import Bools, Floats
from tracking_tools.scenarios.studies import two_mode_path

Spans = tuple[tuple[float, float], ...]  # from, to [s]
_AFTER = 5  # contacts after a manoeuvre that count as after it
_SETTLED = 8  # contact from which filters no longer start
TWO_MODE_SD = 100.0  # [m]


@dataclass(frozen=True)
class Course:
    """One path with its plots; K contacts, T runs, d coordinates."""

    name: str
    period: float  # [s]
    position: Floats  # (K, d) [m]
    velocity: Floats  # (K, d) [m/s]
    measured: Measured
    spans: Spans  # manoeuvres
    onsets: tuple[float, ...]  # of manoeuvres in the first plane [s]
    parameters: dict[str, Any]  # of the motion

    @property
    def turning(self) -> Bools:
        """Contacts (K,) whose preceding interval overlaps a manoeuvre."""
        return self._contacts(0)

    @property
    def after(self) -> Bools:
        """The contacts (K,) after these."""
        return self._contacts(_AFTER) & ~self.turning

    @property
    def straight(self) -> Bools:
        """All others (K,), once the filters have settled."""
        return ~self._contacts(_AFTER) & (np.arange(len(self.position)) >= _SETTLED)

    def _contacts(self, more: int) -> Bools:
        time = self.period * np.arange(len(self.position))
        inside = [(time > a) & (time < b + (more + 1) * self.period) for a, b in self.spans]
        return np.asarray(np.any(inside, axis=0))


def courses(runs: int) -> list[Course]:
    """Return all courses, each with so many runs."""
    return [make(runs) for make in _COURSES]


def _motion(level: list[float], height: list[float], sojourn: float) -> dict[str, Any]:
    return {
        'motion.horizontal.acceleration_sd': level,
        'motion.vertical.acceleration_sd': height,
        'motion.horizontal.sojourn_time': [sojourn, sojourn],
        'motion.vertical.sojourn_time': [sojourn, sojourn],
    }


def _of_scene(name: str, scene: Scene) -> Callable[[int], Course]:
    sojourn = 8.96 * scene.period  # stays with 0.9 from contact to contact

    def make(runs: int) -> Course:
        position, velocity = scene.truth()
        return Course(
            name, scene.period, position, velocity, scene.measured(runs),
            scene.turns + scene.climbs, tuple(start for start, _ in scene.turns),
            _motion([3.0, 35.0], [3.0, 25.0], sojourn),
        )  # fmt: skip

    return make


def _b0(runs: int) -> Course:
    state = b0.truth()
    begin, end = b0.PERIOD * b0.TURN[0], b0.PERIOD * (b0.TURN[1] + 1)
    return Course(
        'B-0', b0.PERIOD, state[:, 0::2], state[:, 1::2], b0.scene(runs)[0], ((begin, end),),
        (begin,), _motion([0.3, 4.0], [0.3, 4.0], 8.96 * b0.PERIOD),
    )  # fmt: skip


def _k0(a: float) -> Callable[[int], Course]:
    def make(runs: int) -> Course:
        position = k0.truth(a)[:, None]
        since = np.clip(k0.PERIOD * (np.arange(k0.STEPS) - k0.BEGIN), 0.0, None)
        velocity = a * k0.GRAVITY * np.minimum(since, k0.PERIOD * (k0.END - k0.BEGIN))
        noise = np.random.default_rng(k0.SEED).standard_normal((k0.STEPS, runs, 1))
        R = np.full((k0.STEPS, runs, 1, 1), k0.SD**2)
        span = (k0.PERIOD * k0.BEGIN, k0.PERIOD * k0.END)
        return Course(
            f'K-0, {a:g} g', k0.PERIOD, position, velocity[:, None],
            Measured(position[:, None] + k0.SD * noise, R), (span,), span[:1],
            _motion([0.5, 10.0], [0.5, 10.0], 8.96 * k0.PERIOD),
        )  # fmt: skip

    return make


def _two_mode(runs: int) -> Course:
    period, contacts = 5.0, 100
    position, velocity = two_mode_path().at(period * np.arange(contacts))
    noise = np.random.default_rng(15).standard_normal((contacts, runs, 2))
    R = np.broadcast_to(TWO_MODE_SD**2 * np.eye(2), (contacts, runs, 2, 2))
    plots = position[:, None, :2] + TWO_MODE_SD * noise
    return Course(
        'air traffic', period, position[:, :2], velocity[:, :2], Measured(plots, R),
        ((125.0, 215.0), (340.0, 370.0)), (125.0, 340.0), _motion([0.1, 2.0], [0.1, 2.0], 95.0),
    )  # fmt: skip


_COURSES: tuple[Callable[[int], Course], ...] = (
    _of_scene('Z-0', Z_0), _of_scene('Z-near', Z_NEAR), _b0, _k0(0.3), _k0(1.0), _two_mode,
)  # fmt: skip
