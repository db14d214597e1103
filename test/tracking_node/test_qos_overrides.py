# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Overrides of quality of service are refused by name, before the middleware sees them."""

import pytest

from tracking_node.qos_overrides import complaint, is_override

PLOTS = 'qos_overrides./plots.subscription'


@pytest.mark.parametrize(
    ('policy', 'value', 'words'),
    [
        (
            'reliability',
            'relyable',
            "must be one of reliable, best_effort, system_default, best_available, got 're",
        ),
        ('reliability', 1, 'must be one of reliable'),
        ('history', 'all', 'must be one of keep_last, keep_all'),
        ('depth', -3, 'must be in [1, 100000] messages, got -3'),
        ('depth', 'abc', "must be a whole number, got 'abc'"),
        ('depth', True, 'must be a whole number, got True'),
    ],
)
def test_bad_override_is_told_with_name_limit_and_value(policy, value, words):
    """The name is the full one."""
    assert f'{PLOTS}.{policy} {words}' in complaint(f'{PLOTS}.{policy}', value)


@pytest.mark.parametrize(
    ('policy', 'value'), [('reliability', 'best_effort'), ('history', 'keep_all'), ('depth', 7)]
)
def test_good_override_is_not_complained_about(policy, value):
    """Those that rclpy takes."""
    assert complaint(f'{PLOTS}.{policy}', value) == ''


def test_only_three_policies_can_be_overridden():
    """Others would have no effect, and are told as unknown parameters."""
    assert is_override(f'{PLOTS}.depth')
    assert not is_override(f'{PLOTS}.durability')
    assert not is_override('sensor.depth')
