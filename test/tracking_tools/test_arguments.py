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
    ('marker_picture', ['BAG', '--params', 'radar', '--output']),
]


def nmea(words):
    """Run the command of a feed."""
    pytest.importorskip('pynmea2', reason='pynmea2 (extra feeds) is not installed')
    return import_module('tracking_tools.nmea.__main__').main(words)


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


@pytest.mark.parametrize('below', ['', 'deeper/'])
@pytest.mark.parametrize('name', ['x', 'sub/x'])
def test_file_where_a_folder_should_be_is_named(below, name, tmp_path, capsys):
    """Not only that something exists."""
    (tmp_path / 'file').write_text('')
    place = tmp_path / 'file' / below / name
    with pytest.raises(SystemExit):
        import_module('tracking_tools.simulate').main(['turns', '--output', str(place)])
    said = capsys.readouterr().err
    assert f'{tmp_path}/file is no folder, nothing can be written in it' in said


@pytest.mark.parametrize('option', ['--radius', '--cutoff'])
@pytest.mark.parametrize('size', ['1e200', '1e-200', 'inf', '0'])
def test_size_whose_powers_are_no_numbers_is_refused(option, size, capsys):
    """Before a bag is opened."""
    with pytest.raises(SystemExit):
        import_module('tracking_tools.evaluate').main(['BAG', option, size])
    assert f'argument {option}: must be ' in capsys.readouterr().err


@pytest.mark.parametrize('seed', ['-1', '1.5', 'x'])
def test_seed_is_a_whole_number_from_0_on(seed, capsys):
    """The words are ours, not those of a generator."""
    with pytest.raises(SystemExit):
        import_module('tracking_tools.simulate').main(['turns', '--output', 'x', f'--seed={seed}'])
    assert f'must be a whole number from 0 on, got {seed}' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['--interval', '-1'], 'must be a number from 0 on, got -1'),
        (['--interval', 'nan'], 'must be a number from 0 on, got nan'),
        (['--rate', '0'], 'must be a number above 0, got 0'),
        (['--date', '2026-13-01'], 'must be a day as 2026-03-01, got 2026-13-01'),
    ],
)
def test_option_of_a_feed_that_makes_no_sense_is_told(arguments, words, capsys):
    """A negative interval would make a message of every sentence."""
    with pytest.raises(SystemExit, match='2'):
        nmea(['log.txt', '--bag', 'bag', *arguments])
    assert words in capsys.readouterr().err


@pytest.mark.parametrize('origin', [('122.4', '-37.8'), ('54.5', 'nan')])
def test_origin_that_is_no_place_is_told(origin, tmp_path, monkeypatch, capsys):
    """As where latitude and longitude have changed places."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'log.txt').write_text('')
    assert nmea(['log.txt', '--bag', 'bag', '--origin', *origin]) == 1
    said = capsys.readouterr().err
    assert f'LAT in [-90, 90] and LON in [-180, 180] deg, got {" ".join(origin)}' in said
