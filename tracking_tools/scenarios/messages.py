# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which messages a simulated radar sends, and when."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from msg_adapters import table
from msg_adapters.message_types import MessageTypes
from tracking_tools.scenarios.passes import TrueStates
from tracking_tools.scenarios.plots import plots, Scenario, SimulatedScan

FRAME = 'radar'
PLOTS, TRUTH = 'plots', 'truth'
# Begin of a recorded scenario, since the epoch [s]: round, and plausible to every tool.
EPOCH = 1_700_000_000.0


class Sent(NamedTuple):
    """A message and the moment it leaves the radar [s of the scenario]."""

    topic: str
    msg: Any
    time: float


def send(
    scenario: Scenario, types: MessageTypes, sectors: int = 1, epoch: float = EPOCH
) -> Iterator[list[Sent]]:
    """
    Turn a scenario into messages, in order.

    Parameters
    ----------
    scenario : Scenario
        Its seed decides the random numbers.
    types : MessageTypes
        Classes to build the messages from.
    sectors : int
        ``plots`` messages in a turn.
    epoch : float
        Stamp at which the scenario begins [s since the epoch].

    Yields
    ------
    list of Sent
        What is sent at the end of each turn or sector: its plots, and after the last sector of a
        turn the truth, with a row each time the antenna passed a contact. Headers carry the
        beginning of the turn or sector, and column ``time`` counts from there.

    """
    turn: list[SimulatedScan] = []
    for scan in plots(scenario, np.random.default_rng(scenario.seed), sectors):
        columns = as_table(scan.columns, scan.start)
        msg = table.from_columns(columns, epoch + scan.start, FRAME, types)
        sent = [Sent(PLOTS, msg, scan.end)]
        turn.append(scan)
        if len(turn) == sectors or scan.end >= scenario.duration:
            sent.append(_truth_of(turn, epoch, types))
            turn = []
        yield sent


def _truth_of(turn: list[SimulatedScan], epoch: float, types: MessageTypes) -> Sent:
    start, end = turn[0].start, turn[-1].end
    truth = TrueStates.joined([scan.truth for scan in turn])
    columns = as_table(truth.columns(), start)
    return Sent(TRUTH, table.from_columns(columns, epoch + start, FRAME, types), end)


def as_table(columns: dict[str, Any], start: float) -> dict[str, Any]:
    """Columns as they travel: ids as uint32, the rest as float32, time from the stamp on."""
    since = columns | {'time': columns['time'] - start}
    return {name: c.astype('u4' if name == 'id' else 'f4') for name, c in since.items()}
