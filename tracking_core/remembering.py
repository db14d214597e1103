# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What do objects that learn have in common? They can be put back to what they knew."""

from __future__ import annotations

from typing import Any


class Remembering:
    """Something whose attributes are replaced as it learns, never changed in place."""

    def remember(self) -> dict[str, Any]:
        """Return all that is known, by attribute."""
        return dict(vars(self))

    def recall(self, memory: dict[str, Any]) -> None:
        """Know what was known when this was remembered."""
        vars(self).update(memory)
