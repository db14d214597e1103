# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The figure that plays a recording: plan view of a radar, bearing-time record of a sonar."""

from __future__ import annotations

from typing import Any

from bokeh.models import BasicTickFormatter, BoxZoomTool, ColumnDataSource, Span
import bokeh.plotting

from tracking_tools.bearing_frame import Frame
from tracking_tools.picture_style import BACK, FAINT, INK, LINES, MARK, PLOT, TRUE

MINUTE = 60.0
FONT = 'sans-serif'
GROUND = '#0d1726'  # of a figure, between page and panel
TOOLS = ('pan', 'wheel_zoom', 'reset')
# What each layer is drawn from; the page's script fills it.
LAYERS = {
    'all_plots': ('x', 'y'),
    'truth_paths': ('xs', 'ys'),
    'paths': ('xs', 'ys', 'colour', 'alpha'),
    'plots': ('x', 'y', 'alpha'),
    'gates': ('x', 'y', 'width', 'height', 'colour'),
    'ellipses': ('x', 'y', 'width', 'height', 'angle', 'colour'),
    'trails': ('xs', 'ys', 'colour'),
    'velocities': ('x', 'y', 'x1', 'y1', 'colour'),
    'truth': ('x', 'y'),
    'chosen': ('x', 'y'),
    'now': ('x', 'y', 'colour', 'label'),
}


def plan_view(unit: str) -> Any:
    """Return the plan view in this unit, empty."""
    plan = dress(
        bokeh.plotting.figure(
            name='stage', sizing_mode='stretch_both', active_scroll='wheel_zoom', min_border=4,
            tools=[*TOOLS, BoxZoomTool(match_aspect=True)], x_axis_label=f'east [{unit}]',
            y_axis_label=f'north [{unit}]', x_range=(0.0, 1.0), y_range=(0.0, 1.0),
        )
    )  # fmt: skip
    layers = sources()
    plan.scatter('x', 'y', source=layers['all_plots'], size=2, color=PLOT, alpha=0.35)
    _lines(plan, layers)
    plan.scatter('x', 'y', source=layers['plots'], size=4, color=MARK, fill_alpha='alpha',
                 line_alpha=0.0)  # fmt: skip
    plan.ellipse('x', 'y', 'width', 'height', source=layers['gates'], fill_alpha=0.0,
                 line_color='colour', line_dash='dotted', line_alpha=0.8)  # fmt: skip
    plan.ellipse('x', 'y', 'width', 'height', 'angle', source=layers['ellipses'],
                 fill_color='colour', fill_alpha=0.28, line_color='colour')  # fmt: skip
    plan.multi_line('xs', 'ys', source=layers['trails'], color='colour', line_width=2.2)
    plan.segment('x', 'y', 'x1', 'y1', source=layers['velocities'], color='colour', line_width=1.4)
    for axis in plan.axis:
        axis.formatter = BasicTickFormatter(use_scientific=False)
    _markers(plan, layers)
    return plan


def bearing_record(frame: Frame) -> Any:
    """Return the bearing-time record, time running down [min], empty."""
    record = dress(
        bokeh.plotting.figure(
            name='stage', sizing_mode='stretch_both', active_scroll='wheel_zoom', min_border=4,
            tools=[*TOOLS, BoxZoomTool()], x_axis_label='bearing [deg from north, clockwise]',
            y_axis_label='time [min]', x_range=(frame.left, frame.right),
            y_range=(frame.end / MINUTE, frame.start / MINUTE),
        )
    )  # fmt: skip
    layers = sources()
    record.scatter('x', 'y', source=layers['all_plots'], size=2.5, color=MARK, alpha=0.5)
    _lines(record, layers)
    record.scatter('x', 'y', source=layers['plots'], size=7, color=MARK, fill_alpha='alpha')
    record.segment('x', 'y', 'x1', 'y1', source=layers['velocities'], color='colour',
                   line_width=5, alpha=0.45)  # fmt: skip
    record.add_layout(Span(name='cursor_stage', dimension='width', location=0.0, line_color=INK,
                           line_alpha=0.6))  # fmt: skip
    _markers(record, layers)
    return record


def sources() -> dict[str, ColumnDataSource]:
    """Return the sources of all layers, empty; the script finds them by name."""
    return {
        name: ColumnDataSource({column: [] for column in columns}, name=name)
        for name, columns in LAYERS.items()
    }


def _lines(figure: Any, layers: dict[str, ColumnDataSource]) -> None:
    figure.multi_line('xs', 'ys', source=layers['truth_paths'], color=TRUE, alpha=0.45,
                      line_dash='dashed')  # fmt: skip
    figure.multi_line('xs', 'ys', source=layers['paths'], color='colour', line_alpha='alpha',
                      line_width=1.3)  # fmt: skip


def _markers(figure: Any, layers: dict[str, ColumnDataSource]) -> None:
    figure.scatter('x', 'y', source=layers['truth'], marker='cross', size=11, color=TRUE)
    figure.scatter('x', 'y', source=layers['chosen'], size=24, fill_alpha=0.0, line_color=INK,
                   line_width=2)  # fmt: skip
    figure.scatter('x', 'y', source=layers['now'], size=8, color='colour', line_color=BACK)
    figure.text('x', 'y', 'label', source=layers['now'], x_offset=9, y_offset=-5,
                text_color='colour', text_font_size='13px', text_font_style='bold',
                text_font={'value': FONT})  # fmt: skip


def dress(figure: Any) -> Any:
    """Give a figure the colours of the page."""
    figure.background_fill_color, figure.border_fill_color = GROUND, None
    figure.outline_line_color = LINES
    figure.grid.grid_line_color = LINES
    figure.toolbar.logo = None
    for axis in figure.axis:
        axis.axis_label_text_color, axis.major_label_text_color = INK, FAINT
        axis.axis_label_text_font = axis.major_label_text_font = FONT
        axis.axis_label_text_font_style = 'normal'
        axis.axis_line_color = axis.major_tick_line_color = LINES
        axis.minor_tick_line_color = None
    return figure
