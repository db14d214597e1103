# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What must a recorded track table have, whoever wrote it?"""

from __future__ import annotations

from msg_adapters.table import Columns
from tracking_tools.bags import BadBag

NEEDED = {
    'radar': ('id', 'status', 'x', 'y', 'z', 'vx', 'vy', 'vz', 'covariance'),
    'sonar': ('id', 'status', 'bearing', 'bearing_rate', 'bearing_sd', 'bearing_rate_sd'),
}
COVARIANCE = (36,)  # of a radar's table, row-major


def check_table(table: Columns, sensor: str, where: str) -> None:
    """Raise BadBag where a table with rows lacks a column, or has a covariance of another size."""
    missing = [name for name in NEEDED[sensor] if table and name not in table]
    if missing:
        raise BadBag(f'{where} has no column {", ".join(missing)}')
    if table and sensor == 'radar' and table['covariance'].shape[1:] != COVARIANCE:
        raise BadBag(
            f'covariance of {where} must have {COVARIANCE[0]} values, got '
            f'{table["covariance"][:1].size}'
        )
