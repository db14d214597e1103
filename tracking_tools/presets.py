# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where are the parameter files that are shipped, wherever the package is installed?"""

from __future__ import annotations

from argparse import ArgumentTypeError
from pathlib import Path

from tracking_core.config import hint

FOLDERS = ('share/contact_tracking/config', 'config')  # of an installation, of a checkout
PARAMETER_HELP = 'parameter file in ROS form (YAML), or the name of a shipped one'


def parameter_file(text: str) -> Path:
    """
    Return a parameter file: a path, or the name of a shipped one, with its suffix or without.

    Raises
    ------
    argparse.ArgumentTypeError
        If there is neither; names the shipped ones.

    """
    path = Path(text)
    if path.exists():
        return path
    shipped = presets(Path(__file__))
    name = text.removesuffix('.yaml')
    if name in shipped:
        return shipped[name]
    raise ArgumentTypeError(
        f'{text}: no such file{hint(name, shipped)}; shipped are {", ".join(shipped) or "none"}'
    )


def presets(module: Path) -> dict[str, Path]:
    """Return the shipped files by name; they are in a folder above this module."""
    for above in module.resolve().parents:
        for folder in FOLDERS:
            if (above / folder / 'radar.yaml').is_file():
                return {file.stem: file for file in sorted((above / folder).glob('*.yaml'))}
    return {}
