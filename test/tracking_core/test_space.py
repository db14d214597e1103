# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""What is near what: points as they are, angles across the seam of the turn."""

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from tracking_core.space import ANGLES, POINTS

SEAM = np.array([[np.pi - 0.01], [-np.pi + 0.01]])
NOBODY_ELSE = np.zeros(2, np.int64)


def test_angles_on_both_sides_of_the_seam_are_near() -> None:
    """As places 6.26 apart, as angles 0.02."""
    half = np.full((2, 1), 0.1)
    assert_array_equal(POINTS.find_pairs(SEAM, half, SEAM), [[0, 1], [0, 1]])
    assert_array_equal(ANGLES.find_pairs(SEAM, half, SEAM), [[0, 0, 1, 1], [0, 1, 0, 1]])


def test_beside_tells_angles_in_the_turn_of_the_reference() -> None:
    """The second one is told as more than pi, seen from the first."""
    assert_allclose(ANGLES.beside(SEAM, SEAM, NOBODY_ELSE)[:, 0], np.pi + np.array([-0.01, 0.01]))
    assert_array_equal(POINTS.beside(SEAM, SEAM, NOBODY_ELSE), SEAM)


def test_shortest_wraps_the_angle_and_leaves_its_rate() -> None:
    """Nearly a turn to the left is a little to the right, however fast; the argument stays."""
    way = np.array([[2.0 * np.pi - 0.1, 5.0]])
    assert_allclose(ANGLES.shortest(way), [[-0.1, 5.0]])
    assert_array_equal(POINTS.shortest(way), [[2.0 * np.pi - 0.1, 5.0]])
