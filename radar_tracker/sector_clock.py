# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
When was each plot seen, if only its message has a time?

Sectors follow each other as the antenna turns, so their stamps and the azimuths of their plots
tell its rate; the azimuth of a plot then tells when the antenna pointed there. Of full turns only
the middle is known, and that only where the user says that they are turns, with `scan.period`.
"""

from __future__ import annotations

import math

import numpy as np

from msg_adapters.bad_message import BadMessage
from radar_tracker.antenna import ONE_DIRECTION
from radar_tracker.config import ScanConfig
from radar_tracker.rotation import PERIODS
from radar_tracker.sector_turn import best_turn
from radar_tracker.sweep import Beam
from tracking_core.batches import Floats, Plots
from tracking_core.linalg import TURN, wrap_angle

_FEWEST, _SAMPLES = 12, 1000  # sectors with plots from which a turn is learnt
_RARELY = 4  # one try in so many sectors with plots
_STEPS = 15  # between stamps that are remembered
_CONVINCING = 3  # messages in a row that show that plots have times after all, or none any more
_APART = 0.02  # rad, between plots that no antenna sees at the same time
_MEMORY, _TOO_STRANGE = 50.0, 0.3  # messages, and share of plots far from where they should be


class SectorClock:
    """
    Tells the times of plots in sectors that come without them.

    Parameters
    ----------
    scan : ScanConfig
        What messages are; snapshots are left as they are.

    """

    def __init__(self, scan: ScanConfig) -> None:
        self._period = scan.period
        self._reach = {'start': 0.5, 'middle': 0.0, 'end': -0.5}[scan.time_reference]
        self._is_whole = scan.assembly == 'message' and scan.period > 0.0
        self._is_wanted = self._is_whole or scan.assembly in ('sector', 'rotation')
        self._has_times = False  # plots tell when they were seen
        self._odd = 0  # messages in a row that show the opposite
        self._was_known = False  # how the antenna turns
        self._last = np.nan  # stamp
        self._forget()

    def _forget(self) -> None:
        self._steps = np.zeros(0)  # from stamp to stamp [s]
        self._stamp, self._azimuth = np.zeros(0), np.zeros(0)  # of the plots while learning
        self._turn = 0.0  # of the antenna from one sector to the next [rad], 0: not known
        self._middle = 0.0  # of the last sector [rad]
        self._tries = 0
        self._strange = 0.0  # share of the last plots that were far from their sector

    @property
    def _is_needed(self) -> bool:
        return self._is_wanted and not self._has_times

    @property
    def beam(self) -> Beam | None:
        """Where the antenna points, None if plots tell their own times."""
        if not (self._is_needed and self._turn):
            return None
        step = self._step
        middle = self._last + self._reach * step
        return Beam(middle, self._middle, self._turn / step, middle + 0.5 * step)

    def times(self, plots: Plots) -> Floats:
        """
        Return when the antenna pointed at each plot (M,) [s].

        Parameters
        ----------
        plots : Plots
            Of one message, in sensor axes; those with times of their own keep them.

        Raises
        ------
        BadMessage
            If how the antenna turns is not known yet.

        """
        x, y, _ = plots.position.T
        azimuth = np.where(np.isnan(plots.azimuth), np.arctan2(y, x), plots.azimuth)
        is_timed = bool((plots.time != plots.stamp).any())
        self._note(is_timed, azimuth)
        if not self._is_needed or (is_timed and not self._turn):
            return plots.time
        if self._is_whole:
            return plots.time + self._reach * self._period
        self._follow(plots.stamp)
        if not self._turn:
            self._learn(plots.stamp, azimuth)
        if self._turn:
            return plots.stamp + (self._reach + self._place(azimuth)) * self._step
        if len(plots) or self._was_known:
            raise BadMessage(
                'rotation not known',
                'sectors tell no times of their plots, and how the antenna turns is not known '
                'yet: give each plot a time, or set scan.period',
            )
        return plots.time

    def span(self, plots: Plots) -> Floats:
        """Return moments (K,) [s] between which all plots of a message were seen."""
        told = np.append(plots.time, plots.stamp)
        length = self._period if self._is_whole else self._step if self._turn else 0.0
        if not self._is_needed or not length:
            return told
        return np.append(told, plots.stamp + (self._reach + np.array([-0.5, 0.5])) * length)

    def _note(self, is_timed: bool, azimuth: Floats) -> None:
        """Take note of whether plots tell their times, as soon as several messages show it."""
        if not is_timed and (np.abs(wrap_angle(azimuth - azimuth[:1])) < _APART).all():
            return  # all may have been seen just at the stamp
        self._odd = self._odd + 1 if is_timed != self._has_times else 0
        if self._odd == _CONVINCING:
            self._has_times, self._odd = is_timed, 0
            self._forget()

    @property
    def _step(self) -> float:
        """How long sectors last [s], those that were lost aside; 0 before the second one."""
        if not len(self._steps):
            return 0.0
        short = float(np.quantile(self._steps, 0.2))
        near = self._steps[np.abs(self._steps - short) <= 0.3 * short]
        return float(near.mean()) if len(near) else short

    def _follow(self, stamp: float) -> None:
        """Turn to the sector with this stamp."""
        if not abs(stamp - self._last) < PERIODS[1]:
            self._forget()
        elif stamp > self._last:
            self._steps = np.append(self._steps, stamp - self._last)[-_STEPS:]
        if self._turn:
            turned = self._turn * round((stamp - self._last) / self._step)
            self._middle = math.remainder(self._middle + turned, TURN)
        self._last = stamp

    def _place(self, azimuth: Floats) -> Floats:
        """
        Return where in its sector the antenna saw each plot, -0.5 to 0.5 from first to last.

        The middle of the sector is moved so that all fit in.
        """
        place = wrap_angle(azimuth - self._middle) / self._turn
        is_near = np.abs(place) < 1.0
        if is_near.any():
            most, least = place[is_near].max(), place[is_near].min()
            move = max(most - 0.5, 0.0) + min(least + 0.5, 0.0)
            self._middle += float(move) * self._turn
            place = place - move
        if len(place):
            self._strange += float(1.0 - is_near.mean() - self._strange) / _MEMORY
            if self._strange > _TOO_STRANGE:
                self._forget()
        return np.clip(place, -0.5, 0.5)

    def _learn(self, stamp: float, azimuth: Floats) -> None:
        """Find the turn at which plots lie in the sectors that their stamps tell."""
        one = azimuth[len(azimuth) // 2 :][:1]  # of each sector, so that many reach back far
        self._stamp = np.append(self._stamp, np.full(len(one), stamp))[-_SAMPLES:]
        self._azimuth = np.append(self._azimuth, one)[-_SAMPLES:]
        self._tries += len(one)
        step = self._step
        if len(self._azimuth) < _FEWEST or not step or self._tries % _RARELY:
            return
        alike = np.abs(np.exp(1j * self._azimuth).mean())
        if alike > ONE_DIRECTION and not self._period:
            return  # a lone contact fits many rates
        count = np.rint((self._stamp - stamp) / step)
        self._turn = best_turn(self._azimuth, count, step, self._period)
        if self._turn:
            self._was_known = True
            beam = np.exp(1j * (self._azimuth - self._turn * count))
            self._middle = float(np.angle(beam.sum()))
