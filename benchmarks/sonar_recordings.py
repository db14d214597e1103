# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which bearings of real movements are there? The shared data as cycles of marks."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tracking_core.batches import Bearings, Floats, Ints
from tracking_core.linalg import wrap_angle
from tracking_core.platform import Platform

DEGREE = np.pi / 180.0


@dataclass(frozen=True)
class Record:
    """One recording: marks by cycle, own ship, and where the contacts truly were."""

    name: str
    cycles: list[Bearings]
    platform: Platform
    scan: Ints  # (N,) of true rows
    contact: Ints  # (N,)
    bearing: Floats  # (N,) [rad]
    distance: Floats  # (N,) [m]
    near: float  # a track within this angle is on the contact [rad]
    reach: float  # contacts beyond are not asked for [m]
    source: list[Ints] = field(default_factory=list)  # by cycle: contact of each mark, -1: none


def vessels(folder: Path, name: str) -> Record:
    """Return bearings of vessels heard from a moving own ship."""
    d = np.load(folder / f'{name}.npz')
    time = d['scan_t']
    own = np.stack([d['own_e'], d['own_n']], axis=1).astype(float)
    return Record(
        name, cycles_of(time, d['meas_scan'], _to_enu(d['meas_bearing'])), own_ship(time, own),
        d['true_scan'].astype(np.int64), d['true_contact'].astype(np.int64),
        _to_enu(d['true_bearing']), d['true_range'].astype(float), 3.0 * DEGREE, 8000.0,
        by_cycle(len(time), d['meas_scan'], d['meas_contact'].astype(np.int64)),
    )  # fmt: skip


def camera(folder: Path, name: str, sensor: str) -> Record:
    """Return camera bearings of two boats from a moving ferry."""
    d = np.load(folder / f'{name}.npz')
    time = d[f'{sensor}_scan_t']
    own = np.stack([d[f'{sensor}_own_e'], d[f'{sensor}_own_n']], axis=1).astype(float)
    scans, contacts, bearings, ranges = [], [], [], []
    for boat in np.unique(d['truth_target']):
        mine = d['truth_target'] == boat
        at = [np.interp(time, d['truth_t'][mine], d[f'truth_{axis}'][mine]) for axis in 'en']
        line = np.stack(at, axis=1) - own
        scans.append(np.arange(len(time)))
        contacts.append(np.full(len(time), boat))
        bearings.append(np.arctan2(line[:, 1], line[:, 0]))
        ranges.append(np.hypot(line[:, 0], line[:, 1]))
    return Record(
        f'{name} {sensor}', cycles_of(time, d[f'{sensor}_scan'], _to_enu(d[f'{sensor}_bearing'])),
        own_ship(time, own), np.concatenate(scans), np.concatenate(contacts).astype(np.int64),
        np.concatenate(bearings), np.concatenate(ranges), 5.0 * DEGREE, np.inf,
    )  # fmt: skip


def _to_enu(compass: Floats) -> Floats:
    return wrap_angle(0.5 * np.pi - compass.astype(float))


def cycles_of(time: Floats, scan: Ints, bearing: Floats) -> list[Bearings]:
    """Return the cycles at times (K,) [s] from marks in order of their cycle (M,), (M,) [rad]."""
    ends = np.searchsorted(scan, np.arange(len(time) + 1))
    return [
        Bearings(
            np.full(last - first, now), bearing[first:last], np.full(last - first, np.nan),
            np.full(last - first, np.nan), float(now),
        )
        for now, first, last in zip(time, ends[:-1], ends[1:], strict=True)
    ]  # fmt: skip


def by_cycle(cycles: int, scan: Ints, source: Ints) -> list[Ints]:
    """Return the sources of the marks (M,) of each cycle."""
    return np.split(source, np.searchsorted(scan, np.arange(1, cycles)))


def own_ship(time: Floats, own: Floats) -> Platform:
    """Return own ship at positions (K, 2), with axes to the east and north."""
    K = len(time)
    flat = np.concatenate([own, np.zeros((K, 1))], axis=1)
    return Platform(
        time, flat, np.tile([0.0, 0.0, 0.0, 1.0], (K, 1)), np.gradient(flat, time, axis=0),
        np.zeros((K, 3, 3)), np.zeros(K), capacity=K + 1,
    )  # fmt: skip
