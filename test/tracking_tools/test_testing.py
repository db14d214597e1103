# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Check what users test their own graphs with: the example of its page, and what it says."""

import os
from pathlib import Path
import re
import subprocess
import sys
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
import pytest
from std_srvs.srv import Trigger

from tracking_tools.testing import NodeFailed, NodeProcess, Peer, private_domain, TrackerProbe

ROOT = Path(__file__).parents[2]
PAGE = ROOT / 'docs' / 'testing.md'
DEADLINE = 20.0  # [s]


def test_example_of_the_page_runs(tmp_path):
    """Whoever copies it has two tests that pass."""
    (example,) = re.findall(r'```python\n(.*?)```', PAGE.read_text(), re.DOTALL)
    file = tmp_path / 'test_example.py'
    file.write_text(example)
    done = subprocess.run(
        [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', str(file)],
        cwd=tmp_path, env={**os.environ, 'PYTHONPATH': str(ROOT)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    print(done.stdout)
    assert '2 passed' in done.stdout, done.stdout + done.stderr


def test_page_names_every_method_that_there_is():
    """What a probe and a peer can do is on the page."""
    text = PAGE.read_text()
    for kind in (Peer, NodeProcess, TrackerProbe):
        for name in vars(kind):
            assert name.startswith('_') or name in ('close', 'spin', 'stop') or name in text, name


def test_waiting_says_for_what(ros_domain_id):
    """A deadline that passes names topic, service or state."""
    with Peer(ros_domain_id) as peer:
        end = peer.hear(DiagnosticArray, 'nothing', [])
        with pytest.raises(TimeoutError, match=r'0\.1 s in vain for somebody else on /nothing'):
            peer.wait_until_matched(end, deadline=0.1)
        with pytest.raises(TimeoutError, match='service nobody/get_state'):
            peer.wait_until_active('nobody', deadline=0.1)
    with (
        TrackerProbe(ros_domain_id) as probe,
        pytest.raises(TimeoutError, match='3 track tables'),
    ):
        probe.collect(3, deadline=0.1)


def test_waiting_in_vain_says_which_nodes_are_there(ros_domain_id):
    """A tracker in another namespace than was thought is seen at once."""
    with Peer(ros_domain_id) as peer, Peer(ros_domain_id, 'radar_tracker', 'ship') as other:
        peer.wait_for_node(other.node.get_fully_qualified_name())
        nodes = r"service radar_tracker/get_state; nodes: \['/ship/radar_tracker'\]"
        with pytest.raises(TimeoutError, match=nodes):
            peer.state('radar_tracker', deadline=0.1)


def test_diagnosed_finds_the_tracker_among_others(ros_domain_id):
    """On /diagnostics any node may speak, of several things or of none."""
    ours = DiagnosticStatus(name='radar_tracker: tracking', values=[KeyValue(key='a', value='1')])
    other = DiagnosticStatus(name='bow/radar_tracker: tracking')
    with TrackerProbe(ros_domain_id) as probe:
        for status in ([other, ours], [other], []):
            probe.diagnostics.append(DiagnosticArray(status=status))
        assert probe.diagnosed('a') == '1'
        assert probe.diagnosed('b') is None


def test_call_asks_again_when_the_answer_does_not_come(ros_domain_id):
    """What changes nothing may be asked twice; the first answer ends it."""
    asked = []

    def answer(request, response):
        asked.append(request)
        return response

    def serve():
        if time.monotonic() > begin + 0.3:  # by then it has been asked more than once
            server.spin(lambda: False, 0.01)

    with Peer(ros_domain_id) as server, Peer(ros_domain_id, name='other', check=serve) as peer:
        server.node.create_service(Trigger, 'late', answer)
        begin = time.monotonic() + 1e9
        peer.spin_until(lambda: 'late' in str(peer.node.get_service_names_and_types()))
        begin = time.monotonic()
        assert peer.call(Trigger, 'late', Trigger.Request(), again=0.1) == Trigger.Response()
        peer.spin_until(lambda: len(asked) > 1)


def test_waiting_for_a_node_that_has_died_ends_at_once(ros_domain_id, tmp_path):
    """The error shows what the node said last."""
    command = [sys.executable, '-c', 'print("no such antenna"); raise SystemExit(3)']
    with NodeProcess(command, ros_domain_id, tmp_path / 'log') as node:
        with pytest.raises(NodeFailed, match='never said'):
            node.wait_for_line('ready')
        with (
            Peer(ros_domain_id, check=node.check) as peer,
            pytest.raises(NodeFailed, match=r'code 3; last lines of .*\n.*no such antenna'),
        ):
            peer.wait_until_active('radar_tracker')
    assert node.exit_code == 3


PARENT = """
import subprocess, sys
child = subprocess.Popen([sys.executable, '-c', sys.argv[1]])
while child.returncode is None:
    try:
        child.communicate()
    except KeyboardInterrupt:
        pass
"""
CHILD = 'import os, signal; print(os.getpid(), flush=True); signal.pause()'
RUNNER = """
import sys
from tracking_tools.testing import NodeProcess
with NodeProcess([sys.executable, '-c', sys.argv[1]], 1, sys.argv[2], patience=3.0) as node:
    node.wait_for_line('')
    print(node.log, flush=True)
    node.wait(1000.0)
"""
STUBBORN = f'import signal; signal.signal(signal.SIGINT, signal.SIG_IGN); {CHILD}'


def is_running(number):
    """Return whether a process is there and more than a name."""
    stat = Path(f'/proc/{number}/stat')
    return stat.exists() and stat.read_text().rpartition(')')[2].split()[0] != 'Z'


def wait_until_gone(number):
    """Wait for the end of a process that is no child of ours."""
    deadline = time.monotonic() + DEADLINE
    while is_running(number):
        assert time.monotonic() < deadline, f'{number} is still there'
        time.sleep(0.01)


def test_what_a_command_has_started_ends_with_it(ros_domain_id, tmp_path):
    """As of a program that starts a node and leaves Ctrl-C to it, since a terminal tells both."""
    command = [sys.executable, '-c', PARENT, CHILD]
    with NodeProcess(command, ros_domain_id, tmp_path / 'log') as node:
        child = int(node.wait_for_line('\n'))
        assert node.stop() == 0  # and once more at the end
    assert node.exit_code == 0
    wait_until_gone(child)


@pytest.mark.parametrize('child', [CHILD, STUBBORN], ids=['obedient', 'stubborn'])
def test_node_ends_with_a_run_that_is_killed(child, tmp_path):
    """As by the time limit of a CI: nobody is left to ask it to end."""
    command = [sys.executable, '-c', RUNNER, child, str(tmp_path / 'log')]
    environment = {**os.environ, 'PYTHONPATH': str(ROOT)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run:
        number = int(run.stdout.readline())
        assert is_running(number)
        run.kill()
    wait_until_gone(number)


@pytest.mark.parametrize('error', [AssertionError, TimeoutError, KeyboardInterrupt])
def test_node_of_a_failed_test_is_heard(error, ros_domain_id, tmp_path, capsys):
    """Its last lines tell more than that something did not come; Ctrl-C is no failure."""
    words = [sys.executable, '-c', 'for k in range(30): print("plots refused", k)']

    def fail():
        with NodeProcess(words, ros_domain_id, tmp_path / 'log') as node:
            node.wait()
            raise error

    with pytest.raises(error):
        fail()
    said = capsys.readouterr().out
    assert ('plots refused 10\n' in said) == (error is not KeyboardInterrupt)
    assert 'plots refused 9\n' not in said


STUCK = """
import ctypes
from tracking_tools import peer

peer.LONGEST_CLOSE = 1.0
with peer.Peer({domain_id}) as stuck:
    stuck.node.destroy_node = lambda: ctypes.PyDLL(None).sleep(3600)  # no Python runs meanwhile
"""


def test_peer_whose_middleware_hangs_ends_its_process(ros_domain_id):
    """With the line where it hangs, rather than never."""
    command = [sys.executable, '-c', STUCK.format(domain_id=ros_domain_id)]
    ended = subprocess.run(command, timeout=60, check=False, capture_output=True, text=True)
    assert ended.returncode == 1
    assert 'in close' in ended.stderr


def test_domain_is_not_given_away_while_a_node_lives_in_it(tmp_path):
    """A node that outlives its test, which was killed perhaps, does not talk into the next one."""
    command = [sys.executable, '-c', 'print("here", flush=True); import signal; signal.pause()']
    with private_domain() as domain:
        node = NodeProcess(command, domain, tmp_path / 'log')
        node.__enter__()
        node.wait_for_line('here')
    try:
        with private_domain() as other:
            assert other != domain
    finally:
        node.stop()
    with private_domain() as again:
        assert again == domain
