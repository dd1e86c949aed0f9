"""Signed distance fields and their surfaces: negative inside, metres, points as (N, 3) arrays."""

import numpy as np


def union(a, b, k):
    """Union with a fillet of about k metres (polynomial smooth minimum)."""
    h = np.clip(0.5 + 0.5 * (b - a) / k, 0.0, 1.0)
    return b * (1.0 - h) + a * h - k * h * (1.0 - h)


def cut(a, b, k):
    """Removes solid b from solid a with a rounded edge of about k metres."""
    return -union(-a, b, k)


def common(a, b, k):
    """Intersection with a rounded edge of about k metres."""
    return -union(-a, -b, k)


def capsule(p, a, b, ra, rb, squash=None):
    """Round cone from a (radius ra) to b (radius rb); squash (3) scales space around the axis."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    pa, ba = p - a, b - a
    t = np.clip(pa @ ba / (ba @ ba), 0.0, 1.0)
    d = pa - t[:, None] * ba
    if squash is not None:
        d = d / np.asarray(squash)
    return np.sqrt((d * d).sum(1)) - (ra + (rb - ra) * t)


def tube(p, points, radii, k, squash=None):
    """Smoothly joined round cones through points with radii."""
    out = capsule(p, points[0], points[1], radii[0], radii[1], squash)
    for i in range(1, len(points) - 1):
        part = capsule(p, points[i], points[i + 1], radii[i], radii[i + 1], squash)
        out = union(out, part, k)
    return out


def ellipsoid(p, centre, radii):
    """Ellipsoid with half axes radii; distance is exact at the surface to first order."""
    q = (p - np.asarray(centre, float)) / np.asarray(radii, float)
    k0 = np.sqrt((q * q).sum(1)) + 1e-9
    q = q / np.asarray(radii, float)
    k1 = np.sqrt((q * q).sum(1)) + 1e-9
    return k0 * (k0 - 1.0) / k1


def box(p, centre, half, radius):
    """Box with half extents `half` and edges rounded by radius."""
    q = np.abs(p - np.asarray(centre, float)) - (np.asarray(half, float) - radius)
    outside = np.sqrt((np.maximum(q, 0.0) ** 2).sum(1))
    return outside + np.minimum(q.max(1), 0.0) - radius


def loft(p, rows, power=2.3):
    """Upright body from rows of (z, x of centre, half width y, depth forward, depth back)."""
    rows = np.asarray(rows, float)
    z = np.linspace(rows[0, 0], rows[-1, 0], 200)
    kernel = np.hanning(19)
    kernel /= kernel.sum()
    table = []
    for column in rows.T[1:]:
        line = np.interp(z, rows[:, 0], column)
        padded = np.pad(line, 9, mode="edge")
        table.append(np.interp(p[:, 2], z, np.convolve(padded, kernel, "valid")))
    centre, width, front, back = table
    x = p[:, 0] - centre
    depth = np.where(x > 0, front, back)
    q = (np.abs(p[:, 1] / width) ** power + np.abs(x / depth) ** power) ** (1.0 / power)
    side = (q - 1.0) * np.minimum(width, depth)
    caps = np.maximum(rows[0, 0] - p[:, 2], p[:, 2] - rows[-1, 0])
    return common(side, caps, 0.03)


def grid(field, lo, hi, step):
    """Samples field on a grid, finely only near its surface; returns (values, origin, step)."""
    lo, hi = np.asarray(lo, float), np.asarray(hi, float)
    coarse = 4
    cells = np.ceil((hi - lo) / (coarse * step)).astype(int)
    axes = [lo[i] + coarse * step * np.arange(cells[i] + 1) for i in range(3)]
    p = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    values = field(p).reshape(cells + 1)
    for axis in range(3):
        values = _between(values, axis, coarse)
    near = np.nonzero(np.abs(values) < 1.6 * coarse * step)
    values[near] = field(lo + step * np.stack(near, -1))
    return values, lo, step


def _between(values, axis, times):
    """Linear interpolation along one axis, `times` as fine."""
    v = np.moveaxis(values, axis, 0)
    out = np.empty((times * (len(v) - 1) + 1, *v.shape[1:]))
    for k in range(times):
        t = k / times
        out[k:-1:times] = v[:-1] * (1 - t) + v[1:] * t
    out[-1] = v[-1]
    return np.moveaxis(out, 0, axis)


def sample(sampled, p, outside=0.2):
    """Trilinear look-up of a grid() result; `outside` beyond its box."""
    values, origin, step = sampled
    q = (p - origin) / step
    cell = np.floor(q).astype(int)
    inside = np.all((cell >= 0) & (cell < np.array(values.shape) - 1), axis=1)
    out = np.full(len(p), outside)
    c, t = cell[inside], (q - cell)[inside]
    total = np.zeros(len(c))
    for corner in range(8):
        o = np.array([corner & 1, corner >> 1 & 1, corner >> 2 & 1])
        w = np.prod(np.where(o == 1, t, 1.0 - t), axis=1)
        i = c + o
        total += w * values[i[:, 0], i[:, 1], i[:, 2]]
    out[inside] = total
    return out


def surface(field, lo, hi, step):
    """Mesh of the zero level by surface nets (Gibson 1998), pulled onto the surface by Newton.

    Returns (vertices (V, 3), quads (Q, 4) with outward normals, the sampled grid).
    """
    sampled = grid(field, lo, hi, step)
    f, origin, _ = sampled
    inside = f < 0.0
    shape = np.array(f.shape) - 1
    total, count = np.zeros((*shape, 3)), np.zeros(shape)
    for axis in range(3):
        others = [a for a in range(3) if a != axis]
        for da in (0, 1):
            for db in (0, 1):
                shift = np.zeros(3, int)
                shift[others[0]], shift[others[1]] = da, db
                ahead = shift.copy()
                ahead[axis] = 1
                low = tuple(slice(s, s + n) for s, n in zip(shift, shape))
                high = tuple(slice(s, s + n) for s, n in zip(ahead, shape))
                crossing = inside[low] != inside[high]
                t = np.where(crossing, f[low] / (f[low] - f[high] + 1e-30), 0.0)
                offset = np.zeros((*shape, 3))
                offset[..., others[0]], offset[..., others[1]] = da, db
                offset[..., axis] = t
                total += np.where(crossing[..., None], offset, 0.0)
                count += crossing
    active = count > 0
    index = np.full(shape, -1)
    index[active] = np.arange(active.sum())
    corner = np.stack(np.nonzero(active), -1)
    vertices = origin + step * (corner + total[active] / count[active][:, None])
    quads = []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        lo_index = [slice(None)] * 3
        hi_index = [slice(None)] * 3
        lo_index[axis], hi_index[axis] = slice(0, -1), slice(1, None)
        for other in (b, c):
            lo_index[other] = hi_index[other] = slice(1, -1)
        a0, a1 = inside[tuple(lo_index)], inside[tuple(hi_index)]
        i = np.stack(np.nonzero(a0 != a1), -1)
        flip = ~a0[tuple(i.T)]
        base = i.copy()
        base[:, b] += 1
        base[:, c] += 1
        ring = []
        for db, dc in ((1, 1), (0, 1), (0, 0), (1, 0)):
            cell = base.copy()
            cell[:, b] -= db
            cell[:, c] -= dc
            ring.append(index[tuple(cell.T)])
        quad = np.stack(ring, -1)
        quad[flip] = quad[flip][:, ::-1]
        quads.append(quad)
    for _ in range(1):
        d, n = field(vertices), gradient(field, vertices)
        vertices = vertices - np.clip(d, -step, step)[:, None] * n
    return vertices, np.concatenate(quads), sampled


def gradient(field, p, h=1e-3):
    """Unit outward normal of the field at p."""
    here = field(p)
    g = np.stack([field(p + h * e) - here for e in np.eye(3)], -1)
    return g / (np.sqrt((g * g).sum(1, keepdims=True)) + 1e-12)
