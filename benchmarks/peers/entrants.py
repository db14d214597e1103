# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Who takes part, by name; a library that is not installed stays away."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from typing import Any, Protocol

from benchmarks.peers.ours import ours
from benchmarks.peers.scenes import Knowledge
from tracking_core.batches import Floats, Ints

OURS = 'ours'
VARIANTS = ('ours_jpda', 'ours_gnn')  # of our own


class Runner(Protocol):
    """A tracker that is given one scan after the other."""

    def step(self, time: float, plots: Floats) -> tuple[Ints, Floats]:
        """Return ids (T,) and positions (T, d) of the tracks that it believes after a scan."""


@dataclass(frozen=True)
class Entrant:
    """A kind of tracker."""

    title: str
    make: Callable[[Knowledge], Runner]
    packages: dict[str, str]  # that it needs: name of the module and of the distribution

    @property
    def is_installed(self) -> bool:
        """Whether all that it needs is here."""
        return all(find_spec(module) for module in self.packages)

    @property
    def versions(self) -> dict[str, str]:
        """Return what is installed of it."""
        return {name: _version(name) for name in self.packages.values()}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return 'unknown'


def _from(module: str, name: str, *arguments: Any) -> Callable[[Knowledge], Runner]:
    """Return a maker that imports its library when it is asked, not before."""

    def make(knowledge: Knowledge) -> Runner:
        maker = getattr(import_module(f'benchmarks.peers.{module}'), name)
        return partial(maker, knowledge, *arguments)()

    return make


_STONE_SOUP = {'stonesoup': 'stonesoup', 'pyehm': 'pyehm'}
ENTRANTS = {
    OURS: Entrant('contact_tracking', ours, {}),
    'ours_jpda': Entrant('contact_tracking, JPDA', partial(ours, association='jpda'), {}),
    'ours_gnn': Entrant(
        'contact_tracking, global nearest', partial(ours, association='global_nearest'), {}
    ),
    'stone_soup': Entrant(
        'Stone Soup JPDA (EHM2)', _from('stone_soup', 'StoneSoup', 'jpda'), _STONE_SOUP
    ),
    'stone_soup_tree': Entrant(
        'Stone Soup JPDA (EHM2), k-d tree', _from('stone_soup', 'StoneSoup', 'jpda_tree'),
        _STONE_SOUP,
    ),
    'stone_soup_gnn': Entrant(
        'Stone Soup GNN, k-d tree', _from('stone_soup', 'StoneSoup', 'gnn_tree'), _STONE_SOUP
    ),
    'filterpy': Entrant(
        'FilterPy IMM, assignment', _from('kalman_banks', 'KalmanBanks'),
        {'filterpy': 'filterpy'},
    ),
    'nrl': Entrant('nrl-tracker JPDA', _from('nrl', 'NrlJpda'), {'pytcl': 'nrl-tracker'}),
}  # fmt: skip
