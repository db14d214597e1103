# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Which plot belongs to which track? The menu of association methods.

All of them take the gated pairs and say how the plots are shared among the tracks. Read
``pda.py`` for a track alone, then ``jpda.py`` for tracks that compete, ``jpda_star.py`` for such
that fly side by side.
"""

from __future__ import annotations

from typing import Protocol

from tracking_core.association.global_nearest import global_nearest
from tracking_core.association.jpda import jpda
from tracking_core.association.jpda_star import jpda_star
from tracking_core.association.nearest import nearest
from tracking_core.association.pda import pda
from tracking_core.batches import Association, Floats, Ints

__all__ = [
    'ASSOCIATORS', 'DECIDING', 'JOINT', 'Associator', 'global_nearest', 'jpda', 'jpda_star',
    'nearest', 'pda',
]  # fmt: skip


class Associator(Protocol):
    """
    One way to share the plots of a scan among the tracks.

    A joint event gives each track at most one of its plots and each plot to at most one track.
    It weighs the product of exp(`log_weight`) over its pairs times the product of
    exp(`log_miss`) over the tracks that it leaves without a plot.
    """

    def __call__(
        self, track: Ints, plot: Ints, log_weight: Floats, log_miss: Floats, plots: int
    ) -> Association:
        """
        Share the plots among the tracks.

        Parameters
        ----------
        track, plot : (P,) arrays of int
            Gated pairs, each once, sorted by track, then plot.
        log_weight : (P,) array
            log(P_D r Lambda / lambda): the plot is the track's, against clutter.
        log_miss : (T,) array
            log(1 - P_D P_G r), finite: the scan has no plot of the track.
        plots : int
            Number of plots M of the scan.

        Returns
        -------
        Association
            Per track, ``miss`` and the ``probability`` of its pairs sum to 1.

        """
        ...


ASSOCIATORS: dict[str, Associator] = {
    'jpda': jpda,
    'jpda_star': jpda_star,
    'pda': pda,
    'global_nearest': global_nearest,
    'nearest': nearest,
}
DECIDING = ('global_nearest', 'nearest')  # the others share a plot among tracks
JOINT = ('jpda', 'jpda_star')  # weigh all tracks jointly; know what to do with plots in common
