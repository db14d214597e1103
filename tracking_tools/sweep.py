# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How good are the tracks over many runs and settings? The command."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
import signal
import sys
from typing import Any

from tqdm import tqdm

from tracking_tools.arguments import make_folder
from tracking_tools.evaluation.options import yardstick_of
from tracking_tools.parameter_file import configure, read_parameter_file
from tracking_tools.replay_topics import Topics
from tracking_tools.sensors import SENSORS
from tracking_tools.stopping import stoppable, STOPPED
from tracking_tools.sweeping.crew import Crew, crew_of, RunFailed, SweepFailed
from tracking_tools.sweeping.options import sweep_parser
from tracking_tools.sweeping.store import Figures, Store, write_whole
from tracking_tools.sweeping.table import Case, cases_of, to_json, to_text
from tracking_tools.sweeping.tasks import (
    check_apart,
    check_sensor,
    settings_of,
    source_of,
    swept_values,
    Task,
    tasks_of,
    Values,
)

Planned = list[tuple[Values, Task]]


def sweep(
    planned: Planned, store: Store, crew: Crew, quiet: bool = False
) -> tuple[list[Case], list[str]]:
    """
    Do what is not done yet; return the runs of every setting, and which runs failed and why.

    Parameters
    ----------
    planned : list of (setting, task)
        What is wanted.
    store : Store
        What is there; every run is kept as soon as it is done.
    crew : callable
        Who works.
    quiet : bool
        Without progress.

    Raises
    ------
    SweepFailed
        When nobody can do runs any more; those done are kept.

    """
    found = {task.key: store.read(task) for _, task in planned}
    todo = [task for _, task in planned if found[task.key] is None]
    bar = tqdm(
        total=len(planned), initial=len(planned) - len(todo), desc='sweep', unit='run',
        disable=quiet or None,
    )  # fmt: skip
    failed: dict[str, str] = {}
    with bar, closing(crew(todo)) as done:
        for task, outcome in done:
            if isinstance(outcome, RunFailed):
                failed[task.key] = outcome.why
            else:
                store.write(task, outcome)
            bar.update()
    results = [
        (setting, task, _whole(store, task)) for setting, task in planned if task.key not in failed
    ]
    return cases_of(results), list(failed.values())


def _whole(store: Store, task: Task) -> Figures:
    figures = store.read(task)
    if figures is None:
        raise SweepFailed(f'{store.path(task)} was taken away or changed while the sweep ran')
    return figures


@stoppable('sweep')
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    parser = sweep_parser()
    chosen = parser.parse_args(arguments)
    try:
        planned = _plan(chosen)
        store = Store(chosen.output)
    except (ValueError, OSError) as error:
        parser.error(str(error))
    try:
        with _terminate_as_interrupt():
            crew = crew_of(chosen.jobs, chosen.dask)
            cases, failed = sweep(planned, store, crew, chosen.quiet)
    except KeyboardInterrupt:
        done = sum(store.read(task) is not None for _, task in planned)
        print(f'sweep: stopped; {done} of {len(planned)} runs are kept in {chosen.output}, the '
              'same command goes on', file=sys.stderr)  # fmt: skip
        return STOPPED
    except (SweepFailed, OSError) as error:
        print(f'sweep: {error}', file=sys.stderr)
        return 1
    undrawn = _report(cases, chosen) if cases else []
    for why in [*failed, *undrawn]:
        print(f'sweep: {why}', file=sys.stderr)
    if failed:
        print(f'sweep: {len(failed)} of {len(planned)} runs failed; the same command tries them '
              'again', file=sys.stderr)  # fmt: skip
    return int(bool(failed or undrawn))


def _report(cases: list[Case], chosen: argparse.Namespace) -> list[str]:
    """Keep, print and draw what came out; return why there is no picture, if there is none."""
    text = to_text(cases)
    write_whole(chosen.output / 'summary.json', to_json(cases))
    write_whole(chosen.output / 'summary.txt', text + '\n')
    print(text)
    if chosen.picture is None:
        return []
    pictures = import_module('tracking_tools.sweeping.picture')  # matplotlib takes long
    try:
        make_folder(chosen.picture.parent)
        pictures.draw_sweep(cases, chosen.picture, chosen.figure)
    except OSError as error:
        return [f'no picture: {error}']
    return []


def _plan(chosen: argparse.Namespace) -> Planned:
    """Return all runs; refuse what cannot work before the first of them."""
    sensor = SENSORS[chosen.sensor]
    fixed: dict[str, Any] = {}
    if chosen.params is not None:
        fixed = read_parameter_file(chosen.params, f'/{sensor.node}')
    given = swept_values(chosen.set)
    fixed |= {name: values[0] for name, values in given.items() if len(values) == 1}
    settings = settings_of({name: v for name, v in given.items() if len(v) != 1})
    for setting in settings:
        configure(sensor.configs, {**fixed, **setting})
    if chosen.truth is not None and len(chosen.sources) > 1:
        raise ValueError(f'--truth is of one recording, got {len(chosen.sources)} sources')
    sources = [source_of(name, chosen.duration, chosen.truth) for name in chosen.sources]
    check_apart(sources)
    check_sensor(sources, chosen.sensor)
    Topics.remapped(chosen.remap, sensor)  # says what is wrong with a rule
    yardstick = yardstick_of(chosen, chosen.sensor)
    return list(
        tasks_of(
            sources, chosen.runs, settings, fixed, chosen.sensor, yardstick, _version(),
            chosen.remap,
        )
    )  # fmt: skip


def _version() -> str:
    try:
        return version('contact_tracking')
    except PackageNotFoundError:
        return 'unknown'


@contextmanager
def _terminate_as_interrupt() -> Iterator[None]:
    """Let SIGTERM stop the sweep as Ctrl-C does: no process is left behind."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


if __name__ == '__main__':
    sys.exit(main())
