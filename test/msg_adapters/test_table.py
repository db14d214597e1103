# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Columns survive the journey, and no message can make us read where nothing is."""

from types import SimpleNamespace

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage
from msg_adapters.table import from_columns, to_columns

KINDS = ['i1', 'u1', 'i2', 'u2', 'i4', 'u4', 'f4', 'f8']


def table(**changes):
    """Return a legal message of two rows with fields a (float32) and b (uint8, count 4)."""
    fields = [
        SimpleNamespace(name='a', offset=0, datatype=7, count=1),
        SimpleNamespace(name='b', offset=4, datatype=2, count=4),
    ]
    whole = {
        'height': 1, 'width': 2, 'fields': fields, 'is_bigendian': False, 'point_step': 8,
        'row_step': 16, 'data': np.arange(16, dtype=np.uint8),
    }  # fmt: skip
    return SimpleNamespace(**{**whole, **changes})


def field(**changes):
    """Return field a with some of it changed."""
    return SimpleNamespace(**{'name': 'a', 'offset': 0, 'datatype': 7, 'count': 1, **changes})


def test_round_trip_keeps_names_types_and_values(types):
    """What goes in comes out, of every datatype, single and with a count."""
    rng = np.random.default_rng(1)
    columns = {kind: rng.integers(0, 100, 5).astype(kind) for kind in KINDS}
    columns['covariance'] = rng.normal(size=(5, 36))
    back = to_columns(from_columns(columns, 12.25, 'radar', types), 5)
    assert list(back) == list(columns)
    for name, values in columns.items():
        assert back[name].dtype == values.dtype
        np.testing.assert_array_equal(back[name], values)


def test_header_keeps_time_and_frame(types):
    """The stamp is exact to the nanosecond that a float can hold."""
    header = from_columns({'a': np.zeros(1)}, 1.7e9 + 0.25, 'radar', types).header
    assert (header.stamp.sec, header.stamp.nanosec) == (1_700_000_000, 250_000_000)
    assert header.frame_id == 'radar'


def test_time_next_to_a_whole_second_does_not_overflow_the_nanoseconds(types):
    """Rounding up gives the next second, not 1e9 nanoseconds."""
    stamp = types.header(1.0 - 1e-12, '').stamp
    assert (stamp.sec, stamp.nanosec) == (1, 0)


@pytest.mark.parametrize('wrong', [np.zeros(2, np.int64), np.zeros((2, 2, 2)), np.zeros(2, bool)])
def test_column_that_cannot_travel_is_refused(types, wrong):
    """64-bit integers, matrices and truth values have no datatype."""
    with pytest.raises(ValueError, match='column wrong cannot be'):
        from_columns({'wrong': wrong}, 0.0, '', types)


def test_columns_of_unequal_length_are_refused(types):
    """All columns have as many rows as the first."""
    with pytest.raises(ValueError, match='column b has 3 rows, the first has 2'):
        from_columns({'a': np.zeros(2), 'b': np.zeros(3)}, 0.0, '', types)


def test_big_endian_is_read():
    """Messages of big-endian machines give the same numbers."""
    data = np.frombuffer(np.array([1.5, -2.0], '>f4').tobytes(), np.uint8)
    msg = table(fields=[field()], point_step=4, row_step=8, data=data, is_bigendian=True)
    np.testing.assert_array_equal(to_columns(msg, 2)['a'], [1.5, -2.0])


def test_row_padding_is_skipped():
    """An image of two rows with padding at their ends gives its points only."""
    image = np.zeros((2, 12), np.uint8)
    image[:, :8] = np.frombuffer(np.arange(4, dtype='<f4').tobytes(), np.uint8).reshape(2, 8)
    msg = table(fields=[field()], height=2, point_step=4, row_step=12, data=image.ravel())
    np.testing.assert_array_equal(to_columns(msg, 4)['a'], [0.0, 1.0, 2.0, 3.0])


def test_no_rows_give_empty_columns(types):
    """A scan that saw nothing still has its columns."""
    columns = {'a': np.zeros(0, np.float32), 'c': np.zeros((0, 36))}
    back = to_columns(from_columns(columns, 0.0, '', types), 0)
    assert back['a'].shape == (0,)
    assert back['c'].shape == (0, 36)


@pytest.mark.parametrize(
    ('changes', 'match'),
    [
        ({'width': 2**32 - 1}, 'width x height is 4294967295 x 1, limit 10 rows'),
        ({'height': 2**32 - 1}, 'limit 10 rows'),
        ({'width': 3}, 'data has 16 bytes, 3 x 1 points of 8 bytes need 24'),
        ({'width': 1, 'row_step': 8}, 'data has 16 bytes'),
        ({'point_step': 0}, 'field a ends at byte 4, point_step is 0'),
        ({'point_step': 2**31}, 'data has 16 bytes'),
        ({'height': 2, 'width': 1, 'row_step': 4}, 'row_step is 4'),
        ({'fields': [field(offset=2**32 - 1)]}, 'field a ends at byte'),
        ({'fields': [field(count=2**32 - 1)]}, 'field a ends at byte'),
        ({'fields': [field(count=0)]}, 'field a has count 0'),
        ({'fields': [field(datatype=9)]}, 'field a has unknown datatype 9'),
        ({'fields': [field(), field()]}, 'field a is there twice'),
        ({'fields': [field(name=str(n)) for n in range(300)]}, 'fields has 300 entries'),
    ],
)
def test_sizes_that_do_not_fit_are_refused(changes, match):
    """Every size is checked against the bytes that are there; the text says field and value."""
    with pytest.raises(BadMessage, match=match):
        to_columns(table(**changes), 10)


NUMBERS = st.one_of(st.integers(0, 40), st.integers(0, 2**32 - 1))
FIELDS = st.builds(
    SimpleNamespace, name=st.sampled_from('abc'), offset=NUMBERS, datatype=st.integers(0, 9),
    count=NUMBERS,
)  # fmt: skip


@settings(max_examples=500)
@given(
    height=st.one_of(st.just(1), NUMBERS), width=NUMBERS, point_step=NUMBERS, row_step=NUMBERS,
    fields=st.lists(FIELDS, max_size=4), size=st.integers(0, 400), is_bigendian=st.booleans(),
)  # fmt: skip
def test_hostile_message_is_read_or_refused(size, **parts):
    """Whatever the numbers say, the answer is columns of that many rows, or BadMessage."""
    msg = SimpleNamespace(data=np.arange(size).astype(np.uint8), **parts)
    try:
        columns = to_columns(msg, 100)
    except BadMessage:
        return
    assert len(columns) == len(parts['fields'])
    assert all(len(values) == parts['height'] * parts['width'] for values in columns.values())
    assert sum(values.nbytes for values in columns.values()) <= 4 * size
