# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Where did the antenna point, and when?

Every plot of a rotating antenna lies where the antenna pointed at the plot's time, so azimuth and
time of the plots tell rate, direction and phase. They are learnt once, then followed.
"""

from __future__ import annotations

import numpy as np

from radar_tracker.gaps import is_missing, STAMPS
from radar_tracker.rotation import find_rate, IN_STEP, refine_rate, unevenness, worth_keeping
from radar_tracker.sweep import Beam, Sweep
from tracking_core.batches import Floats, NO_GAPS, Plots
from tracking_core.linalg import TURN

ONE_DIRECTION = 0.9  # mean resultant length of the azimuths of a quarter turn
_FEWEST = 8  # plots from which a rate is learnt
_SAMPLES = 400  # plots remembered
_INTERVALS = 5  # between messages, remembered
_EAGER = 20  # messages in which a rate is looked for; later in each of so many
_LONGEST = 2.0  # messages or turns that a plot may be off the stamp of its message
_AGREEING = 3  # messages; of as many that tell when they reach the middle one is believed
_LEAST = 1e-3  # of a turn that a message sweeps; nothing would be a look everywhere at once
_LATE = 0.02  # of a period by which messages of one stream may overlap or be apart


class Antenna:
    """Follows the rotation of one antenna from message to message."""

    def __init__(
        self,
        period: float,
        full_turns: bool,
        time_reference: str,
        stares: bool = False,
        collects: bool = False,
    ) -> None:
        self._period = period  # [s], 0: to be learnt
        self._full_turns = full_turns
        self._collects = collects  # messages are sectors that were put together to whole turns
        # End of a full turn after its stamp, in lengths of it; the plots' own times correct it.
        self._reach = {'start': 1.0, 'middle': 0.5, 'end': 0.0}[time_reference]
        self._spans = np.zeros((0, 2))  # of plots, after the last stamps [s]
        self._rate = 0.0  # [rad/s], 0: not known
        self._time, self._azimuth = np.zeros(0), np.zeros(0)
        self._stamps, self._end = np.zeros(0), -np.inf  # of the last messages [s]
        self._gaps = NO_GAPS
        self._uneven = 0.0  # by how much it may point elsewhere [rad]
        self._tries = 0
        self._stares = stares  # told so
        self._at_once = 0  # messages with plots of one moment all around, since plots told times

    @property
    def rotation_rate(self) -> float:
        """Learnt rate [rad/s], anticlockwise positive; 0 if the sensor does not rotate."""
        return self._rate

    @property
    def turn_time(self) -> float:
        """Time of one turn [s]; 0 if the sensor is not known to turn."""
        return TURN / abs(self._rate) if self._rate else 0.0

    @property
    def longest_offset(self) -> float:
        """Time between a plot and the stamp of its message that can be true [s]."""
        if not self._rate:
            return np.inf
        return _LONGEST * max(self.turn_time, self.interval)

    @property
    def interval(self) -> float:
        """How long it usually is from message to message [s], lost ones aside; 0: not known."""
        steps = np.sort(np.diff(self._stamps[-_INTERVALS - 1 :]))
        return float(steps[(len(steps) - 1) // 2]) if len(steps) else 0.0

    def follow(
        self, plots: Plots, azimuth: Floats, beam: Beam | None = None, part: float = 0.0
    ) -> Sweep:
        """
        Return what the message swept.

        Parameters
        ----------
        plots : Plots
            M plots with their times, and the stamp of the message.
        azimuth : (M,) array
            Of the plots in sensor axes [rad].
        beam : Beam, optional
            Where the antenna points; learnt from the plots without.
        part : float
            Of a turn that could not be collected whole, how long it is [s].

        """
        first = float(plots.time.min(initial=np.inf))
        last = float(plots.time.max(initial=-np.inf))
        if len(plots):
            span = np.array([[first, last]]) - plots.stamp
            self._spans = np.concatenate([self._spans, span])[-_AGREEING:]
        earlier = self._stamps[self._stamps < plots.stamp]
        self._stamps = np.concatenate((earlier, [plots.stamp]))[-STAMPS:]
        if beam is None:
            self._learn(plots.time, azimuth)
        else:
            self._rate, last = beam.rate, last if part else max(last, beam.end_time)
            self._time, self._azimuth = np.array([beam.time]), np.array([beam.azimuth])
        if self._full_turns and self._rate:
            start, end = self._turn(plots, part)
            return self._sweep(min(start, first), max(end, last))
        return self._sweep(min(plots.stamp, first), max(plots.stamp, last))

    def _turn(self, plots: Plots, part: float) -> tuple[float, float]:
        """
        Return from when to when the message is that is a full turn, or less if they overlap.

        The plots of the last messages must fit in; as much as they leave open, nothing changes.
        """
        period = self.turn_time
        length = period if self._collects else min(self.interval, period)
        if length and len(self._spans):
            first, last = np.sort(self._spans, axis=0).T
            earliest, latest = first[(len(first) - 1) // 2], last[len(last) // 2]
            self._reach = float(max(min(self._reach, earliest / length + 1.0), latest / length))
        start = plots.stamp + (self._reach - 1.0) * length
        return start, start + (part or length)

    def _sweep(self, start: float, end: float) -> Sweep:
        last, self._end = self._end, end
        if self._rate == 0.0:
            return Sweep(start, end)
        period = self.turn_time
        contiguous = (
            bool(abs(start - last) < _LATE * period)
            if self._full_turns
            else 0.0 <= end - last < 0.75 * period and not is_missing(self._stamps, period)
        )
        if contiguous:
            start = min(last, end)
        elif start > last:
            self._gaps = (*self._gaps[1:], (last, start))
        end = self._end = max(end, start + _LEAST * period)
        phase, angle = self._phase_at(start), self._rate * (end - start)
        return Sweep(start, end, phase, angle, self._gaps, self._uneven)

    def _phase_at(self, time: float) -> float:
        """Return where the antenna pointed at this time [rad]."""
        beam = self._azimuth - self._rate * (self._time - time)
        return float(np.arctan2(np.sin(beam).sum(), np.cos(beam).sum()))

    def _learn(self, time: Floats, azimuth: Floats) -> None:
        """Follow the rate, or find it."""
        if self._stares or self._is_at_once(time, azimuth) or self._at_once >= _AGREEING:
            return
        if len(time) > _SAMPLES // 2:
            evenly = np.arange(_SAMPLES // 2) * (len(time) - 1) // (_SAMPLES // 2 - 1)
            time, azimuth = time[evenly], azimuth[evenly]
        self._time = np.concatenate([self._time, time])[-_SAMPLES:]
        self._azimuth = np.concatenate([self._azimuth, azimuth])[-_SAMPLES:]
        kept = worth_keeping(self._time, self.turn_time, self._period)
        self._time, self._azimuth = self._time[kept], self._azimuth[kept]
        span = np.ptp(self._time) if len(self._time) else 0.0
        if len(self._time) < _FEWEST or span <= 0.0:
            return
        if self._rate:
            self._refine()
        elif (self._period or self._has_directions()) and self._is_worth_a_try():
            interval = self.interval if self._full_turns and not self._collects else 0.0
            self._rate = find_rate(self._time, self._azimuth, self._period, interval)
            if self._rate:
                self._refine()

    def _is_at_once(self, time: Floats, azimuth: Floats) -> bool:
        """Return whether plots of one moment came from several directions, and count it."""
        if len(time) and np.ptp(time) > 0.0:
            self._at_once = 0
        elif not self._rate and np.abs(np.exp(1j * azimuth).sum()) < IN_STEP * len(azimuth):
            self._at_once += 1
            return True
        return False

    def _has_directions(self) -> bool:
        """Return whether plots came from all over; a lone contact fits many rates."""
        return bool(np.abs(np.exp(1j * self._azimuth).mean()) < ONE_DIRECTION)

    def _is_worth_a_try(self) -> bool:
        """Return whether to look for a rate: costly, so less and less often in vain."""
        self._tries += 1
        return self._tries <= _EAGER or self._tries % _EAGER == 0

    def _refine(self) -> None:
        """Fit the rate to the remembered plots; forget it when they are not on the beam."""
        self._rate = refine_rate(self._time, self._azimuth, self._rate)
        self._uneven = unevenness(self._time, self._azimuth, self._rate)
        if not self._rate:
            self._time, self._azimuth = self._time[-50:], self._azimuth[-50:]
