# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
r"""
What stands before a sentence of NMEA 0183, and when was it sent?

Networks (IEC 61162-450) and loggers put a block of tags there, as ``\s:RA0001,c:1772366400*2B\``.
"""

from __future__ import annotations

from functools import reduce
from operator import xor
import re

import numpy as np

_SENT = re.compile(r'\\((?:[^\\*]*,)?c:(\d{1,16})(?:,[^\\*]*)?)\*([0-9A-Fa-f]{2})\\')
_MILLISECONDS = 1e11  # what is more are no seconds since the epoch


def sentence_of(line: str, sign: str) -> str:
    """Return the sentence that begins with its sign, '$' or '!'; all where there is none."""
    return line[max(line.find(sign), 0) :]


def time_of(line: str) -> float:
    """Return when a sentence was sent by its tags [s since the epoch], NaN if they do not say."""
    tags = _SENT.search(line)
    if tags is None or not is_sound(tags[1], tags[3]):
        return np.nan
    sent = float(tags[2])
    return sent / 1000.0 if sent > _MILLISECONDS else sent


def is_sound(text: str, checksum: str) -> bool:
    """Return whether a checksum, two hexadecimal digits, is that of the text."""
    return checksum.upper() == f'{reduce(xor, text.encode(), 0):02X}'
