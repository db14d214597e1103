# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The program of a node ends, whatever hangs while Python ends."""

import signal
import subprocess
import sys

import pytest

HANGS = """
class Endless:
    def __del__(self):
        while True:
            pass

def main(args):
    global kept
    kept = Endless()
    return 0
"""
PROGRAM = 'from tracking_node import start; start.LONGEST_END = 1; start.start("{}", "")'


def test_a_program_that_hangs_as_it_ends_is_ended(tmp_path):
    """An object that never goes, as a participant of the middleware once did not."""
    (tmp_path / 'hangs.py').write_text(HANGS)
    program = f'import sys; sys.path.insert(0, {str(tmp_path)!r}); {PROGRAM.format("hangs")}'
    ended = subprocess.run([sys.executable, '-c', program], timeout=60, check=False)
    assert ended.returncode == -signal.SIGALRM


@pytest.mark.parametrize('word', ['-h', '--help'])
@pytest.mark.parametrize('node', ['radar_tracker', 'sonar_tracker'])
def test_help_says_what_the_node_is(node, word):
    """Who asks learns of topics and arguments, and that is no failure; no ROS is needed for it."""
    command = [sys.executable, '-m', f'{node}.node', word]
    said = subprocess.run(command, timeout=60, check=True, capture_output=True, text=True).stdout
    assert said.startswith(f'usage: {node} ')
    assert all(each in said for each in ('--params-file', '~/tracks', 'config/', 'parameters.md'))
