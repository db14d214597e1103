# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What can be wrong with the layout and the header of a PointCloud2, fault by fault?

Every fault takes a message in the making and a random generator, and returns it spoilt.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from benchmarks.column_faults import Columns, ODD_TEXTS, Rng
from msg_adapters.message_types import MessageTypes

ODD_SIZES = np.array([0, 1, 2, 3, 4, 7, 8, 255, 2**16, 2**31 - 1, 2**31, 2**32 - 8, 2**32 - 1])
ODD_SECONDS = np.array([0, 1, -1, -(2**31), 2**31 - 1, 4_102_444_800 - 2**32, 1_000_000_000])
ODD_NANOSECONDS = np.array([0, 1, 999_999_999, 1_000_000_000, 2**32 - 1])


@dataclass(frozen=True)
class Cloud:
    """A PointCloud2 before it is one; `fields` are name, offset, datatype and count."""

    columns: Columns
    sec: int
    nanosec: int
    frame: str
    fields: list[list[Any]] = field(default_factory=list)
    sizes: dict[str, int] = field(default_factory=dict)
    data: bytes = b''
    is_bigendian: bool = False

    def to_message(self, types: MessageTypes) -> Any:
        """Return the message of rclpy or of rosbags."""
        return types.PointCloud2(
            header=types.Header(
                stamp=types.Time(sec=self.sec, nanosec=self.nanosec), frame_id=self.frame
            ),
            fields=[
                types.PointField(name=name, offset=offset, datatype=datatype, count=count)
                for name, offset, datatype, count in self.fields
            ],
            is_bigendian=self.is_bigendian,
            is_dense=True,
            data=types.to_bytes(self.data),
            **self.sizes,
        )


def odd_stamp(rng: Rng) -> tuple[int, int]:
    """Return seconds and nanoseconds as no clock tells them."""
    return int(rng.choice(ODD_SECONDS)), int(rng.choice(ODD_NANOSECONDS))


def _size(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(
        cloud,
        sizes={**cloud.sizes, str(rng.choice(list(cloud.sizes))): int(rng.choice(ODD_SIZES))},
    )


def _field(cloud: Cloud, rng: Rng) -> Cloud:
    if not cloud.fields:
        return cloud
    fields, which = [list(f) for f in cloud.fields], int(rng.integers(len(cloud.fields)))
    part = int(rng.integers(4))
    new = [rng.choice(ODD_TEXTS), rng.choice(ODD_SIZES), rng.integers(256), rng.choice(ODD_SIZES)]
    fields[which][part] = str(new[0]) if part == 0 else int(new[part])
    return replace(cloud, fields=fields)


def _fields_twice(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(cloud, fields=cloud.fields * int(rng.choice([2, 200])))


def _cut(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(cloud, data=cloud.data[: int(rng.integers(0, len(cloud.data) + 1))])


def _lengthen(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(cloud, data=cloud.data + rng.bytes(int(rng.integers(1, 100))))


def _flip(cloud: Cloud, rng: Rng) -> Cloud:
    data = np.frombuffer(cloud.data, np.uint8).copy()
    if len(data):
        data[rng.integers(0, len(data), 8)] ^= rng.integers(0, 256, 8).astype(np.uint8)
    return replace(cloud, data=data.tobytes())


def _swap(cloud: Cloud, _: Rng) -> Cloud:
    return replace(cloud, is_bigendian=not cloud.is_bigendian)


def _fold(cloud: Cloud, rng: Rng) -> Cloud:
    """Return the rows as an image with padding, as legal as before."""
    width, step = cloud.sizes['width'], cloud.sizes['point_step']
    if not width or len(cloud.data) != width * step:
        return cloud
    height = next(n for n in (4, 3, 2, 1) if width % n == 0)
    padding = int(rng.integers(0, 9))
    lines = np.frombuffer(cloud.data, np.uint8).reshape(height, -1)
    sizes = {'height': height, 'width': width // height, 'point_step': step,
             'row_step': step * (width // height) + padding}  # fmt: skip
    return replace(cloud, sizes=sizes, data=np.pad(lines, ((0, 0), (0, padding))).tobytes())


def _stamp(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(cloud, sec=int(rng.choice(ODD_SECONDS)))


def _nanoseconds(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(cloud, nanosec=int(rng.choice(ODD_NANOSECONDS)))


def _shift(cloud: Cloud, rng: Rng) -> Cloud:
    """
    Return the message in the past or in the future, by minutes to years.

    A stamp less than a minute off can be believed, and then tells where contacts were or will be.
    """
    by = float(rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(2.0, 8.0))
    return replace(cloud, sec=int(np.clip(cloud.sec + int(by), -(2**31), 2**31 - 1)))


def _frame(cloud: Cloud, rng: Rng) -> Cloud:
    return replace(cloud, frame=str(rng.choice(ODD_TEXTS)))


OF_LAYOUT: tuple[Callable[[Cloud, Rng], Cloud], ...] = (
    _size, _size, _field, _field, _fields_twice, _cut, _lengthen, _flip, _swap, _fold,
)  # fmt: skip
OF_HEADER: tuple[Callable[[Cloud, Rng], Cloud], ...] = (_stamp, _nanoseconds, _shift, _frame)
