# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""From scan to scan of the demo scene, what is drawn of a track neither flickers nor changes."""

from itertools import pairwise
from pathlib import Path

import pytest

from msg_adapters.message_types import rosbags_types
from tracking_node.display import Display
from tracking_tools.replay import read_configs
from tracking_tools.screen import Screen
from tracking_tools.sensors import SENSORS

ROOT = Path(__file__).parents[2]
RADAR = SENSORS['radar']


class Log:
    """Hears nothing."""

    def info(self, message):
        """Forget it."""

    warning = info


@pytest.fixture(scope='module')
def drawings(cut_bag, messages):
    """Return the MarkerArray after each of 120 turns, with the ids of the tracks at that time."""
    configs = read_configs(ROOT / 'config' / 'terminal_radar.yaml', {}, RADAR)
    session = RADAR.make_session(*configs, rosbags_types(), Log())
    display, drawn = Display(rosbags_types()), []
    for time, msg in messages(cut_bag(120), '/plots'):
        assert session.plots(msg, time * 1e-9) is not None
        session.instrument.follow()
        ids = set(session.tracks.id.tolist())
        drawn.append((display.draw(session, time * 1e-9, configs[1].markers), ids))
    return drawn


def test_screen_shows_the_tracks_and_nobody_else(drawings):
    """After every scan: who is there is shown, who is gone is not."""
    screen = Screen()
    for msg, ids in drawings:
        screen.take(msg)
        assert screen.ids() == ids
        assert {key for key in screen.markers if key[0] == 'id'} == {('id', i) for i in ids}


def test_track_that_was_deleted_never_comes_back(drawings):
    """An id is shown without a gap, from its first drawing to its deletion."""
    gone, before = set(), set()
    for msg, ids in drawings:
        there = {m.id for m in msg.markers if m.ns == 'id' and m.action == m.ADD}
        deleted = {m.id for m in msg.markers if m.ns == 'id' and m.action == m.DELETE}
        assert there == ids
        assert deleted == before - ids
        assert not there & gone
        gone, before = gone | deleted, ids
    assert gone  # false tracks have come and gone


def test_colour_of_an_id_never_changes(drawings):
    """Whatever its shape and however many others are there; only the opacity may."""
    colours = {}
    for msg, _ in drawings:
        for m in msg.markers:
            if m.action == m.ADD:
                colours.setdefault(m.id, set()).add((m.color.r, m.color.g, m.color.b))
    assert len(colours) > 10
    assert all(len(seen) == 1 for seen in colours.values())


def test_letters_and_lines_do_not_change_their_size(drawings):
    """The scene grows by a few kilometres; sizes go in powers of two."""
    sizes = [{m.scale.z for m in msg.markers if m.ns == 'id'} - {1.0} for msg, _ in drawings]
    assert all(len(seen) <= 1 for seen in sizes)
    in_order = [seen.pop() for seen in sizes if seen]
    changes = sum(a != b for a, b in pairwise(in_order))
    assert changes <= 2
