# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Does every command of the tutorial work as it stands there?"""

from __future__ import annotations

from collections.abc import Callable
import json
import os
from pathlib import Path
import re
import subprocess
import sys

import pytest

ROOT = Path(__file__).parents[2]
TUTORIAL = ROOT / 'docs' / 'tutorial.md'


def commands() -> list[str]:
    """Return the shell blocks of the tutorial, in order."""
    return re.findall(r'^```sh\n(.*?)^```$', TUTORIAL.read_text(), re.DOTALL | re.MULTILINE)


@pytest.mark.slow
def test_tutorial_runs_from_top_to_bottom(
    cut_bag: Callable[[int], Path], tmp_path: Path, ros_domain_id: int
) -> None:
    """In a folder with the beginning of the recording all succeed and leave what they promise."""
    pytest.importorskip('bokeh', reason='bokeh (extra report) is not installed')
    (tmp_path / 'demo').mkdir()
    (tmp_path / 'demo' / 'terminal_area').symlink_to(cut_bag(40))
    paths = os.pathsep.join([str(Path(sys.executable).parent), os.environ['PATH']])
    environment = {**os.environ, 'PATH': paths, 'PYTHONPATH': str(ROOT), 'OMP_NUM_THREADS': '1'}
    blocks = commands()
    assert len(blocks) >= 8
    said = subprocess.run(
        ['bash', '-euo', 'pipefail', '-c', '\n'.join(blocks)], cwd=tmp_path, env=environment,
        capture_output=True, text=True, check=False, timeout=600,
    )  # fmt: skip
    assert said.returncode == 0, said.stdout + said.stderr
    figures = json.loads((tmp_path / 'output' / 'mine.json').read_text())
    assert figures['held']['coverage'] > 0.8
    made = ('first.html', 'mine.html', 'again.html', 'live/demo.html', 'live/demo.png')
    assert all((tmp_path / 'output' / name).stat().st_size > 10_000 for name in made)


def test_tutorial_shows_pictures_that_are_there() -> None:
    """Every picture and page that the tutorial leads to exists."""
    targets = re.findall(r'\]\(([^)#]+)', TUTORIAL.read_text())
    assert targets
    assert not [target for target in targets if not (TUTORIAL.parent / target).exists()]
