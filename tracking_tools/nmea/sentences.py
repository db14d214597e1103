# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which targets are in NMEA sentences: TTM by range and bearing, TLL by latitude and longitude.

They were tracked already, by the radar: errors of one target hang together from report to report.
"""

from __future__ import annotations

from collections import Counter
from datetime import time
from importlib import import_module
from typing import Any

import numpy as np

from tracking_tools.feeds.report import NAUTICAL_MILE, polar_of, Report
from tracking_tools.feeds.sources import lines_of
from tracking_tools.feeds.tags import sentence_of, time_of

UNITS = {'N': NAUTICAL_MILE, 'K': 1000.0, 'S': 1609.344}  # m
LOST = 'L'  # status of a target
Origin = tuple[float, float]
Outcome = tuple[Report | None, str]  # a report, or None and why there is none


def read_sentences(
    data: bytes, counts: Counter[str], origin: Origin | None = None, relative: bool = False
) -> list[Report]:
    """
    Return the targets in some sentences.

    Parameters
    ----------
    data : bytes
        Lines.
    counts : Counter
        By reason, what was left out.
    origin : tuple of float, optional
        Latitude and longitude of the frame [deg], for TLL.
    relative : bool
        Whether bearings from ahead are wanted, in the ship's frame, rather than true ones.

    """
    nmea, reports = import_module('pynmea2'), []
    for line in lines_of(data, counts):
        try:
            sentence = nmea.parse(sentence_of(line, '$'), check=True)
            report, why = _to_report(sentence, origin, relative)
        except nmea.SentenceTypeError:
            report, why = None, 'another sentence'
        except (nmea.ParseError, ArithmeticError, ValueError):  # numbers are read when asked for
            report, why = None, 'damaged sentence'
        if report is None:
            counts[why] += 1
        else:
            reports.append(report._replace(sent=time_of(line)))
    return reports


def _to_report(sentence: Any, origin: Origin | None, relative: bool) -> Outcome:
    kind = getattr(sentence, 'sentence_type', '')
    if kind == 'TTM':
        return _of_ttm(sentence, relative)
    if kind == 'TLL':
        return _of_tll(sentence, origin)
    return None, 'another sentence'


def _of_ttm(target: Any, relative: bool) -> Outcome:
    if target.status == LOST:
        return None, 'lost target'
    if (target.brg_ref == 'R') != relative:
        return None, 'bearing from ahead' if target.brg_ref == 'R' else 'true bearing'
    if target.distance is None or target.bearing is None or target.dist_unit not in UNITS:
        return None, 'without range or bearing'
    north = 0.0 if relative else 0.5 * np.pi
    distance = float(target.distance) * UNITS[target.dist_unit]
    azimuth = north - np.radians(float(target.bearing))
    return _report(target, target.target_number, distance, azimuth), ''


def _of_tll(target: Any, origin: Origin | None) -> Outcome:
    if target.target_status == LOST:
        return None, 'lost target'
    if origin is None:
        return None, 'TLL without --origin'
    latitude = _degrees(target.lat, 2) * (-1.0 if target.lat_dir == 'S' else 1.0)
    longitude = _degrees(target.lon, 3) * (-1.0 if target.lon_dir == 'W' else 1.0)
    return _report(target, target.target_number, *polar_of(latitude, longitude, origin)), ''


def _report(target: Any, number: Any, distance: float, azimuth: float) -> Report:
    told = target.timestamp
    if not (np.isfinite(distance) and np.isfinite(azimuth)) or isinstance(told, str):
        raise ValueError('neither a place nor a time')  # pynmea2 leaves text where it fails
    return Report(
        source=str(target.talker),
        time_of_day=_seconds(told) if told else np.nan,
        range=distance,
        azimuth=azimuth,
        track=None if number is None else max(int(number), 0) % 2**32,
    )


def _seconds(told: time) -> float:
    return told.hour * 3600.0 + told.minute * 60.0 + told.second + told.microsecond * 1e-6


def _degrees(text: str, digits: int) -> float:
    """Return degrees from 'ddmm.mmm' or 'dddmm.mmm'."""
    return float(text[:digits]) + float(text[digits:]) / 60.0
