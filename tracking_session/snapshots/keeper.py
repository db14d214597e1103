# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which tracks a node takes up again after it has been started anew, and how they are kept.

All that a session remembers goes into a file from time to time; a node that starts with the same
name, sensor and parameters soon enough goes on from there. Whatever is not fit is refused in
words, and tracking starts without it. Ids are reserved ahead of their use, so that none comes
twice even if a node is killed right after it has given one away.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
import time
from typing import Any

from tracking_core.config import parameters
from tracking_session.node_config import Configs
from tracking_session.session import Session
from tracking_session.snapshots.file import (
    BadSnapshot,
    free_ids,
    read_snapshot,
    write_snapshot,
)  # fmt: skip
from tracking_session.snapshots.form import check_form
from tracking_session.snapshots.session_memory import recall, remember

RESERVED = 1000  # ids beyond those that are given away

# Parameters of a node without which its tracks and frames mean something else.
MEANING = ('tracking_frame', 'use_tf', 'input_type', 'fields.')


class Keeper:
    """
    The snapshots of one session; without a file there are none.

    Parameters
    ----------
    session : Session
        Just begun.
    configs : tuple
        Of the tracker and of the node.
    node : str
        Its full name: the tracks of others are not for it.
    clock : callable
        Returns the time of day [s]: the one that goes on while no node runs.

    """

    def __init__(
        self,
        session: Session,
        configs: Configs,
        node: str = '',
        clock: Callable[[], float] = time.time,
    ) -> None:
        self._session, self._node, self._clock = session, node, clock
        self._config = configs[1].snapshot
        self._path = Path(self._config.file).expanduser() if self._config.file else None
        fixed = [p for p in parameters(configs[0]) if not p.live]
        fixed += [p for p in parameters(configs[1]) if p.name.startswith(MEANING)]
        self._parameters = {
            p.name: list(p.value) if isinstance(p.value, tuple) else p.value for p in fixed
        }
        self._bound = 0  # ids below are reserved in the file
        self._mark: tuple[int, int] | None = None  # of the file that was written last
        self._written = session.instrument.tracker.state  # what the file has

    def open(self, every: Callable[[float, Callable[[], None]], None], received: float) -> None:
        """Restore what is there, and save again and again; `every` calls back in a period."""
        if self._path is not None:
            self.restore(self._path, received)
            every(self._config.period, self.save)

    def restore(self, path: Path, received: float) -> None:
        """
        Go on from the file, if it is there and fits.

        Parameters
        ----------
        path : Path
            The file.
        received : float
            Now, by the clock that messages are received by [s].

        """
        try:
            ids = free_ids(path)
            self._take_ids(ids)  # whatever else is wrong with the file
            memory = read_snapshot(path)
            age = self._check(memory)
            self._recall(memory, ids, received - age)
        except FileNotFoundError:
            self._session.log.info(f'no snapshot {path} yet')
        except (BadSnapshot, OSError) as error:
            self._session.log.warning(
                f'snapshot {path} is not used: {error}; tracking starts anew'
            )
        else:
            self._session.log.info(
                f'{len(self._session.tracks)} tracks of {age:.1f} s ago are back '
                f'from {path}, in frame {self._session.frame.name!r}'
            )

    def save(self) -> None:
        """Write what the session knows now; a failure is said and hurts nothing else."""
        if self._path is None or self._session.instrument.tracker.state is self._written:
            return
        session, tracker = self._session, self._session.instrument.tracker
        bound = tracker.state.next_id + RESERVED
        memory = {
            'node': self._node,
            'sensor': session.instrument.topic,
            'parameters': self._parameters,
            'saved': self._clock(),
            'session': remember(session),
            'tracker': session.instrument.remember(),
        }
        try:
            if self._mark is not None and _mark(self._path) not in (self._mark, None):
                what = 'snapshot is written by another node, too'
                session.ledger.fail(what, f'{self._path}; give each its own snapshot.file')
            write_snapshot(self._path, memory, bound)
            self._mark = _mark(self._path)
            self._bound, self._written = bound, tracker.state
        except OSError as error:
            session.ledger.fail('snapshot cannot be written', f'{self._path}: {error}')

    def reserve_ids(self) -> None:
        """Keep in the file which ids are given away; to be called before they go."""
        if self._path is not None and self._session.instrument.tracker.state.next_id > self._bound:
            self.save()

    def _take_ids(self, ids: int) -> None:
        """Give away only ids that nobody has had."""
        tracker = self._session.instrument.tracker
        tracker.state = replace(tracker.state, next_id=max(ids, tracker.state.next_id))

    def _check(self, memory: dict[str, Any]) -> float:
        """Return the age of the file [s]; BadSnapshot where it does not fit."""
        topic, theirs = self._session.instrument.topic, memory.get('sensor')
        if theirs != topic:
            raise BadSnapshot(f'it is of a node that hears {theirs}, this one hears {topic}')
        if (theirs := memory.get('node')) != self._node:
            raise BadSnapshot(f'it is of {theirs}, this node is {self._node}')
        theirs = memory.get('parameters')
        for name, value in self._parameters.items():
            told = theirs.get(name) if isinstance(theirs, dict) else None
            if told != value:
                raise BadSnapshot(f'parameter {name} was {told}, and is {value} now')
        saved = memory.get('saved')
        age = self._clock() - saved if isinstance(saved, float) else -1.0
        if not 0.0 <= age <= self._config.max_age:
            raise BadSnapshot(
                f'it is {age:.1f} s old, limit {self._config.max_age:g} s (snapshot.max_age)'
            )
        return age

    def _recall(self, memory: dict[str, Any], ids: int, received: float) -> None:
        session = self._session
        try:
            check_form(memory['session'], remember(session))
            session.instrument.recall(memory['tracker'])
            recall(session, memory['session'], received)
        except (KeyError, TypeError, ValueError) as error:
            raise BadSnapshot(f'it has contents that do not fit: {error}') from error
        finally:
            self._take_ids(ids)
        self._written = session.instrument.tracker.state


def _mark(path: Path) -> tuple[int, int] | None:
    """Return what another file in its place would not have, None where there is none."""
    try:
        known = path.stat()
    except FileNotFoundError:
        return None
    return known.st_ino, known.st_mtime_ns
