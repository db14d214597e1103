# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is a parameter that this tracker does not have one of the other sensor's?"""

from __future__ import annotations

from collections.abc import Collection, Iterable

# How names begin that one sensor's tracker has and the other's has not.
_OWN = {
    'radar': (
        'alpha_beta.', 'fields.azimuth', 'fields.range', 'initiation.speed_', 'motion.horizontal.',
        'motion.vertical.', 'scan.assembly', 'sensor.azimuth_sd', 'sensor.range_',
    ),
    'sonar': (
        'fields.bearing', 'initiation.rate_', 'motion.bearing_', 'motion.rate_', 'ranging.',
        'sensor.array', 'sensor.bearing_',
    ),
}  # fmt: skip


def other_sensor(given: Iterable[str], known: Collection[str]) -> str:
    """
    Return which of the given names is the other sensor's, as the end of a sentence, or ''.

    Parameters
    ----------
    given : iterable of str
        Names of parameters.
    known : collection of str
        All names that this tracker has.

    """
    foreign = {s: own for s, own in _OWN.items() if not any(n.startswith(own) for n in known)}
    for sensor, own in foreign.items():
        for name in given:
            if name.startswith(own):
                return f'; the {sensor} tracker has {name}: is the parameter file meant for it?'
    return ''
