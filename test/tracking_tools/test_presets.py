# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A shipped parameter file is found by its name, wherever the package is installed."""

from argparse import ArgumentTypeError
from pathlib import Path

import pytest

from tracking_tools.presets import parameter_file, presets

CONFIG = Path(__file__).parents[2] / 'config'


@pytest.mark.parametrize('name', ['terminal_radar', 'terminal_radar.yaml'])
def test_a_shipped_file_is_found_by_its_name(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From any folder, with its suffix or without."""
    monkeypatch.chdir(tmp_path)
    assert parameter_file(name) == CONFIG / 'terminal_radar.yaml'


def test_a_file_of_ones_own_wins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A path is a path."""
    monkeypatch.chdir(tmp_path)
    Path('radar.yaml').touch()
    assert parameter_file('radar.yaml') == Path('radar.yaml')


def test_a_slip_names_the_shipped_ones() -> None:
    """The error says what was meant, and what there is."""
    with pytest.raises(ArgumentTypeError, match=r'did you mean terminal_radar.*harbour_radar'):
        parameter_file('terminl_radar')


@pytest.mark.parametrize('below', ['lib/python3.12/site-packages', 'Lib/site-packages'])
def test_they_are_found_beside_an_installed_package(below: str, tmp_path: Path) -> None:
    """As pip, colcon and Debian packages put both under one prefix."""
    share = tmp_path / 'share' / 'contact_tracking' / 'config'
    share.mkdir(parents=True)
    (share / 'radar.yaml').touch()
    module = tmp_path / below / 'tracking_tools' / 'presets.py'
    assert presets(module) == {'radar': share.resolve() / 'radar.yaml'}


def test_without_any_the_error_says_so(tmp_path: Path) -> None:
    """A zip without data has none."""
    assert presets(tmp_path / 'tracking_tools' / 'presets.py') == {}
