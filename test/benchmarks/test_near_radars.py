# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Drones, an airport, people and cars: are the scenes what they say, and do the presets hold?"""

import numpy as np
import pytest

from benchmarks.airport import airport
from benchmarks.near_radars import CASES, main, run, STARING, TURNING


def plots_of(scene):
    """Return how many plots there are, and in how many looks a contact could be seen."""
    return sum(len(message) for message in scene.messages), int(scene.there.sum())


@pytest.mark.parametrize(('name', 'radar'), [('turning', TURNING), ('staring', STARING)])
def test_radar_gives_as_many_plots_as_it_says(name, radar):
    """A contact, where it does not hover, P_D a look; false plots besides."""
    scene = CASES[f'drones, {name}'][0](seed=1)
    plots, chances = plots_of(scene)
    own = plots - radar.clutter_per_turn * len(scene.messages)
    assert own / chances == pytest.approx(radar.detection_probability, abs=0.08)


def test_plots_are_where_contacts_are_but_for_their_noise():
    """Nine in ten plots of a queue are within 25 m of one; false ones are not."""
    scene = CASES['airport, queue'][0](seed=1)
    far = []
    for look, message in enumerate(scene.messages[:20]):
        place = message.range * np.stack([np.cos(message.azimuth), np.sin(message.azimuth)])
        ids = np.flatnonzero(scene.there[look])
        for where, time in zip(place.T, message.time, strict=True):
            there = [scene.truth.of_contact(int(k)).at(np.array([time])).position[0] for k in ids]
            far.append(np.linalg.norm(np.array(there) - where, axis=1).min())
    assert np.mean(np.array(far) < 25.0) == pytest.approx(21.0 / 31.0, abs=0.08)


def test_airliners_give_several_plots_where_that_is_said():
    """One to five, 2.2 on average, of which each is missed in one look of ten."""
    one, several = plots_of(airport(2)), plots_of(airport(2, several=True))
    assert one[1] == several[1]
    assert 1.3 < several[0] / one[0] < 1.8


@pytest.mark.parametrize(
    'name',
    ['drones, turning', 'drones, staring', 'drones, 3-D without Doppler', 'airport',
     'airport, queue', 'near, people and robots', 'near, cars and people',
     'near, objects in x and y'],
)  # fmt: skip
def test_preset_holds_its_contacts_and_follows_nobody_else(name):
    """As the page says, on a seed that nothing was chosen on; found in five looks."""
    figures = run(name, CASES[name][1][1], seed=90)
    assert figures.held > 0.985
    assert figures.tracks == pytest.approx(1.0, abs=0.02)
    assert figures.found < 5.5
    assert figures.ids < 0.2
    assert figures.false < 0.1
    assert figures.nees < 3.0


def test_preset_for_drones_knows_the_noise_of_places():
    """With the default of 30 m they were found after 6.5 looks, among 0.7 false tracks."""
    figures = run('drones, staring, in x and y', 'drone_radar', seed=92)
    assert figures.held > 0.985
    assert figures.found < 5.5
    assert figures.false < 0.2


@pytest.mark.parametrize('name', [name for name in CASES if name.startswith('near')])
def test_defaults_hold_what_is_near(name):
    """Without a preset nothing was, before the farthest plot told how noisy plots can be."""
    assert run(name, '', seed=90).held > 0.9


def test_airliner_that_gives_several_plots_has_one_track_with_its_size():
    """1.7 tracks without."""
    size = run('airport, several plots', CASES['airport, several plots'][1][2], seed=90)
    assert size.tracks == pytest.approx(1.0, abs=0.05)
    assert size.held > 0.98


def test_command_prints_a_row_for_defaults_and_presets(capsys):
    """In the order of the menu."""
    main(['--only', 'near, objects', '--runs', '1', '--jobs', '1'])
    rows = capsys.readouterr().out.splitlines()[2:]
    names = ('defaults', 'harbour_radar', 'short_range_radar')
    assert [row.split(' | ')[0] for row in rows] == [
        f'| near, objects in x and y, {name}' for name in names
    ]
