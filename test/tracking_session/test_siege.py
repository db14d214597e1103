# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A session under siege keeps its memory, its state and the tracks that are fed."""

from concurrent.futures import ProcessPoolExecutor
import multiprocessing
import tracemalloc
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip('rosbags')
from benchmarks.healthy_scenes import contacts, flights, HEALTHY, TRUE
from benchmarks.siege import besiege, Siege, stand
from tracking_session.orders import acquire

SHORT, LONG = 200, 500_000
GROWTH = 1.02  # of memory, from the second tenth to the last


@pytest.mark.parametrize(
    ('sensor', 'parameters'),
    [
        ('radar', {}),
        ('radar', {'estimator': 'adaptive_alpha_beta'}),
        ('radar', {'estimator': 'markov_jump_joint', 'lifecycle': 'm_of_n'}),
        ('sonar', {}),
        ('sonar', {'estimator': 'modified_polar'}),
    ],
)
def test_session_stands_a_siege(sensor, parameters):
    """Nothing raises or warns; refused messages change nothing; no track that is fed is lost."""
    siege = Siege(sensor, np.random.default_rng(1), parameters)
    besiege(siege, SHORT)
    assert len(siege.kept) == (3 if sensor == 'radar' else 8)
    assert siege.outcomes['tracks lost'] == siege.outcomes['tracks lost to a lie'] == 0
    assert siege.outcomes['plots refused'] > 0.4 * SHORT
    assert siege.outcomes['plots used'] > 0.1 * SHORT


@pytest.mark.parametrize('is_lie', [False, True])
def test_siege_counts_a_track_that_is_lost(monkeypatch, is_lie):
    """A contact that is seen no more costs its track; after a plot far from it, to a lie."""
    siege = Siege('radar', np.random.default_rng(1))
    if is_lie:
        monkeypatch.setitem(TRUE, 'radar', lambda stamp: flights(stamp) + 1e4)
        while not siege.attack():
            pass
    monkeypatch.setitem(
        HEALTHY, 'radar', lambda stamp: {name: v[1:] for name, v in contacts(stamp).items()}
    )
    for _ in range(12):
        siege.feed()
    assert siege.outcomes['tracks lost to a lie'] == is_lie
    assert siege.outcomes['tracks lost'] == (not is_lie)


@pytest.mark.soak
@pytest.mark.parametrize('sensor', HEALTHY)
def test_session_stands_a_long_siege(sensor, monkeypatch):
    """The same half a million times, in a process of its own, which is no larger at the end."""
    monkeypatch.setenv('PYTHONMALLOC', 'malloc')  # so that all that is held is seen
    with ProcessPoolExecutor(1, multiprocessing.get_context('spawn')) as pool:
        outcomes, memory = pool.submit(stand, sensor, LONG).result()
    print(
        f'\n{sensor}: {LONG} hostile messages, {outcomes}, [MB] {memory.held}, {memory.resident}'
    )
    assert memory.held[-1] <= GROWTH * memory.held[1]
    assert outcomes.get('tracks lost', 0) == 0
    assert outcomes.get('tracks lost to a lie', 0) == 0
    assert memory.resident[-1] <= GROWTH * memory.resident[1]


@pytest.mark.parametrize('sensor', HEALTHY)
def test_session_under_siege_holds_no_more_with_time(sensor):
    """Resident memory follows the largest message so far; what Python holds does not grow."""
    siege = Siege(sensor, np.random.default_rng(1))
    besiege(siege, 50)
    tracemalloc.start()
    try:
        besiege(siege, 100)
        before, _ = tracemalloc.get_traced_memory()
        besiege(siege, 200)
        after, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert after < before + 300_000


def test_acquire_keeps_max_tracks():
    """Points do not make more tracks than there may be."""
    siege = Siege('radar', np.random.default_rng(1), {'max_tracks': 10})
    for number in range(30):
        point = SimpleNamespace(x=1e3 * number, y=1e3, z=0.0)
        header = SimpleNamespace(frame_id='radar')
        acquire(siege.session, SimpleNamespace(header=header, point=point))
    assert len(siege.session.tracks) == 10
    assert siege.session.counts['acquire'].refused['no room'] == 23
