# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Tracks become shapes for RViz: what they show, and that they stay the same from scan to scan."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from msg_adapters.markers import NAMESPACES, to_markers
from msg_adapters.shapes import colours, erase_all, round_extent
from msg_adapters.tracks import kinematics
from msg_adapters.trails import Trails
from tracking_core.rows import take


def draw(tracks, types, shown=frozenset()):
    """Return the markers of the tracks, after two scans."""
    position = kinematics(tracks, 'mmse')[0][:, :3]
    trails = Trails.empty(5).extend(tracks.id, position).extend(tracks.id, position + 1.0)
    header = types.header(1.0, 'map')
    return to_markers(
        tracks, trails, set(shown), header, types, lean=np.full(len(tracks), 0.5), output='mmse',
        lead_time=10.0,
    ).markers  # fmt: skip


@pytest.mark.parametrize('dimensions', [2, 3])
def test_every_track_is_drawn_in_its_own_colour(types, make_tracks, dimensions):
    """Five shapes each; the hue belongs to the id, whoever else is there."""
    markers = draw(make_tracks([1, 2], dimensions), types)
    assert {(m.ns, m.id) for m in markers} == {(ns, i) for ns in NAMESPACES for i in (1, 2)}
    hue = {(m.color.r, m.color.g) for m in markers if m.id == 1}
    assert len(hue) == 1
    alone = draw(make_tracks([1], dimensions), types)
    assert {(m.color.r, m.color.g) for m in alone} == hue


def test_covariance_ellipse_has_three_sigma_half_axes(types, make_tracks):
    """The axes of the shape are six roots of the eigenvalues, along their vectors."""
    tracks = make_tracks([1])
    _, covariance = kinematics(tracks, 'mmse')
    (ellipse,) = (m for m in draw(tracks, types) if m.ns == 'covariance')
    q, scale = ellipse.pose.orientation, ellipse.scale
    axis = Rotation.from_quat([q.x, q.y, q.z, q.w]).apply([1.0, 0.0, 0.0])[:2]
    variance = axis @ covariance[0, :2, :2] @ axis
    np.testing.assert_allclose(scale.x, 6.0 * np.sqrt(variance))
    np.testing.assert_allclose(
        scale.x * scale.y, 36.0 * np.sqrt(np.linalg.det(covariance[0, :2, :2]))
    )


def test_arrow_points_along_the_velocity(types, make_tracks):
    """Turned by its pose, the x axis is the velocity, climb included."""
    tracks = make_tracks([1])
    velocity = kinematics(tracks, 'mmse')[0][0, 3:]
    (arrow,) = (m for m in draw(tracks, types) if m.ns == 'velocity')
    q = arrow.pose.orientation
    ahead = Rotation.from_quat([q.x, q.y, q.z, q.w]).apply([arrow.scale.x, 0.0, 0.0])
    np.testing.assert_allclose(ahead, 10.0 * velocity)


def test_markers_of_deleted_tracks_are_deleted(types, make_tracks):
    """What was shown and is gone is taken off the screen, shape by shape."""
    markers = draw(make_tracks([2]), types, shown={1, 2})
    deleted = [m for m in markers if m.action == types.Marker.DELETE]
    assert {(m.ns, m.id) for m in deleted} == {(ns, 1) for ns in NAMESPACES}
    (everything,) = erase_all(types.header(0.0, 'map'), types).markers
    assert everything.action == types.Marker.DELETEALL


def test_gate_is_an_ellipse_that_touches_its_box(types, make_tracks):
    """Half sizes of 50 m along x and y, leaning: the outline reaches both and nothing beyond."""
    (gate,) = (m for m in draw(make_tracks([1]), types) if m.ns == 'gate')
    q = gate.pose.orientation
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    outline = np.stack([np.cos(angle) * gate.scale.x, np.sin(angle) * gate.scale.y], axis=1) / 2.0
    turned = Rotation.from_quat([q.x, q.y, q.z, q.w]).apply(np.pad(outline, ((0, 0), (0, 1))))
    # Half a degree between points of the outline leaves 1e-4 of its size.
    np.testing.assert_allclose(np.abs(turned).max(axis=0)[:2], 50.0, rtol=1e-4)
    assert gate.type == types.Marker.SPHERE
    assert turned[np.argmax(np.hypot(*turned.T[:2])), :2].prod() > 0.0  # leans as x goes with y


def test_gate_that_is_not_known_any_more_leaves_the_screen(types, make_tracks):
    """An old gate would stand where the track is no more."""
    tracks = make_tracks([1])
    tracks.gate_size[:] = np.nan
    (gate,) = (m for m in draw(tracks, types) if m.ns == 'gate')
    assert gate.action == types.Marker.DELETE


def test_trail_fades_from_the_track_to_nothing(types, make_tracks):
    """Newest point first, in the full colour; every older one is fainter."""
    (trail,) = (m for m in draw(make_tracks([1]), types) if m.ns == 'history')
    assert len(trail.colors) == len(trail.points) == 2
    assert [c.a for c in trail.colors] == pytest.approx([trail.color.a, 0.8 * trail.color.a])
    assert {c.r for c in trail.colors} == {trail.color.r}


def test_colours_tell_near_ids_apart():
    """Of any two ids fewer than thirty apart, no two look alike; an id keeps its colour."""
    rgb = colours(np.arange(1, 200), np.ones(199, bool))[:, :3]
    for apart in range(1, 30):
        # 0.05 is a difference that a display shows and an eye sees side by side.
        assert np.linalg.norm(rgb[apart:] - rgb[:-apart], axis=1).min() > 0.05
    np.testing.assert_array_equal(colours(np.array([77]), np.array([True]))[0, :3], rgb[76])


def test_letters_keep_their_size_while_contacts_move():
    """Sizes follow the scene in steps of two, not from scan to scan."""
    near = [round_extent(np.array([[x, 0.0, 0.0]])) for x in np.linspace(70e3, 130e3, 50)]
    assert set(near) == {2.0**17}
    assert round_extent(np.zeros((0, 3))) == 1.0


def test_same_track_keeps_its_markers_whatever_row_it_is_in(types, make_tracks):
    """Namespace and id belong to the track: nothing is drawn under another's name."""
    tracks = make_tracks([4, 9])
    there = {(m.ns, m.id): m.color.g for m in draw(tracks, types)}
    assert there == {(m.ns, m.id): m.color.g for m in draw(take(tracks, np.array([1, 0])), types)}


def test_track_that_came_after_the_last_scan_is_drawn_without_a_trail(types, make_tracks):
    """A user may start or drop a track between a scan and its drawing."""
    tracks, header = make_tracks([2, 3]), types.header(1.0, 'map')
    trails = Trails.empty(5)
    for step in range(2):
        trails = trails.extend(np.array([1, 2]), np.full((2, 3), float(step)))
    drawing = to_markers(
        tracks, trails, {1, 2}, header, types, lean=np.zeros(2), output='mmse', lead_time=1.0
    )
    assert [m.id for m in drawing.markers if (m.ns, m.action) == ('history', 0)] == [2]
    assert [m.id for m in drawing.markers if (m.ns, m.action) == ('id', 0)] == [2, 3]
