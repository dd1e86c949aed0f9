"""Open triangle meshes: cutting along a level line, even spacing, turned hems."""

import numpy as np


def triangulate(quads):
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def compact(v, t):
    """Drops vertices that no triangle uses; returns (vertices, triangles, kept indices)."""
    used = np.unique(t)
    index = np.full(len(v), -1)
    index[used] = np.arange(len(used))
    return v[used], index[t], used


def cut(v, t, level, snap_m=0.004):
    """Keeps where level(v) < 0; vertices near the line are moved onto it, so that no slivers arise."""
    h = level(v)
    g = np.stack([level(v + 1e-4 * e) - level(v - 1e-4 * e) for e in np.eye(3)], -1) / 2e-4
    near = np.abs(h) < snap_m
    move = -h[:, None] * g / ((g * g).sum(1, keepdims=True) + 1e-9)
    v = np.where(near[:, None], v + move, v)
    h = np.where(near, 0.0, h)
    inside = h[t] < 0
    whole = np.all(h[t] <= 0, 1) & inside.any(1)
    mixed = inside.any(1) & (h[t] > 0).any(1)
    out, extra, made = [t[whole]], [], {}

    def crossing(a, b):
        key = (min(a, b), max(a, b))
        if key not in made:
            s = h[key[0]] / (h[key[0]] - h[key[1]])
            made[key] = len(v) + len(extra)
            extra.append(v[key[0]] + s * (v[key[1]] - v[key[0]]))
        return made[key]

    pieces = []
    for tri in t[mixed]:
        ring = []
        for i in range(3):
            a, b = int(tri[i]), int(tri[(i + 1) % 3])
            if h[a] <= 0:
                ring.append(a)
            if h[a] * h[b] < 0:
                ring.append(crossing(a, b))
        pieces += [(ring[0], ring[i], ring[i + 1]) for i in range(1, len(ring) - 1)]
    if extra:
        v = np.concatenate([v, np.array(extra)])
    if pieces:
        out.append(np.array(pieces))
    v, t, _ = compact(v, np.concatenate(out))
    return v, t


def largest(v, t):
    """The piece of the mesh with most triangles."""
    label = np.arange(len(v))
    while True:
        low = label[t].min(1)
        new = label.copy()
        for i in range(3):
            np.minimum.at(new, t[:, i], low)
        new = new[new]
        if np.array_equal(new, label):
            break
        label = new
    count = np.bincount(label[t[:, 0]])
    v, t, _ = compact(v, t[label[t[:, 0]] == count.argmax()])
    return v, t


def rim(t):
    """Directed boundary edges (B, 2): the surface lies to their left."""
    e = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    key = np.sort(e, 1)
    _, inverse, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    return e[count[inverse] == 1]


def even(v, t, passes=4):
    """Moves inner vertices towards the mean of their neighbours along the surface."""
    e = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    e = np.unique(np.concatenate([e, e[:, ::-1]]), axis=0)
    count = np.bincount(e[:, 0], minlength=len(v))[:, None] + 1e-9
    fixed = np.zeros(len(v), bool)
    fixed[rim(t).ravel()] = True
    for _ in range(passes):
        total = np.stack(
            [np.bincount(e[:, 0], v[e[:, 1], k], minlength=len(v)) for k in range(3)], -1
        )
        n = normals(v, t)
        move = total / count - v
        move -= (move * n).sum(1, keepdims=True) * n
        v = np.where(fixed[:, None], v, v + 0.6 * move)
    return v


def normals(v, t):
    """Unit vertex normals, weighted by area."""
    face = np.cross(v[t[:, 1]] - v[t[:, 0]], v[t[:, 2]] - v[t[:, 0]])
    out = np.zeros_like(v)
    for i in range(3):
        for k in range(3):
            out[:, k] += np.bincount(t[:, i], face[:, k], minlength=len(v))
    return out / (np.linalg.norm(out, axis=1, keepdims=True) + 1e-12)


def hem(v, t, thick_m=0.004, deep_m=0.022):
    """Turns every open edge inwards, as a sewn hem; returns (vertices, triangles, parents).

    parents (V) names the vertex of the open mesh that each vertex hangs on.
    """
    edges = rim(t)
    n = normals(v, t)
    lines = np.unique(edges)
    index = np.full(len(v), -1)
    index[lines] = np.arange(len(lines))
    out = np.zeros_like(v)
    for a, b in ((0, 1), (1, 0)):
        side = np.cross(v[edges[:, 1]] - v[edges[:, 0]], n[edges[:, a]])
        np.add.at(out, edges[:, a], side)
    outward = out[lines] / (np.linalg.norm(out[lines], axis=1, keepdims=True) + 1e-12)
    inward = n[lines]
    base = v[lines]
    rings = [
        base + 0.4 * thick_m * outward - 0.5 * thick_m * inward,
        base - thick_m * inward,
        base - (thick_m + 0.002) * inward - deep_m * outward,
    ]
    parents = [np.arange(len(v))]
    vertices, triangles, before = [v], [t], lines
    for k, ring in enumerate(rings):
        start = len(v) + k * len(lines)
        now = start + np.arange(len(lines))
        a, b = index[edges[:, 0]], index[edges[:, 1]]
        # The strip beyond the edge: its triangles run against the edge's direction.
        triangles.append(np.stack([before[b], before[a], now[a]], -1))
        triangles.append(np.stack([before[b], now[a], now[b]], -1))
        vertices.append(ring)
        parents.append(lines)
        before = now
    return np.concatenate(vertices), np.concatenate(triangles), np.concatenate(parents)
