# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where the bytes of a feed come from: UDP, or the lines of a file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
import socket
from struct import pack
from urllib.parse import urlsplit

LARGEST = 65_535  # bytes of a datagram
LONGEST = 1024  # bytes of a line
PATIENCE = 0.2  # between two looks at whether to go on [s]


def open_udp(address: str) -> socket.socket:
    """
    Return a socket that hears 'udp://HOST:PORT'; a multicast group is joined on all networks.

    Raises
    ------
    ValueError
        For another form of address, or port 0, for which any would be taken that is free.
    OSError
        Where nobody can listen, or somebody does; names the address.

    """
    parts = urlsplit(address)
    if parts.scheme != 'udp' or not parts.hostname or not parts.port:
        raise ValueError(f'address must be udp://HOST:PORT, PORT from 1 on, got {address}')
    try:
        return _listen(parts.hostname, parts.port)
    except OSError as error:
        raise OSError(f'{address}: {error.strerror}') from error


def _listen(host: str, port: int) -> socket.socket:
    group = socket.inet_aton(socket.gethostbyname(host))
    hearing = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    is_group = 224 <= group[0] < 240
    if is_group or not any(group):  # what is sent to all may be heard by many, else by one alone
        hearing.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        hearing.bind((host, port))
        if is_group:
            _join(hearing, group)
    except OSError:
        hearing.close()
        raise
    hearing.settimeout(PATIENCE)
    return hearing


def _join(hearing: socket.socket, group: bytes) -> None:
    """Join a group wherever that can be: the system alone would choose one network, by routes."""
    refused, networks = list[OSError](), socket.if_nameindex()
    for index, _ in networks:
        request = pack('4s4si', group, bytes(4), index)
        try:
            hearing.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, request)
        except OSError as error:  # one without addresses, or one too many
            refused.append(error)
    if len(refused) == len(networks):
        raise refused[0]


def lines_of_file(path: Path, counts: Counter[str]) -> Iterator[bytes]:
    """Yield the lines of a file, one after another."""
    with path.open('rb') as file:
        yield from file


def lines_of(data: bytes, counts: Counter[str]) -> Iterator[str]:
    """Yield the lines in a piece of text that can be sentences; count those that cannot."""
    for line in data.splitlines():
        if len(line) > LONGEST or not line.isascii():
            counts['not a sentence'] += 1
        elif line.strip():
            yield line.decode('ascii').strip()
