# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Who does the runs: this process, all cores of this machine, or a Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import as_completed, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
import multiprocessing
import os
import signal
from threading import RLock, Thread
import time
from typing import Any

from tqdm import tqdm

from tracking_tools.sweeping.tasks import Task
from tracking_tools.sweeping.work import work

Done = Generator[tuple[Task, str], None, None]  # results as they come
Crew = Callable[[Sequence[Task]], Done]
ORPHAN_CHECK = 1.0  # [s]


class SweepFailed(RuntimeError):  # noqa: N818 (it is the sweep that has failed)
    """A run that cannot be done; says which."""


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
        with _naming(task):
            text = work(task)
        yield task, text


def by_processes(tasks: Sequence[Task], jobs: int) -> Done:
    """Do the tasks on several cores; processes are spawned, so that no thread is copied."""
    if not tasks:
        return
    context = multiprocessing.get_context('spawn')
    with _one_thread_each():
        pool = ProcessPoolExecutor(jobs, context, _begin, (os.getpid(),))
        futures = {pool.submit(work, task): task for task in tasks}
    try:
        for future in as_completed(futures):
            with _naming(futures[future]):
                text = future.result()
            yield futures[future], text
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


def _begin(parent: int) -> None:
    """Leave Ctrl-C to the parent, and do not outlive it."""
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
    with distributed.Client(scheduler, set_as_default=False) as client:
        futures = {client.submit(work, task, key=task.key): task for task in tasks}
        try:
            for future in distributed.as_completed(futures, loop=client.loop):
                with _naming(futures[future]):
                    text = future.result()
                yield futures[future], text
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
def _naming(task: Task) -> Iterator[None]:
    """Say which task it was that failed."""
    try:
        yield
    except BrokenProcessPool as error:
        raise SweepFailed(f'a process was ended from outside: {error}') from error
    except Exception as error:
        values = ', '.join(f'{name}={value}' for name, value in task.values)
        where = f'{task.source.name}, seed {task.seed}, {values or "defaults"}'
        raise SweepFailed(f'{where}: {type(error).__name__}: {error}') from error
