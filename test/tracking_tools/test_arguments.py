# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Arguments that cannot be used are refused before anything is done."""

from importlib import import_module

import pytest

COMMANDS = [
    ('replay', ['BAG', '--sensor', 'radar', '--output', 'OUT', '--picture']),
    ('replay', ['BAG', '--sensor', 'radar', '--output', 'OUT', '--report']),
    ('report.command', ['BAG', '--output']),
    ('evaluate', ['BAG', '--json']),
    ('sweep', ['crossing', '--output', 'OUT', '--picture']),
    ('marker_picture', ['BAG', '--params', 'P', '--output']),
]


@pytest.mark.parametrize(('module', 'words'), COMMANDS)
@pytest.mark.parametrize('directory', ['there', 'not_there/'])
def test_directory_is_no_file_to_write(module, words, directory, tmp_path, monkeypatch, capsys):
    """Whether it is there, or meant to be one."""
    (tmp_path / 'there').mkdir()
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as stopped:
        import_module(f'tracking_tools.{module}').main([*words, directory])
    assert stopped.value.code == 2
    assert f'{directory} is a directory, not the name of a file' in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ['there']


@pytest.mark.parametrize('seed', ['-1', '1.5', 'x'])
def test_seed_is_a_whole_number_from_0_on(seed, capsys):
    """The words are ours, not those of a generator."""
    with pytest.raises(SystemExit):
        import_module('tracking_tools.simulate').main(['turns', '--output', 'x', f'--seed={seed}'])
    assert f'must be a whole number from 0 on, got {seed}' in capsys.readouterr().err
