# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a sweep: what is drawn, and where it cannot be written."""

from pathlib import Path

import pytest

from tracking_tools.sweep import main

TINY = ('crossing', '--duration', '20', '--jobs', '1', '--quiet')


def test_sweep_draws_its_lines_along_the_axis(tmp_path: Path) -> None:
    """Numbers in whatever order give the same picture."""
    pictures = []
    for values in ('0.9,0.7,0.95', '0.7,0.9,0.95'):
        pictures.append(tmp_path / f'{values}.png')
        given = ('--set', f'gate.probability={values}', '--output', str(tmp_path / 'runs'))
        assert main([*TINY, '--runs', '2', *given, '--picture', str(pictures[-1])]) == 0
    assert pictures[0].read_bytes() == pictures[1].read_bytes()


def test_sweep_without_a_place_for_its_picture_prints_the_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What took hours is not lost; the exit code says that something is missing."""
    (tmp_path / 'file').write_text('')
    picture = ['--picture', str(tmp_path / 'file' / 'sweep.png')]
    assert main([*TINY, *picture, '--output', str(tmp_path / 'runs')]) == 1
    told = capsys.readouterr()
    assert 'worst runs of' in told.out
    assert told.err.startswith('sweep: no picture: ')
    assert main([*TINY, '--picture', str(tmp_path / 'odd.xyz'), '--output', str(tmp_path)]) == 0
    assert (tmp_path / 'odd.xyz').read_bytes().startswith(b'\x89PNG')
