# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which recorded flights make the demo scene, and how they become smooth trajectories."""

from __future__ import annotations

from dataclasses import dataclass
import gzip
import json
import math
from pathlib import Path
import zipfile

import numpy as np
from scipy.interpolate import make_smoothing_spline

SAMPLES = 'traffic/data/samples'
DURATION = 1800.0
# Where the antenna stands: latitude, longitude [deg]; between the two airports of the recording.
RADAR = (48.84, 2.44)
EARTH_RADIUS = 6_371_000.0
FOOT = 0.3048
# The radar does not look at the ground; heights are pressure altitudes [m].
LOWEST = 150.0
# Width of the smoothing: detail shorter than this [s] is taken for noise of the reports; in plan
# also what is shorter than so many reports.
SMOOTHING_PLAN, SMOOTHING_HEIGHT = 4.0, 15.0
SMOOTHING_REPORTS = 1.6
# Reports farther than this from the smooth curve are thrown out [m].
OUTLIER = 120.0
LONGEST_GAP = 25.0
KNOT_SPACING = 2.5

# One recording, one window of time: these aircraft fly as they flew, to each other and in time.
COMMON = 'collections/quickstart'
COMMON_START = 1_633_612_921.0  # since the epoch [s]
COMMON_CALLSIGNS = (
    'ABR471', 'AFR1013', 'AFR1285', 'AFR15AH', 'AFR17YC', 'AFR474', 'CCM774V', 'DITRA', 'FHMAC',
    'MTO787', 'RYR4ZG', 'TVF19YP', 'VLG8018', 'VLJ670W',
)  # fmt: skip


@dataclass(frozen=True)
class Guest:
    """A flight of another place and day, shifted into the scene; its shape is untouched."""

    sample: str
    start: float
    """Begin of the piece, since the first report [s]."""
    centre: tuple[float, float]
    """Where the middle of the piece goes, east and north of the radar [m]; so that paths cross."""


GUESTS = (
    Guest('featured/belevingsvlucht', 1_200.0, (-59_000.0, -58_800.0)),
    Guest('calibration/sydney', 8_100.0, (33_400.0, 39_000.0)),
    Guest('calibration/munich', 2_100.0, (-38_000.0, 42_000.0)),
    Guest('calibration/ajaccio', 300.0, (46_800.0, -56_800.0)),
    Guest('military/inflight_refuelling', 3_000.0, (77_900.0, 4_500.0)),
    Guest('ambulances/rega_sg', 0.0, (0.0, -22_000.0)),
)


@dataclass(frozen=True)
class Flight:
    """Smooth trajectory in the scene."""

    name: str
    time: np.ndarray  # (K,) [s]
    position: np.ndarray  # (K, 3) east, north, up of the radar [m]


def read_flights(wheel: Path) -> list[Flight]:
    """
    Make the flights of the scene.

    Parameters
    ----------
    wheel : Path
        The file ``traffic-2.13-py3-none-any.whl``.

    Returns
    -------
    list of Flight
        In the order of their names here.

    """
    with zipfile.ZipFile(wheel) as archive:
        rows = _read(archive, COMMON)
        flights = [_common(rows, callsign) for callsign in COMMON_CALLSIGNS]
        return flights + [_guest(_read(archive, guest.sample), guest) for guest in GUESTS]


def _read(archive: zipfile.ZipFile, sample: str) -> list[dict]:
    """Read the reports that have a position, in order of time; ``timestamp`` becomes seconds."""
    reports = json.loads(gzip.decompress(archive.read(f'{SAMPLES}/{sample}.json.gz')))
    needed = ('latitude', 'longitude', 'altitude')
    complete = [r for r in reports if all(r.get(name) is not None for name in needed)]
    return sorted(complete, key=lambda r: r['timestamp'])


def _common(rows: list[dict], callsign: str) -> Flight:
    mine = _columns([r for r in rows if r['callsign'] == callsign])
    place = _in_plane(mine, RADAR)
    return _smooth(f'{COMMON}:{callsign}', mine[:, 0] - COMMON_START, place)


def _guest(rows: list[dict], guest: Guest) -> Flight:
    mine = _columns(rows)
    time = mine[:, 0] - mine[0, 0] - guest.start
    piece = (time >= 0.0) & (time <= DURATION)
    middle = mine[piece, 1:3].mean(axis=0)
    place = _in_plane(mine, (middle[0], middle[1])) + np.array([*guest.centre, 0.0])
    return _smooth(guest.sample, time, place)


def _columns(rows: list[dict]) -> np.ndarray:
    """Time [s], latitude, longitude [deg], height [m]; without repeated reports."""
    names = ('timestamp', 'latitude', 'longitude', 'altitude')
    columns = np.array([[r[name] for name in names] for r in rows]) * [1e-3, 1.0, 1.0, FOOT]
    is_new = np.any(np.diff(columns[:, 1:3], axis=0) != 0.0, axis=1)
    is_later = np.diff(columns[:, 0]) > 0.0
    return columns[np.concatenate([[True], is_new & is_later])]


def _in_plane(columns: np.ndarray, origin: tuple[float, float]) -> np.ndarray:
    """East and north in the azimuthal equidistant map about the origin, height as it is [m]."""
    latitude, longitude = np.radians(columns[:, 1:3]).T
    latitude0, longitude0 = np.radians(origin)
    turn = longitude - longitude0
    east = np.cos(latitude) * np.sin(turn)
    north = np.cos(latitude0) * np.sin(latitude) - np.sin(latitude0) * np.cos(latitude) * np.cos(
        turn
    )
    angle = np.arcsin(np.hypot(east, north))
    scale = EARTH_RADIUS / np.sinc(angle / np.pi)
    return np.stack([east * scale, north * scale, columns[:, 3]], axis=1)


def _smooth(name: str, time: np.ndarray, place: np.ndarray) -> Flight:
    """Longest piece of the window without a gap, through a smoothing spline."""
    inside = (time >= 0.0) & (time <= DURATION) & (place[:, 2] > LOWEST)
    time, place = time[inside], place[inside]
    pieces = np.split(np.arange(len(time)), np.flatnonzero(np.diff(time) > LONGEST_GAP) + 1)
    piece = max(pieces, key=lambda rows: time[rows[-1]] - time[rows[0]])
    time, place = time[piece], place[piece]
    for _ in range(3):
        curve = _spline(time, place)
        good = np.linalg.norm((curve(time) - place)[:, :2], axis=1) < OUTLIER
        time, place = time[good], place[good]
    first, last = time[[0, -1]]
    knots = np.linspace(first, last, math.ceil((last - first) / KNOT_SPACING) + 1)
    return Flight(name, knots, _spline(time, place)(knots))


def _spline(time: np.ndarray, place: np.ndarray):
    """Cubic smoothing spline, its penalty from the wanted width: h^4 = penalty x spacing."""
    spacing = (time[-1] - time[0]) / (len(time) - 1)
    plan = max(SMOOTHING_PLAN, SMOOTHING_REPORTS * spacing)
    axes = [
        make_smoothing_spline(time, column, lam=width**4 / spacing)
        for column, width in zip(place.T, (plan, plan, SMOOTHING_HEIGHT), strict=True)
    ]
    return lambda at: np.stack([axis(at) for axis in axes], axis=-1)
