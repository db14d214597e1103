# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do the items of a record say?"""

from __future__ import annotations

from typing import Any

import numpy as np


def part(item: Any, *names: str) -> Any:
    """Return an item inside an item, None where it was not sent."""
    for name in names:
        item = None if item is None else item.variation.get_item(name)
    return item


def number(item: Any, name: str) -> int:
    """Return the number in a part of an item, 0 where it was not sent."""
    inner = part(item, name)
    return 0 if inner is None else int(inner.as_uint())


def quantity(item: Any, unit: str) -> float:
    """Return the quantity that an item is."""
    return float(item.variation.content.as_quantity(unit))


def optional(record: Any, name: str, parts: tuple[str, ...], unit: str) -> float:
    """Return the quantity in a part of an item, NaN where it was not sent."""
    item = part(record.get_item(name), *parts)
    return np.nan if item is None else quantity(item, unit)
