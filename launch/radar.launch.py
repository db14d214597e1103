# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Start the radar tracker."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

SHARE = FindPackageShare('contact_tracking')
TOPICS = ('plots', 'ownship')
# Name, default and meaning.
ARGUMENTS = (
    ('preset', 'radar.yaml', 'parameter file among those shipped'),
    (
        'params_file',
        PathJoinSubstitution([SHARE, 'config', LaunchConfiguration('preset')]),
        'parameter file of the node',
    ),
    ('namespace', '', 'namespace of the node and its topics'),
    ('plots', 'plots', 'topic with the radar plots'),
    ('ownship', 'ownship', 'topic with the odometry of the platform, if it moves'),
    ('use_sim_time', 'false', 'take the time from /clock'),
    ('autostart', 'true', 'configure and activate the node at once'),
    ('log_level', 'info', 'debug, info, warn, error or fatal'),
)


def generate_launch_description():
    """Describe one node and the arguments that a site sets."""
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=meaning)
        for name, default, meaning in ARGUMENTS
    ]
    return LaunchDescription([*declared, _tracker()])


def _tracker():
    return Node(
        package='contact_tracking',
        executable='radar_tracker',
        name='radar_tracker',
        namespace=LaunchConfiguration('namespace'),
        output='screen',
        parameters=[{name: _switch(name) for name in ('use_sim_time', 'autostart')}],
        remappings=[(topic, LaunchConfiguration(topic)) for topic in TOPICS],
        arguments=[
            # In parameters, launch skips a file that is not there; the node ends and names it.
            '--ros-args', '--params-file', LaunchConfiguration('params_file'),
            '--log-level', LaunchConfiguration('log_level'),
        ],
    )  # fmt: skip


def _switch(name):
    return ParameterValue(LaunchConfiguration(name), value_type=bool)
