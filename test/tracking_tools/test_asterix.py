# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""ASTERIX reports become plots, on the right day; whatever the bytes are, nothing breaks."""

from collections import Counter
from datetime import datetime, timezone
from pathlib import Path
import subprocess
import sys

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from msg_adapters.message_types import rosbags_types
from msg_adapters.table import to_columns
from tracking_tools.asterix.__main__ import main
from tracking_tools.asterix.blocks import blocks_of_file, MOST, read_reports
from tracking_tools.bags import open_bag
from tracking_tools.feeds.clock import DAY, DayClock
from tracking_tools.feeds.feed import AHEAD, Feed

ROOT = Path(__file__).parents[2]
generated = pytest.importorskip('asterix.generated')
PLOTS, SERVICE = generated.Cat_048_1_32, generated.Cat_034_1_29
RADAR = (('SAC', 25), ('SIC', 201))


def plot(time_of_day, rho=10.0, theta=90.0, kind=1, **items):
    """Return a record of CAT048: rho [NM], theta [deg], kind as in I048/020."""
    return PLOTS.cv_record.create(
        {
            '010': RADAR, '140': (time_of_day, 's'), '020': ((kind, 0, 0, 0, 0, None),),
            '040': (('RHO', (rho, 'NM')), ('THETA', (theta, '°'))), **items,
        }
    )  # fmt: skip


def block(*records, of=PLOTS):
    """Return a data block."""
    return of.create(list(records)).unparse().to_bytes()


def mark(time_of_day):
    """Return a block of CAT034: the antenna crosses a sector."""
    items = {'000': 2, '010': RADAR, '030': (time_of_day, 's'), '020': (90.0, '°')}
    return block(SERVICE.cv_record.create(items), of=SERVICE)


def test_report_has_our_units_and_axes():
    """10 NM to the east are 18520 m at azimuth 0; time, Doppler, power and number arrive."""
    record = plot(
        1000.5, theta=90.0, **{'120': {'CAL': (0, 0, (-55, 'm/s'))}, '130': {'PAM': (-70, 'dBm')},
        '161': (0, 77)}
    )  # fmt: skip
    (report,) = read_reports(block(record), Counter())
    assert report.source == (25, 201)
    assert report.time_of_day == 1000.5
    np.testing.assert_allclose(report.range, 18520.0)
    assert report.azimuth == pytest.approx(0.0, abs=1e-4)  # 360 / 65536 deg
    assert (report.doppler, report.amplitude, report.track) == (-55.0, -70.0, 77)


@pytest.mark.parametrize(('theta', 'azimuth'), [(0.0, 90.0), (45.0, 45.0), (180.0, -90.0)])
def test_angles_are_counted_from_east(theta, azimuth):
    """North is pi / 2, and clockwise is negative."""
    (report,) = read_reports(block(plot(0.0, theta=theta)), Counter())
    assert np.degrees(report.azimuth) == pytest.approx(azimuth, abs=0.006)


def test_what_is_no_plot_is_counted_by_reason():
    """No detection, other categories, records without a place."""
    counts = Counter()
    nothing = PLOTS.cv_record.create({'010': RADAR, '140': (1.0, 's')})
    other = bytes([62, 0, 5, 1, 2])
    assert not read_reports(block(plot(1.0, kind=0), nothing) + other, counts)
    assert counts == {
        'no detection': 1, 'without source, time or position': 1, 'category 62': 1,
    }  # fmt: skip


def test_damage_costs_what_is_behind_it_only():
    """The whole block before a truncated one is read."""
    counts, good = Counter(), block(plot(1.0), plot(2.0))
    for cut in range(1, len(good)):
        assert len(read_reports(good + good[:-cut], counts)) == 2
    assert counts == {'truncated or of wrong length': len(good) - 1}


@pytest.mark.parametrize('place', [1, 2])
def test_damaged_length_costs_its_block_only(place, tmp_path):
    """In a recording of a day, a bit that flipped is not the end."""
    blocks = [block(plot(float(second))) for second in range(20)]
    damaged = bytearray(blocks[7])
    damaged[place] ^= 0xFF if place == 1 else 0x04
    blocks[7] = bytes(damaged)
    path, counts = tmp_path / 'night.ast', Counter()
    path.write_bytes(b''.join([b'a header of the recorder', *blocks]))
    told = [
        r.time_of_day for data in blocks_of_file(path, counts) for r in read_reports(data, counts)
    ]
    assert set(told) >= {*range(7), *range(8, 20)}
    assert counts['truncated or of wrong length'] >= 2


def test_block_of_empty_records_is_bounded():
    """65 kB of zeros are records without items; they end at the limit."""
    counts = Counter()
    assert not read_reports(bytes([48, 0xFF, 0xFF]) + bytes(65532), counts)
    assert counts[f'records beyond {MOST} of a block'] == 1
    assert counts.total() == MOST + 1


@settings(max_examples=300)
@given(st.binary(max_size=200), st.integers(0, 2**32 - 1))
def test_any_bytes_are_read_without_an_error(data, seed):
    """Noise, noise behind a valid header, and a good block with bytes changed."""
    rng, good = np.random.default_rng(seed), bytearray(block(plot(1.0), plot(2.0)))
    for place in rng.integers(3, len(good), 3):
        good[place] = rng.integers(256)
    header = bytes([48]) + (len(data) + 3).to_bytes(2, 'big')
    for chain in (data, header + data, bytes(good), bytes([34]) + header[1:] + data):
        for report in read_reports(chain, Counter()):
            assert 0.0 <= report.time_of_day < DAY


def test_clock_goes_on_over_midnight_and_takes_late_reports():
    """23:59:58 and 00:00:02 are four seconds apart, and the day does not jump back."""
    clock = DayClock(5.0 * DAY - 10.0)
    times = [clock.time(tod) for tod in (DAY - 2.0, 2.0, DAY - 1.0, 3.0)]
    np.testing.assert_allclose(np.array(times) - 5.0 * DAY, [-2.0, 2.0, -1.0, 3.0])


def test_wrong_times_do_not_move_the_day():
    """Two damaged reports of ours; and two other radars whose clocks were never set."""
    feed, others = Feed(read_reports, rosbags_types(), 'radar', 10.0 * DAY + 1e4), []
    for radar in (1, 2):
        others.append({'010': (('SAC', 9), ('SIC', radar))})
    for step in range(60):
        now = 1e4 + 4.0 * step
        told = feed.take(block(plot(now)))
        assert told[0] == pytest.approx(10.0 * DAY + now - AHEAD, abs=1e-5)
        feed.take(block(*(plot((now + 29e3 * (n + 1)) % DAY, **o) for n, o in enumerate(others))))
        if step % 20 == 10:
            feed.take(block(plot((now + 2e3 * step) % DAY)))


def test_feed_follows_one_radar_and_marks_are_looks_without_plots():
    """A sector in which nothing was seen is a message without rows; other radars are counted."""
    feed = Feed(read_reports, rosbags_types(), 'radar', 10.0 * DAY)
    assert feed.take(mark(100.0))[0] == 10.0 * DAY + 100.0 - AHEAD
    other = plot(1.0, **{'010': (('SAC', 1), ('SIC', 1))})
    assert feed.take(block(other)) is None
    stamp, msg = feed.take(block(plot(101.0), plot(102.5)) + mark(100.5))
    assert stamp == 10.0 * DAY + 100.5 - AHEAD
    np.testing.assert_allclose(to_columns(msg, 9)['time'] - AHEAD, [0.5, 2.0])
    assert feed.counts == {'plots': 2, 'from another source': 1}


def test_file_becomes_a_bag_that_a_replay_reads(tmp_path, capsys):
    """Over midnight of the day that the user says."""
    path, bag = tmp_path / 'night.ast', tmp_path / 'bag'
    path.write_bytes(b''.join(block(plot(t % DAY)) for t in (DAY - 4.0, DAY, DAY + 4.0)))
    assert main([str(path), '--bag', str(bag), '--date', '2026-03-01']) == 0
    assert '25/201: plots 3' in capsys.readouterr().out
    with open_bag(bag) as recorded:
        stamps = [time_ns / 1e9 for _, time_ns, _ in recorded.messages()]
    midnight = datetime(2026, 3, 2, tzinfo=timezone.utc).timestamp()
    np.testing.assert_allclose(np.array(stamps) - midnight + AHEAD, [-4.0, 0.0, 4.0], atol=1e-6)


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        (['udp://nowhere'], 'udp://HOST:PORT'),
        (['udp://127.0.0.1:0'], 'udp://HOST:PORT, PORT from 1 on'),
        (['udp://127.0.0.1:9', '--bag', 'x'], '--bag is for a file'),
        (['/no/such/file'], 'No such file'),
    ],
)
def test_what_cannot_be_read_is_told(arguments, words, capsys):
    """No traceback."""
    assert main(arguments) == 1
    assert words in capsys.readouterr().err


def test_file_without_reports_makes_no_bag(tmp_path, capsys):
    """A wrong file is told, with what was found in it."""
    path, bag = tmp_path / 'notes.txt', tmp_path / 'bag'
    path.write_text('not ASTERIX')
    assert main([str(path), '--bag', str(bag)]) == 1
    said = 'notes.txt gives no message; no reports: truncated or of wrong length 1'
    assert said in capsys.readouterr().err
    assert not bag.exists()


def test_decoder_is_loaded_before_anybody_is_heard():
    """It takes seconds, in which the datagrams of a radar would be lost."""
    program = (
        'import sys; from tracking_tools.asterix.__main__ import main; '
        'from tracking_tools.feeds import command; '
        "command.open_udp = lambda _: sys.exit('asterix.generated' not in sys.modules); "
        "main(['udp://127.0.0.1:1'])"
    )
    assert subprocess.run([sys.executable, '-c', program], cwd=ROOT, check=False).returncode == 0
