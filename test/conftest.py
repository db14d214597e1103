# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What every test starts from: a strict, private ROS, its message classes, and no display."""

from collections.abc import Iterator
import os
from pathlib import Path
import runpy
import signal
from typing import Any

from hypothesis import HealthCheck, settings
import pytest
import setuptools

from msg_adapters.message_types import MessageTypes, rclpy_types, rosbags_types
from tracking_tools.node_process import private_domain

# Before the first message class is imported: without it a wrong type is sent as garbage.
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['MPLBACKEND'] = 'Agg'

# A shell that runs the tests in the background has them, and all they start, ignore Ctrl-C.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# The same examples in every run, and no complaint of a machine that others use as well.
settings.register_profile(
    'fixed', derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile('new', settings.get_profile('fixed'), derandomize=False)
settings.load_profile('fixed')


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the long runs, unless the expression of -m names them."""
    if 'soak' in config.option.markexpr:
        return
    long = [item for item in items if item.get_closest_marker('soak')]
    config.hook.pytest_deselected(items=long)
    items[:] = [item for item in items if item not in long]


@pytest.fixture
def ros_domain_id(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Give this test a ROS domain that no other test on this machine has at the moment."""
    with private_domain() as domain_id:
        monkeypatch.setenv('ROS_DOMAIN_ID', str(domain_id))
        yield domain_id


@pytest.fixture(scope='session')
def setup_arguments() -> dict[str, Any]:
    """Read what setup.py hands to setuptools."""
    arguments: dict[str, Any] = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(Path(__file__).parent.parent)
        patch.setattr(setuptools, 'setup', arguments.update)
        runpy.run_path('setup.py')
    return arguments


@pytest.fixture(params=['rclpy', 'rosbags'])
def types(request: pytest.FixtureRequest) -> MessageTypes:
    """Run the test with the classes of rclpy, then with those of rosbags."""
    if request.param == 'rclpy':
        pytest.importorskip('sensor_msgs.msg')
        return rclpy_types()
    pytest.importorskip('rosbags')
    return rosbags_types()
