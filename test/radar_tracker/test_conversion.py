# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Polar to Cartesian: exact linearised covariance, and an unbiased one where noise is bent."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
import pytest
from scipy.stats import chi2

from radar_tracker.conversion import (
    azimuth_of,
    BIAS_LIMIT,
    blurred,
    farthest,
    linearised,
    to_cartesian,
    to_polar,
    unbiased,
)
from tracking_core.batches import Plots

POINTS = 10_000


def random_polar(seed: int, dimensions: int = 3):
    """Random range, azimuth, elevation, and their standard deviations."""
    rng = np.random.default_rng(seed)
    polar = np.stack(
        [
            np.exp(rng.uniform(np.log(100.0), np.log(3e5), POINTS)),
            rng.uniform(-np.pi, np.pi, POINTS),
            rng.uniform(-1.4, 1.4, POINTS),
        ],
        axis=1,
    )
    sd = np.stack(
        [
            rng.uniform(1.0, 500.0, POINTS),
            rng.uniform(1e-4, 1e-2, POINTS),
            rng.uniform(1e-4, 1e-2, POINTS),
        ],
        axis=1,
    )
    return polar[:, :dimensions], sd[:, :dimensions]


def position_of(polar):
    """Cartesian position in the definition of the angles; complex steps may pass through."""
    r, azimuth = polar[:, 0], polar[:, 1]
    elevation = polar[:, 2] if polar.shape[1] == 3 else 0.0 * r
    flat = r * np.cos(elevation)
    full = [flat * np.cos(azimuth), flat * np.sin(azimuth), r * np.sin(elevation)]
    return np.stack(full[: polar.shape[1]], axis=1)


def relative_error(R, expected):
    """Largest error of each matrix, relative to its largest element."""
    scale = np.abs(expected).max(axis=(1, 2))
    return (np.abs(R - expected).max(axis=(1, 2)) / scale).max()


@pytest.mark.parametrize('dimensions', [2, 3])
def test_linearised_equals_the_numerical_jacobian(dimensions: int) -> None:
    """J diag(sd^2) J^T at 10^4 random points, J from complex steps, which are exact."""
    polar, sd = random_polar(1, dimensions)
    columns = [
        position_of(polar + 1e-30j * np.eye(dimensions)[i]).imag / 1e-30 for i in range(dimensions)
    ]
    J = np.stack(columns, axis=2)
    position, R = linearised(polar, sd)
    assert_allclose(position, position_of(polar), rtol=1e-12, atol=1e-9)
    assert relative_error(R, np.einsum('mij,mj,mkj->mik', J, sd**2, J)) < 1e-13


def test_linearised_equals_the_elements_written_out() -> None:
    """[ZHUK09] eq. 10 to 15 with the misprints of 13 to 15 put right."""
    polar, sd = random_polar(2)
    r, azimuth, elevation = polar.T
    sr2, sb2, se2 = sd.T**2
    c2b, s2b = np.cos(azimuth) ** 2, np.sin(azimuth) ** 2
    c2e, s2e = np.cos(elevation) ** 2, np.sin(elevation) ** 2
    away, over, across = sr2 * c2e, r**2 * se2 * s2e, r**2 * sb2 * c2e
    xy = 0.5 * np.sin(2.0 * azimuth) * (c2e * sr2 - c2e * r**2 * sb2 + s2e * r**2 * se2)
    up = 0.5 * np.sin(2.0 * elevation) * (sr2 - r**2 * se2)
    xz, yz = up * np.cos(azimuth), up * np.sin(azimuth)
    expected = np.array(
        [
            [away * c2b + over * c2b + across * s2b, xy, xz],
            [xy, away * s2b + over * s2b + across * c2b, yz],
            [xz, yz, sr2 * s2e + r**2 * se2 * c2e],
        ]
    )
    assert relative_error(linearised(polar, sd)[1], np.moveaxis(expected, -1, 0)) < 1e-13


def test_linearised_as_printed_is_no_covariance() -> None:
    """With the printed (13) to (15) a quarter of the random points would have an indefinite R."""
    polar, sd = random_polar(3)
    r, azimuth, elevation = polar.T
    sr2, sb2, se2 = sd.T**2
    c2e, s2e = np.cos(elevation) ** 2, np.sin(elevation) ** 2
    R = linearised(polar, sd)[1].copy()
    R[:, 0, 1] = 0.5 * np.sin(2.0 * azimuth) * (sr2 - r**2 * sb2 * c2e + s2e * r**2 * se2)
    up = 0.5 * np.sin(2.0 * elevation) * (sr2 - r**2 * se2)
    R[:, 0, 2], R[:, 1, 2] = up * np.sin(azimuth), up * np.cos(azimuth)
    R[:, 1, 0], R[:, 2, 0], R[:, 2, 1] = R[:, 0, 1], R[:, 0, 2], R[:, 1, 2]
    correct = np.linalg.eigvalsh(linearised(polar, sd)[1])
    assert (correct[:, 0] > -1e-9 * correct[:, -1]).all()
    printed = np.linalg.eigvalsh(R)
    assert np.mean(printed[:, 0] < -1e-6 * printed[:, -1]) > 0.1


@pytest.mark.parametrize('dimensions', [2, 3])
def test_to_polar_inverts_the_conversion(dimensions: int) -> None:
    """There and back again."""
    polar, sd = random_polar(4, dimensions)
    assert_allclose(to_polar(linearised(polar, sd)[0]), polar, rtol=1e-9, atol=1e-9)


def measured_around(true, sd, samples: int = 40_000):
    """Noisy plots of one true place."""
    rng = np.random.default_rng(5)
    return true + rng.standard_normal((samples, len(true))) * sd, np.tile(sd, (samples, 1))


def nees(true, converted) -> float:
    """Mean normalised estimation error squared of converted plots of one place."""
    error = converted[0] - position_of(np.array([true]))
    inner = np.linalg.solve(converted[1], error[..., None])[..., 0]
    return float((error * inner).sum(axis=1).mean())


FAR = [
    ((50_000.0, 0.7), (30.0, np.deg2rad(1.5))),  # r s^2 / s_r = 1.1
    ((100_000.0, -2.5), (50.0, np.deg2rad(2.0))),  # 2.4
    ((60_000.0, 0.3, 0.6), (50.0, np.deg2rad(1.5), np.deg2rad(1.5))),  # 0.8
    ((100_000.0, 2.0, 0.3), (100.0, np.deg2rad(2.0), np.deg2rad(2.0))),  # 1.2
    ((60_000.0, -1.0, 0.9), (300.0, np.deg2rad(1.5), np.deg2rad(4.0))),  # 1.0
]


@pytest.mark.parametrize(('true', 'sd'), FAR)
def test_to_cartesian_is_consistent_where_noise_is_bent(true, sd) -> None:
    """Beyond r s^2 / s_r = 0.4 the mean NEES is d to 5 %, and linearised it is not."""
    plots, sds = measured_around(np.array(true), np.array(sd))
    d, band = len(true), chi2.ppf([0.0005, 0.9995], len(true) * len(plots)) / len(plots)
    assert true[0] * max(sd[1:]) ** 2 / sd[0] > BIAS_LIMIT
    ours, straight = nees(true, to_cartesian(plots, sds)), nees(true, linearised(plots, sds))
    # The covariance is that of the expected error given the plot, so the NEES has a small excess.
    assert 0.95 * band[0] < ours < 1.05 * band[1]
    assert abs(straight - d) > 5.0 * abs(ours - d)


@pytest.mark.parametrize(('true', 'sd'), FAR)
def test_to_cartesian_has_no_bias_where_noise_is_bent(true, sd) -> None:
    """The mean of the converted plots is the true place; linearised it falls short."""
    plots, sds = measured_around(np.array(true), np.array(sd))
    place = position_of(np.array([true]))[0]
    sight = place / np.linalg.norm(place)
    error = to_cartesian(plots, sds)[0] - place
    standard_error = error.std(axis=0) / np.sqrt(len(plots))
    assert (np.abs(error.mean(axis=0)) < 4.0 * standard_error).all()
    short = ((linearised(plots, sds)[0] - place) @ sight).mean()
    assert short < -0.4 * np.sum(np.square(sd[1:])) * true[0]


def test_to_cartesian_is_linearised_where_noise_is_straight() -> None:
    """Below the limit nothing is corrected, above it everything."""
    polar = np.array([[10_000.0, 0.5], [100_000.0, 0.5]])
    sd = np.array([[50.0, 0.01], [50.0, 0.02]])
    position, R = to_cartesian(polar, sd)
    assert_allclose(position[0], linearised(polar, sd)[0][0])
    assert_allclose(position[1], unbiased(polar, sd)[0][1])
    assert_allclose(R[1], unbiased(polar, sd)[1][1])


@pytest.mark.parametrize('dimensions', [2, 3])
def test_unbiased_tends_to_linearised(dimensions: int) -> None:
    """For small angle noise both agree."""
    polar, sd = random_polar(6, dimensions)
    sd[:, 1:] *= 1e-2
    far = sd[:, 0] > 1e-2 * polar[:, 0] * sd[:, 1:].max(axis=1)
    near, R = linearised(polar[far], sd[far])
    other, R_other = unbiased(polar[far], sd[far])
    assert_allclose(other, near, rtol=1e-6, atol=1.0)
    assert relative_error(R_other, R) < 1e-2


def test_to_cartesian_is_regular_at_the_origin_and_the_zenith() -> None:
    """J is singular there; a plot never is, and is as unsure across as its noise allows."""
    sd = np.array([[50.0, 2e-3, 2e-3]])
    for polar in ([0.0, 1.0, 0.2], [1e-9, 1.0, 0.2], [5e4, 1.0, np.pi / 2], [0.0, 1.0, np.pi / 2]):
        for dimensions in (2, 3):
            _, covariance = to_cartesian(np.array([polar])[:, :dimensions], sd[:, :dimensions])
            sizes = np.sqrt(np.linalg.eigvalsh(covariance[0]))
            arm = max(polar[0], sd[0, 0])
            assert sizes[0] >= min(arm * 2e-3, 50.0) * 0.9  # cos of an elevation of 0.2


@pytest.mark.parametrize('dimensions', [2, 3])
def test_blurred_equals_linearised_where_j_is_regular(dimensions: int) -> None:
    """Far from origin and zenith its axes, scaled, are those of J."""
    polar, sd = random_polar(7, dimensions)
    regular = polar[:, 0] > sd[:, 0]
    polar, sd = polar[regular], sd[regular]
    assert relative_error(blurred(polar, sd), linearised(polar, sd)[1]) < 1e-12


def test_blurred_by_hand_at_the_origin_and_the_zenith() -> None:
    """As unsure across as at the range noise; straight up as unsure in azimuth as in elevation."""
    sd = np.array([[50.0, 2e-3, 4e-3]])
    origin = blurred(np.array([[0.0, np.pi / 2.0, 0.0]]), sd)[0]
    assert_allclose(origin, np.diag([0.1, 50.0, 0.2]) ** 2, atol=1e-12)
    zenith = blurred(np.array([[1e4, 0.7, np.pi / 2.0]]), sd)[0]
    assert_allclose(zenith, np.diag([40.0, 40.0, 50.0]) ** 2, atol=1e-8)
    near = np.array([[10.0, 0.3, 0.2]])
    assert_allclose(to_cartesian(near, sd)[1], blurred(near, sd))


def test_azimuth_and_distance_are_told_by_polar_or_by_cartesian_columns() -> None:
    """Heights count for a 3-D radar only, where they are known."""
    polar = Plots.polar(np.zeros(2), np.array([3e3, 1e3]), np.array([0.4, -2.0]))
    assert_allclose(azimuth_of(polar, is_polar=True), [0.4, -2.0])
    assert farthest(polar, True, 2) == 3e3
    place = np.array([[-300.0, 400.0, 1200.0], [600.0, 0.0, np.nan]])
    plots = Plots.cartesian(np.zeros(2), place)
    assert_allclose(azimuth_of(plots, is_polar=False), [np.arctan2(4.0, -3.0), 0.0])
    assert farthest(plots, False, 2) == pytest.approx(600.0)
    assert farthest(plots, False, 3) == pytest.approx(1300.0)
