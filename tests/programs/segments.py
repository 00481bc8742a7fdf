# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances of points to the nearest of many segments in a plane, all as numpy arrays (n x 2)."""
import numpy as np


def nearest_of_all(points, begin, end):
    """Distance of each point to the nearest of some segments; infinite where there are none."""
    along = end - begin
    share = np.einsum("pij,ij->pi", points[:, None] - begin[None], along)
    share = np.clip(share / np.maximum((along * along).sum(axis=1), 1e-30), 0, 1)
    nearest = begin[None] + share[..., None] * along[None]
    return np.linalg.norm(points[:, None] - nearest, axis=2).min(axis=1, initial=np.inf)


def nearest(points, begin, end, close):
    """The same, where most distances are at most `close`: of a strip of points the segments beside it are looked at first."""
    low, high = np.minimum(begin, end)[:, 0], np.maximum(begin, end)[:, 0]
    order = np.argsort(points[:, 0])
    distances = np.empty(len(points))
    for strip in np.array_split(order, max(1, len(points) // 40)):
        if len(strip) == 0:
            continue
        some = points[strip]
        beside = (low <= some[-1, 0] + close) & (high >= some[0, 0] - close)
        found = nearest_of_all(some, begin[beside], end[beside])
        # a segment that is left out is farther off than `close`: it may be the nearest of these only
        doubtful = found > close
        if doubtful.any():
            found[doubtful] = nearest_of_all(some[doubtful], begin, end)
        distances[strip] = found
    return distances
