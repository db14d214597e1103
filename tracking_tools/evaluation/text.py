# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How figures are shown: a table for people, JSON for programs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
import json
import math
from typing import Any

import numpy as np

from tracking_tools.evaluation.judgement import ContactJudgement, Judgement
from tracking_tools.evaluation.units import in_words, percent, Unit, UNITS
from tracking_tools.scoring.consistency import Consistency

MINUTE = 60.0
AMBIGUOUS = 1.5  # tracks on a contact
FEW = 0.01  # of the rows
LARGEST = 0.2  # part of where contacts were that a match radius may be
PART = 0.25  # of the errors that the truth may have


def to_json(judgement: Judgement) -> str:
    """Return all figures, in SI units and radians; what is not a number is null."""
    return json.dumps(plain(asdict(judgement)), indent=1, allow_nan=False)


def plain(value: Any) -> Any:
    """Return figures as JSON knows them."""
    if isinstance(value, dict):
        return {name: plain(part) for name, part in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(part) for part in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def to_text(judgement: Judgement) -> str:
    """Return the figures as a table."""
    unit = UNITS[judgement.sensor]
    lines = [
        *head(judgement),
        '',
        *(f'{name:<24}{value:>14}  {remark}'.rstrip() for name, value, remark in rows(judgement)),
        '',
        ' contact      there     held  rel. time  breaks  switches  confirm       error  tracks',
        *(_contact(contact, unit) for contact in judgement.per_contact),
    ]
    false = [track.track for track in judgement.per_track if track.contact is None]
    if false:
        lines.append(f'false tracks: {", ".join(map(str, false))}')
    return '\n'.join(lines)


def head(judgement: Judgement) -> list[str]:
    """Return what was compared, and a word on a match radius that tells little."""
    unit = UNITS[judgement.sensor]
    return [
        f'{judgement.sensor}: {judgement.scans} scans in {judgement.duration / MINUTE:.1f} min, '
        f'{judgement.contacts} contacts, {judgement.tracks} confirmed tracks; '
        f'matched within {unit.far(judgement.radius)}'
        + (' over the ground' if judgement.dimensions == 2 else ''),
        *_doubt(judgement, unit),
    ]


def _doubt(judgement: Judgement, unit: Unit) -> Iterator[str]:
    """Yield words on figures that tell less of the tracks than they seem to."""
    if judgement.contacts > 1 and judgement.radius > LARGEST * judgement.extent:
        yield (
            f'all contacts were within {unit.far(judgement.extent)}, so the match radius tells '
            'little: set --radius'
        )
    if judgement.outside > FEW:
        yield (
            f'{judgement.outside:.0%} of the rows of tracks are from before or after all truth: '
            'they count as false'
        )
    if judgement.truth_error > PART * judgement.accuracy.rmse:
        yield (
            f'between its samples the truth is known to some {unit.far(judgement.truth_error)} '
            'only: errors are those of the truth, too; it should be told more often'
        )
    if judgement.siap.ambiguity > AMBIGUOUS:
        yield (
            f'contacts have {judgement.siap.ambiguity:.1f} tracks at a time: two trackers in one '
            'bag, a recording that was played twice, or several plots of a contact?'
        )


def rows(judgement: Judgement) -> Iterator[tuple[str, str, str]]:
    """Yield name, value and remark of each figure of the whole."""
    yield from _held_rows(judgement)
    yield from _accuracy_rows(judgement)
    yield 'NEES position', _number(judgement.nees_position.mean), _band(judgement.nees_position)
    yield 'NEES state', _number(judgement.nees_state.mean), _band(judgement.nees_state)
    yield 'NIS, nearest mode', _number(judgement.nis.mean), _nearest(judgement.nis)
    yield from _set_rows(judgement)
    if judgement.ranges is not None:
        ranges = judgement.ranges
        yield (
            'range RMSE',
            in_words(ranges.rmse, 0, 'm'),
            f'told in {percent(ranges.share, 1)} of the rows',
        )


def _held_rows(judgement: Judgement) -> Iterator[tuple[str, str, str]]:
    held, timing = judgement.held, judgement.timing
    yield 'coverage', percent(held.coverage, 2), 'of the scans with a contact'
    yield 'breaks', str(held.breaks), ''
    changes = f'{held.lasting_switches} lasting; {held.new_ids_after_absence} after an absence'
    yield 'id switches', str(held.id_switches), changes
    yield 'purity', percent(held.purity, 2), ''
    yield (
        'relative tracking time',
        _number(held.relative_tracking_time),
        'one break or new id halves it',
    )
    yield 'false tracks', str(held.false_tracks), f'{held.false_tracks_per_hour:.1f} an hour'
    late, latest = timing.time_to_confirm_median, timing.time_to_confirm_max
    never = f'; {timing.never_confirmed} contacts never' if timing.never_confirmed else ''
    confirm = f'median {in_words(late, 1, "s")}, most {in_words(latest, 1, "s")}{never}'
    yield 'time to confirm', in_words(timing.time_to_confirm_mean, 1, 's'), confirm
    told = f'{timing.manoeuvres_told} of {timing.manoeuvres} manoeuvres told'
    yield 'onset delay', in_words(timing.onset_delay_mean, 1, 's'), told
    alarm = timing.manoeuvre_false_alarm
    yield 'manoeuvre false alarm', percent(alarm, 2), 'of the rows in straight motion'


def _accuracy_rows(judgement: Judgement) -> Iterator[tuple[str, str, str]]:
    a, unit = judgement.accuracy, UNITS[judgement.sensor]
    far, fast = unit.far, unit.fast
    split = f'straight {far(a.rmse_straight)}, turning {far(a.rmse_turning)}'
    yield f'{unit.place} RMSE', far(a.rmse), split
    split = f'straight {fast(a.velocity_straight)}, turning {fast(a.velocity_turning)}'
    yield f'{unit.motion} RMSE', fast(a.velocity_rmse), split


def _set_rows(judgement: Judgement) -> Iterator[tuple[str, str, str]]:
    g, o, s, far = judgement.gospa, judgement.ospa, judgement.siap, UNITS[judgement.sensor].far
    parts = f'localisation {far(g.localisation)}, missed {far(g.missed)}, false {far(g.false)}'
    yield 'GOSPA', far(g.mean), f'rms {far(g.rms)}: {parts}; c {far(g.cutoff)}, p {g.power:g}'
    parts = f'localisation {far(o.localisation)}, cardinality {far(o.cardinality)}'
    yield 'OSPA', far(o.mean), f'{parts}; c {far(o.cutoff)}, p {o.power:g}'
    picture = f'ambiguity {_number(s.ambiguity)}, spuriousness {percent(s.spuriousness, 2)}'
    yield 'SIAP completeness', percent(s.completeness, 2), picture


def _band(found: Consistency) -> str:
    if not found.samples:
        return 'no samples'
    verdict = 'inside' if found.is_inside else 'outside'
    return (
        f'per dimension; {verdict} {found.low:.3f} to {found.high:.3f}, the 95 % band of '
        f'{found.samples} samples were they independent; {_inside(found)}'
    )


def _nearest(found: Consistency) -> str:
    """Return what can be said of distances from the nearest mode: no band holds for them."""
    if not found.samples:
        return 'no samples'
    return f'per dimension; below 1 where several modes are right; {_inside(found)}'


def _inside(found: Consistency) -> str:
    return f'{found.inside:.1%} below the 95 % quantile of one'


def _contact(contact: ContactJudgement, unit: Unit) -> str:
    ids = ', '.join(map(str, contact.tracks)) or 'none'
    confirm = in_words(contact.time_to_confirm, 0, 's')
    return (
        f'{contact.contact:8d} {contact.duration / MINUTE:6.1f} min {contact.coverage:8.1%} '
        f'{contact.relative_tracking_time:10.3f} {contact.breaks:7d} {contact.id_switches:9d} '
        f'{confirm:>8} {unit.far(contact.accuracy.rmse):>11}  {ids}'
    )


def _number(value: float) -> str:
    return f'{value:.3f}' if math.isfinite(value) else 'none'
