# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Are our measures those of Stone Soup on the same tracks?"""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
import pytest

from tracking_core.rows import take
from tracking_tools.scoring import continuity, Matches, Stretches, track_error, TrackRows, Truth
from tracking_tools.scoring.gospa import gospa_of_distances
from tracking_tools.scoring.matching import candidates, choose_pairs
from tracking_tools.scoring.ospa import distances_of_scans, ospa_of_distances
from tracking_tools.scoring.siap import nearest, siap

pytest.importorskip('stonesoup', reason='Stone Soup (extra peers) is not installed')

from stonesoup.dataassociator.tracktotrack import TrackToTruth
from stonesoup.measures import Euclidean
from stonesoup.metricgenerator.clearmotmetrics import ClearMotMetrics
from stonesoup.metricgenerator.manager import MultiManager
from stonesoup.metricgenerator.ospametric import GOSPAMetric, OSPAMetric
from stonesoup.metricgenerator.tracktotruthmetrics import SIAPMetrics
from stonesoup.types.association import AssociationSet, TimeRangeAssociation
from stonesoup.types.groundtruth import GroundTruthPath, GroundTruthState
from stonesoup.types.state import GaussianState
from stonesoup.types.time import CompoundTimeRange, TimeRange
from stonesoup.types.track import Track

SCANS, CUTOFF = 30, 25.0  # as in random_scene
BEGIN = datetime(2026, 1, 1)
PLACE, SPEED = [0, 1], [2, 3]
TOLERANCE = 1e-9  # both compute in double precision, in another order


def at(scan: float) -> datetime:
    """Return when a scan was."""
    return BEGIN + timedelta(seconds=float(scan))


def their_tracks(rows: TrackRows) -> dict[int, Track]:
    """Return the same tracks as Stone Soup has them."""
    state = np.concatenate([rows.position, rows.velocity], axis=1)
    return {
        int(number): Track(
            [
                GaussianState(state[i], rows.covariance[i], timestamp=at(rows.scan[i]))
                for i in np.flatnonzero(rows.id == number)
            ]
        )
        for number in np.unique(rows.id)
    }


def their_truth(truth: Truth) -> dict[int, GroundTruthPath]:
    """Return the same truth as Stone Soup has it."""
    state = np.concatenate([truth.position, truth.velocity], axis=1)
    return {
        int(number): GroundTruthPath(
            [
                GroundTruthState(state[i], timestamp=at(truth.time[i]))
                for i in np.flatnonzero(truth.id == number)
            ]
        )
        for number in np.unique(truth.id)
    }


def associations(on: Matches, tracks: dict[int, Any], paths: dict[int, Any]) -> AssociationSet:
    """Return our choice of pairs, each at its moments, for Stone Soup to judge."""
    found = set()
    for track, contact in np.unique(np.stack([on.track, on.contact], axis=1), axis=0):
        moments = on.scan[(on.track == track) & (on.contact == contact)]
        ranges = CompoundTimeRange([TimeRange(at(k - 0.1), at(k + 0.1)) for k in moments])
        found.add(TimeRangeAssociation({tracks[int(track)], paths[int(contact)]}, ranges))
    return AssociationSet(found)


@pytest.fixture(params=range(5))
def compared(request: pytest.FixtureRequest, random_scene: Any) -> Any:
    """Return rows, truth, candidates and stretches of one random scene."""
    rows, truth = random_scene(request.param)
    starts = np.arange(SCANS + 1.0)
    near = candidates(rows, truth, CUTOFF, 0.0)
    return rows, truth, near, Stretches.of_truth(truth, starts)


def test_gospa_and_its_parts_are_those_of_stone_soup(compared: Any) -> None:
    """Total, localisation, missed and false agree in every scan."""
    rows, truth, near, stretches = compared
    tracks, paths = their_tracks(rows), their_truth(truth)
    generator = GOSPAMetric(p=2, c=CUTOFF, measure=Euclidean(mapping=PLACE))
    theirs = generator.compute_over_time(
        *generator.extract_states(tracks.values(), True),
        *generator.extract_states(paths.values(), True),
    )
    values = {metric.timestamp: metric.value for metric in theirs.value}
    for k, distance in enumerate(distances_of_scans(rows, near, stretches, SCANS, CUTOFF)):
        ours = gospa_of_distances(distance, CUTOFF)
        their = values.get(at(k))
        if their is None:  # nothing there and nothing said
            assert ours.total == 0.0
            continue
        half = 0.5 * CUTOFF**2
        parts = (ours.total, ours.localisation, half * ours.missed, half * ours.false)
        names = ('distance', 'localisation', 'missed', 'false')
        assert_allclose(parts, [their[name] for name in names], rtol=TOLERANCE, atol=TOLERANCE)


def test_ospa_is_that_of_stone_soup(compared: Any) -> None:
    """It agrees in every scan for power 1 (for others theirs minimises sums of first powers)."""
    rows, truth, near, stretches = compared
    generator = OSPAMetric(p=1, c=CUTOFF, measure=Euclidean(mapping=PLACE))
    theirs = generator.compute_over_time(
        *generator.extract_states(their_tracks(rows).values(), True),
        *generator.extract_states(their_truth(truth).values(), True),
    )
    values = {metric.timestamp: metric.value for metric in theirs.value}
    for k, distance in enumerate(distances_of_scans(rows, near, stretches, SCANS, CUTOFF)):
        ours = ospa_of_distances(distance, CUTOFF).total
        assert_allclose(ours, values.get(at(k), 0.0), rtol=TOLERANCE, atol=TOLERANCE)


def test_siap_is_that_of_stone_soup(compared: Any) -> None:
    """The five measures agree when both are told the same pairs."""
    rows, truth, near, stretches = compared
    tracks, paths = their_tracks(rows), their_truth(truth)
    generator = SIAPMetrics(
        position_measure=Euclidean(mapping=PLACE), velocity_measure=Euclidean(mapping=SPEED)
    )
    manager = MultiManager([generator], associator=TrackToTruth(association_threshold=CUTOFF))
    manager.add_data({'tracks': set(tracks.values()), 'groundtruth_paths': set(paths.values())})
    manager.association_set = associations(nearest(near), tracks, paths)
    theirs = {metric.title: metric.value for metric in generator.compute_metric(manager)}
    ours = siap(rows, near, stretches)
    for name in ('completeness', 'ambiguity', 'spuriousness', 'position_accuracy',
                 'velocity_accuracy'):  # fmt: skip
        their = theirs[f'SIAP {name.replace("_", " ").title()}']
        assert_allclose(getattr(ours, name), their, rtol=TOLERANCE)


def test_held_and_switches_add_up_to_their_clear_mot(compared: Any) -> None:
    """MOTA counts misses, false rows and switches from one scan to the next; MOTP is distance."""
    rows, truth, near, stretches = compared
    pairs, tracks, paths = choose_pairs(near, CUTOFF), their_tracks(rows), their_truth(truth)
    generator = ClearMotMetrics(distance_measure=Euclidean(mapping=PLACE))
    manager = MultiManager([generator])
    manager.add_data({'tracks': set(tracks.values()), 'groundtruth_paths': set(paths.values())})
    manager.association_set = associations(pairs, tracks, paths)
    theirs = {metric.title: metric.value for metric in generator.compute_metric(manager)}
    at_once = sum(
        int((np.diff(mine.track)[np.diff(mine.scan) == 1] != 0).sum())
        for mine in (take(pairs, pairs.contact == contact) for contact in range(6))
    )
    held = continuity(rows, pairs, np.unique(near.track), stretches).held
    wrong = (1.0 - held) * len(truth.id) + len(rows) - len(pairs) + at_once
    assert at_once > 0
    assert_allclose(1.0 - wrong / len(truth.id), theirs['MOTA'], rtol=TOLERANCE)
    assert_allclose(pairs.distance.mean(), theirs['MOTP'], rtol=TOLERANCE)


def test_rmse_is_that_of_their_distances(compared: Any) -> None:
    """Root mean squares of Stone Soup's distances of the same pairs."""
    rows, truth, near, _ = compared
    on, tracks, paths = nearest(near), their_tracks(rows), their_truth(truth)
    ours = track_error(rows, on)
    for mapping, value in ((PLACE, ours.rmse), (SPEED, ours.velocity_rmse)):
        measure = Euclidean(mapping=mapping)
        squares = [
            measure(tracks[int(track)][at(k)], paths[int(contact)][at(k)]) ** 2
            for track, contact, k in zip(on.track, on.contact, on.scan, strict=True)
        ]
        assert_allclose(value, np.sqrt(np.mean(squares)), rtol=TOLERANCE)
