# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The parts of the page that are text and tables; all that was recorded is escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np

from tracking_core.config import with_unit
from tracking_tools.evaluation.text import head, rows
from tracking_tools.evaluation.units import in_words, UNITS
from tracking_tools.report.material import Material, Setting

MINUTE = 60.0


def metrics_part(material: Material) -> str:
    """Return the table of the whole, and a place for GOSPA over time."""
    if material.judgement is None:
        return '<p>Without a truth nobody can say how good the tracks are.</p>'
    said = ''.join(f'<p>{escape(line)}</p>' for line in head(material.judgement))
    body = _table_rows(rows(material.judgement))
    return f'{said}<table><tbody>{body}</tbody></table><div id="gospa"></div>'


def contacts_part(material: Material) -> str:
    """Return the table of the contacts; empty without a truth."""
    if material.judgement is None:
        return ''
    unit = UNITS[material.judgement.sensor]
    body = _table_rows(
        (
            str(c.contact), f'{c.duration / MINUTE:.1f} min', f'{c.coverage:.1%}', str(c.breaks),
            str(c.id_switches), in_words(c.time_to_confirm, 0, 's'), unit.far(c.accuracy.rmse),
            ', '.join(map(str, c.tracks)),
        )
        for c in material.judgement.per_contact
    )  # fmt: skip
    names = ('contact', 'there', 'held', 'breaks', 'switches', 'confirmed', 'error', 'tracks')
    head = ''.join(f'<th scope="col">{name}</th>' for name in names)
    return f'<table class="numbers"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'


def steps_part(material: Material) -> str:
    """Return how long scans took, and a place for the histogram."""
    if not len(material.step_times):
        return '<p>The recording does not tell how long scans took.</p>'
    middle, late, most = 1000.0 * np.quantile(material.step_times, (0.5, 0.95, 1.0))
    return (
        f'<p>Half of the scans took less than {middle:.1f} ms, 95 % less than {late:.1f} ms, '
        f'all less than {most:.1f} ms.</p><div id="histogram"></div>'
    )


def settings_part(settings: Sequence[Setting]) -> str:
    """Return the parameters, those that were changed first."""
    if not settings:
        return '<p>The parameters were not given.</p>'
    changed = [s for s in settings if not s.is_default]
    usual = [s for s in settings if s.is_default]
    return (
        f'{_setting_table(changed)}<details><summary>{len(usual)} parameters with their '
        f'defaults</summary>{_setting_table(usual)}</details>'
    )


def _setting_table(settings: Sequence[Setting]) -> str:
    body = _table_rows((s.name, with_unit(s.value, s.unit), s.meaning) for s in settings)
    return f'<table><tbody>{body}</tbody></table>'


def _table_rows(cells: Iterable[tuple[str, ...]]) -> str:
    return ''.join(
        '<tr>' + ''.join(f'<td>{escape(cell)}</td>' for cell in row) + '</tr>' for row in cells
    )


def list_part(items: Iterable[str]) -> str:
    """Return a list of texts."""
    return '<ul>' + ''.join(f'<li>{escape(item)}</li>' for item in items) + '</ul>'
