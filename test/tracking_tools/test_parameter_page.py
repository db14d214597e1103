# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Is the page of parameters what the config dataclasses say?"""

from pathlib import Path

from tracking_core.config import parameters
from tracking_tools.parameter_page import NODES, page

PAGE = Path(__file__).parents[2] / 'docs' / 'parameters.md'


def test_page_is_current() -> None:
    """A changed default is changed here too: run python -m tracking_tools.parameter_page."""
    assert PAGE.read_text() == page()


def test_page_has_every_parameter_with_a_meaning() -> None:
    """No parameter without words, none twice in a node."""
    for configs in NODES.values():
        names = [p.name for config in configs for p in parameters(config)]
        assert len(names) == len(set(names))
        assert all(p.doc for config in configs for p in parameters(config))
        assert all(f'`{name}`' in page() for name in names)


def test_each_parameter_is_understood_alone() -> None:
    """`ros2 param describe` and the page of a recording show it without the one before."""
    for configs in NODES.values():
        words = [p.doc for config in configs for p in parameters(config)]
        assert not [doc for doc in words if doc.startswith(('...', 'the same'))]
        assert not [doc for doc in words if 'the same holds' in doc]


def test_limits_may_be_typed_as_they_are_printed() -> None:
    """Rounded up, a whole turn would be refused."""
    assert '0.001 to 6.28318 |' in page()
    assert '6.28319' not in page()
