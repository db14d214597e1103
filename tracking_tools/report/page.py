# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How everything becomes one file; nothing that was recorded is ever taken for markup."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timezone
from html import escape
from importlib.resources import files
import json
from pathlib import Path
from string import Template
from typing import Any

from bokeh.embed import json_item
from bokeh.resources import Resources
import numpy as np

from msg_adapters.message_types import LATEST
from tracking_session.node_config import Configs
from tracking_tools.arguments import make_folder
from tracking_tools.bearing_frame import frame_of_tracks
from tracking_tools.picture_style import COLOURS, FAINT
from tracking_tools.replay_topics import Topics
from tracking_tools.report.columns import (
    encode,
    modes_of,
    plan_dimensions,
    plot_columns,
    track_columns,
    truth_columns,
)
from tracking_tools.report.material import gather, Material, of_replay
from tracking_tools.report.panels import (
    gospa_panel,
    histogram,
    LIGHT_COLOURS,
    overview,
    own_panels,
)
from tracking_tools.report.parts import (
    contacts_part,
    list_part,
    metrics_part,
    settings_part,
    steps_part,
)
from tracking_tools.report.plan import KM, lead_time, plan_unit
from tracking_tools.report.stage import bearing_record, plan_view
from tracking_tools.scene import Scene

MINUTE, HOUR = 60.0, 3600.0
LONG = 3.0 * HOUR
MILLENNIUM = 946_684_800.0  # stamps since then are of a clock, not of a simulation [s]


def write_page(material: Material, path: Path | str) -> None:
    """Write the page; its folder is made when it is missing."""
    path = Path(path)
    make_folder(path.parent)
    path.write_text(page(material), encoding='utf-8')


def report_replay(
    where: tuple[str, Topics, Path, Path],
    configs: Configs,
    step_times: Sequence[float],
    path: Path | str,
) -> None:
    """
    Write the page of a recording that was just tracked.

    Parameters
    ----------
    where : tuple
        'radar' or 'sonar', topics, bag of the plots, bag of the tracks.
    configs : tuple
        Parameters of the tracker and its node.
    step_times : sequence of float
        Of each scan [s]; empty: as recorded.
    path : Path or str
        File to write.

    """
    write_page(gather(of_replay(*where), configs, step_times, title=where[2].name), path)


def page(material: Material) -> str:
    """Return the page as HTML."""
    table = track_columns(material.scene)
    parts = files('tracking_tools.report')
    return Template(parts.joinpath('page.html').read_text('utf-8')).substitute(
        title=escape(material.title),
        summary=escape(_summary(material, table)),
        style=parts.joinpath('page.css').read_text('utf-8'),
        bokeh=Resources(mode='inline', components=['bokeh'], log_level='error').render_js(),
        data=safe_json(_content(material, table)),
        script=parts.joinpath('page.js').read_text('utf-8'),
        metrics=metrics_part(material),
        contacts=contacts_part(material),
        steps=steps_part(material),
        settings=settings_part(material.settings),
        sources=list_part(f'{what}: {where}' for what, where in material.sources),
    )


def _content(material: Material, table: dict[str, Any]) -> dict[str, Any]:
    """Return all that the script needs."""
    scene = material.scene
    stamps = np.unique(table['stamp'])
    period = float(np.median(np.diff(stamps))) if len(stamps) > 1 else 1.0
    modes = len(modes_of(table))
    unit, lead = KM, 0.0
    if isinstance(scene, Scene):
        unit, lead = plan_unit(scene), lead_time(table)
        kind, stage = 'plan', plan_view('km' if unit == KM else 'm')
        dimensions = plan_dimensions(scene.published)
    else:
        kind, stage, dimensions = 'record', bearing_record(frame_of_tracks(scene)), 1
    own = own_panels(modes, dimensions)
    figures = {'stage': stage, 'own': own, 'overview': overview(table, period)}
    if material.judgement is not None:
        figures['gospa'] = gospa_panel(material.judgement)
    if len(material.step_times):
        figures['histogram'] = histogram(material.step_times)
    return {
        'kind': kind,
        'period': period,
        'modes': modes,
        'unit': unit,
        'lead': lead,
        'colours': COLOURS,
        'lights': list(LIGHT_COLOURS.values()),
        'faint': FAINT,
        'tracks': encode(table),
        'plots': encode(plot_columns(scene)),
        'truth': encode(truth_columns(scene)),
        'scans': encode({'stamp': stamps}),
        'figures': {name: json_item(figure, name) for name, figure in figures.items()},
    }


def safe_json(content: dict[str, Any]) -> str:
    """Return JSON that no text in it can end or leave: no <, no & and no line separators."""
    text = json.dumps(content, separators=(',', ':'))
    return text.replace('<', '\\u003c').replace('>', '\\u003e').replace('&', '\\u0026')


def _summary(material: Material, table: dict[str, Any]) -> str:
    scene = material.scene
    plots = scene.plots if isinstance(scene, Scene) else scene.marks
    count, what = len(plots.get('time', ())), 'plots' if isinstance(scene, Scene) else 'marks'
    parts = [
        _duration(float(np.ptp(table['stamp']))) + _since(scene.begin),
        f'{len(np.unique(table["stamp"]))} scans with tracks',
        *([f'{count} {what}'] if count else []),
        *([f'{len(np.unique(scene.truth["id"]))} contacts'] if scene.has_truth else []),
        f'{len(np.unique(table["id"]))} confirmed tracks',
    ]
    return ' · '.join(parts)


def _since(begin: float) -> str:
    """Return when a recording began [s since the epoch], '' of simulated time."""
    if not MILLENNIUM < begin < LATEST:
        return ''
    return f' from {datetime.fromtimestamp(begin, timezone.utc):%Y-%m-%d %H:%M:%S} UTC'


def _duration(span: float) -> str:
    """Return a time [s] in words."""
    if span < 2.0 * MINUTE:
        return f'{span:.0f} seconds'
    return f'{span / MINUTE:.0f} minutes' if span < LONG else f'{span / HOUR:.1f} hours'
