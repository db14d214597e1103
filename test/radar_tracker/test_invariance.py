# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What must not change tracks does not: where north is, which way round, when, in which units."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.tracker import RadarTracker
from studies.scenes import messages
from tracking_core.batches import Plots
from tracking_core.config import parameters, with_values
from tracking_core.rows import take
from tracking_tools.scenarios import Contact, Legs, Scenario, SimulatedRadar

CONTACTS = tuple(
    Contact(k + 1, Legs((r * np.cos(2.4 * k), r * np.sin(2.4 * k), 2e3), 150.0, 1.3 * k))
    for k, r in enumerate(np.linspace(8e3, 30e3, 8))
)
# The powers of metre and second in the units of parameters that have any.
UNITS = {'m': (1, 0), 'm/s': (1, -1), 'm/s^2': (1, -2), 's': (0, 1), '1/h': (0, -1)}


@cache
def scene(rotation: str, heights: bool) -> tuple[Plots, ...]:
    """Return the messages of a radar with range rates, and false plots."""
    radar = SimulatedRadar(
        period=4.0, range_sd=32.0, azimuth_sd=0.002, elevation_sd=0.003 if heights else None,
        range_rate_sd=2.0, clutter_per_turn=12.0, range_limits=(1e3, 5e4), rotation=rotation,
        elevation_limits=(0.0, 0.7),
    )  # fmt: skip
    sensed = messages(Scenario(radar, CONTACTS, 80.0), np.random.default_rng(5))
    return tuple(plots for plots, _ in sensed)


def config(rotation: str, length: float = 1.0, time: float = 1.0) -> RadarTrackerConfig:
    """Return parameters told in other units."""
    values = {
        'sensor.range_sd': 32.0, 'sensor.azimuth_sd': 0.002, 'sensor.elevation_sd': 0.003,
        'sensor.range_max': 5e4, 'initiation.speed_max': 400.0,
        'scan.assembly': 'snapshot' if rotation == 'staring' else 'message',
    }  # fmt: skip
    made = with_values(RadarTrackerConfig(), values)
    scaled = {}
    for parameter in parameters(made):
        metres, seconds = UNITS.get(parameter.unit, (0, 0))
        value = np.array(parameter.value) if (metres, seconds) != (0, 0) else None
        if value is not None:
            scaled[parameter.name] = (value * length**metres * time**seconds).tolist()
    return with_values(made, scaled)


def tracked(plots: tuple[Plots, ...], of: RadarTrackerConfig) -> RadarTracker:
    """Return a tracker after these messages."""
    tracker = RadarTracker(of)
    for message in plots:
        tracker.track(message)
    return tracker


def changed(plots: Plots, turn=0.0, sense=1.0, epoch=0.0, length=1.0, time=1.0) -> Plots:
    """Return the plots of a world that is turned, mirrored, later, larger or slower."""
    return replace(
        plots,
        azimuth=np.angle(np.exp(1j * (sense * plots.azimuth + turn))),
        time=time * plots.time + epoch,
        stamp=time * plots.stamp + epoch,
        range=length * plots.range,
        range_rate=length / time * plots.range_rate,
    )


CHANGES = {
    'turned': {'turn': 0.5 * np.pi},
    'turned round': {'turn': np.pi},
    'mirrored': {'sense': -1.0},
    'of today': {'epoch': 1.7e9},
    'before the epoch': {'epoch': -40.0},
    'larger': {'length': 8.0},
    'smaller': {'length': 1.0 / 8.0},
    'larger and slower': {'length': 8.0, 'time': 8.0},
}  # such that the cells of the map of clutter are the same again


@pytest.mark.parametrize('change', CHANGES.values(), ids=CHANGES)
@pytest.mark.parametrize(
    ('rotation', 'heights'), [('clockwise', False), ('anticlockwise', True), ('staring', True)]
)
def test_tracks_are_those_of_the_changed_world(rotation, heights, change) -> None:
    """The same ids, looks and chances to exist, and the same places there."""
    length, time = change.get('length', 1.0), change.get('time', 1.0)
    plots = scene(rotation, heights)
    one = tracked(plots, config(rotation))
    other = tracked(tuple(changed(p, **change) for p in plots), config(rotation, length, time))
    assert one.tracks.confirmed.sum() == len(CONTACTS)
    assert_same(one, other, change)


def assert_same(one: RadarTracker, other: RadarTracker, change) -> None:
    """Check that the tracks of the other world are those of this one."""
    a, b = (take(tracker.tracks, tracker.tracks.confirmed) for tracker in (one, other))
    for name in ('id', 'hits', 'misses'):
        assert_array_equal(getattr(b, name), getattr(a, name))
    assert_allclose(b.existence_probability, a.existence_probability, atol=1e-3)
    length, time = change.get('length', 1.0), change.get('time', 1.0)
    back = np.exp(-1j * change.get('turn', 0.0))
    (here, P), there = a.planes[0].moments(), b.planes[0].moments()[0]
    for at, scale in ((0, length), (1, length / time)):
        place = (there[:, at] + 1j * there[:, at + 2]) * back / scale
        place = place if change.get('sense', 1.0) > 0.0 else place.conj()
        off = place - (here[:, at] + 1j * here[:, at + 2])
        assert (np.abs(off) < 0.01 * np.sqrt(P[:, at, at] + P[:, at + 2, at + 2])).all()


@pytest.mark.parametrize(('rotation', 'heights'), [('clockwise', False), ('staring', True)])
def test_order_of_plots_and_parameters_set_again_change_nothing(rotation, heights) -> None:
    """Within a message plots are in any order; a parameter may be set to what it is."""
    plots, rng = scene(rotation, heights), np.random.default_rng(1)
    one, other = tracked(plots, config(rotation)), RadarTracker(config(rotation))
    for message in plots:
        other.track(take(message, rng.permutation(len(message))))
        other.reconfigure(other.config)
    assert_same(one, other, {})
