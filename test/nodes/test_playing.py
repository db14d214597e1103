# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A recording is played to a live node message by message."""

from rclpy.serialization import serialize_message

from tracking_tools.recording import open_player, stamp_of


def test_first_answer_may_have_been_lost(start_node, probe, ros_domain_id):
    """A tracker that has answered before it knew the player begins anew and answers again."""
    node = start_node()
    probe.meet()
    probe.stamp += 1.0
    question = serialize_message(probe.send(probe.sensor.contacts(probe.stamp), probe.stamp))
    probe.spin_until(lambda: probe.is_answered(probe.stamp), 'the answer that the player misses')
    topics = probe.sensor.topic, f'{probe.sensor.node}/tracks'
    with open_player(*topics, ros_domain_id, node.check) as player:
        player.find_tracker()
        assert stamp_of(player.ask(question)) == stamp_of(question)
