# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where the bytes of a feed come from: UDP, or the lines of a file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
import socket
from urllib.parse import urlsplit

LARGEST = 65_535  # bytes of a datagram
LONGEST = 1024  # bytes of a line
PATIENCE = 0.2  # between two looks at whether to go on [s]


def open_udp(address: str) -> socket.socket:
    """
    Return a socket that hears 'udp://HOST:PORT'; a multicast group is joined.

    Raises
    ------
    ValueError
        For another form of address, or port 0, for which any would be taken that is free.

    """
    parts = urlsplit(address)
    if parts.scheme != 'udp' or not parts.hostname or not parts.port:
        raise ValueError(f'address must be udp://HOST:PORT, PORT from 1 on, got {address}')
    hearing = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    group = socket.inet_aton(socket.gethostbyname(parts.hostname))
    is_group = 224 <= group[0] < 240
    if is_group or not any(group):  # what is sent to all may be heard by many, else by one alone
        hearing.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        hearing.bind((parts.hostname, parts.port))
    except OSError:
        hearing.close()
        raise
    if is_group:
        request = group + socket.inet_aton('0.0.0.0')  # noqa: S104 (any interface joins the group)
        hearing.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, request)
    hearing.settimeout(PATIENCE)
    return hearing


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
