# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""FilterPy on the plots of a scene: an IMM for each track, and the best assignment of plots."""

from __future__ import annotations

from filterpy.kalman import IMMEstimator, KalmanFilter
import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree

from benchmarks.peers.scenes import Knowledge
from benchmarks.peers.upkeep import Lives
from tracking_core.batches import Floats, Ints

GATE = 11.6  # chi-square of 0.997 in the plane
FAR = 1e6


class KalmanBanks:
    """IMM with two modes; a plot belongs to one track, so that all distances are least."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._knowledge = knowledge
        self._lives: Lives[IMMEstimator] = Lives()

    def _new(self, plot: Floats) -> IMMEstimator:
        known, filters = self._knowledge, []
        n, d = 2 * known.axes, known.axes
        for mode in known.modes:
            one = KalmanFilter(dim_x=n, dim_z=d)
            one.x[::2, 0] = plot
            one.P = np.diag(np.tile([known.noise**2, known.speed_sd**2], d))
            one.F, one.H = known.transition(), known.measurement()
            one.Q, one.R = known.process_noise(mode), known.noise**2 * np.eye(d)
            filters.append(one)
        share = np.array(known.sojourn) / sum(known.sojourn)
        return IMMEstimator(filters, share, known.mode_transition())

    def step(self, time: float, plots: Floats) -> tuple[Ints, Floats]:
        """Return ids (T,) and positions (T, d) of the confirmed tracks after a scan."""
        for life in self._lives.all:
            life.filter.predict()
        mine = self._assign(plots)
        for life, plot in zip(self._lives.all, mine, strict=True):
            if plot >= 0:
                life.filter.update(plots[plot][:, None])
            life.look(plot >= 0)
        free = np.setdiff1d(np.arange(len(plots)), mine)
        self._lives.end()
        self._lives.start([self._new(plots[plot]) for plot in free])
        sure = self._lives.confirmed
        place = np.array([life.filter.x[::2, 0] for life in sure])
        return np.array([life.id for life in sure], np.int64), place.reshape(-1, plots.shape[1])

    def _assign(self, plots: Floats) -> Ints:
        """Return the plot of each track (T,), -1 for none."""
        tracks = [life.filter for life in self._lives.all]
        chosen = np.full(len(tracks), -1)
        if not tracks or not len(plots):
            return chosen
        mean = np.array([one.x[::2, 0] for one in tracks])
        S = np.array([one.P[::2, ::2] for one in tracks])
        S += self._knowledge.noise**2 * np.eye(plots.shape[1])
        reach = np.sqrt(GATE * np.einsum('tdd->t', S))
        cost = np.full((len(tracks), len(plots)), FAR)
        for t, near in enumerate(cKDTree(plots).query_ball_point(mean, reach)):
            off = plots[near] - mean[t]
            cost[t, near] = (off * np.linalg.solve(S[t], off.T).T).sum(axis=1)
        row, column = linear_sum_assignment(np.minimum(cost, GATE))
        fits = cost[row, column] < GATE
        chosen[row[fits]] = column[fits]
        return chosen
