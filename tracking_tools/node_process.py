# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How a node is run as a process of its own, in a ROS graph that nobody else is in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
import fcntl
import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile
import time
from typing import IO

from tracking_tools.watch import Watch

DOMAIN_IDS = range(1, 101)
PATIENCE = 10.0  # for a node to end after SIGINT [s]
DEADLINE = 20.0  # for a node to say something [s]; discovery takes 2.4 s on a loaded machine
SHOWN = 20  # lines of a node's log where a test has failed
LOOK = 0.02  # between two looks into the log [s]

_locks: dict[int, int] = {}  # file descriptor of the lock by domain id


class NodeFailed(RuntimeError):  # noqa: N818 (it is the node that failed)
    """A node that does not do what it should; says how it ended and where its log is."""


@contextmanager
def private_domain() -> Iterator[int]:
    """
    Yield a ROS domain id that no other user of this function has, on this machine alone.

    The nodes that run in it hold it too: one that outlives whoever started it meets nobody.
    """
    folder = Path(tempfile.gettempdir(), f'contact_tracking_domains_{os.getuid()}')
    folder.mkdir(exist_ok=True)
    first = os.getpid() % len(DOMAIN_IDS)  # seldom where somebody else's nodes were left alone
    for domain_id in (*DOMAIN_IDS[first:], *DOMAIN_IDS[:first]):
        with (folder / str(domain_id)).open('w') as lock:
            if _is_locked(lock):
                _locks[domain_id] = lock.fileno()
                try:
                    yield domain_id
                finally:
                    del _locks[domain_id]
                return
    raise NodeFailed(f'all ROS domains of {DOMAIN_IDS} are taken; see {folder}')


def _is_locked(lock: IO[str]) -> bool:
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def python_node(module: str, *ros_arguments: str) -> list[str]:
    """Return the command of a node in a Python module, with the arguments after --ros-args."""
    return [sys.executable, '-m', module, '--ros-args', *ros_arguments]


class NodeProcess:
    """
    A node that runs as long as the context does.

    Parameters
    ----------
    command : sequence of str
        Program and arguments; see `python_node`.
    domain_id : int
        ROS domain; the node keeps to this machine.
    log : Path or str
        File for what it says.
    patience : float
        For it to end after it was asked to [s].
    folder : Path or str, optional
        Where it runs.

    """

    def __init__(
        self,
        command: Sequence[str],
        domain_id: int,
        log: Path | str,
        patience: float = PATIENCE,
        folder: Path | str | None = None,
    ) -> None:
        self._command, self._folder = list(command), folder
        self._held = [_locks[domain_id]] if domain_id in _locks else []
        self._environment = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain_id),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }
        self.log_file, self._patience = Path(log), patience
        self.exit_code: int | None = None

    def __enter__(self) -> NodeProcess:
        with self.log_file.open('wb') as out:
            self.process = subprocess.Popen(  # noqa: S603 (a list, no shell; its caller's words)
                self._command,
                cwd=self._folder,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                env=self._environment,
                pass_fds=self._held,
                start_new_session=True,  # a Ctrl-C at the terminal is ours to pass on
            )
        self._watch = Watch(self.process.pid, self._patience)
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        self.exit_code = self.stop()
        if isinstance(error, (AssertionError, TimeoutError)):  # of a test: pytest shows it
            print(f'The node of {self.log_file} said last:', *self._last_lines(SHOWN), sep='\n')

    @property
    def log(self) -> str:
        """Everything said so far."""
        return self.log_file.read_text(errors='replace')

    def wait_for_line(self, text: str, deadline: float = DEADLINE) -> str:
        """
        Return the first line of the log with this text, waiting for it.

        Raises
        ------
        NodeFailed
            If the node ends without it, or has not said it within `deadline` [s].

        """
        end = time.monotonic() + deadline
        while True:
            has_ended, is_late = self.process.poll() is not None, time.monotonic() > end
            for line in self.log.splitlines(keepends=True):
                if text in line and line.endswith('\n'):
                    return line
            if has_ended or is_late:
                raise NodeFailed(f'the node never said {text!r}, see {self.log_file}:\n{self.log}')
            with suppress(subprocess.TimeoutExpired):
                self.process.wait(LOOK)

    def check(self) -> None:
        """Raise NodeFailed if the node has ended."""
        code = self.process.poll()
        if code is not None:
            raise NodeFailed(
                f'the node ended with code {code}; last lines of {self.log_file}:\n'
                + '\n'.join(self._last_lines(3))
            )

    def _last_lines(self, count: int) -> list[str]:
        return self.log.strip().splitlines()[-count:]

    def signal(self, number: int) -> None:
        """Send a signal, as a terminal does: also to what the command has started."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, number)

    def wait(self, deadline: float = DEADLINE) -> int:
        """Return the exit code of a node that ends by itself within `deadline` [s]."""
        return self.process.wait(deadline)

    def stop(self) -> int:
        """Ask the node to end, insist if it does not, and return its exit code."""
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # an impatient user must wait
        try:
            for request in (signal.SIGINT, signal.SIGTERM):
                self.signal(request)
                with suppress(subprocess.TimeoutExpired):
                    return self.process.wait(self._patience)
            self.signal(signal.SIGKILL)
            return self.process.wait()
        finally:
            self._watch.end()
            signal.signal(signal.SIGINT, before)
