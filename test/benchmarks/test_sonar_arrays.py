# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Arrays that are not as told: are the scenes what they say, and judged so?"""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.array_scenes import Array, CONTACTS, listen
from benchmarks.sonar_arrays import CASES, judge, run
from benchmarks.sonar_score import BearingRows
from tracking_core.linalg import wrap_angle


@pytest.mark.parametrize('side', ['starboard', 'port'])
def test_contacts_stay_on_the_side_that_is_asked_for(side):
    """As they are, where the tracker counts marks on both sides; marks are to starboard."""
    heard = listen(1, Array(side=side, both_sides=True))
    cycles, first = heard.record.cycles, heard.record.bearing[:CONTACTS]
    assert (np.sign(first) == (1.0 if side == 'port' else -1.0)).all()  # heading east
    assert (np.concatenate([marks.bearing for marks in cycles]) <= 0.0).all()


def test_tracks_that_are_the_truth_are_judged_so():
    """Held, with one id each and the right range; one more that is nowhere is false."""
    heard = listen(1, Array(linear=False))
    rows = []
    for cycle in range(len(heard.record.cycles)):
        here = slice(cycle * CONTACTS, (cycle + 1) * CONTACTS)
        bearing = heard.record.bearing[here]
        gaps = np.sort(bearing)
        lonely = gaps[np.diff(gaps).argmax()] + 0.5 * np.diff(gaps).max()
        rows.append(BearingRows(
            np.arange(CONTACTS + 1), np.append(bearing, wrap_angle(lonely)),
            np.append(heard.record.distance[here], np.nan),
        ))  # fmt: skip
    figures = judge(heard, rows, [np.full(CONTACTS + 1, 0.01)] * len(rows), cost=1.0)
    assert (figures.held, figures.told, figures.wrong, figures.nees) == (1.0, 1.0, 0.0, 0.0)
    assert (figures.ids, figures.found, figures.doubles, figures.false) == (1.0, 1.0, 0.0, 1.0)


@pytest.mark.slow
def test_both_sides_keep_contacts_to_port(monkeypatch):
    """Their ids change in own ship's turns otherwise; the first 800 s have one."""
    monkeypatch.setattr('benchmarks.array_scenes.DURATION', 800.0)
    port = Array(side='port')
    monkeypatch.setitem(CASES, 'port', (port, ()))
    monkeypatch.setitem(CASES, 'port on both', (replace(port, both_sides=True), ()))
    blind, both = run('port', {}, seed=2), run('port on both', {}, seed=2)
    assert both.ids < blind.ids
    assert both.held > 0.95
