# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Which datagrams are in a capture, as tcpdump (pcap) and Wireshark (pcapng) write them?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from struct import unpack_from

_ORDERS = {
    b'\xd4\xc3\xb2\xa1': '<', b'\x4d\x3c\xb2\xa1': '<', b'\xa1\xb2\xc3\xd4': '>',
    b'\xa1\xb2\x3c\x4d': '>',
}  # fmt: skip
_NEXT_GENERATION = b'\x0a\x0d\x0d\x0a'
_INTERFACE, _PACKET = 1, 6  # blocks of pcapng
_ETHERNET = 1
# Where the packet begins in a frame: loopback, Ethernet, raw, both any-interfaces of Linux.
_HEADERS = {0: 4, _ETHERNET: 14, 101: 0, 113: 16, 228: 0, 276: 20}
_TAGGED = (0x8100, 0x88A8)  # Ethernet frames of a virtual network, four bytes longer
_UDP, _FRAGMENT = 17, 0x3FFF
Frames = Iterator[tuple[int, bytes]]  # with the type of their link


def is_capture(path: Path) -> bool:
    """Return whether a file begins as captures do."""
    with path.open('rb') as file:
        return file.read(4) in {*_ORDERS, _NEXT_GENERATION}


def datagrams_of_capture(path: Path, counts: Counter[str]) -> Iterator[bytes]:
    """Yield what the datagrams of a capture carry; count frames that are none or not whole."""
    data = path.read_bytes()
    frames = _of_pcapng(data) if data.startswith(_NEXT_GENERATION) else _of_pcap(data)
    for link, frame in frames:
        content = _content(link, frame)
        if content:
            yield content
        else:
            counts['frame without a datagram'] += 1


def _of_pcap(data: bytes) -> Frames:
    order, at = _ORDERS[data[:4]], 24
    link = unpack_from(f'{order}I', data.ljust(at, b'\0'), 20)[0] & 0xFFFF
    while at + 16 <= len(data):
        (length,) = unpack_from(f'{order}I', data, at + 8)
        yield link, data[at + 16 : at + 16 + length]
        at += 16 + length


def _of_pcapng(data: bytes) -> Frames:
    order, at, links = '<', 0, list[int]()
    while at + 28 <= len(data):
        if data[at : at + 4] == _NEXT_GENERATION:
            order, links = ('>' if data[at + 8] == 0x1A else '<'), []
        kind, length = unpack_from(f'{order}II', data, at)
        if length < 12:
            return
        if kind == _INTERFACE:
            links.append(unpack_from(f'{order}H', data, at + 8)[0])
        if kind == _PACKET:
            (interface,), (size,) = (unpack_from(f'{order}I', data, at + n) for n in (8, 20))
            link = links[interface] if interface < len(links) else -1
            yield link, data[at + 28 : at + min(28 + size, length)]
        at += length


def _content(link: int, frame: bytes) -> bytes:
    """Return what a whole datagram (IPv4) carries, nothing of other frames."""
    at = _HEADERS.get(link, len(frame))
    while link == _ETHERNET and int.from_bytes(frame[at - 2 : at], 'big') in _TAGGED:
        at += 4
    packet = frame[at:]
    if len(packet) < 28 or packet[0] >> 4 != 4 or packet[9] != _UDP:
        return b''
    datagram = packet[4 * (packet[0] & 0xF) :]
    length = int.from_bytes(datagram[4:6], 'big')
    is_part = int.from_bytes(packet[6:8], 'big') & _FRAGMENT or length > len(datagram)
    return b'' if is_part else datagram[8:length]
