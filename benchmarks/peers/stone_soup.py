# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Stone Soup on the plots of a scene: JPDA with EHM2, and global nearest neighbour.

Built of its own parts in the way of its tutorials: a constant-velocity Kalman filter, tracks from
``MultiMeasurementInitiator`` with its own 2-D assignment, ended by ``UpdateTimeStepsDeleter``.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from datetime import datetime, timedelta
from typing import Any

import numpy as np
from pyehm.plugins.stonesoup import JPDAWithEHM2
from stonesoup.dataassociator.neighbour import GNNWith2DAssignment
from stonesoup.dataassociator.probability import JPDAwithEHM
from stonesoup.dataassociator.tree import DetectionKDTreeGNN2D, DetectionKDTreeMixIn
from stonesoup.deleter.error import CovarianceBasedDeleter
from stonesoup.deleter.multi import CompositeDeleter
from stonesoup.deleter.time import UpdateTimeStepsDeleter
from stonesoup.hypothesiser.distance import DistanceHypothesiser
from stonesoup.hypothesiser.probability import PDAHypothesiser
from stonesoup.initiator.simple import MultiMeasurementInitiator
from stonesoup.measures import Mahalanobis
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.transition.linear import LinearGaussianTimeInvariantTransitionModel
from stonesoup.predictor.kalman import KalmanPredictor
from stonesoup.tracker.simple import MultiTargetMixtureTracker, MultiTargetTracker
from stonesoup.types.detection import Detection
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import KalmanUpdater

from benchmarks.peers.scenes import Knowledge
from tracking_core.batches import Floats, Ints

EPOCH = datetime(2026, 1, 1)
GATE = 0.997  # probability, and as a Mahalanobis distance in the plane
GATE_DISTANCE = 3.4
WIDE = 15.0  # sd in noises of a plot beyond which a track is no use
CONFIRM, DROP, DROP_NEW = 3, 5, 2  # plots, then scans without


class KDTreeJPDA(DetectionKDTreeMixIn, JPDAwithEHM):
    """Its own JPDA with EHM2, offered the plots near a track only."""


class StoneSoup:
    """A tracker of Stone Soup that is fed scan by scan."""

    def __init__(self, knowledge: Knowledge, association: str) -> None:
        self._scans: deque[tuple[datetime, set[Detection]]] = deque()
        d, n = knowledge.axes, 2 * knowledge.axes
        self._model = LinearGaussian(n, list(range(0, n, 2)), knowledge.noise**2 * np.eye(d))
        motion = LinearGaussianTimeInvariantTransitionModel(
            transition_matrix=knowledge.transition(),
            covariance_matrix=knowledge.process_noise(knowledge.single),
        )
        self._predictor, self._updater = KalmanPredictor(motion), KalmanUpdater(self._model)
        self._far = 10.0 * knowledge.noise + 4.0 * knowledge.speed_max * knowledge.period
        joint = association.startswith('jpda')
        tracker = MultiTargetMixtureTracker if joint else MultiTargetTracker
        self._tracker = iter(tracker(
            initiator=self._initiator(knowledge),
            deleter=self._deleter(DROP, knowledge),
            detector=self._feed(),
            data_associator=self._associator(association, knowledge),
            updater=self._updater,
        ))  # fmt: skip
        self._id: dict[str, int] = {}

    def _associator(self, name: str, knowledge: Knowledge) -> Any:
        tree = {'predictor': self._predictor, 'updater': self._updater,
                'max_distance': self._far}  # fmt: skip
        near = DistanceHypothesiser(
            self._predictor, self._updater, Mahalanobis(), missed_distance=GATE_DISTANCE
        )
        likely = PDAHypothesiser(
            self._predictor, self._updater, knowledge.clutter_density,
            prob_detect=knowledge.detection_probability, prob_gate=GATE,
        )  # fmt: skip
        return {
            'jpda': lambda: JPDAWithEHM2(likely),
            'jpda_tree': lambda: KDTreeJPDA(likely, **tree),
            'gnn': lambda: GNNWith2DAssignment(near),
            'gnn_tree': lambda: DetectionKDTreeGNN2D(near, **tree),
        }[name]()

    def _initiator(self, knowledge: Knowledge) -> MultiMeasurementInitiator:
        variance = np.tile([knowledge.noise**2, knowledge.speed_sd**2], knowledge.axes)
        return MultiMeasurementInitiator(
            prior_state=GaussianState(np.zeros((len(variance), 1)), np.diag(variance)),
            measurement_model=self._model,
            deleter=self._deleter(DROP_NEW, knowledge),
            data_associator=self._associator('gnn_tree', knowledge),
            updater=self._updater,
            min_points=CONFIRM,
        )

    def _deleter(self, scans: int, knowledge: Knowledge) -> CompositeDeleter:
        """End tracks after so many scans without a plot, or with a gate that fits anything."""
        wide = CovarianceBasedDeleter(
            (WIDE * knowledge.noise) ** 2, mapping=list(range(0, 2 * knowledge.axes, 2))
        )
        return CompositeDeleter([UpdateTimeStepsDeleter(scans), wide], intersect=False)

    def _feed(self) -> Iterator[tuple[datetime, set[Detection]]]:
        while True:
            yield self._scans.popleft()

    def step(self, time: float, plots: Floats) -> tuple[Ints, Floats]:
        """Return ids (T,) and positions (T, d) of the tracks after a scan."""
        now = EPOCH + timedelta(seconds=time)
        self._scans.append(
            (now, {Detection(plot[:, None], now, measurement_model=self._model) for plot in plots})
        )
        _, tracks = next(self._tracker)
        ids = [self._id.setdefault(track.id, len(self._id)) for track in tracks]
        mean = [track.state_vector[::2, 0] for track in tracks]
        shape = (len(ids), self._model.ndim_meas)
        return np.array(ids, np.int64), np.array(mean, float).reshape(shape)
