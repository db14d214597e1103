# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How well a tracker is doing, in the words and numbers of /diagnostics."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
import math
import time

from tracking_core.batches import Floats
from tracking_session.session import Session

NEAR_CAPACITY = 0.9  # of max_tracks
QUIET = 5.0  # s without plots that are worth a warning
PAUSES = 2.0  # between plots, the same of an antenna that turns slowly
LONGEST = 30.0  # s between plots; a longer pause is none of the antenna


@dataclass
class Health:
    """Times of the last step and of the last messages, and what was complained about so far."""

    started: float  # when the node became active, by a clock that never goes back [s]
    step_time: float = 0.0  # of the last plots message [s]
    step_cpu: float = 0.0  # the same of the processor [s]
    latency: float = math.nan  # from arrival to tracks [s]
    plots_at: float = -math.inf  # when the last plots came, by the same clock [s]
    pause: float = 0.0  # between the last two plots [s]
    ownship_at: float = -math.inf
    shared: tuple[str, ...] = ()  # topics of ours on which others publish, too
    unheard: tuple[str, ...] = ()  # inputs on which all publishers are of another type or QoS
    _told: Counter[str] = field(default_factory=Counter)  # complaints up to the last report
    _begun: tuple[float, float] = (0.0, 0.0)

    def plots_come(self, now: float) -> None:
        """Take note that plots came now, and how long after the last ones."""
        known = math.isfinite(self.plots_at)
        self.pause, self.plots_at = min(now - self.plots_at, LONGEST) if known else 0.0, now

    def step_begins(self) -> None:
        """Start both clocks of a step."""
        self._begun = time.perf_counter(), time.thread_time()

    def step_ends(self) -> None:
        """Take note of how long it took."""
        begun, used = self._begun
        self.step_time, self.step_cpu = time.perf_counter() - begun, time.thread_time() - used

    def level(self, session: Session, now: float) -> tuple[str, str]:
        """Return level and message: all that is wrong at the moment, the worst first."""
        wrong = '; '.join(chain(self._silences(session, now), self._warnings(session)))
        return ('WARN', wrong) if wrong else ('OK', 'tracking')

    def _silences(self, session: Session, now: float) -> Iterator[str]:
        """Yield which inputs have stopped coming."""
        silent = now - max(self.plots_at, self.started)
        if silent > max(QUIET, PAUSES * self.pause):
            yield f'no {session.instrument.topic} for {silent:.0f} s'
        if session.whereabouts.transforms is not None:
            return  # tf2 tells
        alone = now - max(self.ownship_at, self.started)
        patience = max(QUIET, session.whereabouts.platform.max_extrapolation)
        if session.frame.needs_platform and alone > patience:
            yield f'no ownship for {alone:.0f} s'

    def _warnings(self, session: Session) -> Iterator[str]:
        """Yield what is wrong with the inputs that come."""
        topic, new = session.instrument.topic, _complaints(session) - self._told
        if new.pop(f'{topic} shed', 0):
            yield f'too slow: only the newest {topic} are used'
        if len(session.tracks) >= NEAR_CAPACITY * session.instrument.tracker.config.max_tracks:
            yield 'close to max_tracks'
        if crowded := self.crowded(session):
            yield f'several publishers on {" and ".join(crowded)}'
        if self.unheard:
            yield f'no publisher fits on {" and ".join(self.unheard)}'
        yield from sorted(new)
        doubts = chain(session.instrument.doubts(), session.whereabouts.doubts())
        yield from (doubt.what for doubt in doubts)

    def crowded(self, session: Session) -> list[str]:
        """Return the topics with several publishers where one is wanted."""
        sensors = (session.instrument.topic, 'ownship')  # orders may come from several consoles
        crowded = [name for name in sensors if session.counts[name].publishers > 1]
        return crowded + list(self.shared)

    def told(self, session: Session) -> None:
        """Take note that complaints up to now have been reported."""
        self._told = _complaints(session)

    def values(self, session: Session, now: float) -> dict[str, object]:
        """Return every number by name; ages and times in s."""
        tracks, report = session.tracks, session.instrument.tracker.state.report
        topic = session.instrument.topic
        capacity = session.instrument.tracker.config.max_tracks
        return {
            'tracks': len(tracks),
            'tracks confirmed': int(tracks.confirmed.sum()),
            'tracks capacity': capacity,
            'tracks refused (capacity)': report.refused,
            'tracks broken': report.broken,
            'tracks approximate': report.approximate,
            f'{topic} used': report.plots,
            f'{topic} held': report.held,
            'clutter density': report.clutter_density,
            'clutter density, densest': report.densest_clutter,
            **_scatter(session.instrument.tracker.state.scatter.ratio),
            'step time [s]': self.step_time,
            'step CPU [s]': self.step_cpu,
            'latency [s]': self.latency,
            f'{topic} waited [s]': session.counts[topic].wait,
            f'{topic} waited in vain': session.counts[topic].in_vain,
            f'{topic} age [s]': now - self.plots_at,
            'ownship age [s]': now - self.ownship_at,
            'clock jumps': session.guard.jumps,
            f'{topic} silences': session.guard.silences,
            **{
                name: value
                for topic, count in session.counts.items()
                for name, value in count.values(topic).items()
            },
        }


def _scatter(ratio: Floats) -> dict[str, float]:
    """Return the noise of plots over what is told (d,), by axis."""
    axes = ('bearing',) if len(ratio) == 1 else ('range', 'azimuth', 'elevation')
    return {f'scatter in {axis}': times for axis, times in zip(axes, ratio.tolist(), strict=False)}


def _complaints(session: Session) -> Counter[str]:
    """Return what was lost, shed, refused and dropped so far, by topic and reason."""
    complaints = Counter({f'{session.instrument.topic} were silent': session.guard.silences})
    complaints.update(session.ledger.failures)
    for topic, count in session.counts.items():
        complaints[f'{topic} waited in vain for ownship'] += count.in_vain
        complaints[f'{topic} lost'] += count.lost
        complaints[f'{topic} shed'] += count.shed
        for reason, number in count.refused.items():
            complaints[f'{topic} refused: {reason}'] += number
        for reason, number in count.dropped.items():
            complaints[f'{topic} dropped: {reason}'] += number
    return complaints
