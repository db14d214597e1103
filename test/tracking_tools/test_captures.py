# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings made with tcpdump and Wireshark are the datagrams that are in them."""

from collections import Counter
from struct import pack

from hypothesis import given
from hypothesis import strategies as st
import pytest

from tracking_tools.bags import open_bag
from tracking_tools.feeds.captures import datagrams_of_capture, is_capture
from tracking_tools.nmea.__main__ import main

SENT = [b'first', b'the second datagram', b'3']


def packet(content, protocol=17, fragment=0):
    """Return an IPv4 packet with a UDP datagram."""
    udp = pack('>HHHH', 8600, 8600, 8 + len(content), 0) + content
    head = pack('>BBHHHBBH', 0x45, 0, 20 + len(udp), 1, fragment, 64, protocol, 0)
    return head + bytes([10, 0, 0, 1, 239, 0, 0, 1]) + udp


def ethernet(content, tags=b'', **kinds):
    """Return a frame, padded to the least that is sent."""
    return (bytes(12) + tags + b'\x08\x00' + packet(content, **kinds)).ljust(60, b'\0')


def pcap(frames, order='<', magic=0xA1B2C3D4, link=1):
    """Return a capture of tcpdump."""
    head = pack(f'{order}IHHiIII', magic, 2, 4, 0, 0, 65535, link)
    return head + b''.join(pack(f'{order}IIII', 1, 2, len(f), len(f)) + f for f in frames)


def blocks(frames, order='<', link=1):
    """Return a capture of Wireshark: a section, an interface, a block of statistics, frames."""

    def block(kind, body):
        body = body.ljust(-(-len(body) // 4) * 4, b'\0')
        length = pack(f'{order}I', 12 + len(body))
        return pack(f'{order}I', kind) + length + body + length

    yield block(0x0A0D0D0A, pack(f'{order}IHHq', 0x1A2B3C4D, 1, 0, -1))
    yield block(1, pack(f'{order}HHI', link, 0, 65535))
    yield block(5, bytes(12))
    for frame in frames:
        yield block(6, pack(f'{order}IIIII', 0, 1, 2, len(frame), len(frame)) + frame)


FRAMES = list(map(ethernet, SENT))


@pytest.mark.parametrize(
    'capture',
    [
        pcap(FRAMES),
        pcap(FRAMES, '>', 0xA1B23C4D),
        pcap([ethernet(content, b'\x81\x00\x00\x07') for content in SENT]),
        pcap([bytes(16) + packet(content) for content in SENT], link=113),
        pcap(map(packet, SENT), link=101),
        b''.join(blocks(FRAMES)),
        b''.join(blocks(FRAMES, '>')),
    ],
)
def test_datagrams_come_out_as_they_were_sent(capture, tmp_path):
    """Either order of bytes, virtual networks, any interface of Linux, raw packets, pcapng."""
    path, counts = tmp_path / 'night', Counter()
    path.write_bytes(capture)
    assert is_capture(path)
    assert list(datagrams_of_capture(path, counts)) == SENT
    path.write_bytes(capture[:-3])
    assert list(datagrams_of_capture(path, counts))[:2] == SENT[:2]


def test_other_frames_are_counted(tmp_path):
    """TCP, parts of datagrams, another kind of network."""
    path, counts = tmp_path / 'night', Counter()
    others = [ethernet(b'x', protocol=6), ethernet(b'x', fragment=0x2000), b'', bytes(60)]
    path.write_bytes(pcap([*others, FRAMES[0]]))
    assert list(datagrams_of_capture(path, counts)) == SENT[:1]
    assert counts == {'frame without a datagram': 4}


@given(st.binary(max_size=120), st.sampled_from([pcap([])[:24], b''.join(blocks([]))]))
def test_any_bytes_are_read_without_an_error(tmp_path_factory, data, head):
    """Noise behind a valid beginning, or nothing."""
    path = tmp_path_factory.mktemp('noise') / 'night'
    path.write_bytes(head + data)
    list(datagrams_of_capture(path, Counter()))
    path.write_bytes(head[: len(data)].ljust(4, b'\0'))
    if is_capture(path):
        list(datagrams_of_capture(path, Counter()))


def test_capture_becomes_a_bag(tmp_path, capsys):
    """Two sentences in a datagram, among frames of others."""
    pytest.importorskip('pynmea2')
    path, bag = tmp_path / 'watch.pcap', tmp_path / 'bag'
    lines = (
        b'$RATTM,05,10.0,90.0,T,12.0,270.0,T,0.5,3.2,N,NAME,T,,120000.00,A*3C\r\n'
        b'$RATTM,06,11.0,90.0,T,12.0,270.0,T,0.5,3.2,N,NAME,T,,120000.00,A*3E\r\n'
    )
    path.write_bytes(pcap([ethernet(b'', protocol=6), ethernet(lines)]))
    assert main([str(path), '--bag', str(bag)]) == 0
    assert 'plots 2' in capsys.readouterr().out
    with open_bag(bag) as recorded:
        assert recorded.message_count == 1
