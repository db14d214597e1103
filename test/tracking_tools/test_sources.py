# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""Where feeds hear their senders."""

import socket

import pytest

from tracking_tools.feeds.sources import open_udp

GROUP = '239.73.20.7'


def test_group_is_heard_on_every_network():
    """A radar is seldom in the network of the default route; here it is in the loopback."""
    with socket.socket(type=socket.SOCK_DGRAM) as sender, open_udp(_free(GROUP)) as hearing:
        loopback = socket.inet_aton('127.0.0.1')
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, loopback)
        sender.sendto(b'plots', hearing.getsockname())
        hearing.settimeout(10.0)
        assert hearing.recv(100) == b'plots'


def _free(host):
    """Return the address of a port that is free there."""
    with socket.socket(type=socket.SOCK_DGRAM) as free:
        free.bind((host, 0))
        return f'udp://{host}:{free.getsockname()[1]}'


@pytest.mark.parametrize('host', ['127.0.0.1', '198.51.100.77'])
def test_address_that_cannot_be_heard_is_named(host):
    """One that another feed hears, one of another machine."""
    address = _free('127.0.0.1').replace('127.0.0.1', host)
    with open_udp(address.replace(host, '127.0.0.1')), pytest.raises(OSError, match=address):
        open_udp(address)
