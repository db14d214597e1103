# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How recordings are opened and written: rosbag2 directories, by way of rosbags, no ROS graph."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from os import SEEK_END
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType
from typing import Any

from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.interfaces import (
    Connection,
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import CompressionMode, StoragePlugin, Writer
from rosbags.rosbag2.enums import CompressionFormat
from rosbags.serde import SerdeError
from rosbags.typesys import get_typestore, Stores
from rosbags.typesys.store import Typestore

from msg_adapters.message_types import NANOSECONDS
from tracking_tools.arguments import make_folder

TYPESTORE: Typestore = get_typestore(Stores.ROS2_JAZZY)
POINT_CLOUD = 'sensor_msgs/msg/PointCloud2'
UNREADABLE = (AnyReaderError, SerdeError)  # a message that is damaged
MAX_ROWS = 1_000_000  # of one message that the tools read
_STORAGE = 'recording'
_MCAP_END = b'\x89MCAP0\r\n'
# What rmw reports for a publisher that sets neither deadline nor lifespan nor lease.
_UNLIMITED = QosTime(9223372036, 854775807)


def nanoseconds(seconds: float) -> int:
    """Time [s] as the whole nanoseconds that bags and stamps count in."""
    whole = int(seconds // 1)
    return whole * NANOSECONDS + round((seconds - whole) * NANOSECONDS)


def absolute(topic: str) -> str:
    """Return the topic's name as bags have it, with the leading slash."""
    return '/' + topic.lstrip('/')


def reliable() -> Qos:
    """Quality of service of our publishers: reliable, volatile, keep last 10."""
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=10,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.VOLATILE,
        deadline=_UNLIMITED,
        lifespan=_UNLIMITED,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=_UNLIMITED,
        avoid_ros_namespace_conventions=False,
    )


class BadBag(ValueError):  # noqa: N818 (it is the bag that is bad)
    """A bag that cannot be used; says what it has and what is missing."""


@contextmanager
def open_bag(path: Path | str) -> Iterator[AnyReader]:
    """
    Give a recording to read, mcap or sqlite3.

    Bags that carry no message definitions are read with those of Jazzy.

    Raises
    ------
    FileNotFoundError
        If there is nothing at `path`.
    BadBag
        If what is there is no recording, or a damaged one.

    """
    path = Path(path)
    if not path.exists():
        raise FileNotFoundError(f'no bag at {path}')
    if path.is_dir() and not (path / 'metadata.yaml').exists():
        raise BadBag(
            f'{path} is no rosbag2 recording: there is no metadata.yaml in it{_hint(path)}'
        )
    try:
        bag = AnyReader([path], default_typestore=TYPESTORE)
        bag.open()
    except Exception as error:  # whatever damaged bytes lead the reader to
        why = str(error).rstrip('.') or type(error).__name__
        raise BadBag(
            f'{path} cannot be read as a rosbag2 recording: {why}{_hint(path)}'
        ) from error
    with closing(bag):
        yield bag


def _hint(path: Path) -> str:
    """Return what to do with what a recorder has left that was killed, '' for anything else."""
    files = [path] if path.is_file() else sorted(path.glob('*.mcap')) + sorted(path.glob('*.db3'))
    for file in files:
        if file.suffix == '.mcap' and file.stat().st_size and not _has_end(file):
            return (
                f'. The end of {file} is missing, as where a recorder was killed: '
                f'mcap recover {file} -o whole.mcap, then give whole.mcap'
            )
    if files and path.is_dir() and not (path / 'metadata.yaml').exists():
        return f', as where a recorder was killed: ros2 bag reindex {path}, or give {files[0]}'
    return ''


def _has_end(file: Path) -> bool:
    with file.open('rb') as stream:
        stream.seek(-min(len(_MCAP_END), file.stat().st_size), SEEK_END)
        return stream.read() == _MCAP_END


class BagWriter:
    """
    New rosbag2 directory with mcap storage, as a context manager.

    The same messages give the same bytes, whatever the directory is called: the storage file
    inside always has the same name. The directory appears when the bag is complete. Topics are
    announced by the first message on them or beforehand with ``announce``, so that a topic may
    stay empty.

    Parameters
    ----------
    path : Path or str
        Directory to make; it must not exist.
    compress : bool
        Whether the storage chunks are compressed (zstd).

    Raises
    ------
    FileExistsError, NotADirectoryError
        Where something exists at ``path``, or a file where its folder should be.

    """

    def __init__(self, path: Path | str, compress: bool = False) -> None:
        path = Path(path)
        if path.exists():
            raise FileExistsError(f'{path} exists already; remove it or choose another name')
        make_folder(path.parent)
        self._path = path
        # Goes with the writer at the latest, wherever a signal ends the command.
        self._workshop = TemporaryDirectory(prefix=f'.{path.name}.', dir=path.parent)
        self._unfinished = Path(self._workshop.name) / _STORAGE
        self._writer = Writer(self._unfinished, version=9, storage_plugin=StoragePlugin.MCAP)
        if compress:
            self._writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        self._connections: dict[str, Connection] = {}

    def __enter__(self) -> BagWriter:
        self._writer.open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._writer.close()
        if error is None:
            self._unfinished.rename(self._path)
        self._workshop.cleanup()

    def announce(self, topic: str, msgtype: str) -> Connection:
        """Add a topic, with the quality of service of our publishers; names become absolute."""
        topic = absolute(topic)
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(
                topic,
                msgtype,
                typestore=TYPESTORE,
                offered_qos_profiles=[reliable()],
            )
        return self._connections[topic]

    def write(self, topic: str, msg: Any, time: int) -> None:
        """Append a message of a rosbags type, recorded at ``time`` [ns since the epoch]."""
        self.write_raw(topic, msg.__msgtype__, TYPESTORE.serialize_cdr(msg, msg.__msgtype__), time)

    def write_raw(self, topic: str, msgtype: str, cdr: bytes | memoryview, time: int) -> None:
        """Append a serialised message, recorded at ``time`` [ns since the epoch]."""
        self._writer.write(self.announce(topic, msgtype), time, cdr)
