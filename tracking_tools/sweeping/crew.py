# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Who does the runs: this process, all cores of this machine, or a Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import as_completed, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
import multiprocessing
import os
import signal
import tempfile
from tempfile import TemporaryDirectory
from threading import RLock, Thread
import time
from typing import Any

from tqdm import tqdm

from tracking_tools.sweeping.tasks import Task
from tracking_tools.sweeping.work import work

WORKERS_WAIT = 60.0  # for the first worker of a Dask scheduler [s]


@dataclass(frozen=True)
class RunFailed:
    """What is there instead of the result of a run that cannot be done."""

    why: str  # and which run it was


Outcome = str | RunFailed
Done = Generator[tuple[Task, Outcome], None, None]  # as they come
Crew = Callable[[Sequence[Task]], Done]
ORPHAN_CHECK = 1.0  # [s]


class SweepFailed(RuntimeError):  # noqa: N818 (it is the sweep that has failed)
    """Nobody can do runs any more; says why."""


def crew_of(jobs: int, scheduler: str | None) -> Crew:
    """Return who works: a Dask scheduler's workers, so many processes, or this one."""
    if scheduler is not None:
        return lambda tasks: by_dask(tasks, scheduler)
    return alone if jobs == 1 else lambda tasks: by_processes(tasks, jobs)


def cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, 'sched_getaffinity'):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def alone(tasks: Sequence[Task]) -> Done:
    """Do one task after the other, here."""
    for task in tasks:
        yield task, _outcome(task, partial(work, task))


def by_processes(tasks: Sequence[Task], jobs: int) -> Done:
    """Do the tasks on several cores; processes are spawned, so that no thread is copied."""
    if not tasks:
        return
    with TemporaryDirectory(prefix='sweep_') as folder, _pool(jobs, folder) as pool:
        with _one_thread_each():
            futures = {pool.submit(work, task): task for task in tasks}
        for future in as_completed(futures):
            yield futures[future], _outcome(futures[future], future.result)


@contextmanager
def _pool(jobs: int, folder: str) -> Iterator[ProcessPoolExecutor]:
    """Provide processes whose temporary files are in this folder; an error ends them at once."""
    context = multiprocessing.get_context('spawn')
    pool = ProcessPoolExecutor(jobs, context, _begin, (os.getpid(), folder))
    try:
        yield pool
    except BaseException:  # Ctrl-C above all: what runs is not waited for
        for process in list((pool._processes or {}).values()):  # no public way to end them
            process.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """Let the processes that are spawned meanwhile have one thread for linear algebra."""
    name = 'OMP_NUM_THREADS'
    before = os.environ.get(name)
    os.environ.setdefault(name, '1')
    try:
        yield
    finally:
        if before is None:
            del os.environ[name]


def _begin(parent: int, folder: str) -> None:
    """Leave Ctrl-C to the parent, do not outlive it, and put what is temporary in its folder."""
    tempfile.tempdir = folder
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    tqdm.set_lock(RLock())  # its own is a semaphore, which is left behind where a process is ended
    Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(ORPHAN_CHECK)
    os._exit(1)


def by_dask(tasks: Sequence[Task], scheduler: str) -> Done:
    """
    Do the tasks on the workers of a Dask scheduler.

    What a worker had when it died is done by another. Results come back here, so workers need
    the package, and recordings at the same paths, but no folder in common.
    """
    if not tasks:
        return
    distributed = _import_dask()
    with _connected(distributed, scheduler) as client:
        futures = {client.submit(work, task, key=task.key): task for task in tasks}
        try:
            for future in distributed.as_completed(futures, loop=client.loop):
                yield futures[future], _outcome(futures[future], future.result)
        finally:
            client.cancel(list(futures))


def _import_dask() -> Any:
    try:
        import distributed  # noqa: PLC0415 (an extra that only this needs)
    except ImportError as error:
        raise SweepFailed(f'Dask is not installed ({error}): pip install distributed'
                          ) from error  # fmt: skip
    return distributed


@contextmanager
def _connected(distributed: Any, scheduler: str) -> Iterator[Any]:
    """Provide a client of the scheduler, which has a worker at least."""
    try:
        distributed.comm.get_address_host_port(scheduler)  # a client of none takes a minute to end
        client = distributed.Client(scheduler, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise SweepFailed(f'no Dask scheduler at {scheduler}: {error}') from error
    with client:
        try:
            client.wait_for_workers(1, timeout=WORKERS_WAIT)
        except TimeoutError as error:
            raise SweepFailed(
                f'the Dask scheduler {scheduler} had no worker for {WORKERS_WAIT:.0f} s'
            ) from error
        yield client


def _outcome(task: Task, result: Callable[[], str]) -> Outcome:
    """Return the result of a task, or which one it was and why there is none."""
    try:
        return result()
    except BrokenProcessPool as error:
        raise SweepFailed(f'a process was ended from outside: {error}') from error
    except Exception as error:
        values = ', '.join(f'{name}={value}' for name, value in task.values)
        where = f'{task.source.name}, seed {task.seed}, {values or "defaults"}'
        return RunFailed(f'{where}: {type(error).__name__}: {error}')
