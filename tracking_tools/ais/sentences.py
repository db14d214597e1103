# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which position reports are in AIS sentences (VDM).

They tell the second of the minute at most: the rest of the time is when they came, or was
recorded by the tags before them.
"""

from __future__ import annotations

from collections import Counter
from importlib import import_module
from typing import Any

import numpy as np

from tracking_tools.feeds.report import polar_of, Report
from tracking_tools.feeds.sources import lines_of
from tracking_tools.feeds.tags import is_sound, sentence_of, time_of

POSITIONS = (1, 2, 3, 9, 18, 19)  # message types: ships of class A and B, aircraft that search
DAMAGED = 'damaged sentence, or a part of one'
NO_LATITUDE, NO_LONGITUDE, NO_SECOND = 91.0, 181.0, 60  # what is sent for 'not known'
INOPERATIVE = 63  # instead of the second: the ship's receiver of positions does not work


def read_positions(data: bytes, counts: Counter[str], origin: tuple[float, float]) -> list[Report]:
    """
    Return the ships in some sentences.

    Parameters
    ----------
    data : bytes
        Lines.
    counts : Counter
        By reason, what was left out.
    origin : tuple of float
        Latitude and longitude of the frame [deg].

    """
    ais, reports = import_module('pyais'), []
    for line in lines_of(data, counts):
        sentence = sentence_of(line, '!')
        body, _, checksum = sentence[1:].partition('*')
        if not is_sound(body, checksum[:2]):
            counts[DAMAGED] += 1
            continue
        if sentence[3:6] != 'VDM':  # VDO tells of own ship
            counts['another sentence'] += 1
            continue
        try:
            message = ais.decode(sentence)
        except (ais.exceptions.AISBaseException, ArithmeticError, LookupError, ValueError):
            counts[DAMAGED] += 1
            continue
        report, why = _to_report(message, origin)
        if report is None:
            counts[why] += 1
        else:
            reports.append(report._replace(sent=time_of(line)))
    return reports


def _to_report(message: Any, origin: tuple[float, float]) -> tuple[Report | None, str]:
    if message.msg_type not in POSITIONS:
        return None, 'another message'
    told = message.lat, message.lon, message.second, message.mmsi
    if None in told:  # a message that ends too early
        return None, DAMAGED
    latitude, longitude = float(message.lat), float(message.lon)
    is_known = abs(latitude) < NO_LATITUDE and abs(longitude) < NO_LONGITUDE
    if not is_known or message.second == INOPERATIVE:
        return None, 'without a position'
    distance, azimuth = polar_of(latitude, longitude, origin)
    second = float(message.second) if message.second < NO_SECOND else np.nan
    report = Report('AIS', range=distance, azimuth=azimuth, track=int(message.mmsi), second=second)
    return report, ''
