# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
How a process ends with the one that started it, however that ends.

A test run that is killed, by a time limit perhaps, can ask nobody to end.
"""

from __future__ import annotations

import subprocess

# Who reads a pipe to its end learns that the writer is gone. Then: as by Ctrl-C, at last by force.
_SCRIPT = """
exec 2>/dev/null
test -n "$(cat)" && exit
kill -s INT -- "-$1"
left=$2
while kill -0 "$1" && test "$left" -gt 0; do sleep 1; left=$((left - 1)); done
kill -s KILL -- "-$1"
"""


class Watch:
    """
    Ends a process when we are gone.

    Parameters
    ----------
    group : int
        Its number, which is that of its process group, too.
    patience : float
        Between the request to end and force, in whole seconds [s].

    """

    def __init__(self, group: int, patience: float) -> None:
        self._watcher = subprocess.Popen(  # noqa: S603 (no word of a user)
            ['/bin/sh', '-c', _SCRIPT, 'watch', str(group), str(round(patience))],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            start_new_session=True,
        )

    def end(self) -> None:
        """Watch no longer: the number may soon be another process's."""
        if self._watcher.returncode is None:
            self._watcher.communicate(b'end')
