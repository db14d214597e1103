# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever comes on an input is used or refused."""

from collections import Counter
from types import SimpleNamespace
import warnings

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from msg_adapters.bad_message import BadMessage, LONGEST
from msg_adapters.bearings import to_bearings
from msg_adapters.ownship import to_platform
from msg_adapters.plots import to_plots
from msg_adapters.table import from_columns
from radar_tracker.sensor_config import SensorConfig
from sonar_tracker.sensor_config import SensorConfig as SonarSensorConfig

pytest.importorskip('rosbags')
from benchmarks.healthy_scenes import contacts, marks, START
from benchmarks.hostile_messages import spoil
from benchmarks.processes import own_memory
from benchmarks.siege import TYPES

MILLION = 1_000_000
ROWS = 20_000
GROWTH = 1.02  # of memory from a tenth of the way to the end: caches of Python and numpy
anything = st.floats(allow_nan=True, allow_infinity=True, width=64)
column = st.lists(anything, min_size=5, max_size=5).map(np.array)
quick = settings(max_examples=100)


@pytest.mark.parametrize('seed', range(30))
def test_spoilt_message_is_read_or_refused(types, seed):
    """Both adapters return sound rows of a spoilt message, or BadMessage."""
    rng = np.random.default_rng(seed)
    for make, read, sensor in (
        (contacts, to_plots, SensorConfig()), (marks, to_bearings, SonarSensorConfig())
    ):  # fmt: skip
        msg = spoil(make(START), START, 'here', rng).to_message(types)
        try:
            plots = read(msg, sensor, ROWS).plots
        except BadMessage:
            continue
        assert np.isfinite(plots.time).all()
        assert (np.abs(plots.time - plots.stamp) <= 60.0).all()


@pytest.mark.soak
def test_adapters_stand_a_million_messages():
    """Each is rows of sound numbers or BadMessage; memory is in the last quarter as before."""
    rng, memory, ends = np.random.default_rng(1), [], Counter()
    readers = ((contacts, to_plots, SensorConfig()), (marks, to_bearings, SonarSensorConfig()))
    for number in range(MILLION):
        if number % (MILLION // 100) == 0:
            memory.append(own_memory())
        make, read, sensor = readers[number % 2]
        msg = spoil(make(START), START, 'here', rng).to_message(TYPES)
        try:
            assert np.isfinite(read(msg, sensor, ROWS).plots.time).all()
            ends['read'] += 1
        except BadMessage as error:
            ends[error.reason] += 1
        del msg  # it may be large
    quarters = [float(np.median(part)) for part in np.split(np.array(memory), 4)]
    print(f'\n{MILLION} messages: {dict(ends)}, median memory of the quarters [MB] {quarters}')
    assert quarters[3] <= GROWTH * quarters[1]


@quick
@given(
    values=st.fixed_dictionaries(
        {'range': column, 'azimuth': column},
        optional=dict.fromkeys(
            ('elevation', 'time', 'range_sd', 'azimuth_sd', 'snr', 'x'), column
        ),
    )
)
def test_kept_rows_are_inside_the_limits(values):
    """Whatever the numbers are, what is left of them is finite and where a radar can see."""
    sensor = SensorConfig()
    try:
        plots = to_plots(from_columns(values, START, 'radar', TYPES), sensor, ROWS).plots
    except BadMessage:
        return
    assert ((plots.range >= sensor.range_min) & (plots.range <= sensor.range_max)).all()
    assert ((plots.azimuth >= -np.pi) & (plots.azimuth < np.pi)).all()
    told = plots.range_sd[~np.isnan(plots.range_sd)]
    assert ((told >= 1e-3) & (told <= 1e5)).all()


@quick
@given(
    numbers=st.lists(anything, min_size=10, max_size=10), variance=anything,
    nanosec=st.integers(0, 2**32 - 1), sec=st.integers(-(2**31), 2**31 - 1),
)  # fmt: skip
def test_odometry_is_read_or_refused(numbers, variance, nanosec, sec):
    """A platform is finite, turned by a unit quaternion and of no negative variance."""
    named = dict(zip(('x', 'y', 'z', 'w'), numbers, strict=False))
    point, turn = (
        SimpleNamespace(**named),
        SimpleNamespace(**dict(zip('xyzw', numbers[3:7], strict=True))),
    )
    pose = SimpleNamespace(pose=SimpleNamespace(position=point, orientation=turn),
                           covariance=np.full(36, variance))  # fmt: skip
    linear = SimpleNamespace(**dict(zip('xyz', numbers[7:], strict=True)))
    header = SimpleNamespace(stamp=SimpleNamespace(sec=sec, nanosec=nanosec), frame_id='')
    twist = SimpleNamespace(twist=SimpleNamespace(linear=linear))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('error')
            platform = to_platform(SimpleNamespace(header=header, pose=pose, twist=twist))
    except BadMessage:
        return
    assert nanosec < 1_000_000_000
    assert np.isfinite(platform.position).all()
    assert np.linalg.norm(platform.orientation) == pytest.approx(1.0)
    assert (platform.yaw_variance >= 0.0).all()


def test_nanoseconds_of_more_than_a_second_are_refused():
    """They would come out again in the stamps of the tracks."""
    msg = from_columns(contacts(START), START, 'radar', TYPES)
    msg.header.stamp.nanosec = 1_000_000_000
    with pytest.raises(BadMessage, match='nanosec is 1000000000'):
        to_plots(msg, SensorConfig(), ROWS)


def test_bad_message_is_shown_as_one_short_line():
    """Names from a message cannot fill the log, break its lines or reach the terminal."""
    text = str(BadMessage('bad field', 'field \x1b[31m\n' + 1_000_000 * 'x'))
    assert text.isprintable()
    assert len(text) < LONGEST + 20
