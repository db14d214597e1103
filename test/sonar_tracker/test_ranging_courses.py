# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""When is the heading in doubt? Where most contacts were lately on no straight course."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.testing import assert_array_equal
import pytest

from sonar_tracker.ranging_courses import Courses

NOW, NEVER = 1000.0, -np.inf


def courses(straight: list[float], bent: list[float]) -> Courses:
    """Return courses that were straight and bent at these times [s]."""
    return replace(Courses.unknown(len(bent)), straight=np.array(straight), bent=np.array(bent))


@pytest.mark.parametrize(
    ('straight', 'bent', 'is_doubted'),
    [
        ([NEVER], [990.0], False),
        ([NEVER, NEVER], [990.0, 900.0], True),
        ([NEVER, NEVER], [990.0, 799.0], False),
        ([980.0, 985.0, 990.0, 990.0], [990.0, 990.0, NEVER, NEVER], False),
        ([980.0, 985.0, NEVER, NEVER], [990.0, 990.0, NEVER, NEVER], True),
    ],
    ids=['one alone', 'two', 'one after another', 'half', 'all that were fitted'],
)
def test_heading_is_doubted_by_most_contacts_and_two_at_least(
    straight: list[float], bent: list[float], is_doubted: bool
) -> None:
    """Those of the last 200 s count, of the contacts that fits have judged at all."""
    assert courses(straight, bent).doubt_heading(NOW) == is_doubted


def test_courses_follow_their_ids() -> None:
    """Whatever the order; new ones are unknown."""
    known = courses([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]).of(np.array([7, 8, 9]), np.array([9, 5, 7]))
    assert_array_equal(known.straight, [3.0, NEVER, 1.0])
    assert_array_equal(known.bent, [6.0, NEVER, 4.0])
    assert np.isnan(known.state).all()
