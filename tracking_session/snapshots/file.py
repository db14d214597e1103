# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How is a tree of values kept in one file, safely?

A line that says what this is and which ids are free, a line with the SHA-256 of all else, the
length of a JSON text, that text, and the bytes of all arrays in a row. Nothing in it is code;
every size is checked against the file before memory is taken. A new file takes the place of the
old one in one step, so that a node which is killed while it writes leaves the old one. The first
line is the same in all versions: whatever has become of the rest, ids go on.
"""

from __future__ import annotations

from collections.abc import Mapping
from hashlib import sha256
import json
import os
from pathlib import Path
import re
import tempfile
from typing import Any

from tracking_session.snapshots.values import from_plain, to_plain

VERSION = 2
MAGIC = b'contact_tracking snapshot '
LARGEST = 1_000_000_000  # bytes of a file; 200,000 tracks are less
_LENGTH = 8  # bytes that hold the length of the JSON text
_FIRST_LINE = 80  # bytes of it, at most
_HEAD = re.compile(MAGIC + rb'\d+ (\d{1,10})\n')
_IDS = 2**32  # that a track table can tell


class BadSnapshot(ValueError):  # noqa: N818 (it is the snapshot that is bad)
    """A file that cannot be restored; says why."""


def write_snapshot(path: Path, tree: Mapping[str, Any], ids: int = 0) -> None:
    """
    Put a tree of values where the old file was, all or nothing; OSError if that fails.

    A folder that is not there is made. From `ids` on nobody has had them.
    """
    arrays: list[Any] = []
    text = json.dumps(to_plain(dict(tree), arrays)).encode()
    body = b''.join(
        [len(text).to_bytes(_LENGTH, 'little'), text, *(values.tobytes() for values in arrays)]
    )
    head = MAGIC + f'{VERSION} {ids}'.encode()
    path.parent.mkdir(parents=True, exist_ok=True)
    number, name = tempfile.mkstemp(prefix=f'.{path.name}.', dir=path.parent)
    try:
        with os.fdopen(number, 'wb') as file:
            file.write(head + b'\n' + _checksum(head, body) + b'\n')
            file.write(body)
            file.flush()
            os.fsync(file.fileno())
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def free_ids(path: Path) -> int:
    """Return from where on ids are free, 0 where a file does not say; OSError without a file."""
    with path.open('rb') as file:
        head = file.readline(_FIRST_LINE)
    told = _HEAD.match(head)
    ids = int(told[1]) if told else 0
    return ids if ids < _IDS else 0


def read_snapshot(path: Path) -> dict[str, Any]:
    """
    Return the tree of values of a file.

    Raises
    ------
    OSError
        If there is no file or it cannot be read.
    BadSnapshot
        If it is no snapshot, one of another version, or damaged.

    """
    if path.stat().st_size > LARGEST:
        raise BadSnapshot(f'it has more than {LARGEST} bytes')
    head, _, rest = path.read_bytes().partition(b'\n')
    checksum, _, body = rest.partition(b'\n')
    if not head.startswith(MAGIC):
        raise BadSnapshot('it is no snapshot')
    version = head.removeprefix(MAGIC).decode('ascii', 'replace').partition(' ')[0]
    if version != str(VERSION):
        raise BadSnapshot(f'it is of version {version[:20]}, this program reads {VERSION}')
    if checksum != _checksum(head, body):
        raise BadSnapshot('it is damaged: the checksum is wrong')
    return _tree(body)


def _checksum(head: bytes, body: bytes) -> bytes:
    return sha256(head + body).hexdigest().encode()


def _tree(body: bytes) -> dict[str, Any]:
    """Return what a body says; whoever wrote it knew the checksum, so it may still be anything."""
    end = _LENGTH + int.from_bytes(body[:_LENGTH], 'little')
    try:
        tree, used = from_plain(json.loads(body[_LENGTH:end]), memoryview(body)[end:])
    except (ValueError, TypeError, KeyError, RecursionError) as error:
        raise BadSnapshot(f'it has contents that are none: {error}') from error
    if not isinstance(tree, dict) or end + used != len(body):
        raise BadSnapshot('it has contents that are none')
    return tree
