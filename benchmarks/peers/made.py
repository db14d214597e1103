# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When, on what and with what did this run?"""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime, timezone
import os
from pathlib import Path
import platform

import numpy as np
import scipy

from benchmarks.peers.entrants import Entrant


def made(entrants: Iterable[Entrant]) -> str:
    """Return date, machine and versions."""
    versions = {'numpy': np.__version__, 'scipy': scipy.__version__}
    for entrant in entrants:
        versions |= entrant.versions
    names = ', '.join(f'{name} {value}' for name, value in versions.items())
    now, cores = datetime.now(timezone.utc), os.cpu_count()
    return (
        f'{now:%Y-%m-%d %H:%M} UTC, {_processor()}, {cores} cores, {_load()}'
        f'Python {platform.python_version()}; {names}'
    )


def _load() -> str:
    """Return how busy the machine was, where it says so."""
    try:
        return f'load of the last quarter hour {os.getloadavg()[2]:.1f}, '
    except (AttributeError, OSError):
        return ''


def _processor() -> str:
    try:
        lines = Path('/proc/cpuinfo').read_text(encoding='utf-8').splitlines()
    except OSError:
        return platform.machine()
    models = [line.split(':', 1)[1].strip() for line in lines if line.startswith('model name')]
    return models[0] if models else platform.machine()
