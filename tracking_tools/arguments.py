# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What several commands check of their arguments before they begin."""

from __future__ import annotations

from argparse import ArgumentTypeError
from datetime import datetime
import math
import os
from pathlib import Path


def file_to_write(text: str) -> Path:
    """Return the path of a file that may be there already; refuse a directory."""
    if text.endswith('/') or Path(text).is_dir():
        raise ArgumentTypeError(f'{text} is a directory, not the name of a file')
    return Path(text)


def make_folder(path: Path) -> None:
    """Make a folder and those that it is in; NotADirectoryError where a file is in the way."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError) as error:
        file = next(place for place in (path, *path.parents) if os.path.lexists(place))
        raise NotADirectoryError(f'{file} is no folder, nothing can be written in it') from error


def positive(text: str) -> float:
    """Return a finite number above 0."""
    number = _number(text)
    if not 0.0 < number < math.inf:
        raise ArgumentTypeError(f'must be a number above 0, got {text}')
    return number


def not_negative(text: str) -> float:
    """Return a finite number from 0 on."""
    number = _number(text)
    if not 0.0 <= number < math.inf:
        raise ArgumentTypeError(f'must be a number from 0 on, got {text}')
    return number


def finite(text: str) -> float:
    """Return a finite number."""
    number = _number(text)
    if not math.isfinite(number):
        raise ArgumentTypeError(f'must be a number, got {text}')
    return number


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def day(text: str) -> datetime:
    """Return a day, or a time of it, as ISO 8601 has them."""
    try:
        return datetime.fromisoformat(text)
    except ValueError as error:
        raise ArgumentTypeError(f'must be a day as 2026-03-01, got {text}: {error}') from error


def count(text: str) -> int:
    """Return a whole number from 1 on."""
    if not text.isdecimal() or int(text) == 0:
        raise ArgumentTypeError(f'must be a whole number from 1 on, got {text}')
    return int(text)


def seed(text: str) -> int:
    """Return the seed of random numbers."""
    if not text.isdecimal():
        raise ArgumentTypeError(f'must be a whole number from 0 on, got {text}')
    return int(text)
