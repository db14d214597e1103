# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""How the state of a node becomes a DiagnosticArray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from msg_adapters.message_types import MessageTypes


def to_diagnostics(
    name: str,
    level: str,
    message: str,
    *,
    values: Mapping[str, object],
    header: Any,
    types: MessageTypes,
) -> Any:
    """Return a DiagnosticArray with one status; `level` is OK, WARN, ERROR or STALE."""
    status = types.DiagnosticStatus(
        level=getattr(types.DiagnosticStatus, level),
        name=name,
        message=message,
        hardware_id='',
        values=[types.KeyValue(key=key, value=_text(value)) for key, value in values.items()],
    )
    return types.DiagnosticArray(header=header, status=[status])


def _text(value: object) -> str:
    return f'{value:.4g}' if isinstance(value, float) else str(value)
