# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which rows get into the page, and how: columns by name, as little-endian bytes in base64.

All times count from the beginning of the recording [s]. Lengths are in the unit of the plan where
they are drawn, bearings in degrees from north clockwise. Rows of one `piece` are joined by a line.
"""

from __future__ import annotations

from base64 import b64encode
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msg_adapters.table import Columns
from tracking_core.batches import Floats
from tracking_core.chances import chi_square_bound
from tracking_tools.bearing_frame import frame_of_tracks
from tracking_tools.bearing_scene import BearingScene
from tracking_tools.evaluation.rows import has_heights
from tracking_tools.report.plan import plan_unit, single
from tracking_tools.scene import choose, Scene
from tracking_tools.scoring.stretches import absences

ELLIPSE = 0.95  # of the true places inside the covariance ellipse
LIGHTS = (0.95, 0.999)  # share of right innovations below amber and below red
GREEN, AMBER, RED, DARK = 0, 1, 2, 3


def encode(columns: Columns) -> dict[str, dict[str, str]]:
    """Return columns as the page's script reads them."""
    return {name: _encode(values) for name, values in columns.items()}


def _encode(values: NDArray[Any]) -> dict[str, str]:
    kind = values.dtype.newbyteorder('<')
    name = {'f': 'Float', 'u': 'Uint', 'i': 'Int'}[kind.kind]
    data = b64encode(np.ascontiguousarray(values, kind).tobytes()).decode()
    return {'type': f'{name}{8 * kind.itemsize}Array', 'data': data}


def track_columns(scene: Scene | BearingScene) -> Columns:
    """Return the rows of all confirmed tracks, sorted by track, then time."""
    table = scene.published if isinstance(scene, Scene) else scene.tracks
    table = choose(table, np.lexsort((table['stamp'], table['id'])))
    common = {
        'id': table['id'].astype(np.uint32),
        'stamp': table['stamp'],
        'time': table['time'],
        'piece': _pieces(table['id'], table['stamp']),
        'existence': _known(table, 'existence_probability'),
        'manoeuvre': _known(table, 'manoeuvre_probability'),
        'nis': _known(table, 'nis'),
        'coasted': (_known(table, 'coasted') > 0).astype(np.uint8),
        **{name: table[name] for name in modes_of(table)},
    }
    if isinstance(scene, Scene):
        return {
            **common,
            **_plan_columns(table, plan_unit(scene)),
            'light': lights(table, plan_dimensions(table)),
        }
    return {**common, **_bearing_columns(scene, table), 'light': lights(table, 1)}


def modes_of(table: Columns) -> list[str]:
    """Return the names of the columns of mode probabilities."""
    return [name for name in table if name.startswith('p_') and name[2:].isdigit()]


def plan_dimensions(table: Columns) -> int:
    """Return how many coordinates a radar's plot has."""
    return 3 if has_heights(table) else 2


def lights(table: Columns, dimensions: int) -> NDArray[np.uint8]:
    """Return of each row whether its NIS is usual, rare, very rare, or not there."""
    nis = _known(table, 'nis')
    bounds = [chi_square_bound(share, dimensions) for share in LIGHTS]
    light = np.searchsorted(bounds, np.nan_to_num(nis))
    dark = ~np.isfinite(nis) | (_known(table, 'coasted') > 0)
    return np.where(dark, DARK, light).astype(np.uint8)


def _pieces(ids: NDArray[Any], time: Floats) -> NDArray[np.uint32]:
    """Return the numbers of the pieces that rows sorted by id and time are of."""
    begins: NDArray[np.uint32] = np.zeros(len(ids), np.uint32)
    begins[absences(ids, time)] = 1
    return np.cumsum(begins, dtype=np.uint32)


def _plan_columns(table: Columns, unit: float) -> Columns:
    full = table['covariance'].reshape(-1, 6, 6)
    major, minor, angle = ellipses(full[:, :2, :2])
    places = {name: single(table[name] / unit) for name in ('x', 'y')}
    lengths = {'z': table['z'], 'vx': table['vx'], 'vy': table['vy'],
               'gate_x': _known(table, 'gate_x'), 'gate_y': _known(table, 'gate_y'),
               'major': major, 'minor': minor}  # fmt: skip
    scaled = {name: (values / unit).astype(np.float32) for name, values in lengths.items()}
    names = ('speed', 'course')
    return {**places, **scaled, 'angle': angle, **{name: _known(table, name) for name in names}}


def ellipses(covariance: Floats) -> tuple[Floats, Floats, Floats]:
    """
    Return the ellipses that hold the true place with probability `ELLIPSE`.

    Parameters
    ----------
    covariance : (N, 2, 2) array
        Of x and y.

    Returns
    -------
    major, minor : (N,) arrays
        Half axes, in the unit of the coordinates.
    angle : (N,) array
        Of the major axis from x [rad].

    """
    values, vectors = np.linalg.eigh(covariance)
    half = np.sqrt(np.maximum(values, 0.0) * chi_square_bound(ELLIPSE, 2))
    angle = np.arctan2(vectors[:, 1, 1], vectors[:, 0, 1])
    return half[:, 1], half[:, 0], angle.astype(np.float32)


def _bearing_columns(scene: BearingScene, table: Columns) -> Columns:
    frame = frame_of_tracks(scene)
    degrees = {name: np.degrees(_known(table, name)).astype(np.float32)
               for name in ('bearing_sd', 'gate')}  # fmt: skip
    return {
        'bearing': frame.degrees(table['bearing']).astype(np.float32),
        **degrees,
        **{name: _known(table, name) for name in ('range', 'range_sd', 'speed', 'course')},
    }


def plot_columns(scene: Scene | BearingScene) -> Columns:
    """Return all plots or marks, sorted by time."""
    if isinstance(scene, Scene):
        part, unit = scene.plots, plan_unit(scene)
    else:
        part, unit = scene.marks, 1.0
    if not len(part.get('time', ())):
        return {}
    part = choose(part, np.argsort(part['time'], kind='stable'))
    if isinstance(scene, BearingScene):
        degrees = frame_of_tracks(scene).degrees(part['bearing']).astype(np.float32)
        return {'time': part['time'], 'bearing': degrees, 'snr': part['snr'].astype(np.float32)}
    return {'time': part['time'], **{n: single(part[n] / unit) for n in ('x', 'y')}}


def truth_columns(scene: Scene | BearingScene) -> Columns:
    """Return all true places, sorted by contact, then time."""
    if not scene.has_truth:
        return {}
    part = choose(scene.truth, np.lexsort((scene.truth['time'], scene.truth['id'])))
    known = {'id': part['id'].astype(np.uint32), 'time': part['time'],
             'piece': _pieces(part['id'], part['time'])}  # fmt: skip
    if isinstance(scene, BearingScene):
        degrees = frame_of_tracks(scene).degrees(part['bearing']).astype(np.float32)
        return {**known, 'bearing': degrees}
    unit = plan_unit(scene)
    return {**known, **{n: single(part[n] / unit) for n in ('x', 'y')}}


def _known(table: Columns, name: str) -> Floats:
    """Return a column, NaN where the table does not have it."""
    return np.asarray(table.get(name, np.full(len(table['id']), np.nan)), np.float32)
