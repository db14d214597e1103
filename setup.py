# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Build and install rules, for pip and for colcon alike."""

from glob import glob

from setuptools import find_packages, setup

NAME = 'contact_tracking'
SHARE = f'share/{NAME}'

setup(
    name=NAME,
    version='0.1.0',
    description='Radar plots and sonar bearings to tracks, live in ROS 2 or over a recorded bag',
    author='contact_tracking authors',
    author_email='maintainers@contact-tracking.invalid',
    maintainer='contact_tracking authors',
    maintainer_email='maintainers@contact-tracking.invalid',
    license='Apache-2.0',
    python_requires='>=3.10',
    packages=find_packages(
        include=[
            f'{package}{below}'
            for package in (
                'msg_adapters',
                'radar_tracker',
                'sonar_tracker',
                'tracking_core',
                'tracking_node',
                'tracking_session',
                'tracking_tools',
            )
            for below in ('', '.*')
        ]
    ),
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (SHARE, ['package.xml']),
        (f'{SHARE}/launch', sorted(glob('launch/*.launch.py'))),
        (f'{SHARE}/config', sorted(glob('config/*.yaml'))),
        (f'{SHARE}/policies', sorted(glob('policies/*.xml'))),
        (f'{SHARE}/rviz', sorted(glob('rviz/*.rviz'))),
        (f'{SHARE}/foxglove', sorted(glob('foxglove/*.json'))),
    ],
    install_requires=['setuptools', 'numpy>=1.26', 'scipy>=1.11'],
    extras_require={
        # What a machine with ROS has from its own packages; see package.xml.
        'ros': [
            'ros-jazzy-rclpy',
            'ros-jazzy-common-interfaces',
            'ros-jazzy-rmw-fastrtps-cpp',  # rclpy does not import without it
        ],
        'tools': ['rosbags>=0.11', 'matplotlib>=3.6', 'tqdm>=4.66', 'pyyaml>=6.0'],
        'report': ['bokeh>=3.4'],  # the page of a recording
        # What our tracks and times are compared with; nothing of ours needs them to run.
        'peers': [
            'stonesoup>=1.9',
            'pyehm>=2.2',  # EHM2 for the JPDA of Stone Soup
            'filterpy>=1.4.5',
            'nrl-tracker>=2.11; python_version >= "3.11"',
        ],
        'dask': ['distributed>=2024.1'],  # sweeps over more than one machine
        'feeds': ['libasterix>=0.36', 'pynmea2>=1.19', 'pyais>=2.6'],  # decoders
        # colcon runs the tests only when an extra of this name lists pytest.
        'test': [
            'pytest>=7.4',
            'pytest-cov>=4.1',
            'pytest-xdist>=3.5',  # node tests wait for each other's processes: several at once
            'hypothesis>=6.98',
            'distributed>=2024.1',
            'ruff==0.17.*',  # the next minor version may format otherwise
            'mypy==2.4.*',
            'import-linter==2.*',
            'colcon-common-extensions>=0.3',
            'colcon-ros>=0.5',
            'playwright>=1.45',  # drives a browser that is there; brings none
            'setuptools<80',  # from 80 on, colcon cannot link to the sources
        ],
    },
    package_data={'tracking_tools.report': ['page.html', 'page.css', 'page.js']},
    zip_safe=True,
    entry_points={
        'console_scripts': [
            'evaluate = tracking_tools.evaluate:main',
            'radar_tracker = radar_tracker.node:main',
            'replay = tracking_tools.replay:main',
            'report = tracking_tools.report.command:main',
            'simulate = tracking_tools.simulate:main',
            'sonar_tracker = sonar_tracker.node:main',
            'sweep = tracking_tools.sweep:main',
        ],
    },
)
