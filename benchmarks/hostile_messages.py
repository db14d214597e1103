# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages as an enemy would send them: healthy ones, spoilt at random in one to three ways.

Random bytes are refused at the first look; a healthy message with one thing wrong gets further.
Read ``column_faults.py`` and ``message_faults.py`` next: what can be wrong.
"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from benchmarks.column_faults import Columns, ODD_NUMBERS, ODD_TEXTS, OF_COLUMNS, Rng
from benchmarks.message_faults import Cloud, odd_stamp, OF_HEADER, OF_LAYOUT
from msg_adapters.table import DATATYPES

NO_NUMBERS = [np.nan, np.inf, 1e30]


def spoil(columns: Columns, stamp: float, frame: str, rng: Rng) -> Cloud:
    """
    Return a message that would be a healthy scan, were it not for one to three faults.

    Parameters
    ----------
    columns : dict of (M,) arrays
        Of the healthy scan.
    stamp : float
        Of the healthy scan [s].
    frame : str
        Of the healthy scan.
    rng : Generator
        Decides what is wrong.

    """
    nanoseconds = round(stamp * 1e9)
    sec, nanosec = divmod(nanoseconds, 1_000_000_000)
    cloud = Cloud(dict(columns), sec, nanosec, frame)
    chosen = [int(n) for n in rng.integers(0, 3, rng.integers(1, 4))]
    for fault in rng.choice(np.array(OF_COLUMNS), chosen.count(0)):
        cloud = replace(cloud, columns=fault(cloud.columns, rng))
    cloud = _lay_out(cloud)
    for fault in rng.choice(np.array(OF_LAYOUT), chosen.count(1)):
        cloud = fault(cloud, rng)
    for fault in rng.choice(np.array(OF_HEADER), chosen.count(2)):
        cloud = fault(cloud, rng)
    return cloud


def odd_odometry(frame: str, rng: Rng) -> Any:
    """Return an odometry whose pose is bad; one that is well-formed would be a lie."""
    numbers = [0.0, 0.0, 0.0, *rng.choice(ODD_NUMBERS, 4)]
    numbers[int(rng.integers(7))] = float(rng.choice(NO_NUMBERS))
    x, y, z, *q = map(float, numbers)
    pose = SimpleNamespace(
        position=SimpleNamespace(x=x, y=y, z=z),
        orientation=SimpleNamespace(**dict(zip('xyzw', q, strict=True))),
    )
    velocity = SimpleNamespace(**dict(zip('xyz', rng.choice(ODD_NUMBERS, 3), strict=True)))
    return SimpleNamespace(
        header=_odd_header(frame, rng),
        pose=SimpleNamespace(pose=pose, covariance=rng.choice(ODD_NUMBERS, 36)),
        twist=SimpleNamespace(twist=SimpleNamespace(linear=velocity)),
    )


def odd_point(frame: str, rng: Rng) -> Any:
    """Return a point that is nowhere; one that is somewhere would be an order."""
    position = rng.choice(ODD_NUMBERS, 3)
    position[rng.integers(3)] = rng.choice(NO_NUMBERS)
    point = SimpleNamespace(**dict(zip('xyz', map(float, position), strict=True)))
    return SimpleNamespace(header=_odd_header(frame, rng), point=point)


def _odd_header(frame: str, rng: Rng) -> Any:
    sec, nanosec = odd_stamp(rng)
    frame = str(rng.choice([*ODD_TEXTS, *[frame] * 10]))
    return SimpleNamespace(stamp=SimpleNamespace(sec=sec, nanosec=nanosec), frame_id=frame)


def _lay_out(cloud: Cloud) -> Cloud:
    """Return the cloud with its columns as bytes, as a healthy publisher would."""
    names = list(cloud.columns)
    kinds = [(f'f{n}', values.dtype, values.shape[1:]) for n, values in enumerate(
        cloud.columns.values())]  # fmt: skip
    dtype = np.dtype(kinds)
    rows = np.zeros(len(cloud.columns[names[0]]) if names else 0, dtype)
    for n, values in enumerate(cloud.columns.values()):
        rows[f'f{n}'] = values
    codes = {kind: code for code, kind in DATATYPES.items()}
    fields = [
        [names[n], dtype.fields[f'f{n}'][1], codes[v.dtype.str[1:]], int(np.prod(v.shape[1:]))]
        for n, v in enumerate(cloud.columns.values())
    ]
    sizes = {
        'height': 1, 'width': len(rows), 'point_step': dtype.itemsize,
        'row_step': dtype.itemsize * len(rows),
    }  # fmt: skip
    return replace(cloud, fields=fields, sizes=sizes, data=rows.tobytes())
