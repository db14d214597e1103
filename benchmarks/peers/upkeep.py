# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When do tracks of a library that has filters but no track management live? Plots counted."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import count
from typing import Generic, TypeVar

Filter = TypeVar('Filter')
CONFIRM, WINDOW, DROP, DROP_NEW = 3, 5, 5, 2


@dataclass
class Life(Generic[Filter]):
    """A track and what became of its last looks."""

    id: int
    filter: Filter
    looks: list[bool] = field(default_factory=lambda: [True])
    confirmed: bool = False

    def look(self, hit: bool) -> None:
        """Remember whether a scan had a plot of the track."""
        self.looks = [*self.looks[-max(WINDOW, DROP) + 1 :], hit]
        self.confirmed |= sum(self.looks[-WINDOW:]) >= CONFIRM

    @property
    def lives(self) -> bool:
        """Whether it had a plot lately."""
        return any(self.looks[-(DROP if self.confirmed else DROP_NEW) :])


class Lives(Generic[Filter]):
    """All tracks of one tracker."""

    def __init__(self) -> None:
        self.all: list[Life[Filter]] = []
        self._ids = count(1)

    def start(self, filters: list[Filter]) -> None:
        """Start tentative tracks."""
        self.all += [Life(next(self._ids), one) for one in filters]

    def end(self) -> None:
        """Drop those without plots."""
        self.all = [life for life in self.all if life.lives]

    @property
    def confirmed(self) -> list[Life[Filter]]:
        """Those that are believed."""
        return [life for life in self.all if life.confirmed]
