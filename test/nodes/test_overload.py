# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The live radar node when plots come faster than it can use them."""

import numpy as np
import pytest

from benchmarks.overload import HEAD, overload
from msg_adapters.message_types import seconds
from tracking_tools.testing import confirmed_ids

MESSAGES, PLOTS = 45, 4000  # fewer messages than the transport keeps
MAX_DELAY = 0.05  # s, in which no machine uses all of them
RELIABLE = 'qos_overrides./plots.subscription.reliability:=reliable'
STEP = 0.05  # s between stamps


def noise(rng):
    """Return so many false plots that a scan of them takes long."""
    columns = {'range': rng.uniform(1e3, 3e5, PLOTS), 'azimuth': rng.uniform(-3.1, 3.1, PLOTS)}
    return {name: values.astype(np.float32) for name, values in columns.items()}


def test_node_that_is_too_slow_uses_the_newest_plots_and_counts_the_rest(start_node, probe):
    """A burst: the last message is answered, each is used or shed, and the wait stays bounded."""
    start_node(RELIABLE, f'max_delay:={MAX_DELAY}')
    probe.meet()
    probe.spin_until(lambda: probe.is_answered(probe.stamp), 'the last greeting')
    probe.diagnostics.clear()  # greetings may have been shed
    probe.spin_until(lambda: probe.diagnosed('plots shed'), 'diagnostics of now')
    messages, shed = (int(probe.diagnosed(f'plots {what}')) for what in ('messages', 'shed'))
    scans = [noise(np.random.default_rng(seed)) for seed in range(MESSAGES)]
    stamps = probe.stamp + 1.0 + STEP * np.arange(MESSAGES)
    answered = len(probe.tables)
    for columns, stamp in zip(scans, stamps.tolist(), strict=True):
        probe.send(columns, stamp)
    last = stamps[-1]
    probe.spin_until(lambda: probe.is_answered(last), 'the newest plots')
    used = len(probe.tables) - answered
    assert used < MESSAGES
    probe.spin_until(
        lambda: probe.diagnosed('plots shed') == str(shed + MESSAGES - used), 'the shed ones'
    )
    assert probe.diagnosed('plots lost') == '0'
    assert probe.diagnosed('plots messages') == str(messages + MESSAGES)
    heard = [seconds(table.header.stamp) for table in probe.tables]
    assert (np.diff(heard) > 0.0).all()
    texts = [status.message for msg in probe.diagnostics for status in msg.status]
    assert any('too slow: only the newest plots are used' in text for text in texts)


def share_plots(probe):
    """Let a second publisher of plots come, until the diagnostics warn of it."""
    second = probe.tell(probe.plots.msg_type, 'plots')
    probe.peer.wait_until_matched(second)
    warning = 'several publishers on plots'

    def send(_):
        probe.stamp += probe.sensor.period
        probe.send(probe.sensor.contacts(probe.stamp), probe.stamp)

    def is_warned():
        return any(warning in m.status[0].message for m in probe.diagnostics)

    probe.peer.ask(send, is_warned, warning, again=0.2)


def test_two_publishers_of_plots_are_reported(start_node, probe):
    """A recording and a radar on one topic: the diagnostics warn."""
    start_node()
    probe.meet()
    share_plots(probe)
    probe.spin_until(lambda: probe.diagnosed('plots publishers') == '2', 'the number of them')


def test_two_trackers_of_one_name_are_reported(start_node, probe):
    """Their tracks and ids are mixed on one topic: both say so, until one is gone."""
    start_node()
    probe.meet()
    warning = 'several publishers on /radar_tracker/tracks'

    def are_warned(expected):
        probe.diagnostics.clear()
        return lambda: any(
            (warning in message.status[0].message) == expected for message in probe.diagnostics
        )

    probe.spin_until(are_warned(False), 'no word while the node is alone')
    twin = start_node()
    probe.spin_until(are_warned(True), warning)
    twin.stop()
    probe.spin_until(are_warned(False), 'no word when it is alone again')


@pytest.mark.slow
def test_publishers_that_stay_where_one_is_wanted_are_named(start_node, probe):
    """A second radar on the topic, a second tracker of the same name: once, in the log."""
    node = start_node()
    probe.meet()
    share_plots(probe)
    twin = start_node()
    line = node.wait_for_line('several publishers on /plots', 50.0)
    assert 'on /plots: /probe, /probe; one is wanted' in line
    for each in (node, twin):
        line = each.wait_for_line('several publishers on /radar_tracker/tracks', 50.0)
        assert 'tracks: /radar_tracker, /radar_tracker; give each node its own name' in line
    assert node.log.count('several publishers') == 2


def test_limits_of_tracks_and_plots_hold(start_node, probe):
    """With room for two, the third contact is refused; a message with too many rows hurts none."""
    start_node(RELIABLE, 'max_tracks:=2', 'max_plots:=50')
    probe.meet()
    tables = [probe.scan() for _ in range(10)]
    assert max((table['status'] < 2).sum() for table in tables) == 2
    before = confirmed_ids(tables[-1])
    assert len(before) == 2
    columns = {name: values[:51] for name, values in noise(np.random.default_rng(0)).items()}
    probe.send(columns, probe.stamp + 1.0)
    probe.spin_until(lambda: probe.diagnosed('plots messages refused') == '1', 'a refusal')
    assert confirmed_ids(probe.scan()) == before
    assert any('close to max_tracks' in m.status[0].message for m in probe.diagnostics)


@pytest.mark.soak
def test_age_of_tracks_is_bounded_at_ten_times_the_plots_a_node_can_use(tmp_path):
    """For three minutes; the figures of docs/reliability.md."""
    outcome = overload(1.0, 180.0, tmp_path / 'node.log')
    print(f'\n{HEAD}\n{outcome.row("1")}')
    assert outcome.rate > 5.0 * outcome.capacity  # else the sender was the slow one
    assert np.percentile(outcome.ages, 95) < 2.0  # max_delay and a step
    assert outcome.shed + outcome.lost > 0.5
    first, second = outcome.growth
    assert second < 0.5 * first  # buffers of the transport fill, and stay
