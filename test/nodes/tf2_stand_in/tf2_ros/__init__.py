# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
What our nodes need of tf2_ros, which has no wheel: names, signatures and exceptions are its own.

Transforms come one by one (TransformStamped) on /tf_stand_in: TFMessage has no wheel either.
"""

from bisect import bisect_left

from geometry_msgs.msg import TransformStamped
import numpy as np

NANOSECONDS = 1_000_000_000


class TransformException(Exception):  # noqa: N818 (tf2's own name)
    """Any reason for which a transform cannot be told."""


class LookupException(TransformException):
    """A frame that nobody has told of."""


class ExtrapolationException(TransformException):
    """A time before the first or after the last transform."""


class Buffer:
    """One chain of two frames, by time."""

    def __init__(self, cache_time=None, node=None):
        self.clear()

    def clear(self):
        """Forget all."""
        self._told = {}

    def set_transform(self, transform, authority):
        """Take one transform."""
        key = transform.header.frame_id, transform.child_frame_id
        stamp = transform.header.stamp
        told = self._told.setdefault(key, [])
        told.append((stamp.sec + stamp.nanosec / NANOSECONDS, transform))
        told.sort(key=lambda pair: pair[0])

    def lookup_transform(self, target_frame, source_frame, time, timeout=None):
        """Return the transform from source to target, linear between those that were told."""
        told = self._told.get((target_frame, source_frame))
        if told is None:
            raise LookupException(f'"{source_frame}" passed to lookupTransform does not exist')
        times, wanted = [t for t, _ in told], time.nanoseconds / NANOSECONDS
        if not times[0] - 1e-6 <= wanted <= times[-1] + 1e-6:
            raise ExtrapolationException(
                f'requested time {wanted:.6f}, data until {times[-1]:.6f}'
            )
        after = min(max(bisect_left(times, wanted), 1), max(len(told) - 1, 1))
        (begin, first), (end, last) = told[after - 1], told[min(after, len(told) - 1)]
        share = (wanted - begin) / (end - begin) if end > begin else 0.0
        return _between(first, last, share)


def _between(first, last, share):
    made = TransformStamped()
    for part, axes in (('translation', 'xyz'), ('rotation', 'xyzw')):
        one, other = (np.array([getattr(getattr(t.transform, part), a) for a in axes])
                      for t in (first, last))  # fmt: skip
        mixed = (1.0 - share) * one + share * other
        mixed = mixed / np.linalg.norm(mixed) if part == 'rotation' else mixed
        for axis, value in zip(axes, mixed.tolist(), strict=True):
            setattr(getattr(made.transform, part), axis, value)
    return made


class TransformListener:
    """Fills a buffer."""

    def __init__(self, buffer, node, *, spin_thread=False):
        self._node = node
        self._end = node.create_subscription(
            TransformStamped, '/tf_stand_in', lambda msg: buffer.set_transform(msg, 'test'), 100
        )

    def unregister(self):
        """Stop listening."""
        self._node.destroy_subscription(self._end)
