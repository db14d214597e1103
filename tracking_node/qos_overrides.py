# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What may a user say of a topic's quality of service? ``qos_overrides.TOPIC.publisher.depth``."""

from __future__ import annotations

from typing import Any

PREFIX = 'qos_overrides.'
CHOICES = {
    'reliability': ('reliable', 'best_effort', 'system_default', 'best_available'),
    'history': ('keep_last', 'keep_all', 'system_default'),
}
DEPTHS = (1, 100_000)


def is_override(name: str) -> bool:
    """Return whether a parameter is a policy of a topic that can be overridden."""
    return name.startswith(PREFIX) and name.rpartition('.')[2] in (*CHOICES, 'depth')


def complaint(name: str, value: Any) -> str:
    """Return what is wrong with an override, '' for nothing."""
    policy = name.rpartition('.')[2]
    if policy in CHOICES and str(value).lower() not in CHOICES[policy]:
        return f'{name} must be one of {", ".join(CHOICES[policy])}, got {value!r}'
    if policy == 'depth':
        if not isinstance(value, int) or isinstance(value, bool):
            return f'{name} must be a whole number, got {value!r}'
        if not DEPTHS[0] <= value <= DEPTHS[1]:
            return f'{name} must be in [{DEPTHS[0]}, {DEPTHS[1]}] messages, got {value}'
    return ''
