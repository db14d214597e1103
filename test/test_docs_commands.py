# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Every command in the README and the pages beside it works, or names only what exists.

What runs without a ROS installation runs here, in a folder with a short piece of the demo scene;
nodes, benchmarks and studies have tests of their own and are looked up. Commands of ros2 are
compared with entry points, launch files, parameters and topics. The tutorial's run in
``tracking_tools/test_tutorial.py``.
"""

from importlib.util import find_spec
from itertools import islice
from pathlib import Path
import re
import runpy
import shlex
import sys
from types import ModuleType
from unittest.mock import MagicMock

import pytest

from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from tracking_core.config import parameters
from tracking_tools.bags import BagWriter, open_bag

ROOT = Path(__file__).parent.parent
PAGES = (
    'README.md',
    'CONTRIBUTING.md',
    *sorted(f'docs/{path.name}' for path in ROOT.glob('docs/*.md') if path.stem != 'tutorial'),
)
FENCE = re.compile(r'^```(\w*)\n(.*?)^```$', re.MULTILINE | re.DOTALL)
HERE = {
    'tracking_tools.replay', 'tracking_tools.evaluate', 'tracking_tools.report',
    'tracking_tools.simulate',
}  # fmt: skip
CONFIGS = {
    'radar_tracker': (RadarTrackerConfig(), radar_node_config()),
    'sonar_tracker': (SonarTrackerConfig(), sonar_node_config()),
}
TOPICS = re.compile(
    r'/(my_radar/points|plots|diagnostics|(bow/)?(radar|sonar)_tracker/(tracks|odometry|markers))'
)


def commands():
    """Return page and words of every command in a block of its own."""
    found = []
    for page in PAGES:
        for kind, block in FENCE.findall((ROOT / page).read_text(encoding='utf-8')):
            if kind not in ('', 'sh', 'bash'):
                continue
            whole = block.replace('\\\n', ' ').splitlines()  # a backslash goes on below
            lines = (shlex.split(line, comments=True) for line in whole)
            found += [(page, words) for words in lines if words]
    return found


def of(*start):
    """Return those that begin with these words, the words after them, each with its page."""
    return [
        pytest.param(words[len(start) :], id=f'{page}: {" ".join(words)}')
        for page, words in commands()
        if words[: len(start)] == list(start)
    ]


@pytest.fixture
def folder(tmp_path):
    """Return a folder with what the commands name: twenty turns of the demo scene, parameters."""
    (tmp_path / 'config').symlink_to(ROOT / 'config')
    with (
        open_bag(ROOT / 'demo' / 'terminal_area') as bag,
        BagWriter(tmp_path / 'demo' / 'terminal_area') as out,
    ):
        for connection, time, raw in islice(bag.messages(), 40):
            out.write_raw(connection.topic, connection.msgtype, raw, time)
    return tmp_path


def test_all_commands_are_of_a_known_kind():
    """A command that no test below looks at would be a promise that nobody keeps."""
    known = {
        ('make',), ('python', '-m'), ('colcon',), ('rviz2',), ('ros2', 'launch'), ('ros2', 'run'),
        ('ros2', 'param'), ('ros2', 'topic'), ('ros2', 'service'), ('ros2', 'lifecycle'),
        ('ros2', 'bag'), ('ros2', 'security'), ('dask',), ('export',),
    }  # fmt: skip
    assert len(commands()) > 20
    strange = [w for _, w in commands() if not {tuple(w[:1]), tuple(w[:2])} & known]
    assert not strange


def test_tools_run_in_the_order_of_the_pages(folder, monkeypatch):
    """Each ends with 0 and leaves what it promises; a later one uses what an earlier one wrote."""
    monkeypatch.chdir(folder)
    told = [(page, words[2], words[3:]) for page, words in commands() if words[1:2] == ['-m']]
    for page, module, arguments in told:
        output = arguments[arguments.index('--output') + 1] if '--output' in arguments else None
        if module not in HERE or (output is not None and Path(output).exists()):
            continue  # the README and a page name the same
        assert run(module, arguments, monkeypatch) == 0, f'{page}: {module} {arguments}'
        assert output is None or Path(output).exists()


@pytest.mark.parametrize('words', of('python', '-m'))
def test_module_has_these_options(words, monkeypatch, capsys):
    """Also those that would take too long here."""
    if words[0] not in HERE:
        check_options(words[0], words[1:], monkeypatch, capsys)


def run(module, arguments, monkeypatch):
    """Do as `python -m` does; return the exit code."""
    spec = find_spec(module)
    if spec.submodule_search_locations is not None:
        spec = find_spec(f'{module}.__main__')
    monkeypatch.setattr(sys, 'argv', [spec.origin, *arguments])
    with pytest.raises(SystemExit) as end:
        runpy.run_path(spec.origin, run_name='__main__')
    return end.value.code or 0


def check_options(module, arguments, monkeypatch, capsys):
    """Compare with what the module says of itself; nodes have no help."""
    assert find_spec(module) is not None
    files = [word for word in arguments if word.startswith('config/')]
    assert all((ROOT / file).exists() for file in files)
    if module.startswith('tracking_tools'):
        assert run(module, ['--help'], monkeypatch) == 0
        known = set(re.findall(r'--[\w-]+', capsys.readouterr().out))
        ours = arguments[: [*arguments, '--ros-args'].index('--ros-args')]
        assert {word for word in ours if word.startswith('--')} <= known


@pytest.mark.parametrize('page', [ROOT / 'README.md', *sorted(ROOT.glob('docs/**/*.md'))], ids=str)
def test_modules_that_a_page_names_exist(page):
    """Commands in the running text, in tables and in results too."""
    for module in re.findall(r'python -m ([a-z_][\w.]*\w)', page.read_text(encoding='utf-8')):
        assert module.endswith('NAME') or find_spec(module) is not None, module


@pytest.mark.parametrize('words', of('make'))
def test_make_has_the_target(words):
    """What they do has tests of its own."""
    assert re.search(rf'^{words[0]}:', (ROOT / 'Makefile').read_text(), re.MULTILINE)


@pytest.mark.parametrize('words', of('ros2', 'launch'))
def test_launch_file_declares_these_arguments(words, monkeypatch):
    """Names of arguments, and files among those shipped."""
    package, file, *given = words
    declared = []
    for name in ('', '.actions', '.conditions', '.substitutions'):
        module = ModuleType(f'launch{name}')
        module.__getattr__ = lambda _: MagicMock()
        module.DeclareLaunchArgument = lambda name, **_: declared.append(name)
        monkeypatch.setitem(sys.modules, module.__name__, module)
    for name in ('', '.actions', '.parameter_descriptions', '.substitutions'):
        module = ModuleType(f'launch_ros{name}')
        module.__getattr__ = lambda _: MagicMock()
        monkeypatch.setitem(sys.modules, module.__name__, module)
    runpy.run_path(str(ROOT / 'launch' / file))['generate_launch_description']()
    values = dict(word.split(':=') for word in given)
    assert package == 'contact_tracking'
    assert set(values) <= set(declared)
    assert not values.get('preset') or (ROOT / 'config' / values['preset']).exists()


@pytest.mark.parametrize('words', of('ros2', 'run'))
def test_ros2_run_finds_the_command(words, setup_arguments):
    """An entry point of this name exists."""
    scripts = setup_arguments['entry_points']['console_scripts']
    assert words[0] == 'contact_tracking'
    assert words[1] in {script.split(' =')[0] for script in scripts}
    enclaves = [word for word in words if word.startswith('/contact_tracking/')]
    assert enclaves == [f'/contact_tracking/{words[1]}'] * ('--enclave' in words)


@pytest.mark.parametrize('words', of('ros2', 'param'))
def test_parameter_exists(words):
    """Of the node that is named, with a value that it takes."""
    verb, node, name, *_ = words
    known = {p.name for config in CONFIGS[node.lstrip('/')] for p in parameters(config)}
    assert verb in ('describe', 'set', 'get')
    assert name in known | {'input_types_available', 'output_types_available'}


@pytest.mark.parametrize('words', of('ros2', 'topic'))
def test_topic_is_one_of_ours(words):
    """Names in the pages are those of the nodes, or of the example's radar."""
    named = [word for word in words if word.startswith('/')]
    assert words[0] in ('list', 'info', 'hz', 'echo')
    assert all(TOPICS.fullmatch(name) for name in named)


@pytest.mark.parametrize(
    'words', [*of('ros2', 'service'), *of('ros2', 'lifecycle'), *of('ros2', 'bag'), *of('rviz2')]
)
def test_the_rest_names_nodes_topics_and_files_that_exist(words):
    """Service, node, topic, configuration."""
    for word in words:
        if word.startswith('/'):
            node = re.fullmatch(r'(/bow)?/(radar|sonar)_tracker(/reset)?', word)
            assert node or TOPICS.fullmatch(word)
        elif word.startswith(('rviz/', 'demo/')):
            assert (ROOT / word).exists()


@pytest.mark.parametrize('words', [*of('ros2', 'security'), *of('dask')])
def test_policies_are_shipped_and_extras_are_named(words, setup_arguments):
    """What the other programs are given is in share/, or they come with an extra."""
    extras = ' '.join(setup_arguments['extras_require']['dask'])
    assert words[0] in ('create_keystore', 'generate_artifacts') or 'distributed' in extras
    shipped = dict(setup_arguments['data_files'])
    for word in words:
        folder, _, file = word.partition(')/')[2].rpartition('/')
        assert not file or file in {Path(path).name for path in shipped[folder]}
