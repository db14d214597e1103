# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What does association cost? Milliseconds per scan of every method on scenes from easy to dense.

Run ``python -m benchmarks.association_cost``. The last column is `jpda` with belief propagation
in all clusters of more than two tracks: judge by ratios within one run.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import perf_counter

import numpy as np
from scipy.spatial import KDTree

from tracking_core.association import ASSOCIATORS, jpda
from tracking_core.batches import Association, Floats, Ints

Scene = tuple[Ints, Ints, Floats, Floats, int]
DETECTION = 0.9  # probability
DISTANCE = 9.2  # Mahalanobis squared at the edge of the gate


def scattered(tracks: int, plots: int, expected: float, rng: np.random.Generator) -> Scene:
    """Return tracks anywhere on a unit square; `expected` plots fall in a gate by chance."""
    radius = np.sqrt(expected / plots / np.pi)
    position = rng.random((tracks, 2))
    seen = position[rng.random(tracks) < DETECTION]
    seen += rng.normal(0.0, radius / np.sqrt(DISTANCE), seen.shape)
    clutter = rng.random((max(plots - len(seen), 0), 2))
    where = np.concatenate([seen, clutter])
    near = KDTree(where).query_ball_point(position, radius, return_sorted=True)
    track = np.repeat(np.arange(tracks), [len(row) for row in near])
    plot = np.concatenate([np.asarray(row, np.int64) for row in near])
    distance = DISTANCE * np.sum((position[track] - where[plot]) ** 2, axis=1) / radius**2
    return track, plot, 2.0 - distance / 2.0, np.full(tracks, np.log(0.1)), len(where)


def formations(groups: int, size: int, rng: np.random.Generator) -> Scene:
    """Return groups of `size` tracks that share all of their `size` to `size` + 2 plots."""
    plots = rng.integers(size, size + 3, groups)
    first = np.cumsum(plots) - plots
    track = np.repeat(np.arange(groups * size), np.repeat(plots, size))
    start = np.flatnonzero(np.diff(track, prepend=-1))
    plot = np.arange(len(track)) - start[track] + first[track // size]
    weight = rng.normal(1.0, 2.0, len(track))
    return track, plot, weight, np.full(groups * size, np.log(0.1)), int(plots.sum())


def cost(associate: Callable[..., Association], scene: Scene, runs: int = 30) -> float:
    """Return the median time of one call [ms]."""
    times = []
    for _ in range(runs):
        start = perf_counter()
        associate(*scene)
        times.append(perf_counter() - start)
    return 1e3 * float(np.median(times))


def main() -> None:
    """Print one line per scene."""
    rng = np.random.default_rng(1)
    scenes = {
        f'{tracks} tracks, {share} by chance': scattered(tracks, 2 * tracks, share, rng)
        for tracks in (200, 1000, 10_000)
        for share in (0.05, 0.3, 0.7)
    }
    for size in (4, 8):
        scenes[f'200 tracks in {size}s'] = formations(200 // size, size, rng)
    methods = {**ASSOCIATORS, 'propagation': partial(jpda, largest=0)}
    print(f'{"scene":32}{"pairs":>7}' + ''.join(f'{name:>16}' for name in methods))
    for name, scene in scenes.items():
        times = ''.join(f'{cost(method, scene):16.2f}' for method in methods.values())
        print(f'{name:32}{len(scene[0]):7}{times}')


if __name__ == '__main__':
    main()
