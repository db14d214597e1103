# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When and on what did a benchmark run, and who else used the machine?"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime, timezone
import os
from pathlib import Path
import platform

import numpy as np
import scipy


def machine(versions: Mapping[str, str] | None = None) -> str:
    """Return date, processor, load, and the versions of Python, numpy, scipy and others."""
    now, cores = datetime.now(timezone.utc), os.cpu_count()
    used = {'numpy': np.__version__, 'scipy': scipy.__version__, **(versions or {})}
    names = ', '.join(f'{name} {value}' for name, value in used.items())
    return (
        f'{now:%Y-%m-%d %H:%M} UTC, {_processor()}, {cores} cores, {_load()}'
        f'Python {platform.python_version()}; {names}'
    )


def _load() -> str:
    """Return how busy the machine was, where it says so."""
    try:
        return f'load in the minute before {os.getloadavg()[0]:.1f}, '
    except (AttributeError, OSError):
        return ''


def _processor() -> str:
    try:
        lines = Path('/proc/cpuinfo').read_text(encoding='utf-8').splitlines()
    except OSError:
        return platform.machine()
    models = [line.split(':', 1)[1].strip() for line in lines if line.startswith('model name')]
    return models[0] if models else platform.machine()
