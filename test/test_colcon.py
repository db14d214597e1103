# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Build, install and test the package with colcon in a fresh workspace."""

import os
from pathlib import Path
import re
import shutil
import subprocess
import sys

import pytest

from tracking_tools.testing import NodeProcess, Peer

ROOT = Path(__file__).parent.parent
NAME = 'contact_tracking'
COLCON = shutil.which('colcon', path=f'{Path(sys.executable).parent}{os.pathsep}{os.defpath}')

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        not (ROOT / '.git').exists(), reason='the list of files comes from a git checkout'
    ),
    pytest.mark.skipif(
        COLCON is None and 'CI' not in os.environ, reason='colcon is not installed'
    ),
]


def _run(workspace: Path, *command: str) -> str:
    """Run a command in the workspace, with nothing of this environment's own ROS packages."""
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in {'AMENT_PREFIX_PATH', 'COLCON_PREFIX_PATH', 'PYTHONPATH'}
    }
    environment['COLCON_HOME'] = str(workspace)
    done = subprocess.run(
        command, cwd=workspace, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope='module')
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build a copy of the files that git knows, or would take, in a workspace of its own."""
    workspace = tmp_path_factory.mktemp('workspace')
    known = ('ls-files', '--cached', '--others', '--exclude-standard', '-z')
    listing = _run(ROOT, 'git', '-c', 'safe.directory=*', *known)
    for name in listing.split('\0'):
        if (ROOT / name).is_file():
            copy = workspace / 'src' / NAME / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, copy)
    _run(workspace, str(COLCON), 'build')
    return workspace


def test_build_installs_what_ros_looks_for(workspace: Path) -> None:
    """Commands, launch files, parameter files and the marker are where ros2 finds them."""
    prefix = workspace / 'install' / NAME
    assert (prefix / 'lib' / NAME / 'radar_tracker').is_file()
    assert (prefix / 'share/ament_index/resource_index/packages' / NAME).is_file()
    share = prefix / 'share' / NAME
    assert {path.name for path in (share / 'launch').iterdir()} >= {'radar.launch.py'}
    assert {path.name for path in (share / 'config').iterdir()} >= {'radar.yaml'}


def test_installed_command_runs(workspace: Path) -> None:
    """A command runs from the workspace, with its own copy of the code."""
    command = f'source install/setup.bash && install/{NAME}/lib/{NAME}/replay --help'
    assert 'usage: replay' in _run(workspace, 'bash', '-c', command)
    where = "python -c 'import tracking_core; print(tracking_core.__file__)'".replace(
        'python', sys.executable, 1
    )
    found = _run(workspace, 'bash', '-c', f'source install/setup.bash && {where}')
    assert Path(found.strip()).is_relative_to(workspace / 'install')


def test_installed_node_becomes_active(
    workspace: Path, ros_domain_id: int, tmp_path: Path
) -> None:
    """As ros2 run starts it, with a preset from share/; it ends with 0."""
    prefix = workspace / 'install' / NAME
    preset = prefix / 'share' / NAME / 'config' / 'terminal_radar.yaml'
    command = (
        f'source {workspace}/install/setup.bash && '
        f'exec {prefix}/lib/{NAME}/radar_tracker --ros-args --params-file {preset}'
    )
    with (
        NodeProcess(
            ['bash', '-c', command], ros_domain_id, tmp_path / 'log', folder=tmp_path
        ) as run,
        Peer(ros_domain_id, check=run.check) as peer,
    ):
        peer.wait_until_active('radar_tracker')
        assert 'parameters come from files' in run.log
    assert run.exit_code == 0


def test_colcon_test_runs_tests(workspace: Path) -> None:
    """Colcon finds pytest and counts its tests; a run of nothing would be green as well."""
    chosen = ('--pytest-args', 'test/test_launch_files.py', '--no-cov')  # whose pages take long
    _run(workspace, str(COLCON), 'test', '--return-code-on-test-failure', *chosen)
    summary = _run(workspace, str(COLCON), 'test-result')
    counts = re.search(r'(\d+) tests, 0 errors, 0 failures, 0 skipped', summary)
    assert counts is not None, summary
    assert int(counts.group(1)) > 0
