# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How an adapter refuses a message."""

from __future__ import annotations


class BadMessage(ValueError):  # noqa: N818 (it is the message that is bad)
    """
    A message that cannot be used; the text names the field and its value.

    Attributes
    ----------
    reason : str
        Short and without values, to count refusals by.

    """

    def __init__(self, reason: str, text: str) -> None:
        super().__init__(text)
        self.reason = reason
