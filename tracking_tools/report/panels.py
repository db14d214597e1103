# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The figures over time: one track, all tracks at once, GOSPA, and how long a scan took."""

from __future__ import annotations

from typing import Any

from bokeh.layouts import column
from bokeh.models import ColumnDataSource, FixedTicker, LinearColorMapper, Span
import bokeh.plotting
import numpy as np
from numpy.typing import NDArray

from msg_adapters.table import Columns
from tracking_core.batches import Bools, Floats, Ints
from tracking_core.chances import chi_square_bound
from tracking_tools.evaluation import Judgement
from tracking_tools.evaluation.units import UNITS
from tracking_tools.picture_style import COLOURS, FAINT, INK, PANEL, PROBABILITY, TURN
from tracking_tools.report.columns import AMBER, DARK, GREEN, LIGHTS, RED
from tracking_tools.report.stage import dress, MINUTE
from tracking_tools.scoring.stretches import absences, OUT_OF_SIGHT

LIGHT_COLOURS = {GREEN: '#43c59e', AMBER: '#f9c74f', RED: '#f25f5c', DARK: '#56657c'}
WIDEST = 2000  # cells of the overview
NOTHING = 101  # a cell without a track
MAPS = {
    'existence': ('#f25f5c', '#f25f5c', '#f8961e', '#f9c74f', '#7fb8a4', '#2f7d95'),
    'manoeuvre': ('#26364d', '#5b4a3d', '#96692f', '#ffb454', '#ffe3b8'),
}
CLEAR = 'rgba(0, 0, 0, 0)'
LABELS = 40  # of an axis


def own_panels(modes: int, dimensions: int) -> Any:
    """Return the figures of the chosen track over time [min], empty."""
    names = ['t', 'existence', 'manoeuvre', 'nis', 'colour', *(f'p_{j}' for j in range(modes))]
    rows = ColumnDataSource({name: [] for name in names}, name='own')
    first = over_time('own_existence', 'probability', 150, y_range=(-0.03, 1.03))
    first.line('t', 'existence', source=rows, color=TURN, line_width=2, legend_label='exists')
    first.line('t', 'manoeuvre', source=rows, color=PROBABILITY, line_width=2,
               legend_label='manoeuvres')  # fmt: skip
    second = over_time('own_modes', 'modes', 140, x_range=first.x_range, y_range=(0.0, 1.0))
    colours = [COLOURS[j % len(COLOURS)] for j in range(modes)]
    second.varea_stack([f'p_{j}' for j in range(modes)], x='t', source=rows, color=colours,
                       alpha=0.75, legend_label=[f'mode {j}' for j in range(modes)])  # fmt: skip
    third = over_time('own_nis', 'NIS', 150, x_range=first.x_range, y_range=(0.0, 1.0))
    third.y_range.end = 1.6 * chi_square_bound(LIGHTS[1], dimensions)
    for share, light in zip(LIGHTS, (AMBER, RED), strict=True):
        third.add_layout(Span(dimension='width', location=chi_square_bound(share, dimensions),
                              line_color=LIGHT_COLOURS[light], line_dash='dotted'))  # fmt: skip
    third.scatter('t', 'nis', source=rows, color='colour', size=4)
    shown = (first, second, third) if modes > 1 else (first, third)
    for figure in shown[:-1]:
        _legend(figure)
        figure.xaxis.visible = False
    return column(*shown, sizing_mode='stretch_width')


def overview(table: Columns, period: float) -> Any:
    """
    Return all tracks over time [min], a row each: existence, manoeuvre, light of the NIS.

    Parameters
    ----------
    table : dict of columns
        As of `track_columns`.
    period : float
        From scan to scan [s].

    """
    ids = np.unique(table['id'])
    end = float(table['stamp'].max()) + period
    cells = int(np.clip(np.ceil(end / period), 1, WIDEST))
    row, cell = _filled(table['stamp'], period, end, cells)
    at = (np.searchsorted(ids, table['id'])[row], cell)
    figure = over_time('overview', '', max(140, min(15 * len(ids) + 60, 520)), (0.0, end / MINUTE),
                       (len(ids), 0.0), tools='xpan,xwheel_zoom,reset')  # fmt: skip
    figure.yaxis.ticker = FixedTicker(ticks=(np.arange(len(ids)) + 0.5)[:: _step(len(ids))])
    figure.yaxis.major_label_overrides = {k + 0.5: str(number) for k, number in enumerate(ids)}
    figure.yaxis.axis_label, figure.grid.visible = 'track', False
    for name, palette in (*MAPS.items(), ('light', tuple(LIGHT_COLOURS.values()))):
        values = table[name] if name == 'light' else np.round(100.0 * np.nan_to_num(table[name]))
        image: NDArray[np.uint8] = np.full((len(ids), cells), NOTHING, np.uint8)
        image[at] = values.astype(np.uint8)[row]
        high = len(palette) - 1 if name == 'light' else 100
        mapper = LinearColorMapper(palette, low=0, high=high, high_color=CLEAR)
        drawn = figure.image([image], x=0.0, y=0.0, dw=end / MINUTE, dh=len(ids),
                             color_mapper=mapper, name=f'overview_{name}')  # fmt: skip
        drawn.visible = name == 'existence'
    return figure


def _filled(stamp: Floats, period: float, end: float, cells: int) -> tuple[Ints, Ints]:
    """
    Return rows (N,) of a table, and the cells (N,) of the time up to `end` [s] that they fill.

    Each row lasts to the next scan; where that comes after a pause, one `period` [s].
    """
    moments, scan = np.unique(stamp, return_inverse=True)
    until = np.append(moments[1:], end)
    until = np.where(until - moments <= OUT_OF_SIGHT * period, until, moments + period)
    first, beyond = ((time * (cells / end)).astype(int) for time in (moments, until))
    count = np.maximum(beyond - first, 1)[scan]
    row = np.repeat(np.arange(len(stamp)), count)
    nth = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    return row, np.minimum(first[scan][row] + nth, cells - 1)


def gospa_panel(judgement: Judgement) -> Any:
    """Return the metric scan by scan, and how many contacts are missed and tracks false."""
    unit, p, scans = UNITS[judgement.sensor], judgement.gospa.power, judgement.by_scan
    scan, is_end = _pieces(scans.time)
    time = scans.time[scan] / MINUTE
    figure = over_time('gospa', f'GOSPA [{unit.far_unit}]', 150)
    figure.line(time, np.where(is_end, np.nan, unit.scale * scans.gospa[scan]), color=INK,
                legend_label='GOSPA')  # fmt: skip
    one = unit.scale * (0.5 * judgement.gospa.cutoff**p) ** (1.0 / p)
    for name, colour in (('missed', PROBABILITY), ('false', LIGHT_COLOURS[RED])):
        part = np.where(is_end, 0.0, one * getattr(scans, name)[scan] ** (1.0 / p))
        figure.varea(time, 0.0 * part, part, color=colour, alpha=0.4, legend_label=name)
    _legend(figure)
    return figure


def _pieces(time: Floats) -> tuple[Ints, Bools]:
    """Return rows between pauses, each end of a piece once more, and which are such ends."""
    parts = np.split(np.arange(len(time)), absences(np.zeros(len(time), np.int64), time))
    ends = [np.pad(np.zeros(len(part), bool), 1, constant_values=True) for part in parts]
    return np.concatenate([np.pad(part, 1, 'edge') for part in parts]), np.concatenate(ends)


def histogram(step_times: Floats) -> Any:
    """Return how long scans took [ms]."""
    milliseconds = 1000.0 * step_times
    widest = max(float(np.quantile(milliseconds, 0.995)), 1e-3)
    count, edge = np.histogram(np.minimum(milliseconds, widest), 40, (0.0, widest))
    figure = dress(
        bokeh.plotting.figure(
            name='histogram', height=190, sizing_mode='stretch_width', tools='',
            x_axis_label='time of a scan [ms]', y_axis_label='scans', toolbar_location=None,
        )
    )  # fmt: skip
    figure.quad(left=edge[:-1], right=edge[1:], top=count, bottom=0, color=TURN, alpha=0.7,
                line_color=PANEL)  # fmt: skip
    for share in (0.5, 0.95):
        figure.add_layout(Span(dimension='height', line_color=INK, line_dash='dashed',
                               location=float(np.quantile(milliseconds, share))))  # fmt: skip
    return figure


def over_time(
    name: str, label: str, height: int, x_range: Any = None, y_range: Any = None, tools: str = ''
) -> Any:
    """Return a figure over time [min] with a cursor that shows the moment."""
    ranges = {'x_range': x_range, 'y_range': y_range}
    given = {key: value for key, value in ranges.items() if value is not None}
    figure = dress(
        bokeh.plotting.figure(
            name=name, height=height, sizing_mode='stretch_width', tools=tools, min_border=2,
            toolbar_location=None, x_axis_label='time [min]', y_axis_label=label, **given,
        )
    )  # fmt: skip
    figure.add_layout(Span(name=f'cursor_{name}', dimension='height', location=0.0, line_color=INK,
                           line_alpha=0.7))  # fmt: skip
    if tools:
        figure.toolbar.active_scroll = 'auto'
    return figure


def _legend(figure: Any) -> None:
    legend = figure.legend[0]
    figure.add_layout(legend, 'above')
    legend.orientation, legend.padding, legend.margin, legend.spacing = 'horizontal', 0, 0, 12
    legend.background_fill_alpha = legend.border_line_alpha = 0.0
    legend.label_text_color, legend.label_text_font_size = FAINT, '11px'
    legend.glyph_height = legend.label_height = 12


def _step(count: int) -> int:
    return -(-count // LABELS)
