# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The pages of the nodes name every field, topic, key and line of the log, and no other."""

from pathlib import Path
import re

from nav_msgs.msg import Odometry
import numpy as np
import pytest

from msg_adapters import fans, markers
from msg_adapters.message_types import rclpy_types
from msg_adapters.table import from_columns, to_columns
from radar_tracker.config import RadarTrackerConfig
from radar_tracker.node_config import radar_node_config
from radar_tracker.session import radar_session
from sonar_tracker.config import SonarTrackerConfig
from sonar_tracker.node_config import sonar_node_config
from sonar_tracker.session import sonar_session
from tracking_core.config import with_values
from tracking_node.health import Health
from tracking_session.waiting import Waiting

ROOT = Path(__file__).parent.parent
DOCS = ROOT / 'docs'
TYPES = rclpy_types()
POLAR = {'range': [1e3, 2e3], 'azimuth': [0.1, 1.0], 'elevation': [0.1, 0.2]}
OF_NODES = (
    'nothing has come', 'there is no parameter', 'no parameters from', 'cannot', 'header.stamp of',
)  # fmt: skip
PAGES = {'radar': 'radar_node.md', 'sonar': 'sonar_node.md'}


class Log(list):
    """Keeps every line."""

    info = warning = list.append


def session(sensor='radar', tracker=None, node=None):
    """Return a session with these parameters, and its log."""
    make = {'radar': radar_session, 'sonar': sonar_session}[sensor]
    configs = {
        'radar': (RadarTrackerConfig(), radar_node_config()),
        'sonar': (SonarTrackerConfig(), sonar_node_config()),
    }[sensor]
    values = (tracker or {}), (node or {})
    filled = (with_values(c, v) for c, v in zip(configs, values, strict=True))
    log = Log()
    return make(*filled, TYPES, log), log


def message(stamp=100.0, frame='radar', **columns):
    """Return plots."""
    columns = {name: np.asarray(v, float) for name, v in (columns or POLAR).items()}
    return from_columns(columns, stamp, frame, TYPES)


def section(page, title):
    """Return the text under a heading."""
    text = (DOCS / page).read_text(encoding='utf-8')
    return re.split(rf'^#+ {re.escape(title)}\n', text, flags=re.M)[1].split('\n## ')[0]


def first_cells(text):
    """Return all names in the first column of the tables, one by one."""
    cells = [line.split('|')[1] for line in text.splitlines() if line.startswith('| `')]
    return {name for cell in cells for part in re.findall('`([^`]*)`', cell) for name in [part]}


def fields_in(page):
    """Return the names of the fields that a page has."""
    text = section(page, 'Fields of `~/tracks`').split('\n### ')[0]
    return {name for names in first_cells(text) for name in names.split()}


def table(sensor):
    """Return the track table of a session after one message."""
    one, _ = session(sensor)
    columns = POLAR if sensor == 'radar' else {'bearing': [0.1, 1.0]}
    return to_columns(one.plots(message(**columns), 1.0), 100)


def test_pages_have_every_field_of_the_tables():
    """Modes are documented once; the sonar's page refers to the common ones of the radar's."""
    named = {'radar': fields_in('radar_node.md'), 'sonar': fields_in('sonar_node.md')}
    text = section('sonar_node.md', 'Fields of `~/tracks`')
    named['sonar'] |= set(re.search(r'\(`([^`]*)`\)', text).group(1).split())
    for sensor, names in named.items():
        there = {re.sub(r'^p_(vertical_)?\d+$', 'p_<mode>', name) for name in table(sensor)}
        assert there - {'manoeuvre_probability_vertical'} == names


@pytest.mark.parametrize('sensor', PAGES)
def test_pages_have_every_namespace_of_the_markers(sensor):
    """Each is named and so explained."""
    spaces = {'radar': markers.NAMESPACES, 'sonar': fans.NAMESPACES}[sensor]
    text = section(PAGES[sensor], 'Markers').split('\n## ')[0]
    missing = {space for space in spaces if f'`{space}`' not in text}
    assert missing <= {'id'}


def test_page_has_every_key_of_the_diagnostics():
    """Keys of the node's topics stand for all four."""
    one, _ = session()
    one.plots(message(), 1.0)
    keys = {
        re.sub(r'^(plots|ownship|acquire|cancel) (?!age|used|held|silences|waited)', 'TOPIC ', key)
        for key in Health(0.0).values(one, 1.0)
    }
    text = section('radar_node.md', 'Diagnostics')
    assert keys == {name for name in first_cells(text) if not name.endswith('REASON')}


@pytest.mark.parametrize('page', [*sorted(DOCS.glob('*.md')), ROOT / 'README.md'], ids=str)
def test_links_lead_somewhere(page):
    """Files, and headings within them."""
    text = page.read_text(encoding='utf-8')
    for target in re.findall(r'\]\((?!https?:)([^)\s]+)\)', text):
        file, _, heading = target.partition('#')
        path = page.parent / file if file else page
        assert path.exists(), target
        if heading:
            titles = re.findall(r'^#+ (.*)$', path.read_text(encoding='utf-8'), re.M)
            anchors = {re.sub(r'[^\w\- ]', '', t.lower()).replace(' ', '-') for t in titles}
            assert heading in anchors, target


def normal(line):
    """Return a line of the log without its numbers."""
    return re.sub(r'-?\d+(\.\d+)?', '0', line.strip())


def own_ship(stamp, frame='map', x=0.0, yaw=0.0, yaw_variance=0.0):
    """Return odometry of a ship that says that it is at rest."""
    msg = Odometry(header=TYPES.header(stamp, frame))
    msg.pose.pose.position.x = x
    msg.pose.pose.orientation.z, msg.pose.pose.orientation.w = np.sin(yaw / 2), np.cos(yaw / 2)
    msg.pose.covariance[35] = yaw_variance
    return msg


def plots_of_eight(farthest, times):
    """Return looks at eight contacts at rest, azimuth noise so many times as large as told."""
    rng, azimuth = np.random.default_rng(2), np.linspace(-3.0, 3.0, 8)
    distance, sd = np.linspace(0.2, 1.0, 8) * farthest, 0.00175 * times
    return [
        message(100.0 + 4.0 * k, range=distance, azimuth=azimuth + sd * rng.normal(size=8))
        for k in range(40)
    ]


def sectors():
    """Return twelve turns with sixteen contacts in eight messages each."""
    place = np.linspace(0.01, 0.99, 16)  # of a turn
    for number in range(96):
        here = place[(8.0 * place).astype(int) == number % 8]
        columns = {
            'range': 3e4 + 1e3 * here, 'azimuth': 2.0 * np.pi * here,
            'time': 4.0 * here - 0.5 * (number % 8),
        }  # fmt: skip
        yield from_columns(columns, 100.0 + 0.5 * number, 'radar', TYPES)


def lines_of_sessions():
    """Make every mistake of the page once; return what was said."""
    said = []

    def use(*messages, tracker=None, node=None, odometry=()):
        one, log = session(tracker=tracker, node=node)
        for msg in odometry:
            one.ownship(msg, 1.0)
        for step, msg in enumerate(messages):
            one.plots(msg, 1.0 + step)
        said.extend(log)

    use(message(range=[1.0], snr=[2.0]))
    use(message(range=[1e3, 2e3], azimuth=[20.0, 50.0]))
    use(message(range=[1e3] * 3, azimuth=[1.0, 2.0, 50.0]))
    use(message(), tracker={'sensor.range_max': 1500.0})
    use(message(range=[1.0], azimuth=[1.0], velocity=[1.0]))
    use(message(range=[1e3], azimuth=[0.1]), message(104.0, x=[1.0], y=[2.0]))
    use(message(), tracker={'max_plots': 1})
    use(message(), node={'tracking_frame': 'map'})
    use(message(), message(104.0, 'other'))
    use(message(), tracker={'sensor.mount.x': 3.0})
    use(odometry=[own_ship(90.0)], node={'tracking_frame': 'odom'})
    use(message(), message())
    use(message(), *(message(500.0 + step) for step in range(4)))
    use(message(), odometry=[own_ship(90.0)])
    use(message(), tracker={'sensor.azimuth_convention': 'compass'}, odometry=[own_ship(99.0)])
    use(message(), tracker={'scan.assembly': 'sector'})
    places = [
        from_columns({'x': np.ones(1), 'y': np.ones(1)}, 100.0 + k, 'odom', TYPES) for k in (0, 4)
    ]
    use(*places, tracker={'sensor.mount.x': 3.0}, odometry=[own_ship(99.0, 'odom')])
    use(*plots_of_eight(50.0, 1.0))
    use(*plots_of_eight(3e4, 4.0))
    leap = [own_ship(90.0), own_ship(90.5), *(own_ship(91.0 + step, x=1e3) for step in range(3))]
    use(odometry=leap)
    use(odometry=[own_ship(90.0, yaw_variance=99999.0)])
    use(odometry=[own_ship(90.0 + step, x=8.0 * step) for step in range(40)])
    reset = [own_ship(90.0 + 0.1 * k, yaw=0.2 * (k >= 50)) for k in range(100)]
    use(odometry=reset)
    turns = [message(100.0 + step, range=[1e3, 2e3], azimuth=[0.1, 2.0]) for step in range(9)]
    use(*turns, odometry=[own_ship(90.0 + step, yaw=0.02 * step) for step in range(20)])
    use(*sectors())
    return [*said, *lines_of_who_waits()]


def lines_of_who_waits():
    """Return what is said where own ship's odometry does not come."""
    one, log = session()
    waiting = Waiting(one, radar_node_config(), lambda came, p: one.plots(came.msg, 0.0, p))
    waiting.ownship(own_ship(99.0), 0.0)
    waiting.plots(message(), 1.0)
    waiting.retry(3.1)
    return log


def test_lines_of_the_log_are_those_that_it_prints():
    """Numbers aside; those that only a process says are compared in ``test/nodes``."""
    said = {normal(line) for line in lines_of_sessions()}
    printed = [
        line
        for page in ('troubleshooting.md', 'integrate.md')
        for block in re.findall(r'^```text\n(.*?)^```', (DOCS / page).read_text(), re.M | re.S)
        for line in block.splitlines()
    ]
    of_sessions = [line for line in printed if not line.startswith(OF_NODES)]
    assert len(of_sessions) > 12
    assert {normal(line) for line in of_sessions} <= said
