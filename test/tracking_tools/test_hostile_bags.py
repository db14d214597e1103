# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""A damaged recording ends a replay in words, whatever is damaged in it."""

from collections import Counter
from pathlib import Path
import shutil

import numpy as np
import pytest

from tracking_tools.bags import BadBag
from tracking_tools.replay import replay

SHORT, LONG = 12, 2000
FILES = ('metadata.yaml', 'recording.mcap')
EXTREMES = (b'\xff' * 8, bytes(8), b'\xff\xff\xff\x7f\0\0\0\0')


def damage(data: bytes, rng: np.random.Generator) -> bytes:
    """Return bytes cut short, flipped, overwritten by an extreme number, or copied elsewhere."""
    spoilt = bytearray(data)
    place, other = (int(n) for n in rng.integers(0, len(data), 2))
    kind = rng.integers(4)
    if kind == 0:
        return data[:place]
    if kind == 1:
        for flipped in rng.integers(0, len(data), rng.choice([1, 3, 50])):
            spoilt[flipped] ^= int(rng.integers(1, 256))
    elif kind == 2:
        place = int(rng.choice([place, place % 400, len(data) - 1 - place % 600]))
        spoilt[place : place + 8] = EXTREMES[rng.integers(len(EXTREMES))]
    else:
        spoilt[place : place + 200] = spoilt[other : other + 200]
    return bytes(spoilt)


def replay_damaged(source: Path, folder: Path, count: int) -> Counter[str]:
    """Replay so many damaged copies of a recording; return how they ended."""
    rng, ends = np.random.default_rng(1), Counter()
    for _ in range(count):
        bag = shutil.copytree(source, folder / 'bag')
        victim = bag / FILES[int(rng.random() < 0.7)]
        victim.write_bytes(damage(victim.read_bytes(), rng))
        try:
            replay(bag, folder / 'out', quiet=True)
            ends['replayed'] += 1
            shutil.rmtree(folder / 'out')
        except (BadBag, OSError):
            ends['refused'] += 1
        shutil.rmtree(bag)
        assert list(folder.iterdir()) == []  # nothing half written stays
    return ends


def test_replay_of_a_damaged_bag_ends_in_words(cut_bag, tmp_path):
    """It is refused, or read as far as it makes sense; nothing else is raised."""
    assert replay_damaged(cut_bag(5), tmp_path, SHORT)['refused'] > SHORT // 4


@pytest.mark.soak
def test_replay_of_many_damaged_bags_ends_in_words(cut_bag, tmp_path):
    """The same two thousand times."""
    print(f'\n{LONG} damaged bags: {dict(replay_damaged(cut_bag(5), tmp_path, LONG))}')


@pytest.mark.parametrize(
    ('file', 'content'),
    [('metadata.yaml', b'\xff\xfe'), ('recording.mcap', b'\x89MCAP0\r\n\x01' + b'\xff' * 8)],
)
def test_replay_names_the_bag_that_cannot_be_opened(cut_bag, tmp_path, file, content):
    """Bytes that are no text, and a length that no memory holds."""
    bag = shutil.copytree(cut_bag(5), tmp_path / 'bag')
    (bag / file).write_bytes(content)
    with pytest.raises(BadBag, match=r'bag cannot be read as a rosbag2 recording: \S'):
        replay(bag, tmp_path / 'out', quiet=True)


def test_recording_of_a_killed_recorder_says_how_to_mend_it(cut_bag, tmp_path):
    """Its folder has no metadata.yaml, and the end of its file may be missing."""
    bag = shutil.copytree(cut_bag(5), tmp_path / 'bag')
    (bag / 'metadata.yaml').unlink()
    words = r'killed: ros2 bag reindex \S*bag, or give \S*bag/recording.mcap'
    with pytest.raises(BadBag, match=words):
        replay(bag, tmp_path / 'out', quiet=True)
    replay(bag / 'recording.mcap', tmp_path / 'out', quiet=True)
    whole = (bag / 'recording.mcap').read_bytes()
    (bag / 'recording.mcap').write_bytes(whole[:-300])
    for path in (bag, bag / 'recording.mcap'):
        with pytest.raises(BadBag, match=r'killed: mcap recover \S*bag/recording.mcap -o'):
            replay(path, tmp_path / 'again', quiet=True)
