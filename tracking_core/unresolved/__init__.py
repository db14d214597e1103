# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What if the sensor cannot resolve contacts, and two of them make one plot?

Say tracks 0 and 1 are within a beam's width of each other, and one plot lies between them. Step by
step, in the order in which to read:

1. ``resolution``: they are one to the sensor with a chance c, from how far apart they may be. That
   is a *link* (0, 1, c).
2. ``grouping`` and ``ways``: linked tracks are a *group*; a *partition* says who of it is one with
   whom. Here there are two: {0}, {1} with chance 1 - c, and {0, 1} with chance c. What competes
   for a plot is a *unit*: units 0 and 1 are the tracks themselves, unit 2 is the *set* {0, 1}, of
   which tracks 0 and 1 are the *members*.
3. ``sets``: where the set's plot ought to be: at the mean of its members by their levels.
4. ``laws``: the set can have made the plot by three laws: it is of both (a *share* of the mean
   each), or of track 0 alone, which has drowned track 1, or the other way round. What a track has
   to do with the plot by one law is a row: its *part* is the chance of that law.
5. ``common_pairs``: each row is one more pair of a track and a plot, with innovation and
   likelihood; in `Gated.common` it tells its row among the laws.
6. ``association/partitions.py``: units compete for plots like tracks, in each partition by itself;
   ``sharing.py`` adds up what that says of the tracks.

The method is ours: mixtures over partitions as in a multiple-hypothesis treatment of merged
measurements, with exact marginals. It was made for the array of [VORONINA19], and serves radars
too; nothing is done where no two tracks that are sure and in sight are linked.
"""
