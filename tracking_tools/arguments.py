# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What several commands check of their arguments before they begin."""

from __future__ import annotations

from argparse import ArgumentTypeError
from pathlib import Path


def file_to_write(text: str) -> Path:
    """Return the path of a file that may be there already; refuse a directory."""
    if text.endswith('/') or Path(text).is_dir():
        raise ArgumentTypeError(f'{text} is a directory, not the name of a file')
    return Path(text)


def seed(text: str) -> int:
    """Return the seed of random numbers."""
    if not text.isdecimal():
        raise ArgumentTypeError(f'must be a whole number from 0 on, got {text}')
    return int(text)
