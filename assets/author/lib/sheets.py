"""Bakes a person's sheets: colour, and a normal map in the tangent frame of glTF."""

import numpy as np

from . import sdf


def read_uv(thing):
    """UVs (T, 3, 2) of a triangle mesh."""
    flat = np.empty(len(thing.data.loops) * 2)
    thing.data.uv_layers[0].data.foreach_get("uv", flat)
    return flat.reshape(-1, 3, 2)


def spots(uv, size, owner):
    """Which triangle every texel shows (-1: none) and its barycentric shares (size, size, 3)."""
    which, share = np.full((size, size), -1), np.zeros((size, size, 3))
    for i, tri in enumerate(uv):
        if owner[i] < 0:
            continue
        a = tri * [size, size] * [1, -1] + [0, size]
        lo = np.clip(np.floor(a.min(0) - 1.5).astype(int), 0, size - 1)
        hi = np.clip(np.ceil(a.max(0) + 1.5).astype(int), 0, size)
        gx, gy = np.meshgrid(np.arange(lo[0], hi[0]) + 0.5, np.arange(lo[1], hi[1]) + 0.5)
        b, c = a[1] - a[0], a[2] - a[0]
        det = b[0] * c[1] - c[0] * b[1]
        if abs(det) < 1e-9:
            continue
        x, y = gx - a[0, 0], gy - a[0, 1]
        v, w = (c[1] * x - c[0] * y) / det, (b[0] * y - b[1] * x) / det
        edge = np.sqrt(abs(det)) + 1e-6
        inside = (v > -1.0 / edge) & (w > -1.0 / edge) & (v + w < 1 + 1.0 / edge)
        centre = (v >= 0) & (w >= 0) & (v + w <= 1)
        iy, ix = gy.astype(int), gx.astype(int)
        write = inside & ((which[iy, ix] < 0) | centre)
        iy, ix, v, w = iy[write], ix[write], v[write], w[write]
        share[iy, ix] = np.stack([1 - v - w, v, w], -1)
        which[iy, ix] = i
    return which, share


def bake(thing, uv, owner, parts, painter, size, scale):
    """Paints the sheets: (colour, normals as colour), each (size, size, 3)."""
    count = len(thing.data.vertices)
    co, no = np.empty(count * 3), np.empty(count * 3)
    thing.data.vertices.foreach_get("co", co)
    thing.data.vertices.foreach_get("normal", no)
    co, no = co.reshape(-1, 3) / scale, no.reshape(-1, 3)
    pattern = np.concatenate([p["material"] for p in parts.values()])
    index = np.array([p.vertices[:] for p in thing.data.polygons])
    which, share = spots(uv, size, owner)
    colour = np.zeros((size, size, 3))
    slope = np.zeros((size, size, 3))
    for i, (name, part) in enumerate(parts.items()):
        mine = (which >= 0) & (owner[which] == i)
        tri, s = which[mine], share[mine]
        mix = lambda a: sum(s[:, k : k + 1] * a[index[tri, k]] for k in range(3))
        p, q = mix(co), mix(pattern)
        smooth = mix(no)
        smooth /= np.linalg.norm(smooth, axis=1, keepdims=True) + 1e-9
        normal, depth = smooth, np.zeros(len(p))
        if part["fine"] is not None:
            normal, depth = coarsely(mine, p, part["fine"])
            turned = (normal * smooth).sum(1) < 0.2  # inside a turned hem
            normal[turned] = smooth[turned]
        elif "field" in part:
            normal = sdf.gradient(part["field"], p, 6e-4)
            far = (normal * smooth).sum(1) < 0.3
            normal[far] = smooth[far]
        colour[mine] = painter.colour(name, q, normal, depth)
        normal = bumped(painter, name, q, normal)
        slope[mine] = in_tangents(normal, smooth, co, uv, index, tri)
    known = which >= 0
    return spread(colour, known, 10), 0.5 + 0.5 * spread(slope, known, 10)


def coarsely(mine, p, fine):
    """Normals and depths of a dense surface, looked up at every other texel and filled between."""
    size = mine.shape[0]
    grid = np.zeros((size, size), int)
    grid[mine] = np.arange(len(p))
    some = mine.copy()
    some[1::2], some[:, 1::2] = False, False
    normal, _, depth = fine.at(p[grid[some]])
    full = np.zeros((size, size, 4))
    full[some] = np.concatenate([normal, depth[:, None]], -1)
    full = spread(full, some, 3)[mine]
    length = np.linalg.norm(full[:, :3], axis=1, keepdims=True)
    return full[:, :3] / (length + 1e-9), full[:, 3]


def bumped(painter, name, q, normal):
    """The normal with the slopes of what is sewn or drawn on."""
    if name == "locks":  # pattern coordinates are not metres
        return normal
    h = 6e-4
    here = painter.relief(name, q)
    g = np.stack([painter.relief(name, q + h * e) - here for e in np.eye(3)], -1) / h
    g = np.clip(g, -1.2, 1.2)
    g = g - (g * normal).sum(1, keepdims=True) * normal
    out = normal - g
    return out / np.linalg.norm(out, axis=1, keepdims=True)


def in_tangents(normal, smooth, co, uv, index, tri):
    """Components along the sheet's u, its v (upwards) and the smooth normal."""
    a, b, c = (co[index[tri, k]] for k in range(3))
    d1, d2 = uv[tri, 1] - uv[tri, 0], uv[tri, 2] - uv[tri, 0]
    area = d1[:, 0] * d2[:, 1] - d2[:, 0] * d1[:, 1]
    area = np.where(np.abs(area) < 1e-12, 1e-12, area)[:, None]
    along_u = ((b - a) * d2[:, 1:] - (c - a) * d1[:, 1:]) / area
    along_v = ((c - a) * d1[:, :1] - (b - a) * d2[:, :1]) / area
    flat = along_u - smooth * (smooth * along_u).sum(1, keepdims=True)
    x = flat / (np.linalg.norm(flat, axis=1, keepdims=True) + 1e-12)
    y = np.cross(smooth, x)
    y *= np.sign((y * along_v).sum(1, keepdims=True) + 1e-12)
    out = np.stack([(normal * x).sum(1), (normal * y).sum(1), (normal * smooth).sum(1)], -1)
    out[:, 2] = np.maximum(out[:, 2], 0.15)
    return out / np.linalg.norm(out, axis=1, keepdims=True)


def spread(sheet, known, times):
    """Grows painted areas outwards so that filtering never meets bare sheet."""
    sheet, known = sheet.copy(), known.copy()
    for _ in range(times):
        total, count = np.zeros_like(sheet), np.zeros(known.shape)
        for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            k = np.roll(known, (dy, dx), (0, 1))
            total += np.roll(sheet, (dy, dx), (0, 1)) * k[..., None]
            count += k
        new = ~known & (count > 0)
        sheet[new] = total[new] / count[new][:, None]
        known |= new
    sheet[~known] = sheet[known].mean(0)
    return sheet
