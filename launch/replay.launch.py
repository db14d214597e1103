# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Play a bag to a tracker, record its tracks, and show them in RViz if wanted."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, Shutdown
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

SHARE = FindPackageShare('contact_tracking')
TRACKER = [LaunchConfiguration('sensor'), '_tracker']
SIMULATED = {'use_sim_time': ParameterValue(LaunchConfiguration('use_sim_time'), value_type=bool)}
# Name, default and meaning; a list is put together from its parts.
ARGUMENTS = (
    ('bag', 'recording', 'bag to play'),
    ('sensor', 'radar', 'radar or sonar: whose tracker'),
    ('preset', [LaunchConfiguration('sensor'), '.yaml'], 'parameter file among those shipped'),
    (
        'params_file',
        PathJoinSubstitution([SHARE, 'config', LaunchConfiguration('preset')]),
        'parameter file of the node',
    ),
    ('namespace', '', 'namespace of the node and its topics'),
    ('plots', '/plots', 'topic of the bag with the radar plots'),
    ('bearings', '/bearings', 'topic of the bag with the marks of a sonar'),
    ('ownship', '/ownship', 'topic of the bag with the odometry of the platform'),
    ('use_sim_time', 'true', 'take the time from the clock of the bag'),
    ('autostart', 'true', 'configure and activate the node at once'),
    ('log_level', 'info', 'debug, info, warn, error or fatal'),
    ('rate', '1.0', 'times real time'),
    ('delay', '3.0', 'seconds before the bag is played, for all to find each other'),
    ('record', 'true', 'whether to record what the tracker publishes'),
    ('output', 'tracks', 'bag to record; it must not exist'),
    ('rviz', 'false', 'whether to start RViz'),
    ('view', [LaunchConfiguration('sensor'), '.rviz'], 'RViz configuration among those shipped'),
    (
        'rviz_config',
        PathJoinSubstitution([SHARE, 'rviz', LaunchConfiguration('view')]),
        'RViz configuration',
    ),
)


def generate_launch_description():
    """Describe tracker, recorder and viewer, and the player that ends them all."""
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=meaning)
        for name, default, meaning in ARGUMENTS
    ]
    return LaunchDescription([*declared, _tracker(), _recorder(), _viewer(), _player()])


def _tracker():
    return Node(
        package='contact_tracking',
        executable=TRACKER,
        name=TRACKER,
        namespace=LaunchConfiguration('namespace'),
        output='screen',
        parameters=[
            {
                **SIMULATED,
                'autostart': ParameterValue(LaunchConfiguration('autostart'), value_type=bool),
            },
        ],
        remappings=[
            ('plots', LaunchConfiguration('plots')),
            ('bearings', LaunchConfiguration('bearings')),
            ('ownship', LaunchConfiguration('ownship')),
        ],
        arguments=[
            # In parameters, launch skips a file that is not there; the node ends and names it.
            '--ros-args', '--params-file', LaunchConfiguration('params_file'),
            '--log-level', LaunchConfiguration('log_level'),
        ],
    )  # fmt: skip


def _recorder():
    return ExecuteProcess(
        cmd=[
            'ros2', 'bag', 'record', '--use-sim-time', '--output', LaunchConfiguration('output'),
            '--regex', ['.*/', *TRACKER, '/(tracks|odometry|markers)'],
        ],
        output='screen',
        condition=IfCondition(LaunchConfiguration('record')),
    )  # fmt: skip


def _viewer():
    return Node(
        package='rviz2',
        executable='rviz2',
        name='rviz2',
        output='log',
        parameters=[SIMULATED],
        arguments=['-d', LaunchConfiguration('rviz_config')],
        condition=IfCondition(LaunchConfiguration('rviz')),
    )


def _player():
    return ExecuteProcess(
        cmd=[
            'ros2', 'bag', 'play', LaunchConfiguration('bag'), '--clock', '100',
            '--rate', LaunchConfiguration('rate'), '--delay', LaunchConfiguration('delay'),
            # What a tracker of this name said then; now it says so itself.
            '-x', ['.*/', *TRACKER, '/.*|/diagnostics'],
        ],
        output='screen',
        on_exit=Shutdown(reason='the bag is over'),
    )  # fmt: skip
