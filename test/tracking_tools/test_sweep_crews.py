# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check who does a sweep: one process, several, a Dask cluster; and what interruptions leave."""

from collections.abc import Iterator
from contextlib import contextmanager
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
from threading import Thread
import time

import pytest

from tracking_tools.sweep import main

ROOT = Path(__file__).parents[2]
TINY = ('crossing', '--duration', '20', '--quiet', '--set', 'association=jpda,nearest')
PATIENCE = 60.0  # [s]


def results(folder: Path) -> dict[str, bytes]:
    """Return all result files by name."""
    return {path.name: path.read_bytes() for path in (folder / 'runs').glob('*.json')}


def wait_for_results(folder: Path, count: int, process: subprocess.Popen[bytes]) -> None:
    """Wait until so many runs are done, or fail."""
    deadline = time.monotonic() + PATIENCE
    while len(results(folder)) < count:
        if process.poll() is not None:
            pytest.fail(f'ended before it was interrupted: {process.communicate()[1].decode()}')
        assert time.monotonic() < deadline, 'no results in time'
        time.sleep(0.02)


@contextmanager
def running(*command: str) -> Iterator[subprocess.Popen[bytes]]:
    """Run a Python module, and end it at last."""
    process = subprocess.Popen(
        [sys.executable, '-m', *command], cwd=ROOT, stderr=subprocess.PIPE, stdout=subprocess.PIPE
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@pytest.fixture(scope='module')
def alone(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Return the results of six seeds and two settings, done by one process."""
    folder = tmp_path_factory.mktemp('alone')
    assert main([*TINY, '--runs', '6', '--jobs', '1', '--output', str(folder)]) == 0
    return results(folder)


def children_of(pid: int) -> list[int]:
    """Return the processes that a process has started and that still run, without starting one."""
    listed = Path(f'/proc/{pid}/task').glob('*/children')
    return [int(word) for path in listed for word in path.read_text(encoding='utf-8').split()]


def is_running(pid: int) -> bool:
    """Return whether there is such a process, and not only its remains."""
    try:
        state = Path(f'/proc/{pid}/stat').read_text(encoding='utf-8').rsplit(') ', 1)[1][0]
    except FileNotFoundError:
        return False
    return state != 'Z'


def wait_until_gone(processes: list[int]) -> None:
    """Wait until all have ended, or fail; the tracker of semaphores ends a little later."""
    deadline = time.monotonic() + PATIENCE
    while left := [pid for pid in processes if is_running(pid)]:
        assert time.monotonic() < deadline, f'left behind: {left}'
        time.sleep(0.02)


@pytest.mark.slow
@pytest.mark.skipif(
    not Path('/proc/thread-self/children').exists(), reason='looks for processes in /proc'
)
def test_processes_are_stopped_and_gone_on_with(
    alone: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C leaves whole results, no process, no temporary file; the same command goes on."""
    temporary = tmp_path / 'temporary'
    temporary.mkdir()
    monkeypatch.setenv('TMPDIR', str(temporary))
    for attempt in range(5):  # on a busy machine all may be done before the signal is sent
        folder = tmp_path / str(attempt)
        command = [*TINY, '--runs', '6', '--jobs', '2', '--output', str(folder)]
        with running('tracking_tools.sweep', *command) as process:
            wait_for_results(folder, 1, process)
            workers = children_of(process.pid)
            process.send_signal(signal.SIGINT)
            _, error = process.communicate(timeout=PATIENCE)
        if process.returncode != 0:
            break
    assert process.returncode == 130, error.decode()
    assert b'the same command goes on' in error
    assert b'Traceback' not in error
    assert b'leaked' not in error
    assert workers
    wait_until_gone(workers)
    assert list(temporary.iterdir()) == []
    kept = results(folder)
    assert kept.items() <= alone.items()
    assert main([*command, '--jobs', '1']) == 0
    assert results(folder) == alone


def kill_half_way(folder: Path, worker: int) -> None:
    """Kill a process once two runs are done."""
    deadline = time.monotonic() + PATIENCE
    while len(results(folder)) < 2 and time.monotonic() < deadline:
        time.sleep(0.02)
    os.kill(worker, signal.SIGKILL)


@pytest.mark.slow
def test_dask_loses_nothing_when_a_worker_dies(alone: dict[str, bytes], tmp_path: Path) -> None:
    """Two workers, one killed half-way: every run is done, with the bytes of one process."""
    distributed = pytest.importorskip('distributed')
    where = {'host': '127.0.0.1', 'dashboard_address': None}
    with distributed.LocalCluster(2, threads_per_worker=1, silence_logs=50, **where) as cluster:
        killer = Thread(target=kill_half_way, args=(tmp_path, cluster.workers[0].pid))
        killer.start()
        command = [*TINY, '--runs', '6', '--dask', cluster.scheduler_address]
        assert main([*command, '--output', str(tmp_path)]) == 0
        killer.join()
    assert results(tmp_path) == alone


def test_dask_address_that_is_none_is_told_at_once(tmp_path: Path) -> None:
    """Without a port there is nobody to wait for; a client of Dask needs a minute to give up."""
    with running(
        'tracking_tools.sweep', *TINY, '--dask', 'tcp://127.0.0.1', '--output', str(tmp_path)
    ) as process:
        _, said = process.communicate(timeout=PATIENCE / 2.0)
    assert process.returncode == 1
    assert re.fullmatch(r'sweep: no Dask scheduler at tcp://127.0.0.1: .*port.*\n', said.decode())
