# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How does the decomposed mixed-Markov filter of [ZHUK09] do on scenario Z-0? Runs and figures.

An aircraft at 500 m/s, 225 to 130 km away, turns and climbs hard; 76 contacts 10 s apart.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from studies.figures import Figures, rms
from studies.passes import measure, run, Step
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.composition import Plane
from tracking_core.estimators.markov_jump import MarkovJump
from tracking_core.mode_chain import ModeChain
from tracking_core.motion import ConstantVelocity
from tracking_tools.scenarios.studies import z0_path

Spans = tuple[tuple[int, int], ...]  # from, to [s]

PERIOD = 10.0  # [s]
CONTACTS = 76
SD = np.array([300.0, np.deg2rad(0.166), np.deg2rad(0.166)])  # [m], [rad]
SEED = 20090528
TURNS = ((180, 210), (290, 330), (520, 550))  # [s]
CLIMBS = ((240, 280), (420, 460), (520, 550))  # [s]
SETTLED = 6  # contact from which the filter is no longer starting
PLANES = {'horizontal': TURNS, 'vertical': CLIMBS}
AXES = {'x': TURNS, 'y': TURNS, 'z': CLIMBS}


@dataclass(frozen=True)
class Record:
    """What the figures are made of: K contacts (two-point start: NaN before 2), T runs."""

    manoeuvre_probability: dict[str, Floats]  # (K, T) by plane
    predicted_sd: dict[str, Floats]  # (K, T, 3) by output [m]; map: of the mode that wins at k
    error: dict[str, Floats]  # (K, T, 3) by output [m], and of the plots
    in_gate: Bools  # (K, T, 3)


def paper_planes() -> tuple[Plane, ...]:
    """Return the filters of the paper: 3 and 35 m/s^2 horizontal, 3 and 25 m/s^2 vertical."""
    chain = ModeChain.staying(0.9, PERIOD)
    level = tuple(ConstantVelocity(sd) for sd in (3.0, 35.0))
    height = tuple(ConstantVelocity(sd, axes=1) for sd in (3.0, 25.0))
    return Plane(MarkovJump(level, chain), (0, 1)), Plane(MarkovJump(height, chain), (2,))


def play(runs: int, quiet: bool = True) -> Record:
    """Run the filter over Z-0, all runs as one batch."""
    truth = z0_path().at(PERIOD * np.arange(CONTACTS))[0]
    noise = np.random.default_rng(SEED).standard_normal((runs, CONTACTS, 3))
    measured = measure(truth, SD, noise)
    steps = run(paper_planes(), measured, PERIOD, quiet)
    mean, sd = _on_axes(steps, lambda step: step.predicted.moments())
    plot_sd = np.sqrt(np.einsum('ktdd->ktd', measured.covariance))
    return Record(
        manoeuvre_probability={
            name: _from_start([1.0 - step.updated.mode_probability[:, 0] for step in plane])
            for name, plane in zip(PLANES, steps, strict=True)
        },
        predicted_sd={'mmse': sd, 'map': _on_axes(steps, _winner)[1]},
        error={
            'plot': measured.position - truth[:, None],
            'mmse': _on_axes(steps, lambda s: s.updated.moments())[0] - truth[:, None],
            'map': _on_axes(steps, lambda s: s.updated.most_probable())[0] - truth[:, None],
        },
        in_gate=np.abs(measured.position - mean) <= 3.0 * np.hypot(sd, plot_sd),
    )


def figures(record: Record, runs: Ints) -> Figures:
    """Return all figures, by name, from these runs."""
    busy = _contacts(TURNS, last=2) | _contacts(CLIMBS, last=2)
    quiet = ~busy & (np.arange(CONTACTS) >= SETTLED)
    inside = record.in_gate[:, runs]
    result = {'gate all': float(inside[2:].mean(axis=(0, 1)).min())}
    for plane, spans in PLANES.items():
        decided = record.manoeuvre_probability[plane][:, runs] > 0.5
        result |= {f'{plane} {name}': x for name, x in _decisions(decided, spans, quiet).items()}
    error = {name: values[:, runs] for name, values in record.error.items()}
    for axis, (letter, spans) in enumerate(AXES.items()):
        first = [start // int(PERIOD) + 1 for start, _ in spans]
        grown = _contacts(spans, first=1, last=1)
        calm = ~_contacts(spans, last=2) & (np.arange(CONTACTS) >= SETTLED)
        result[f'gate manoeuvre {letter}'] = float(inside[busy, :, axis].mean())
        for output in ('map', 'mmse'):
            sd = record.predicted_sd[output][:, runs, axis]
            result[f'{output} growth {letter}'] = rms(sd[grown]) / rms(sd[calm])
            ratio = rms(error[output][first, :, axis]) / rms(error['plot'][first, :, axis])
            result[f'{output} first contact {letter}'] = ratio
    for output in ('map', 'mmse'):
        for phase, rows in (('manoeuvre', busy), ('quiet', quiet)):
            ratio = rms(error[output][rows]) / rms(error['plot'][rows])
            result[f'{output} error {phase}'] = ratio
    return result


def _decisions(decided: Bools, spans: Spans, quiet: Bools) -> Figures:
    """Return how soon a plane's decisions (K, T) follow its manoeuvres, how many are false."""
    begun = np.diff(decided.astype(np.int64), axis=0, prepend=0) > 0
    result = {
        'false decisions': float(begun[quiet].mean()),
        'manoeuvre while quiet': float(decided[quiet].mean()),
    }
    onset = _delays(decided, [start for start, _ in spans], least=1)
    release = _delays(~decided, [end for _, end in spans], least=0)
    for change, delay in (('onset', onset), ('release', release)):
        result[f'{change} found'] = float(np.mean(delay <= 3.0))
        result[f'{change} delay'] = float(np.nanmean(delay))
    return result


def _delays(decided: Bools, times: list[int], least: int) -> Floats:
    """Return contacts from each time to the decision (changes times T,), NaN if there is none."""
    delays = []
    for time in times:
        after = decided[time // int(PERIOD) + least :]
        found = np.argmax(after, axis=0) + float(least)
        delays.append(np.where(after.any(axis=0), found, np.nan))
    return np.concatenate(delays)


def _contacts(spans: Spans, first: int = 0, last: int = 0) -> Bools:
    """Return the contacts (K,) whose preceding interval overlaps a span, ends moved so far."""
    k = np.arange(CONTACTS)
    inside = [(k > start / PERIOD + first) & (k <= end / PERIOD + last) for start, end in spans]
    return np.asarray(np.any(inside, axis=0))


def _on_axes(
    steps: list[list[Step]], estimate: Callable[[Step], tuple[Floats, Floats]]
) -> tuple[Floats, Floats]:
    """Return position and its sd (K, T, 3) of what is estimated at every step."""
    mean, sd = [], []
    for step in zip(*steps, strict=True):
        of_planes = [estimate(plane) for plane in step]
        mean.append(np.concatenate([m[:, 0::2] for m, _ in of_planes], axis=1))
        variance = [np.einsum('tnn->tn', P)[:, 0::2] for _, P in of_planes]
        sd.append(np.sqrt(np.concatenate(variance, axis=1)))
    return _from_start(mean), _from_start(sd)


def _from_start(steps: list[Floats]) -> Floats:
    """Return steps in one array, NaN for the two contacts of the start."""
    values = np.stack(steps)
    return np.concatenate([np.full((2, *values.shape[1:]), np.nan), values])


def _winner(step: Step) -> tuple[Floats, Floats]:
    """Return the forecast of the mode that turns out most probable."""
    prior = replace(step.predicted, mode_probability=step.updated.mode_probability)
    return prior.most_probable()
