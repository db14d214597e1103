# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Do marks stay where they are while own ship turns?

Contacts hardly move in so short a time. If the marks turn with own ship, or twice as far, their
bearings are not counted as the parameters say.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from tracking_core.batches import Floats, Scan
from tracking_core.linalg import wrap_angle

TURNS = np.array([0.0, 1.0, 2.0, -1.0])  # of marks over that of own ship; the first: as told
_OLDEST = 60.0  # s, of marks to compare with
_LEAST_TURN = 0.1  # rad, of own ship
_NEAR, _APART = 3.0, 2.0  # sds that marks of one contact are off; reaches that turns must part
_RATE = 1e-3  # rad/s, of usual contacts
_FEWEST, _MOST = 24, 200  # marks; then older ones count half
_CROWD = 100  # marks of a cycle, among which any turn fits
_SURELY, _FEW = 4.0, 0.5  # sds that more marks fit than what is told; these, as a part of them


@dataclass
class TurnCheck:
    """Count the marks that fit marks of before own ship turned, by how far those turned too."""

    _time: float = -np.inf  # of the marks to compare with [s]
    _heading: float = 0.0  # then [rad]
    _bearing: Floats = field(default_factory=lambda: np.zeros(0))  # [rad]
    _fits: Floats = field(default_factory=lambda: np.zeros(len(TURNS)))
    _marks: float = 0.0

    def note(self, scan: Scan, heading: float) -> None:
        """Take note of the marks of a cycle, own ship having this heading [rad]."""
        bearing, now = scan.position[:, 0], scan.coverage.end_time
        if not 0 < len(bearing) <= _CROWD or now <= self._time:
            return
        age, turned = now - self._time, float(wrap_angle(np.array(heading - self._heading)))
        if age < _OLDEST:
            if abs(turned) < _LEAST_TURN:
                return
            sd = float(np.sqrt(np.median(scan.covariance)))
            reach = _NEAR * np.sqrt(2.0) * sd + _RATE * age
            if abs(turned) < _APART * reach:
                return
            self._count(bearing, turned, reach)
        self._time, self._heading, self._bearing = now, heading, bearing

    @property
    def turn(self) -> float:
        """How far marks turn over own ship's turn, one of `TURNS`; 0 unless that is plain."""
        best = int(self._fits.argmax())
        told, most = self._fits[0], self._fits[best]
        is_plain = most - told > _SURELY * np.sqrt(most + told) and told < _FEW * most
        return float(TURNS[best]) if self._marks >= _FEWEST and is_plain else 0.0

    def _count(self, bearing: Floats, turned: float, reach: float) -> None:
        moved = bearing[:, None] - self._bearing  # (M, N)
        off = np.abs(wrap_angle(moved[..., None] - TURNS * turned)).min(axis=1)
        older = 0.5 if self._marks > _MOST else 1.0
        self._fits = older * self._fits + (off < reach).sum(axis=0)
        self._marks = older * self._marks + len(bearing)
