# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How an adapter refuses a message."""

from __future__ import annotations

LONGEST = 300  # characters of a message that are repeated to a user


class BadMessage(ValueError):  # noqa: N818 (it is the message that is bad)
    """
    A message that cannot be used; the text names the field and its value.

    Attributes
    ----------
    reason : str
        Short and without values, to count refusals by.

    """

    def __init__(self, reason: str, text: str) -> None:
        super().__init__(shown(text))
        self.reason = reason


def shown(text: str) -> str:
    """Return a text from outside as one line of bounded length that a terminal can show."""
    clipped = text if len(text) <= LONGEST else f'{text[:LONGEST]}...'
    return ''.join(sign if sign.isprintable() else ascii(sign)[1:-1] for sign in clipped)
