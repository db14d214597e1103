# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check style, types and import rules."""

import importlib.util
import os
from pathlib import Path
import subprocess
import sys

import numpy as np
from numpy.lib import NumpyVersion
import pytest

ROOT = Path(__file__).parent.parent
TYPED = '2.4.0'
LINTERS = {
    'ruff check': ('ruff', ['-m', 'ruff', 'check']),
    'ruff format': ('ruff', ['-m', 'ruff', 'format', '--check', '--diff']),
    'mypy': ('mypy', ['-m', 'mypy']),
    'import-linter': (
        'importlinter',
        ['-c', 'from importlinter.cli import lint_imports_command as run; run()'],
    ),
}


@pytest.mark.parametrize(('module', 'arguments'), LINTERS.values(), ids=LINTERS)
def test_linter_has_no_complaint(module: str, arguments: list[str]) -> None:
    """The linter exits with 0; a machine with ROS alone may lack it, our own runs may not."""
    if module == 'mypy' and NumpyVersion(np.__version__) < TYPED:
        pytest.skip(f'numpy says less of its types before {TYPED}')
    if importlib.util.find_spec(module) is None and 'CI' not in os.environ:
        pytest.skip(f'{module} is not installed')
    done = subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
