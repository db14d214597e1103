# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Start the trackers of two radars and an array, each in its namespace: a pattern to copy."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

CONFIG = [FindPackageShare('contact_tracking'), 'config']
# Namespace, tracker, its input and its parameter file.
SENSORS = (
    ('air_radar', 'radar_tracker', 'plots', 'air_surveillance_3d.yaml'),
    ('navigation_radar', 'radar_tracker', 'plots', 'marine_radar.yaml'),
    ('array', 'sonar_tracker', 'bearings', 'passive_linear_array.yaml'),
)
COMMON = (
    ('namespace', '', 'namespace of all three, in which each has its own'),
    ('ownship', '/ownship', 'topic with the odometry of the platform, if it moves'),
    ('use_sim_time', 'false', 'take the time from /clock'),
    ('autostart', 'true', 'configure and activate the nodes at once'),
    ('log_level', 'info', 'debug, info, warn, error or fatal'),
)


def generate_launch_description():
    """Describe three nodes, the arguments of each and those of all."""
    arguments = [*COMMON]
    for sensor, _, topic, file in SENSORS:
        shipped = PathJoinSubstitution([*CONFIG, file])
        arguments += [
            (f'{sensor}_params_file', shipped, f'parameter file of {sensor}'),
            (f'{sensor}_{topic}', topic, f'topic of {sensor} with the {topic}'),
        ]
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=meaning)
        for name, default, meaning in arguments
    ]
    trackers = [_tracker(sensor, tracker, topic) for sensor, tracker, topic, _ in SENSORS]
    return LaunchDescription([*declared, *trackers])


def _tracker(sensor, tracker, topic):
    return Node(
        package='contact_tracking',
        executable=tracker,
        name=tracker,
        namespace=[LaunchConfiguration('namespace'), '/', sensor],
        output='screen',
        parameters=[
            {
                name: ParameterValue(LaunchConfiguration(name), value_type=bool)
                for name in ('use_sim_time', 'autostart')
            },
        ],
        remappings=[
            (topic, LaunchConfiguration(f'{sensor}_{topic}')),
            ('ownship', LaunchConfiguration('ownship')),
        ],
        arguments=[
            # In parameters, launch skips a file that is not there; the node ends and names it.
            '--ros-args', '--params-file', LaunchConfiguration(f'{sensor}_params_file'),
            '--log-level', LaunchConfiguration('log_level'),
        ],
    )  # fmt: skip
