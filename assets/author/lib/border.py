"""Borders of garments that end on cloth, not on skin: armholes and necklines of a vest, a jacket over trousers.

A border is kept on one smooth curve from the cut to the decimated mesh: hanging may fold the cloth,
but a bound edge does not ruffle.
"""

import numpy as np
from mathutils.bvhtree import BVHTree

from . import sdf, shell


def neighbours(t, count):
    """(smoothing over edges, smoothing along the rim, mask of the rim) of an open mesh."""
    e = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    e = np.unique(np.concatenate([e, e[:, ::-1]]), axis=0)
    r = shell.rim(t)
    r = np.concatenate([r, r[:, ::-1]])
    on = np.zeros(count, bool)
    on[r.ravel()] = True
    return mean_over(e, count), mean_over(r, count), on


def mean_over(pairs, count):
    """Function that gives the mean of the neighbours' rows; pairs (E, 2) in both directions."""
    share = 1.0 / (np.bincount(pairs[:, 0], minlength=count) + 1e-9)[:, None]

    def mean(a):
        columns = [np.bincount(pairs[:, 0], a[pairs[:, 1], k], minlength=count) for k in range(a.shape[1])]
        return np.stack(columns, -1) * share

    return mean


def settle(v, t, field, level, passes=12):
    """Vertices evenly spaced on the surface field = 0, those of the rim on the curve level = 0 in it."""
    around, along, on = neighbours(t, len(v))
    for _ in range(passes):
        v = v + 0.5 * (np.where(on[:, None], along(v), around(v)) - v)
        for _ in range(2):
            n = sdf.gradient(field, v)
            v = v - np.clip(field(v), -0.01, 0.01)[:, None] * n
            p, n = v[on], n[on]
            here = level(p)
            g = np.stack([level(p + 1e-4 * e) - here for e in np.eye(3)], -1) / 1e-4
            g = g - (g * n).sum(1, keepdims=True) * n  # within the cloth
            move = -here[:, None] * g / ((g * g).sum(1, keepdims=True) + 1e-3)
            v[on] = p + np.clip(move, -0.01, 0.01)
    return v


def bind(hung, cut, t, wide_m=0.03, passes=40):
    """The hung cloth with the ruffles of its borders ironed out, over wide_m from the edge.

    What hanging moved is smoothed, not the shape: the curve of the cut stays.
    """
    around, along, on = neighbours(t, len(hung))
    moved = hung - cut
    even = moved
    for _ in range(passes):
        even = even + 0.6 * (np.where(on[:, None], along(even), around(even)) - even)
    rim = cut[on]
    far = np.array([np.sqrt(((rim - p) ** 2).sum(1).min()) for p in cut])
    share = np.clip(1.0 - far / wide_m, 0, 1)[:, None]
    share = share * share * (3 - 2 * share)
    return cut + moved + share * (even - moved)


def over(v, t, below, clear_m, armness, rounds=6):
    """v lifted until it clears the trunk of the garment `below` (mesh.Surface) by clear_m, without a step.

    Sleeves, where armness(pattern) is 1, do not count: the cloth would flee into the armpit.
    """
    around, _, _ = neighbours(t, len(v))
    arm = armness(below.material)
    tree = BVHTree.FromPolygons(below.v.tolist(), below.t[arm[below.t].max(1) < 0.6].tolist())
    for _ in range(rounds):
        place = np.array([tree.find_nearest(p)[0] for p in v.tolist()])
        n, _, _ = below.at(place)
        gap = v - place
        height = (gap * n).sum(1)
        beside = np.linalg.norm(gap - height[:, None] * n, axis=1) > 0.010  # over an open sleeve hole
        lift = np.where(beside, 0.0, np.maximum(clear_m - height, 0.0))[:, None]
        if lift.max() < 2e-4:
            break
        soft = lift
        for _ in range(6):
            soft = np.maximum(soft, around(soft)) * 0.5 + 0.5 * around(soft)
        push = around(around(n))
        push /= np.linalg.norm(push, axis=1, keepdims=True) + 1e-9
        v = v + np.maximum(soft, 0.6 * lift) * push
    return v


def under(v, t, above, clear_m, covered, rounds=4):
    """v pushed in until what is covered (mask) stays clear_m below the garment `above` (vertices, triangles)."""
    around, _, _ = neighbours(t, len(v))
    tree = BVHTree.FromPolygons(above[0].tolist(), above[1].tolist())
    for _ in range(rounds):
        found = [tree.find_nearest(p) for p in v.tolist()]
        place = np.array([f[0] for f in found])
        n = np.array([f[1] for f in found])
        height = ((v - place) * n).sum(1)
        near = np.linalg.norm(v - place, axis=1) < 0.06  # not the far side of the garment
        push = np.where(covered & near, np.maximum(height + clear_m, 0.0), 0.0)[:, None]
        if push.max() < 2e-4:
            break
        soft = np.where(covered[:, None], np.maximum(push, 0.7 * around(push)), 0.0)
        v = v - soft * n
    return v
