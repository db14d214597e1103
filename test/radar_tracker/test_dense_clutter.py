# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts among hundreds of false plots, with a speed limit that leaves room for all of them."""

from __future__ import annotations

import pytest

from benchmarks.dense_clutter import watch


@pytest.mark.parametrize('false_plots', [80.0, 150.0, 300.0])
def test_contacts_are_found_among_hundreds_of_false_plots(false_plots: float) -> None:
    """Two plots prove little there; more do, if they are waited for."""
    outcome = watch(false_plots, seed=1, looks=25)
    assert outcome.held[-1].all()
    assert outcome.false[-1] <= 1
    assert outcome.tracks.max() < 300  # tentative ones included


def test_dense_clutter_stays_affordable() -> None:
    """Where nothing can be followed, tracks do not pile up."""
    outcome = watch(3000.0, seed=1, looks=8)
    assert outcome.false[-1] == 0
    assert outcome.tracks.max() < 600


def test_counting_plots_confirms_no_clutter_there() -> None:
    """M of N knows nothing of clutter: faint tracks would nearly all be confirmed."""
    outcome = watch(300.0, seed=1, looks=8, lifecycle='m_of_n')
    assert outcome.false[-1] == 0
    assert outcome.tracks.max() < 30


def test_faint_starts_are_a_matter_of_what_they_may_cost() -> None:
    """None: nothing is found there; more: found where the usual number is too few."""
    assert not watch(80.0, seed=1, looks=15, **{'initiation.faint_starts': 0}).tracks.any()
    few, many = (
        watch(600.0, seed=2, looks=20, **{'initiation.faint_starts': number}).held[-1].sum()
        for number in (30, 200)
    )
    assert few < many


@pytest.mark.parametrize(('method', 'false_plots'), [('one_point', 15.0), ('two_point', 150.0)])
def test_doubtful_tracks_get_their_plots_for_certain(method: str, false_plots: float) -> None:
    """Were a plot taken for clutter because its track is new, no new track would have one."""
    values = {'association': 'global_nearest', 'initiation.method': method}
    outcome = watch(false_plots, seed=1, looks=20, **values)
    assert outcome.held[-1].all()
    assert outcome.false[-1] == 0
