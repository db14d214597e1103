# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do the runs of scenario V-0 look like? Marks, tracks through the crossing, errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from studies import pictures
from studies.v0_crossing import NEAR, OURS, PAPER, RESOLUTION, Run, run, SEED
from studies.v0_scenes import DEGREE, marks, truth
from tracking_core.batches import Floats

TIME, BEARING = 'time [s]', 'true bearing [deg]'
NAMES = ('stronger', 'weaker')
FINITE_MEMORY = {**PAPER, 'estimator': 'finite_memory'}
_SMOOTH = 15  # cycles over which errors are averaged


def record(path: Path) -> str:
    """Draw what the array hears in one run of NOMINAL; return the Markdown that shows it."""
    figure, axes = pictures.panels(2, 1, width=9.0, height=2.7)
    time, bearing, platform = truth('nominal')
    heard = marks('nominal', SEED, np.inf)
    when = np.concatenate([one.time for one in heard])
    where = np.concatenate([one.bearing for one in heard]) + platform.at(when).yaw
    level = np.concatenate([one.snr for one in heard])
    top, bottom = axes[:, 0]
    dots = top.scatter(when, _compass(where), c=level, s=5, cmap='viridis', vmin=5.0, label='mark')
    figure.colorbar(dots, ax=top, label='level [dB]', pad=0.01)
    _draw_truth(top, time, bearing)
    top.set_title('marks of one run, and where the contacts are', fontsize=10, loc='left')
    count = np.array([len(one) for one in heard])
    apart = np.abs(bearing[:, 0] - bearing[:, 1]) / DEGREE
    bottom.plot(time, apart, color=pictures.COLOURS[0], lw=1.5, label='separation [deg]')
    bottom.axhline(RESOLUTION / DEGREE, color='#d1495b', lw=1.0, ls='--',
                   label='limit of resolution at broadside [deg]')  # fmt: skip
    share = np.convolve(count, np.ones(_SMOOTH) / _SMOOTH, 'same')
    bottom.plot(
        time, share, color=pictures.COLOURS[2], lw=1.0, label='marks a cycle, half a minute'
    )
    bottom.set(xlabel=TIME, ylabel='degrees; marks', xlim=(0.0, time[-1]))
    bottom.legend(fontsize=8, frameon=False)
    return pictures.save(figure, path)


def tracks(path: Path) -> str:
    """Draw one run of the paper's tracker and of ours; return the Markdown that shows it."""
    figure, axes = pictures.panels(2, 1, width=9.0, height=3.2)
    time, bearing, _ = truth('nominal')
    for panel, (title, values) in zip(
        axes[:, 0], (("the paper's tracker", PAPER), ('ours', OURS)), strict=True
    ):
        _draw_truth(panel, time, bearing)
        _draw_tracks(panel, run('nominal', SEED, values, keep=True))
        panel.set_title(f'{title}: ids in the same run', fontsize=10, loc='left')
    return pictures.save(figure, path)


def errors(path: Path, kalman: Sequence[Run], memory: Sequence[Run]) -> str:
    """Draw errors of the first 1000 s over runs; return the Markdown that shows them."""
    figure, axes = pictures.panels(1, 2, width=9.0, height=3.2)
    time = truth('nominal')[0][: len(kalman[0].error)]
    for panel, contact in zip(axes[0], (0, 1), strict=True):
        curves = {
            name: _rms([one.error[:, contact] for one in found])
            for name, found in (('Kalman', kalman), ("finite memory, K' = 15", memory))
        }
        curves['marks, reported sd'] = _reported_sd(contact)[: len(time)]
        pictures.lines(panel, time, curves, TIME, 'bearing error, rms [deg]', NAMES[contact])
        panel.set_yscale('log')
    return pictures.save(figure, path)


def by_hand(path: Path, rows: Mapping[float, tuple[Floats, Floats]]) -> str:
    """Draw Table 2: tracking time and breaks by the sd [deg]; return the Markdown."""
    figure, axes = pictures.panels(1, 2, width=9.0, height=3.0)
    sd = np.array(list(rows))
    for k, (panel, up) in enumerate(
        zip(axes[0], ('tracking time (16)', 'breaks in 1000 s'), strict=True)
    ):
        curves = {name: np.array([row[k][c] for row in rows.values()])
                  for c, name in enumerate(NAMES)}  # fmt: skip
        pictures.lines(panel, sd, curves, 'sd of the marks, set by hand [deg]', up)
        panel.set_xscale('log')
    return pictures.save(figure, path)


def _compass(bearing: Floats) -> Floats:
    return 90.0 - bearing / DEGREE


def _draw_truth(panel: Any, time: Floats, bearing: Floats) -> None:
    for contact, style in enumerate(('-', '--')):
        panel.plot(time, _compass(bearing[:, contact]), color='#20262d', lw=0.9, ls=style,
                   label=f'{NAMES[contact]} contact')  # fmt: skip
    merged = time[np.abs(bearing[:, 0] - bearing[:, 1]) < RESOLUTION]
    pictures.shade(panel, {'one mark': (merged[0], merged[-1])})
    panel.set(xlabel=TIME, ylabel=BEARING, xlim=(0.0, time[-1]))
    panel.legend(loc='upper right', fontsize=8, frameon=False, ncols=3)


def _draw_tracks(panel: Any, one: Run) -> None:
    """Draw the confirmed tracks that were on a contact, with their ids at the start and end."""
    if one.record is None:
        raise ValueError('the run must keep its record')
    time, bearing, number = one.record
    for k, track in enumerate(np.unique(number)):
        mine = number == track
        x, y = time[mine], _compass(bearing[mine])
        colour = pictures.COLOURS[k % len(pictures.COLOURS)]
        panel.plot(x, y, '.', ms=2.5, color=colour)
        for at, side in ((0, 'bottom'), (-1, 'top')):
            panel.annotate(f'{track}', (x[at], y[at]), color=colour, fontsize=9, ha='center',
                           va=side, weight='bold')  # fmt: skip


def _rms(error: Sequence[Floats]) -> Floats:
    """Return the rms over runs and a few cycles [deg]; cycles without a track do not count."""
    square = np.array(error) ** 2
    there = np.isfinite(square)
    kernel = np.ones(_SMOOTH)
    total = np.convolve(np.where(there, square, 0.0).sum(axis=0), kernel, 'same')
    count = np.convolve(there.sum(axis=0), kernel, 'same')
    mean = np.divide(total, count, out=np.full(len(total), np.nan), where=count > 0)
    return np.asarray(np.sqrt(mean) / DEGREE)


def _reported_sd(contact: int) -> Floats:
    """Return what the array reports of the marks near a contact, in one run [deg]."""
    _, bearing, platform = truth('nominal')
    found = np.full(len(bearing), np.nan)
    for k, one in enumerate(marks('nominal', SEED, np.inf)):
        if len(one):
            off = np.abs(one.bearing + platform.at(one.time).yaw - bearing[k, contact])
            found[k] = one.bearing_sd[off.argmin()] if off.min() < NEAR else np.nan
    return _rms([found])
