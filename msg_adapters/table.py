# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How named columns travel in a PointCloud2, and how they are read back safely.

Nothing in a message is believed: every size is checked against the bytes that are there before
memory is touched. Read ``plots.py`` and ``tracks.py`` next.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msg_adapters.bad_message import BadMessage
from msg_adapters.message_types import MessageTypes

Columns = dict[str, NDArray[Any]]

MAX_FIELDS = 256  # more than any driver has; reading a field list costs time
DATATYPES = {1: 'i1', 2: 'u1', 3: 'i2', 4: 'u2', 5: 'i4', 6: 'u4', 7: 'f4', 8: 'f8'}
_CODES = {name: code for code, name in DATATYPES.items()}


def from_columns(
    columns: Mapping[str, NDArray[Any]], time: float, frame: str, types: MessageTypes
) -> Any:
    """
    Return a PointCloud2 with one field per column and one point per row.

    Parameters
    ----------
    columns : mapping of (M,) or (M, k) arrays
        int8 to uint32, float32 or float64; (M, k) becomes a field of count k.
    time : float
        Stamp [s since the epoch].
    frame : str
        Frame of the header.
    types : MessageTypes
        Classes to build the message from.

    Raises
    ------
    ValueError
        For a column of another type or length.

    """
    return from_columns_under(types.header(time, frame), columns, types)


def from_columns_under(
    header: Any, columns: Mapping[str, NDArray[Any]], types: MessageTypes
) -> Any:
    """Return what `from_columns` returns, under a ready header (its stamp is kept exactly)."""
    kinds = [(name, v.dtype.str[1:], v.ndim, v.shape[1:]) for name, v in columns.items()]
    dtype = _row_type(tuple(kinds))
    rows = np.zeros(len(next(iter(columns.values()))), dtype)
    for name, values in columns.items():
        if len(values) != len(rows):
            raise ValueError(f'column {name} has {len(values)} rows, the first has {len(rows)}')
        rows[name] = values
    return types.PointCloud2(
        header=header,
        height=1,
        width=len(rows),
        fields=list(_fields(types, dtype)),
        is_bigendian=False,
        point_step=dtype.itemsize,
        row_step=dtype.itemsize * len(rows),
        data=types.to_bytes(rows.tobytes()),
        is_dense=True,
    )


@lru_cache(maxsize=64)
def _row_type(columns: tuple[tuple[str, str, int, tuple[int, ...]], ...]) -> np.dtype[Any]:
    """Return the packed little-endian record of a row of columns (name, type, axes, shape)."""
    for name, kind, axes, shape in columns:
        if kind not in _CODES or axes not in (1, 2):
            raise ValueError(f'column {name} cannot be {kind} with {axes} axes, rows of {shape}')
    return np.dtype([(name, '<' + kind, shape) for name, kind, _, shape in columns])


@lru_cache(maxsize=64)
def _fields(types: MessageTypes, dtype: np.dtype[Any]) -> tuple[Any, ...]:
    """Return a PointField for each column: the same from message to message."""
    fields: Mapping[str, Any] = dtype.fields or {}
    return tuple(
        types.PointField(
            name=name,
            offset=offset,
            datatype=_CODES[kind.base.str[1:]],
            count=int(np.prod(kind.shape)),
        )
        for name, (kind, offset, *_) in fields.items()
    )


def to_columns(msg: Any, max_rows: int) -> Columns:
    """
    Return the columns of a PointCloud2 by name, in the order of its fields.

    Parameters
    ----------
    msg : PointCloud2
        Of rclpy or of rosbags.
    max_rows : int
        More rows than this are refused.

    Returns
    -------
    dict of (M,) or (M, k) arrays
        In native byte order; views of the message where that needs no copy.

    Raises
    ------
    BadMessage
        For sizes that do not fit, unknown types, duplicate names; says field and value.

    """
    rows = msg.width * msg.height
    if rows > max_rows:
        raise BadMessage(
            'too many rows', f'width x height is {msg.width} x {msg.height}, limit {max_rows} rows'
        )
    _check_fields(msg)
    if not rows:
        return {f.name: np.zeros((0, *_tail(f)), DATATYPES[f.datatype]) for f in msg.fields}
    strides = _check_sizes(msg)
    return {f.name: _column(msg, f, strides) for f in msg.fields}


def _check_fields(msg: Any) -> None:
    if len(msg.fields) > MAX_FIELDS:
        raise BadMessage(
            'too many fields', f'fields has {len(msg.fields)} entries, limit {MAX_FIELDS}'
        )
    names: set[str] = set()
    for f in msg.fields:
        if f.datatype not in DATATYPES:
            raise BadMessage('bad field', f'field {f.name} has unknown datatype {f.datatype}')
        if f.count < 1:
            raise BadMessage('bad field', f'field {f.name} has count {f.count}')
        if f.name in names:
            raise BadMessage('bad field', f'field {f.name} is there twice')
        end = f.offset + f.count * int(DATATYPES[f.datatype][1])
        if end > msg.point_step and msg.width * msg.height:
            raise BadMessage(
                'bad field', f'field {f.name} ends at byte {end}, point_step is {msg.point_step}'
            )
        names.add(f.name)


def _check_sizes(msg: Any) -> tuple[int, int]:
    """Return the steps from row to row and from point to point, known to stay inside the data."""
    width = msg.width * msg.point_step
    step = msg.row_step if msg.height > 1 else width  # some drivers leave row_step 0
    if step < width:
        raise BadMessage(
            'sizes do not fit',
            f'row_step is {msg.row_step}, width x point_step is {msg.width} x {msg.point_step}',
        )
    needed = (msg.height - 1) * step + width
    if len(msg.data) not in (needed, msg.height * step, msg.height * msg.row_step) or (
        len(msg.data) < needed
    ):
        raise BadMessage(
            'sizes do not fit',
            f'data has {len(msg.data)} bytes, {msg.width} x {msg.height} points of '
            f'{msg.point_step} bytes need {needed}',
        )
    return step, msg.point_step


def _column(msg: Any, field: Any, strides: tuple[int, int]) -> NDArray[Any]:
    dtype = np.dtype('<>'[bool(msg.is_bigendian)] + DATATYPES[field.datatype])
    tail = _tail(field)
    view = np.ndarray(
        (msg.height, msg.width, *tail), dtype, np.frombuffer(msg.data, np.uint8), field.offset,
        strides + (dtype.itemsize,) * len(tail),
    )  # fmt: skip
    rows = view.reshape(msg.height * msg.width, *tail)
    return rows.astype(dtype.newbyteorder('='), copy=False)


def _tail(field: Any) -> tuple[int, ...]:
    return (field.count,) if field.count > 1 else ()
