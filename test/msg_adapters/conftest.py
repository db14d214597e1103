# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Tracks to put into messages."""

import numpy as np
import pytest

from tracking_core.batches import Mixture, Tracks


def _covariances(rng, rows, modes, size):
    half = rng.normal(0.0, 10.0, (rows, modes, size, size))
    return half @ half.swapaxes(-1, -2) + np.eye(size)


@pytest.fixture
def make_tracks():
    """Return a maker of tracks with these ids, in two or three dimensions."""

    def make(ids, dimensions=3, seed=1):
        rng, rows = np.random.default_rng(seed), len(ids)
        planes = []
        for size in (4, 2)[: dimensions - 1]:
            probability = rng.dirichlet([1.0, 1.0], rows)
            mean = rng.normal(0.0, 100.0, (rows, 2, size))
            covariance = _covariances(rng, rows, 2, size)
            planes.append(Mixture(mean, covariance, probability, np.zeros((rows, 0))))
        return Tracks(
            id=np.array(ids, np.int64),
            time=np.full(rows, 99.5),
            birth_time=np.full(rows, 90.0),
            planes=tuple(planes),
            existence_probability=rng.uniform(size=rows),
            confirmed=np.arange(rows) % 2 == 0,
            hits=np.arange(rows) + 3,
            misses=np.arange(rows) % 2,
            outside=np.zeros(rows, np.int64),
            history=np.ones(rows, np.int64),
            gate_size=np.full((rows, dimensions), 50.0),
            gate_volume=np.full(rows, 1e5),
            nis=np.full(rows, np.nan),
            doubled=np.zeros(rows, np.int64),
            level=np.full(rows, np.nan),
        )

    return make
