# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C ends every command with a line and the exit code of an interrupted program."""

from importlib import import_module
from typing import Any

import pytest

from tracking_tools.stopping import STOPPED

COMMANDS = [
    ('evaluate', 'evaluate', 'find_sensor', ['BAG', '--truth', 'BAG']),
    ('report', 'report.command', 'find_sensor', ['BAG', '--output', 'PAGE']),
    ('simulate', 'simulate', 'record', ['terminal', '--output', 'BAG']),
    ('marker_picture', 'marker_picture', 'play', ['BAG', '--params', 'P', '--output', 'PNG']),
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
