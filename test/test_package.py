# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Compare package.xml, setup.py and the source tree with one another."""

import ast
from collections.abc import Iterator
import importlib
import importlib.util
from pathlib import Path
import re
import sys
from typing import Any
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).parent.parent
NAME = 'contact_tracking'
PACKAGES = (
    'msg_adapters', 'radar_tracker', 'sonar_tracker', 'tracking_core', 'tracking_node',
    'tracking_session', 'tracking_tools',
)  # fmt: skip
HEADER = ['# Copyright 2026 the contact_tracking authors', '# SPDX-License-Identifier: Apache-2.0']
# path: the reason why 200 lines are not enough
LONG_FILES = {'tracking_core/batches.py': 'the glossary: every batch in one place'}
NOT_IN_ROSDEP = {'setuptools', 'rosbags'}  # part of Python there; has a pip key only
IMPORT_NAMES = {'pyyaml': 'yaml'}
SHARED = {'launch', 'config', 'policies', 'rviz', 'foxglove'}
LAUNCH = {'launch', 'launch_ros', 'ros2bag'}  # no wheels: present on a ROS machine only

# Looked up in rosdep/python.yaml (for Ubuntu) and jazzy/distribution.yaml of ros/rosdistro.
ROSDEP_KEYS = {
    'python3-hypothesis', 'python3-matplotlib', 'python3-numpy', 'python3-pytest',
    'python3-scipy', 'python3-tqdm', 'python3-yaml',
    'builtin_interfaces', 'diagnostic_msgs', 'geometry_msgs', 'launch', 'launch_ros',
    'lifecycle_msgs', 'nav_msgs', 'rcl_interfaces', 'rclpy', 'ros2bag', 'rosgraph_msgs',
    'sensor_msgs', 'std_msgs', 'std_srvs', 'visualization_msgs',
}  # fmt: skip


@pytest.fixture(scope='module')
def manifest() -> ElementTree.Element:
    """Read package.xml."""
    return ElementTree.parse(ROOT / 'package.xml').getroot()


def _texts(manifest: ElementTree.Element, tag: str) -> set[str]:
    return {element.text or '' for element in manifest.iter(tag)}


def _sources() -> Iterator[Path]:
    """List every Python file of the project, relative to its root."""
    for path in sorted(ROOT.rglob('*.py')):
        relative = path.relative_to(ROOT)
        top = relative.parts[0]
        if not top.startswith('.') and top not in {'build', 'install', 'log'}:
            yield relative


def _import_names(requirements: list[str]) -> set[str]:
    names = {re.split(r'[^\w-]', requirement)[0] for requirement in requirements}
    return {IMPORT_NAMES.get(name, name) for name in names}


def _imports(path: Path) -> set[str]:
    """Name the top-level modules that a file imports, anywhere in it."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name.split('.')[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module.split('.')[0])
    return found


def _third_party_imports() -> set[str]:
    shipped = [path for path in _sources() if path.parts[0] in {*PACKAGES, 'launch'}]
    found = set().union(*(_imports(ROOT / path) for path in shipped))
    return found - set(sys.stdlib_module_names) - set(PACKAGES)


def test_version_and_identity_are_equal(
    manifest: ElementTree.Element, setup_arguments: dict[str, Any]
) -> None:
    """Both files name the same package, version, licence and maintainer."""
    maintainer = manifest.find('maintainer')
    assert maintainer is not None
    named = {
        'name': manifest.findtext('name'),
        'version': manifest.findtext('version'),
        'license': manifest.findtext('license'),
        'maintainer': maintainer.text,
        'maintainer_email': maintainer.get('email'),
    }
    assert named == {key: setup_arguments[key] for key in named}


def test_python_dependencies_are_equal(
    manifest: ElementTree.Element, setup_arguments: dict[str, Any]
) -> None:
    """What pip installs to run the package, package.xml asks of the system, and the reverse."""
    required = setup_arguments['install_requires'] + setup_arguments['extras_require']['tools']
    keys = {f'python3-{name}' for name in _import_names(required) - NOT_IN_ROSDEP}
    declared = {key for key in _texts(manifest, 'exec_depend') if key.startswith('python3-')}
    assert keys == declared


def test_every_dependency_has_a_rosdep_key(manifest: ElementTree.Element) -> None:
    """`rosdep install` finds all of package.xml in Jazzy; what has no key is an extra of pip."""
    tags = ('depend', 'build_depend', 'exec_depend', 'test_depend', 'buildtool_depend')
    declared = set().union(*(_texts(manifest, tag) for tag in tags))
    assert declared <= ROSDEP_KEYS
    assert not {key for key in declared if key.endswith('-pip')}  # the build farm takes none


def test_ros_extra_brings_the_ros_dependencies(manifest: ElementTree.Element) -> None:
    """Every ROS package in package.xml can be imported here, where ROS came as wheels."""
    declared = _texts(manifest, 'exec_depend') - LAUNCH
    ros = {key for key in declared if not key.startswith('python3-')}
    assert not {name for name in ros if importlib.util.find_spec(name) is None}


def test_every_import_is_declared(
    manifest: ElementTree.Element, setup_arguments: dict[str, Any]
) -> None:
    """No shipped file imports what neither package.xml nor setup.py names."""
    extras = setup_arguments['extras_require']
    optional = extras['tools'] + extras['report'] + extras['dask']
    required = setup_arguments['install_requires'] + optional
    assert _third_party_imports() <= _texts(manifest, 'exec_depend') | _import_names(required)


def test_test_dependencies_name_pytest(
    manifest: ElementTree.Element, setup_arguments: dict[str, Any]
) -> None:
    """Without pytest in an extra called test, colcon runs nothing and reports success."""
    assert 'pytest' in _import_names(setup_arguments['extras_require']['test'])
    assert 'python3-pytest' in _texts(manifest, 'test_depend')


def test_every_folder_with_code_is_a_package(setup_arguments: dict[str, Any]) -> None:
    """A folder without __init__.py would be left out of the installation."""
    folders = {'.'.join(path.parent.parts) for path in _sources() if path.parts[0] in PACKAGES}
    assert set(setup_arguments['packages']) == folders


def test_files_beside_the_code_are_installed(setup_arguments: dict[str, Any]) -> None:
    """What a package reads at run time goes with it."""
    found = {
        (str(path.relative_to(ROOT).parent).replace('/', '.'), path.name)
        for top in PACKAGES
        for path in _files(top)
        if path.suffix not in {'.py', '.pyc'}
    }
    named = setup_arguments['package_data'].items()
    assert found == {(package, name) for package, names in named for name in names}


def test_tools_check_every_package(setup_arguments: dict[str, Any]) -> None:
    """Types and import rules are checked in all that is installed."""
    settings = pytest.importorskip('tomllib').loads((ROOT / 'pyproject.toml').read_text())['tool']
    packages = {name for name in setup_arguments['packages'] if '.' not in name}
    assert set(settings['mypy']['packages']) == packages
    assert set(settings['importlinter']['root_packages']) == packages


def test_console_scripts_can_be_imported(setup_arguments: dict[str, Any]) -> None:
    """Every command leads to a function."""
    for script in setup_arguments['entry_points']['console_scripts']:
        _, module, function = re.split(r' = |:', script)
        assert callable(getattr(importlib.import_module(module), function)), script


def test_share_files_are_installed(setup_arguments: dict[str, Any]) -> None:
    """ROS finds the marker, the manifest, and every launch, parameter and view file."""
    installed = {
        f'{folder}/{Path(file).name}': Path(file)
        for folder, files in setup_arguments['data_files']
        for file in files
    }
    shared = [path.relative_to(ROOT) for top in SHARED for path in _files(top)]
    assert installed == {
        f'share/ament_index/resource_index/packages/{NAME}': Path('resource', NAME),
        f'share/{NAME}/package.xml': Path('package.xml'),
        **{f'share/{NAME}/{path}': path for path in shared},
    }
    assert {path.parts[0] for path in shared} == SHARED


def test_source_archive_holds_every_folder() -> None:
    """What README has one run is in it: the tests read benchmarks and studies."""
    lines = [line.split() for line in (ROOT / 'MANIFEST.in').read_text().splitlines()]
    named = {line[1] for line in lines if line[0] == 'recursive-include'}
    folders = {path.parts[0] for path in _sources() if len(path.parts) > 1}
    assert folders <= named | set(PACKAGES)


def _files(top: str) -> list[Path]:
    found = (ROOT / top).rglob('*')
    return [path for path in found if path.is_file() and '__pycache__' not in path.parts]


def test_every_file_has_the_header() -> None:
    """Copyright and licence are the first two lines of every Python file."""
    wrong = [
        str(path) for path in _sources() if (ROOT / path).read_text().splitlines()[:2] != HEADER
    ]
    assert not wrong


def test_files_are_short() -> None:
    """A file of 200 lines, a test of 300, holds a second idea; an exception has a reason."""
    long = {
        str(path)
        for path in _sources()
        if len((ROOT / path).read_text().splitlines()) >= (300 if path.parts[0] == 'test' else 200)
    }
    assert long == set(LONG_FILES)
