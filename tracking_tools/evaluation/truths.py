# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How does a truth table become the truth of a radar's or of a sonar's tracks?"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from msg_adapters.table import Columns
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.platform import Platform, pose_at
from tracking_tools.bags import BadBag
from tracking_tools.highlights import smooth_turn_rate
from tracking_tools.scene import choose
from tracking_tools.scoring import Truth

SAME = 1.0  # places of a contact that was told twice are not farther apart [m]
SLOWEST = 0.1  # below, a course means nothing [m/s]


def positions_of(table: Columns, turning: float) -> Truth:
    """
    Return a truth table as the truth of positions.

    Parameters
    ----------
    table : dict of columns
        id, time, x, y; z, vx, vy, vz where there are.
    turning : float
        A contact turns when its course changes faster than this [rad/s].

    """
    table = _complete(table)
    position, velocity = (_vectors(table, names) for names in ('xyz', ('vx', 'vy', 'vz')))
    return Truth.of(table['id'], table['time'], position, velocity, _turning(table, turning))


def bearings_of(table: Columns, platform: Platform | None, turning: float) -> Truth:
    """Return a truth table as bearings [rad] and their rates, as own ship sees them."""
    table = _complete(table)
    pose = pose_at(platform, table['time'])
    line = _vectors(table, 'xyz')[:, :2] - pose.position[:, :2]
    speed = _vectors(table, ('vx', 'vy', 'vz'))[:, :2] - pose.velocity[:, :2]
    square = np.maximum((line**2).sum(axis=1), 1e-12)
    rate = (line[:, 0] * speed[:, 1] - line[:, 1] * speed[:, 0]) / square
    bearing = np.arctan2(line[:, 1], line[:, 0])
    for contact in np.unique(table['id']):
        mine = table['id'] == contact
        bearing[mine] = np.unwrap(bearing[mine])
    return Truth.of(
        table['id'], table['time'], bearing[:, None], rate[:, None], _turning(table, turning)
    )


def ranges_of(table: Columns, platform: Platform | None) -> Columns:
    """Return how far from own ship each row is: id, time, range [m], sorted."""
    table = _complete(table)
    pose = pose_at(platform, table['time'])
    x, y = table['x'] - pose.position[:, 0], table['y'] - pose.position[:, 1]
    return {'id': table['id'], 'time': table['time'], 'range': np.hypot(x, y)}


def _complete(table: Columns) -> Columns:
    """Return the table sorted by contact and time, with all that a truth has."""
    table = {**table, 'id': _whole(table['id'])}
    _, once, same = np.unique(
        np.stack([table['id'], table['time']]), axis=1, return_index=True, return_inverse=True
    )
    _check_places(table, once[same.reshape(-1)])
    table = choose(table, once)  # sorted by contact, then time
    nothing = np.full(len(table['id']), np.nan)
    table['z'] = np.nan_to_num(table.get('z', nothing))  # if not all are known, none is compared
    for axis in 'xyz':
        told = table.get(f'v{axis}', nothing)
        table[f'v{axis}'] = np.where(np.isfinite(told), told, _slope(table, axis))
    return table


def _check_places(table: Columns, first: Ints) -> None:
    """Raise BadBag where a row is elsewhere than the first (M,) of its contact and time."""
    apart = np.hypot(table['x'] - table['x'][first], table['y'] - table['y'][first])
    if (apart > SAME).any():
        row = int(apart.argmax())
        raise BadBag(
            f'contact {table["id"][row]} of the truth is in two places at '
            f'{table["time"][row]:.3f} s, {apart[row]:.6g} m apart; each contact needs an id'
        )


def _whole(ids: NDArray[Any]) -> Ints:
    """Return ids as whole numbers; BadBag for those that a float has made of others."""
    if np.issubdtype(ids.dtype, np.floating):
        most = 2.0 ** (np.finfo(ids.dtype).nmant + 1)
        wrong = ids[(np.abs(ids) > most) | (ids % 1 != 0)]
        if len(wrong):
            raise BadBag(
                f'ids of the truth are {ids.dtype} and must be whole numbers up to {most:.0f}, '
                f'got {wrong[0]:.10g}: contacts that differ may have become one; write uint32'
            )
    return ids.astype(np.int64)


def _slope(table: Columns, axis: str) -> Floats:
    """Return how fast a coordinate changes where the truth does not tell [m/s]."""
    speed = np.zeros(len(table['id']))
    for contact in np.unique(table['id']):
        mine = table['id'] == contact
        if mine.sum() > 1:
            speed[mine] = np.gradient(table[axis][mine].astype(float), table['time'][mine])
    return speed


def _turning(table: Columns, limit: float) -> Bools:
    turns = np.zeros(len(table['id']), bool)
    for contact in np.unique(table['id']):
        mine = table['id'] == contact
        path = choose(table, mine)
        moves = np.hypot(path['vx'], path['vy']) > SLOWEST
        turns[mine] = moves & (np.abs(smooth_turn_rate(path)) > limit)
    return turns


def _vectors(table: Columns, names: str | tuple[str, ...]) -> Floats:
    return np.stack([table[name] for name in names], axis=1).astype(np.float64)
