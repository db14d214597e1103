# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What a stranger sends, and what we depend on: no code from outside, small memory, known pins."""

import ast
from itertools import chain
from pathlib import Path
import tracemalloc
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.table import to_columns

ROOT = Path(__file__).parent.parent
PACKAGES = (
    'msg_adapters', 'radar_tracker', 'sonar_tracker', 'tracking_core', 'tracking_node',
    'tracking_session', 'tracking_tools',
)  # fmt: skip
POLICY = ROOT / 'policies' / 'contact_tracking.policy.xml'
# Modules that run or build what a file says; ruff's rules S see most of the other ways.
CODE_LOADERS = {'pickle', 'marshal', 'shelve', 'dill', 'joblib', 'cloudpickle', 'code'}
CALLS = {'eval', 'exec', 'compile', '__import__'}
EMPTY_PROCESS = 1_000_000  # bytes that a refusal may take


def test_packages_have_no_way_to_run_what_they_read() -> None:
    """No pickle, no eval, no shell: not one name of them in all that is installed."""
    found = []
    for path in (p for package in PACKAGES for p in (ROOT / package).rglob('*.py')):
        for node in ast.walk(ast.parse(path.read_text())):
            names = set()
            if isinstance(node, ast.Import):
                names = {alias.name.partition('.')[0] for alias in node.names} & CODE_LOADERS
            elif isinstance(node, ast.ImportFrom):
                names = {(node.module or '').partition('.')[0]} & CODE_LOADERS
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                names = {node.func.id} & CALLS
            elif isinstance(node, ast.keyword) and node.arg in ('allow_pickle', 'shell'):
                names = {node.arg} if getattr(node.value, 'value', True) else set()
            found += [f'{path.relative_to(ROOT)}: {name}' for name in names]
    assert not found


@pytest.mark.parametrize(
    'sizes',
    [
        {'width': 2**32 - 1},
        {'width': 2**32 - 1, 'height': 2**32 - 1},
        {'width': 20_000, 'point_step': 2**32 - 1},
        {'width': 20_000, 'height': 1, 'row_step': 2**32 - 1},
        {'fields': [SimpleNamespace(name='x', offset=0, datatype=8, count=2**31)]},
        {'fields': [SimpleNamespace(name=str(n), offset=0, datatype=8, count=1)
                    for n in range(100_000)]},
    ],
)  # fmt: skip
def test_sizes_are_checked_before_memory_is_taken(sizes) -> None:
    """A message that says it is huge is refused without a byte for its rows."""
    fields = [SimpleNamespace(name='range', offset=0, datatype=7, count=1)]
    msg = SimpleNamespace(**{
        'height': 1, 'width': 1, 'point_step': 8, 'row_step': 8, 'is_bigendian': False,
        'fields': fields, 'data': np.zeros(8, np.uint8), **sizes,
    })  # fmt: skip
    tracemalloc.start()
    with pytest.raises(BadMessage):
        to_columns(msg, 20_000)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < EMPTY_PROCESS


def test_policy_is_well_formed() -> None:
    """The tags and words that SROS2 reads, one enclave and one profile for each node."""
    policy = ElementTree.parse(POLICY).getroot()
    assert (policy.tag, policy.get('version')) == ('policy', '0.2.0')
    names = []
    for enclave in policy.findall('./enclaves/enclave'):
        profiles = enclave.findall('./profiles/profile')
        assert [enclave.get('path')] == [f'/contact_tracking/{p.get("node")}' for p in profiles]
        for rules in profiles[0]:
            child = {'topics': 'topic', 'services': 'service'}[rules.tag]
            assert set(rules.attrib.values()) == {'ALLOW'}
            assert set(rules.attrib) <= {'publish', 'subscribe', 'reply'}
            assert {element.tag for element in rules} == {child}
        names.append(profiles[0].get('node'))
    assert names == ['radar_tracker', 'sonar_tracker']


def test_pins_satisfy_what_we_require(setup_arguments) -> None:
    """Every pinned version is one that setup.py allows, so that make setup can use it."""
    requirements = pytest.importorskip('packaging.requirements')
    utils = pytest.importorskip('packaging.utils')
    pins = {}
    for line in (ROOT / 'constraints.txt').read_text().splitlines():
        if line and not line.startswith('#'):
            pin = requirements.Requirement(line)
            (only,) = pin.specifier
            assert only.operator == '=='
            pins[utils.canonicalize_name(pin.name)] = only.version
    extras = setup_arguments['extras_require']
    used = (extras[name] for name in ('ros', 'tools', 'feeds', 'report'))
    for text in chain(setup_arguments['install_requires'], *used):
        requirement = requirements.Requirement(text)
        name = utils.canonicalize_name(requirement.name)
        if name != 'setuptools':  # that of the environment itself
            assert requirement.specifier.contains(pins[name]), text
