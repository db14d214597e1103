# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Every promise in docs/complaints.md is held by tests that exist."""

import ast
from pathlib import Path
import re

ROOT = Path(__file__).parent.parent
ROWS = [
    line
    for line in (ROOT / 'docs' / 'complaints.md').read_text().splitlines()
    if line.startswith('| ') and not line.startswith('| complaint')
]


def names_in(path: Path) -> set[str]:
    """Return the names of the test functions in a file."""
    body = ast.parse(path.read_text()).body
    return {each.name for each in body if isinstance(each, ast.FunctionDef)}


def test_every_complaint_has_tests_that_exist() -> None:
    """A renamed test is renamed there too."""
    assert len(ROWS) >= 18
    for row in ROWS:
        *_, tests, _ = row.split('|')
        named = re.findall(r'`(test/[\w/]+\.py)::(test_\w+)`', tests)
        assert named, row
        for file, name in named:
            assert name in names_in(ROOT / file), f'{file}::{name}'
