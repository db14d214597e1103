# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""nrl-tracker (a port of the Tracker Component Library) on the plots of a scene: its JPDA."""

from __future__ import annotations

import numpy as np
from pytcl.assignment_algorithms import jpda_update

from benchmarks.peers.scenes import Knowledge
from benchmarks.peers.upkeep import Life, Lives
from tracking_core.batches import Floats, Ints

GATE = 0.997
WIDE = 8.0  # sd in noises of a plot beyond which plots in the gate tell nothing
CLAIMED = 0.5  # a plot more likely than this from a track starts no other

State = tuple[Floats, Floats]  # mean (n,), covariance (n, n)


class NrlJpda:
    """One constant-velocity Kalman filter a track, updated by ``jpda_update``."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._knowledge = knowledge
        self._F, self._H = knowledge.transition(), knowledge.measurement()
        self._Q = knowledge.process_noise(knowledge.single)
        self._R = knowledge.noise**2 * np.eye(knowledge.axes)
        self._lives: Lives[State] = Lives()

    def _new(self, plot: Floats) -> State:
        known = self._knowledge
        variance = np.tile([known.noise**2, known.speed_sd**2], known.axes)
        return self._H.T @ plot, np.diag(variance)

    def step(self, time: float, plots: Floats) -> tuple[Ints, Floats]:
        """Return ids (T,) and positions (T, d) of the confirmed tracks after a scan."""
        sure = self._lives.confirmed
        tentative = [life for life in self._lives.all if not life.confirmed]
        left = plots[self._follow(sure, plots) < CLAIMED]
        left = left[self._follow(tentative, left) < CLAIMED]
        self._lives.end()
        self._lives.start([self._new(plot) for plot in left])
        sure = self._lives.confirmed
        place = np.array([self._H @ life.filter[0] for life in sure])
        return np.array([life.id for life in sure], np.int64), place.reshape(-1, plots.shape[1])

    def _follow(self, lives: list[Life[State]], plots: Floats) -> Floats:
        """Predict and update tracks; return how much they claim of each plot (M,)."""
        F = self._F
        predicted = [(F @ x, F @ P @ F.T + self._Q) for x, P in (life.filter for life in lives)]
        if not lives or not len(plots):
            for life, state in zip(lives, predicted, strict=True):
                life.filter = state
                life.look(False)
            return np.zeros(len(plots))
        done = jpda_update(
            [x for x, _ in predicted], [P for _, P in predicted], plots, self._H, self._R,
            self._knowledge.detection_probability, self._knowledge.clutter_density, GATE,
        )  # fmt: skip
        share = done.association_probs[:, :-1]
        taken: set[int] = set()  # a plot is a hit for the oldest track only: doubles die
        for t, life in enumerate(lives):
            life.filter = (done.states[t], done.covariances[t])
            best = int(share[t].argmax())
            known = np.diag(life.filter[1])[::2].sum() < (WIDE * self._knowledge.noise) ** 2
            hit = known and best not in taken and share[t, best] > done.association_probs[t, -1]
            life.look(bool(hit))
            taken |= {best} if hit else set()
        return share.sum(axis=0)
