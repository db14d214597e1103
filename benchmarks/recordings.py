# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What real data are there to track? The shared recordings as plots, with truth for scoring.

The folder is ``../shared/data`` beside the project, another one if the environment variable
``CONTACT_TRACKING_DATA`` names it. Everything leaves here in ENU axes with angles anticlockwise
from east.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
import os
from pathlib import Path
from typing import Any

import numpy as np

from tracking_core.batches import Floats, Plots
from tracking_core.platform import Platform
from tracking_tools.scoring import PlotRows, Stretches, Truth

PROJECT = Path(__file__).resolve().parent.parent
_TURNING = np.deg2rad(0.3)  # from this turn rate on a contact counts as turning [rad/s]
_EN_ROUTE_RADIUS = 3000.0  # match radius [m]
Columns = dict[str, Any]


@dataclass(frozen=True)
class Recording:
    """One scene: messages of plots, and what is known about it."""

    name: str
    preset: str  # name of the parameter file
    messages: tuple[Plots, ...]
    plots: PlotRows
    truth: Truth
    stretches: Stretches
    radius: float  # match radius [m]
    slack: float  # one look [s]
    platform: Platform | None = None
    has_velocity: bool = True

    def part(self, first: int, last: int) -> Recording:
        """Return the messages from the first to the last, exclusive, as a scene of its own."""
        messages = self.messages[first:last]
        begin, end = messages[0].stamp, self.messages[first : last + 1][-1].stamp
        inside = (self.plots.time >= begin) & (self.plots.time < end)
        plots = PlotRows(
            *(getattr(self.plots, n)[inside] for n in ('time', 'position', 'contact'))
        )
        return replace(
            self, messages=messages, plots=plots, stretches=stretches_of(plots, messages)
        )


def data_folder() -> Path:
    """Return where the shared recordings are."""
    return Path(os.environ.get('CONTACT_TRACKING_DATA', PROJECT.parent / 'shared' / 'data'))


def air_scene(folder: Path) -> Recording:
    """Return the en-route scene: 84 aircraft, one hour, a turn in 10 s."""
    flights, seen = load(folder, 'air_adsb/air_scene'), load(folder, 'air_adsb/air_scene_plots')
    return _air('air_scene', 'air_surveillance_2d', flights, seen, 0)


def air_tracks(folder: Path) -> Iterator[Recording]:
    """Yield the scenes of one manoeuvring aircraft each, a turn in 4 s."""
    flights = load(folder, 'air_adsb/air_tracks')
    seen = load(folder, 'air_adsb/air_tracks_plots')
    for scene, name in enumerate(flights['names']):
        yield _air(str(name), 'air_approach_2d', flights, seen, scene)


def _air(name: str, preset: str, flights: Columns, seen: Columns, scene: int) -> Recording:
    """Return a scene in axes that have the radar at the origin."""
    mine = seen['scene'] == scene
    origin, period = seen['radar_e_n'][scene], float(seen['rotation_s'])
    time, distance = seen['t'][mine], seen['rho'][mine].astype(float)
    azimuth = np.pi / 2.0 - seen['theta'][mine]
    contact = seen['truth_id'][mine].astype(np.int64)
    messages = _turns(time, distance, azimuth, period)
    position = distance[:, None] * np.stack([np.cos(azimuth), np.sin(azimuth)], axis=1)
    plots = PlotRows(time, position, contact)
    known = np.isin(flights['track'], contact[contact >= 0])
    truth = Truth.of(
        flights['track'][known].astype(np.int64),
        flights['t'][known],
        columns_of(flights, 'e', 'n')[known] - origin,
        columns_of(flights, 've', 'vn')[known],
        np.abs(flights['omega'][known]) > _TURNING,
    )
    return Recording(name, preset, messages, plots, truth, stretches_of(plots, messages),
                     _EN_ROUTE_RADIUS, period)  # fmt: skip


def _turns(time: Floats, distance: Floats, azimuth: Floats, period: float) -> tuple[Plots, ...]:
    """Return a message for every turn, stamped with its start."""
    order = np.argsort(time, kind='stable')
    time, distance, azimuth = time[order], distance[order], azimuth[order]
    last = int(time[-1] // period)
    cuts = np.searchsorted(time, period * np.arange(last + 2))
    return tuple(
        replace(Plots.polar(time[a:b], distance[a:b], azimuth[a:b]), stamp=k * period)
        for k, (a, b) in enumerate(pairwise(cuts))
    )


def stretches_of(plots: PlotRows, messages: tuple[Plots, ...]) -> Stretches:
    """Return what ought to be held: each contact from its fourth plot to its last."""
    stamps = np.array([message.stamp for message in messages])
    scan = np.searchsorted(stamps, plots.time, side='right') - 1
    return Stretches.of_plots(plots.contact, scan)


def columns_of(d: Columns, first: str, second: str) -> Floats:
    """Return two columns as positions or velocities (K, 2)."""
    return np.stack([d[first], d[second]], axis=1).astype(np.float64)


def load(folder: Path, name: str) -> Columns:
    """Return the columns of an archive."""
    with np.load(folder / f'{name}.npz') as archive:
        return {column: archive[column] for column in archive.files}
