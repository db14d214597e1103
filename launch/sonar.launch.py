# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Start the sonar tracker."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Describe one node and the arguments that a site sets."""
    shipped = PathJoinSubstitution([FindPackageShare('contact_tracking'), 'config', 'sonar.yaml'])
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'params_file', default_value=shipped, description='parameter file of the node'
            ),
            DeclareLaunchArgument(
                'namespace', default_value='', description='namespace of the node and its topics'
            ),
            DeclareLaunchArgument(
                'bearings', default_value='bearings', description='topic with the marks'
            ),
            DeclareLaunchArgument(
                'ownship',
                default_value='ownship',
                description='topic with the odometry of the platform, if it moves',
            ),
            DeclareLaunchArgument(
                'use_sim_time', default_value='false', description='take the time from /clock'
            ),
            DeclareLaunchArgument(
                'autostart',
                default_value='true',
                description='configure and activate the node at once',
            ),
            DeclareLaunchArgument(
                'log_level', default_value='info', description='debug, info, warn, error or fatal'
            ),
            Node(
                package='contact_tracking',
                executable='sonar_tracker',
                name='sonar_tracker',
                namespace=LaunchConfiguration('namespace'),
                output='screen',
                parameters=[
                    LaunchConfiguration('params_file'),
                    {
                        'use_sim_time': ParameterValue(
                            LaunchConfiguration('use_sim_time'), value_type=bool
                        ),
                        'autostart': ParameterValue(
                            LaunchConfiguration('autostart'), value_type=bool
                        ),
                    },
                ],
                remappings=[
                    ('bearings', LaunchConfiguration('bearings')),
                    ('ownship', LaunchConfiguration('ownship')),
                ],
                arguments=['--ros-args', '--log-level', LaunchConfiguration('log_level')],
            ),
        ]
    )
