# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C and a closed pipe end every command without a traceback, with the usual exit code."""

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
import os
from pathlib import Path
import signal
import subprocess
import sys
import time
from typing import Any

import pytest

from tracking_tools.bags import BagWriter
from tracking_tools.stopping import HUNG_UP, STOPPED, TERMINATED, UNREAD

DEMO = Path(__file__).parents[2] / 'demo' / 'terminal_area'
PATIENCE = 60.0  # [s]

COMMANDS = [
    ('evaluate', 'evaluate', 'find_sensor', ['BAG', '--truth', 'BAG']),
    ('report', 'report.command', 'find_sensor', ['BAG', '--output', 'PAGE']),
    ('simulate', 'simulate', 'record', ['terminal', '--output', 'BAG']),
    ('marker_picture', 'marker_picture', 'play', ['BAG', '--params', 'radar', '--output', 'PNG']),
    ('sweep', 'sweep', '_plan', ['crossing', '--output', 'DIR']),
    ('nmea', 'nmea.__main__', 'run', ['FILE', '--bag', 'BAG']),
    ('asterix', 'asterix.__main__', 'run', ['FILE', '--bag', 'BAG']),
    ('ais', 'ais.__main__', 'run', ['udp://127.0.0.1:10110']),
    ('replay', 'replay', 'replay', ['BAG', '--sensor', 'radar', '--output', 'OUT']),
    ('replay', 'replay', 'read_configs', ['BAG', '--sensor', 'radar', '--output', 'OUT']),
]


@pytest.mark.parametrize(('name', 'module', 'work', 'words'), COMMANDS)
def test_interrupted_command_says_so(
    name: str, module: str, work: str, words: list[str],
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Any,
) -> None:  # fmt: skip
    """A KeyboardInterrupt out of the command's work is no traceback."""

    def interrupt(*_: Any, **__: Any) -> Any:
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    command = import_module(f'tracking_tools.{module}')
    monkeypatch.setattr(command, work, interrupt)
    assert command.main(words) == STOPPED
    assert capsys.readouterr().err.startswith(f'{name}: stopped')


@pytest.mark.parametrize('unbuffered', ['', '1'])
def test_command_that_nobody_reads_ends_quietly(unbuffered: str) -> None:
    """As in evaluate ... | head -1, whether Python writes at once or at the end."""
    read, write = os.pipe()
    os.close(read)
    command = [sys.executable, '-m', 'tracking_tools.simulate', '--list']
    environment = {**os.environ, 'PYTHONUNBUFFERED': unbuffered}
    with os.fdopen(write, 'wb') as pipe:
        done = subprocess.run(
            command, stdout=pipe, stderr=subprocess.PIPE, env=environment, check=False
        )
    assert done.stderr == b''
    assert done.returncode == UNREAD


@pytest.mark.parametrize('unbuffered', ['', '1'])
def test_full_disk_is_said_in_words(unbuffered: str) -> None:
    """As in evaluate ... > FILE, whether Python writes at once or at the end."""
    command = [sys.executable, '-m', 'tracking_tools.simulate', '--list']
    environment = {**os.environ, 'PYTHONUNBUFFERED': unbuffered}
    with Path('/dev/full').open('wb') as full:
        done = subprocess.run(
            command, stdout=full, stderr=subprocess.PIPE, env=environment, check=False
        )
    assert done.stderr.decode().strip() == 'simulate: [Errno 28] No space left on device'
    assert done.returncode == 1


@pytest.mark.parametrize(
    ('number', 'code'), [(signal.SIGTERM, TERMINATED), (signal.SIGHUP, HUNG_UP)]
)
def test_terminated_replay_leaves_nothing_behind(number: int, code: int, tmp_path: Path) -> None:
    """As by timeout, or where a terminal is closed: half a bag under a hidden name is lost."""
    with replaying(tmp_path, 'env', '--default-signal=HUP') as process:  # whoever tests in nohup
        process.send_signal(number)
        assert process.wait(PATIENCE) == code
    assert list(tmp_path.iterdir()) == []


def test_replay_under_nohup_goes_on(tmp_path: Path) -> None:
    """Who is told to ignore that the terminal closes does so."""
    with replaying(tmp_path, 'nohup') as process:
        process.send_signal(signal.SIGHUP)
        assert process.wait(PATIENCE) == 0
    assert [path.name for path in tmp_path.iterdir()] == ['tracks']


@contextmanager
def replaying(folder: Path, *before: str) -> Iterator[subprocess.Popen[bytes]]:
    """Yield a replay that has begun to write into a folder."""
    words = [str(DEMO), '--sensor', 'radar', '--output', str(folder / 'tracks'), '--quiet']
    command = [*before, sys.executable, '-m', 'tracking_tools.replay', *words]
    with subprocess.Popen(command, stdin=subprocess.DEVNULL) as process:
        deadline = time.monotonic() + PATIENCE
        while not list(folder.glob('.tracks.*/*')):
            assert process.poll() is None
            assert time.monotonic() < deadline, 'nothing is written in time'
            time.sleep(0.01)
        yield process


def test_writer_that_a_signal_overtakes_leaves_nothing_behind(tmp_path: Path) -> None:
    """It may come when the folder is made and before the writer is entered."""
    writer = BagWriter(tmp_path / 'tracks')
    assert list(tmp_path.iterdir())
    with pytest.warns(ResourceWarning, match='cleaning up'):
        del writer
    assert list(tmp_path.iterdir()) == []
