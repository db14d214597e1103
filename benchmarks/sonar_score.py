# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How well were the contacts of a record held? Tracks beside the truth, cycle by cycle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.sonar_recordings import DEGREE, Record
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.linalg import wrap_angle
from tracking_tools.scoring.continuity import purity

_STAYS = 100.0  # [rad] more than any angle: who was on a contact goes first


@dataclass(frozen=True)
class BearingRows:
    """The T confirmed tracks after a cycle."""

    id: Ints  # (T,)
    bearing: Floats  # (T,) [rad]
    range: Floats  # (T,) [m], NaN: not observable

    def __len__(self) -> int:
        return len(self.id)


@dataclass(frozen=True)
class BearingScore:
    """How well the contacts were held; shares and rms are of contact cycles within reach."""

    heard: float  # share with a mark near the contact
    coverage: float  # share with a confirmed track on the contact
    held: float  # the same, of those with a mark near
    purity: float  # share of the rows on a contact that are on the main contact of their track
    breaks: int  # a contact got another track than before
    swaps: int  # ... one that was on another contact before
    false_per_hour: float  # confirmed tracks that are on nothing for most of their rows
    bias: float  # median of the error [deg]
    error: float  # rms of the error, less the bias [deg]
    told: float  # share of the rows on a contact that tell a range
    range_error: float  # median of |error of the range| over the range, where told
    tracks: int


@dataclass(frozen=True)
class Match:
    """Which track was on each true row (N,), and what it said of it."""

    id: Ints  # -1: none
    error: Floats  # [rad], NaN: no track
    range: Floats  # [m], NaN: not told


def match(record: Record, rows: Sequence[BearingRows]) -> Match:
    """
    Return the tracks on the contacts, one to one, nearest first.

    Who was on a contact stays on it while near: close contacts do not swap by noise.
    """
    N = len(record.scan)
    found = Match(np.full(N, -1), np.full(N, np.nan), np.full(N, np.nan))
    last: dict[int, int] = {}
    for cycle, now in enumerate(rows):
        here = np.flatnonzero(record.scan == cycle)
        error = wrap_angle(now.bearing[:, None] - record.bearing[here])
        near = np.abs(error) < record.near
        before = np.array([last.get(int(c), -1) for c in record.contact[here]], np.int64)
        cost = np.abs(error) - _STAYS * (near & (now.id[:, None] == before))
        cost[~near] = np.inf
        while np.isfinite(cost).any():
            row, column = np.unravel_index(cost.argmin(), cost.shape)
            at = here[column]
            found.id[at], found.error[at] = now.id[row], error[row, column]
            found.range[at] = now.range[row]
            last[int(record.contact[at])] = int(now.id[row])
            cost[row], cost[:, column] = np.inf, np.inf
    return found


def score(record: Record, rows: Sequence[BearingRows]) -> BearingScore:
    """Compare the tracks after every cycle with the truth."""
    found, heard = match(record, rows), _heard(record)
    on, wanted = found.id >= 0, record.distance <= record.reach
    length = {int(i): 0 for now in rows for i in now.id}
    for now in rows:
        for number in now.id.tolist():
            length[number] += 1
    contacts = {i: record.contact[found.id == i] for i in length}
    false = sum(len(contacts[i]) < 0.5 * length[i] for i in length)
    breaks, swaps = _changes(record, found.id)
    error = found.error[on] / DEGREE
    told = on & np.isfinite(found.range)
    relative = np.abs(found.range[told] / record.distance[told] - 1.0)
    hours = (record.cycles[-1].stamp - record.cycles[0].stamp) / 3600.0
    return BearingScore(
        heard=_mean(heard[wanted]),
        coverage=_mean(on[wanted]),
        held=_mean(on[wanted & heard]),
        purity=purity(found.id[on], record.contact[on]) if on.any() else 0.0,
        breaks=breaks,
        swaps=swaps,
        false_per_hour=false / hours,
        bias=float(np.median(error)) if len(error) else np.nan,
        error=float(np.sqrt(np.mean((error - np.median(error)) ** 2))) if len(error) else np.nan,
        told=_mean(told[on]),
        range_error=float(np.median(relative)) if len(relative) else np.nan,
        tracks=len(length),
    )


def _mean(values: Bools) -> float:
    return float(values.mean()) if len(values) else np.nan


def _heard(record: Record) -> Bools:
    """Return for which true rows (N,) there is a mark near."""
    heard = np.zeros(len(record.scan), bool)
    for cycle, marks in enumerate(record.cycles):
        here = np.flatnonzero(record.scan == cycle)
        off = np.abs(wrap_angle(marks.bearing[:, None] - record.bearing[here]))
        heard[here] = off.min(axis=0, initial=np.inf) < record.near
    return heard


def _changes(record: Record, found: Ints) -> tuple[int, int]:
    """Return how often contacts lost their track for another one, and for one of another."""
    breaks, swaps, owner = 0, 0, {}
    last: dict[int, int] = {}
    for contact, number in zip(record.contact.tolist(), found.tolist(), strict=True):
        if number < 0:
            continue
        before = last.get(contact)
        if before is not None and before != number:
            breaks += 1
            swaps += owner.get(number, contact) != contact
        last[contact], owner[number] = number, contact
    return breaks, swaps
