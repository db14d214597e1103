# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Plots without times from a ship that turns are told; what is no fault is not."""

from dataclasses import replace
import logging

import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import from_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from radar_tracker.untimed import UntimedPlots
from tracking_core.batches import Plots
from tracking_core.config import with_values
from tracking_core.platform import Platform

TYPES = rosbags_types()
PERIOD = 2.5  # of the antenna [s]


def ship(rate):
    """Return a ship that turns, for a minute [rad/s]."""
    time = np.arange(0.0, 60.0, 0.5)
    half, none = 0.5 * rate * time, 0.0 * time
    turn = np.stack([none, none, np.sin(half), np.cos(half)], axis=1)
    still = np.zeros((len(time), 3))
    return Platform(time, still, turn, still, np.zeros((len(time), 3, 3)), none)


def said(rate, times=False, contacts=3, messages=10):
    """Return how many of the messages leave a doubt."""
    check, count = UntimedPlots(0.005), 0
    for number in range(messages):
        stamp = PERIOD * number
        azimuth = np.linspace(-2.0, 2.0, contacts)
        time = np.full(contacts, stamp) + (0.5 * (azimuth + 2.0) if times else 0.0)
        plots = replace(Plots.polar(time, np.full(contacts, 5e3), azimuth), stamp=stamp)
        check.note(plots, ship(rate))
        count += any(True for _ in check.doubts())
    return count


def test_plots_without_times_are_told_from_the_third_message_on():
    """Of a ship that turns by 1 degree a second; before the first there is no step."""
    assert said(np.radians(1.0)) == 7


@pytest.mark.parametrize(
    'how', [{'rate': 0.0}, {'rate': 0.02, 'times': True}, {'rate': 0.02, 'contacts': 1}], ids=str
)
def test_no_fault_is_not_told(how):
    """A ship that goes straight, plots with times, a plot that may have been at the stamp."""
    assert said(**how) == 0


@pytest.mark.parametrize(
    ('values', 'is_told'),
    [
        ({}, True), ({'scan.period': PERIOD}, False), ({'scan.assembly': 'snapshot'}, False),
        ({'sensor.azimuth_reference': 'tracking_frame'}, False),
    ],
)  # fmt: skip
def test_parameters_that_say_what_messages_are_end_the_doubt(values, is_told):
    """Turns whose middle is known, looks everywhere at once, directions that are true ones."""
    config = with_values(RadarTrackerConfig(), values)
    radar = radar_session(config, radar_node_config(), TYPES, logging.getLogger('untimed'))
    radar.whereabouts.platform = ship(0.02)
    radar.frame.check_ownship('odom', 0.0)
    columns = {'range': np.array([5e3, 6e3]), 'azimuth': np.array([0.3, 2.0])}
    for number in range(8):
        radar.plots(from_columns(columns, 10.0 + PERIOD * number, 'radar', TYPES), 0.0)
    doubts = [doubt.what for doubt in radar.instrument.doubts()]
    assert doubts == ['plots tell no times while own ship turns'] * is_told
