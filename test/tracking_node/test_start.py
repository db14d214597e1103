# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The program of a node ends, whatever hangs while the node or Python ends."""

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
STUCK = """
import ctypes

from rclpy.node import Node
from tracking_node.run import run

class Stuck(Node):
    def __init__(self):
        super().__init__('stuck')
        self.create_timer(0.1, self.context.try_shutdown)

    def destroy_node(self):
        ctypes.PyDLL(None).sleep(3600)  # below Python, which does not run meanwhile

def main(args):
    return run(Stuck, [])
"""
PROGRAM = 'from tracking_node import start; start.LONGEST_END = 1; start.start("{}", "")'


@pytest.mark.parametrize('module', [HANGS, STUCK], ids=['python', 'node'])
def test_a_program_that_hangs_as_it_ends_is_ended(tmp_path, ros_domain_id, module):
    """An object that never goes; a node that the middleware does not destroy."""
    (tmp_path / 'hangs.py').write_text(module)
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
