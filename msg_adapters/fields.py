# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which field of a driver's message is which of ours: names, synonyms and the user's word."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from msg_adapters.bad_message import BadMessage

SYNONYMS = {
    'range': ('r', 'rho', 'distance', 'slant_range'),
    'azimuth': ('azimuth_angle', 'azim', 'az', 'theta'),
    'elevation': ('elevation_angle', 'el', 'phi'),
    'x': (),
    'y': (),
    'z': (),
    'range_rate': (
        'doppler', 'doppler_velocity', 'radial_speed', 'radial_velocity',
        'radar_relative_radial_velocity', 'v_r', 'vr', 'v',
    ),
    'snr': ('signal_to_noise_ratio',),
    'amplitude': ('power', 'intensity', 'rcs'),
    'time': ('t', 'time_offset', 'stamp_offset'),
}  # fmt: skip
WITH_NOISE = ('range', 'azimuth', 'elevation', 'range_rate', 'x', 'y', 'z')
# Of a Cartesian plot; `x_sd` and its like say less and give way.
COVARIANCE = tuple(f'covariance_{axes}' for axes in ('xx', 'xy', 'xz', 'yy', 'yz', 'zz'))
# Nobody knows whether this one is radial, or of which sign; fields.range_rate may name it.
AMBIGUOUS = 'velocity'


def _noise_names(bases: tuple[str, ...]) -> tuple[str, ...]:
    endings = [f'{base}_{end}' for base in bases for end in ('sd', 'std', 'stddev')]
    return (*endings, *(f'sigma_{base}' for base in bases))


# Every field that we read, with the names it is known by, best first.
Names = Mapping[str, tuple[str, ...]]
PLOTS: Names = {
    **{ours: (ours, *others) for ours, others in SYNONYMS.items()},
    **{f'{ours}_sd': _noise_names((ours, *SYNONYMS[ours])) for ours in WITH_NOISE},
    **{ours: (ours,) for ours in COVARIANCE},
}
_BEARING = ('bearing', *PLOTS['azimuth'])
BEARINGS: Names = {
    'bearing': _BEARING,
    'bearing_sd': _noise_names(_BEARING),
    **{ours: PLOTS[ours] for ours in ('snr', 'time')},
}


def find_fields(
    there: Iterable[str], names: Names, overrides: Mapping[str, str]
) -> dict[str, str]:
    """
    Return the message's field for each of ours that it has.

    Parameters
    ----------
    there : iterable of str
        Field names of the message.
    names : mapping
        `PLOTS` or `BEARINGS`.
    overrides : mapping
        Ours to theirs, as the user says; empty values say nothing.

    Returns
    -------
    dict
        Ours to theirs.

    Raises
    ------
    BadMessage
        When a field that the user named is not there.

    """
    known = {name.lower(): name for name in reversed(list(there))}
    found = {
        ours: known[name]
        for ours, synonyms in names.items()
        for name in reversed(synonyms)
        if name in known
    }
    for ours, theirs in overrides.items():
        if not theirs:
            continue
        if theirs.lower() not in known:
            raise BadMessage(
                'missing field',
                f'field {theirs} (parameter fields.{ours}) is missing; {describe(there)}',
            )
        found[ours] = known[theirs.lower()]
    return found


def describe(there: Iterable[str]) -> str:
    """Return a sentence part that says which fields a message has."""
    return f'fields are: {", ".join(there) or "none"}'
