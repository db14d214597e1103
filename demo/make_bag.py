# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the demo bag is made: real flights, a simulated radar. See README.md beside."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import math
from pathlib import Path
import shutil
import sys

from flights_from_wheel import DURATION, Flight, read_flights
import numpy as np

from tracking_tools.scenarios import Contact, Sampled, Scenario, SimulatedRadar
from tracking_tools.simulate import record

HERE = Path(__file__).parent
FLIGHTS, BAG = HERE / 'flights.npz', HERE / 'terminal_area'

RADAR = SimulatedRadar(
    period=4.0,
    range_sd=50.0,
    azimuth_sd=math.radians(0.1),
    elevation_sd=math.radians(0.15),
    detection_probability=0.9,
    clutter_per_turn=25.0,
    range_limits=(1_000.0, 120_000.0),
    elevation_limits=(math.radians(-0.5), math.radians(40.0)),
)
SEED = 20_211_007


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        '--wheel', type=Path, help='make flights.npz anew from traffic-2.13-py3-none-any.whl'
    )
    parser.add_argument('--flights', type=Path, default=FLIGHTS, help='trajectories')
    parser.add_argument('--output', type=Path, default=BAG, help='bag to write, or write anew')
    chosen = parser.parse_args(arguments)
    if chosen.wheel is not None:
        save(read_flights(chosen.wheel), chosen.flights)
    if chosen.output.exists():
        if not (chosen.output / 'metadata.yaml').is_file():
            parser.error(f'{chosen.output} exists and is not a bag')
        shutil.rmtree(chosen.output)
    rows = record(scene(load(chosen.flights)), chosen.output, compress=True)
    print(f'{chosen.output}: {rows}')
    return 0


def scene(flights: list[Flight]) -> Scenario:
    """Return the flights about the radar; ids count from 1 in their order."""
    contacts = tuple(
        Contact(
            number,
            Sampled(flight.time, flight.position),
            appear=float(flight.time[0]),
            disappear=float(flight.time[-1]),
        )
        for number, flight in enumerate(flights, start=1)
    )
    return Scenario(RADAR, contacts, DURATION, 'terminal area, real flights', seed=SEED)


def save(flights: list[Flight], path: Path) -> None:
    """Write flights.npz: a row per knot, in tenths of a metre and hundredths of a second."""
    np.savez_compressed(
        path,
        name=np.array([flight.name for flight in flights]),
        flight=np.repeat(np.arange(len(flights)), [len(f.time) for f in flights]).astype('u1'),
        time=np.concatenate([np.round(f.time * 100) for f in flights]).astype('i4'),
        position=np.concatenate([np.round(f.position * 10) for f in flights]).astype('i4'),
    )


def load(path: Path) -> list[Flight]:
    """Read what ``save`` wrote."""
    with np.load(path) as stored:
        columns = {name: stored[name] for name in stored.files}
    rows = [np.flatnonzero(columns['flight'] == k) for k in range(len(columns['name']))]
    return [
        Flight(str(name), columns['time'][mine] / 100.0, columns['position'][mine] / 10.0)
        for name, mine in zip(columns['name'], rows, strict=True)
    ]


if __name__ == '__main__':
    sys.exit(main())
