# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What the radar makes of a scenario: noise, misses, false plots, merging, cut into messages."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math

import numpy as np

from tracking_core.batches import Bools, Floats, Ints
from tracking_core.linalg import wrap_angle
from tracking_tools.scenarios.merging import merge_unresolved
from tracking_tools.scenarios.passes import Contact, find_passes, place, TrueStates
from tracking_tools.scenarios.radar import SimulatedRadar

FALSE_PLOT = -1
# Chance of noise alone in one resolution cell; fixes the threshold that every snr lies above.
_FALSE_ALARM_PROBABILITY = 1e-6

Columns = dict[str, Floats]


@dataclass(frozen=True)
class Scenario:
    """A radar, its contacts and for how long [s]."""

    radar: SimulatedRadar
    contacts: tuple[Contact, ...]
    duration: float
    description: str = ''
    seed: int = 1

    def __post_init__(self) -> None:
        if not self.duration > 0.0:
            raise ValueError(f'Scenario.duration must be above 0 s, got {self.duration}')
        ids = [contact.id for contact in self.contacts]
        if len(set(ids)) < len(ids):
            raise ValueError(f'Scenario.contacts must have different ids, got {ids}')


@dataclass(frozen=True)
class SimulatedScan:
    """What one message holds: the plots of a turn or a sector of it, and the truth beside."""

    start: float
    """[s]."""
    end: float
    """[s]."""
    columns: Columns
    """Plot columns (M,) by the names of the ``plots`` table; ``time`` [s of the scenario]."""
    contact: Ints
    """Whose plot it is (M,), ``FALSE_PLOT`` for a false one. For scoring only."""
    truth: TrueStates
    """The contacts passed in this time, detected or not (P,)."""


def plots(
    scenario: Scenario, rng: np.random.Generator, sectors: int = 1
) -> Iterator[SimulatedScan]:
    """
    Play a scenario through its radar.

    Parameters
    ----------
    scenario : Scenario
        What happens.
    rng : numpy.random.Generator
        The same state gives the same plots, however they are cut.
    sectors : int
        Messages in a turn.

    Yields
    ------
    SimulatedScan
        One per turn or sector, also when it saw nothing; plots in order of time.

    """
    radar = scenario.radar
    if sectors < 1 or (radar.is_staring and sectors > 1):
        raise ValueError(f'sectors must be 1 for a staring radar and at least 1, got {sectors}')
    truth = find_passes(radar, scenario.contacts, scenario.duration)
    columns, contact = _all_plots(scenario, truth, rng)
    turns = radar.turns(scenario.duration)
    edges = np.arange(turns * sectors + 1) * (radar.period / sectors)
    edges = edges[: int(np.searchsorted(edges, scenario.duration - 1e-9)) + 1]
    edges[-1] = min(edges[-1], scenario.duration)
    cuts = np.searchsorted(columns['time'], edges).tolist()
    marks = np.searchsorted(truth.time, edges).tolist()
    for k in range(len(edges) - 1):
        mine = slice(cuts[k], cuts[k + 1])
        yield SimulatedScan(
            start=float(edges[k]),
            end=float(edges[k + 1]),
            columns={name: column[mine] for name, column in columns.items()},
            contact=contact[mine],
            truth=truth.rows(slice(marks[k], marks[k + 1])),
        )


def _all_plots(
    scenario: Scenario, truth: TrueStates, rng: np.random.Generator
) -> tuple[Columns, Ints]:
    """All plots of the scenario in order of time, and whose they are."""
    radar = scenario.radar
    seen, detected = _true_plots(radar, truth, rng)
    clutter = _false_plots(radar, scenario.duration, rng)
    columns = {name: np.concatenate([seen[name], clutter[name]]) for name in seen}
    contact = np.concatenate([truth.id[detected], np.full(len(clutter['time']), FALSE_PLOT)])
    order = np.argsort(columns['time'], kind='stable')
    columns = {name: column[order] for name, column in columns.items()}
    columns, contact = merge_unresolved(radar, columns, contact[order])
    return _as_measured(radar, columns, rng), contact


def _true_plots(
    radar: SimulatedRadar, truth: TrueStates, rng: np.random.Generator
) -> tuple[Columns, Bools]:
    detected = rng.random(len(truth)) < radar.detection_probability
    noise = rng.standard_normal((len(truth), 4))[detected].T
    power = rng.exponential(size=len(truth))[detected]
    seen = truth.rows(detected)
    exact = place(radar, seen)
    # Swerling 1: detection_probability = exp(-threshold / (1 + mean signal to noise ratio))
    threshold = -math.log(_FALSE_ALARM_PROBABILITY)
    mean_power = -threshold / math.log(min(max(radar.detection_probability, 1e-3), 0.999))
    columns = {
        'range': np.abs(exact['range'] + radar.range_sd * noise[0]),
        'azimuth': wrap_angle(exact['azimuth'] + radar.azimuth_sd * noise[1]),
        'elevation': exact['elevation'] + (radar.elevation_sd or 0.0) * noise[2],
        'range_rate': exact['range_rate'] + (radar.range_rate_sd or 0.0) * noise[3],
        'snr': 10.0 * np.log10(threshold + mean_power * power),
        'time': seen.time,
    }
    return columns, detected


def _false_plots(radar: SimulatedRadar, duration: float, rng: np.random.Generator) -> Columns:
    """Poisson in each turn, uniform in the measured coordinates: equal false alarms per cell."""
    turns = radar.turns(duration)
    turn = np.repeat(np.arange(turns), rng.poisson(radar.clutter_per_turn, size=turns))
    count = len(turn)
    first, width = radar.azimuth_coverage
    azimuth = wrap_angle(first + width * rng.random(count))
    power = -math.log(_FALSE_ALARM_PROBABILITY) + rng.exponential(size=count)
    return {
        'range': rng.uniform(*radar.range_limits, size=count),
        'azimuth': azimuth,
        'elevation': rng.uniform(*radar.elevation_limits, size=count),
        'range_rate': radar.range_rate_limit * rng.uniform(-1.0, 1.0, size=count),
        'snr': 10.0 * np.log10(power),
        'time': turn * radar.period + radar.time_into_turn(azimuth),
    }


def _as_measured(radar: SimulatedRadar, columns: Columns, rng: np.random.Generator) -> Columns:
    """Only what this radar reports, in the order of the table."""
    unmeasured = set()
    if radar.elevation_sd is None:
        unmeasured.add('elevation')
    if radar.range_rate_sd is None:
        unmeasured.add('range_rate')
    kept = {name: column for name, column in columns.items() if name not in unmeasured}
    return _as_cartesian(kept, radar.position_sd, rng) if radar.position_sd > 0.0 else kept


def _as_cartesian(columns: Columns, sd: float, rng: np.random.Generator) -> Columns:
    polar = ('range', 'azimuth', 'elevation')
    elevation = columns.get('elevation', np.zeros_like(columns['range']))
    ground = columns['range'] * np.cos(elevation)
    axes = {
        'x': ground * np.cos(columns['azimuth']),
        'y': ground * np.sin(columns['azimuth']),
        'z': columns['range'] * np.sin(elevation),
    }
    if 'elevation' not in columns:
        del axes['z']
    noisy = {name: axis + sd * rng.standard_normal(len(axis)) for name, axis in axes.items()}
    return noisy | {name: column for name, column in columns.items() if name not in polar}
