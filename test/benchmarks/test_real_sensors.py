# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Radars that are not as the textbook has them: are the scenes what they say, and judged so?"""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.aircraft import aircraft
from benchmarks.long_ships import ships
from benchmarks.real_sensors import CASES, main, run
from benchmarks.scene_figures import judge
from benchmarks.simulated_scene import Part
from tracking_tools.scoring import TrackRows


def test_tracks_that_are_the_truth_are_judged_so():
    """Held throughout, one a contact; one more that is nowhere is false in the half it is in."""
    scene = aircraft(seed=1)
    count = len(scene.messages)
    truth, scan = scene.truth, np.minimum((scene.truth.time / 4.0).astype(int), count - 1)
    stray = np.arange(count)
    far = np.full((count, 3), 1e6)
    rows = TrackRows(
        np.append(scan, stray), np.append(truth.id, np.full(count, 99)),
        np.append(truth.time, 4.0 * stray), np.concatenate([truth.position, far]),
        np.concatenate([truth.velocity, 0.0 * far]), np.tile(np.eye(6), (len(scan) + count, 1, 1)),
    )  # fmt: skip
    halves = (Part(), Part(inside=lambda place: place[:, 0] < 5e5))
    whole, near = judge(replace(scene, parts=halves), rows, np.zeros(count))
    assert (whole.held, whole.found, whole.ids) == (1.0, 1.0, 0.0)
    assert whole.tracks == pytest.approx(1.0, abs=1e-3)  # one is passed twice in a turn
    assert whole.nees == pytest.approx(0.0)
    assert (whole.false, near.false) == (1.0, 0.0)


def test_long_ships_give_several_plots():
    """As many as the pages say: 2.4 a turn, and boats one."""
    scenes = [ships(seed) for seed in range(4)]
    plots = np.mean([len(message) for scene in scenes for message in scene.messages])
    assert (plots - 20.0 - 6.0 * 0.9) / 6.0 == pytest.approx(2.4, abs=0.3)


@pytest.mark.parametrize(
    ('name', 'part', 'held'),
    [('long ships', 'ships', 0.99), ('cars', '', 0.9), ('aircraft, P_D 0.6', '', 0.97),
     ('strobe', 'during, in it', 0.95), ('second time around', '', 0.98)],
)  # fmt: skip
def test_scene_is_played_and_its_contacts_are_held(name, part, held):
    """With what its last row sets."""
    figures = dict(run(name, CASES[name][1][-1], seed=3))[part]
    assert figures.held > held
    assert figures.tracks == pytest.approx(1.0, abs=0.1)


def test_birds_close_together_are_not_each_others_clutter():
    """What contacts gave before they were known is taken back; two thirds were found without."""
    for seed in (3, 5):
        assert dict(run('birds', {}, seed))['birds'].held > 0.95


def test_command_prints_a_row_for_each_part(capsys):
    """With other values there is one for them."""
    given = ['--only', 'birds', '--runs', '2', '--jobs', '1', '--set', 'clutter_density=1e-4']
    main(given)
    table = capsys.readouterr().out.splitlines()[2:]
    assert [row.split(' | ')[0] for row in table] == [
        '| birds, `clutter_density: 0.0001`: birds', '| birds, `clutter_density: 0.0001`: aircraft'
    ]  # fmt: skip
