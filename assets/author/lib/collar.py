"""Collars, lapels and hoods: ribbons sewn along the neckline of a hung garment."""

import numpy as np

from . import shell
from .noise import ridged

AROUND = 72


def neckline(v, t):
    """The rim round the neck as an even closed loop (AROUND, 3) that begins in front."""
    edges = shell.rim(t)
    following = {int(a): int(b) for a, b in edges}
    loops = []
    while following:
        start = at = next(iter(following))
        loop = []
        while at in following:
            loop.append(at)
            at = following.pop(at)
        loops.append(loop)
    loops = [x for x in loops if len(x) > 12]
    loop = max(loops, key=lambda x: v[x, 2].mean())
    p = v[loop]
    begin = np.argmin(p[:, 2] - 0.4 * p[:, 0])  # the lowest place in front
    p = np.roll(p, -begin, 0)
    for _ in range(3):
        p = 0.5 * p + 0.25 * (np.roll(p, 1, 0) + np.roll(p, -1, 0))
    p = np.concatenate([p, p[:1]])
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    at = np.linspace(0, s[-1], AROUND, endpoint=False)
    return np.stack([np.interp(at, s, p[:, k]) for k in range(3)], -1), s[-1]


def widths(kind, far, whole):
    """(height of the stand, width of the leaf, padding) at arc lengths `far` from the front."""
    half = whole / 2
    s = far / half  # 0 in front, 1 at the back
    one = np.ones_like(s)
    if kind == "crew":
        return 0.012 * one, 0.0 * one, 0.0 * one
    if kind == "stand":
        return 0.030 + 0.006 * s, 0.0 * one, 0.0 * one
    if kind == "fold":
        return 0.012 + 0.014 * s, np.interp(far, [0.0, 0.008, 0.020, 0.09, 0.2], [0.0, 0.0, 0.062, 0.046, 0.042]), 0.0 * one
    if kind == "hood":
        return 0.010 + 0.012 * s, np.interp(s, [0, 0.25, 0.6, 1.0], [0.030, 0.050, 0.085, 0.135]), np.interp(s, [0, 0.4, 1.0], [0.006, 0.012, 0.026])
    # lapel: widest below the notch
    tip = 0.56
    leaf = np.interp(s, [0, 0.04, 0.25, tip - 0.10, tip - 0.02, tip, tip + 0.05, 0.8, 1.0], [0.0, 0.012, 0.046, 0.078, 0.090, 0.030, 0.052, 0.050, 0.048])
    return np.interp(s, [0, 0.55, 0.75, 1.0], [0.0, 0.002, 0.014, 0.022]), leaf, 0.0 * one


def make(tailor, fine):
    """(vertices, triangles) of the collar on the hung garment `fine` (mesh.Surface)."""
    kind = tailor.cut.collar
    p, whole = neckline(fine.v, fine.t)
    arc = np.arange(AROUND) * whole / AROUND
    far = np.minimum(arc, whole - arc)
    stand, leaf, pad = widths(kind, far, whole)
    n, _, _ = fine.at(p)
    along = np.roll(p, -1, 0) - np.roll(p, 1, 0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    away = np.cross(along, n)  # over the cloth, away from the opening
    middle = np.array([-0.01, 0, 1.47])
    radial = (p - middle) * [1, 1, 0]
    radial /= np.linalg.norm(radial, axis=1, keepdims=True) + 1e-9
    sign = np.sign((away * radial).sum(1).mean())
    away = away * sign
    up = np.array([0.16, 0, 1.0])
    up = up / np.linalg.norm(up)
    crest = p + stand[:, None] * up - 0.10 * stand[:, None] * radial
    rows = [p - 0.005 * n + 0.004 * away - 0.004 * up * (stand[:, None] > 0.004), p - 0.003 * n - 0.001 * away]
    if kind in ("crew", "stand"):
        rows += [crest - 0.003 * radial, crest + 0.0022 * up, crest + 0.004 * radial]
        rows += [p + 0.004 * n + 0.001 * away, p + 0.003 * n + 0.010 * away, p - 0.001 * n + 0.012 * away]
    else:
        rows += [crest - 0.0025 * radial, crest + 0.003 * up + 0.001 * radial, crest + 0.006 * n + 0.001 * radial]
        for share in (0.2, 0.4, 0.6, 0.8, 0.95, 1.0):
            reach = np.maximum(leaf, 0.002)[:, None] * share
            foot = p + away * reach
            place = np.array([fine.tree.find_nearest(x)[0] for x in foot.tolist()])
            normal, _, _ = fine.at(foot)
            puff = 0.0045 + pad * np.sin(np.pi * share) + 0.35 * stand * max(0.0, 1 - 2.2 * share)
            wobble = 0.012 * (kind == "hood") * (ridged(foot * (13.0, 13.0, 34.0), 3) - 0.6) * np.sin(np.pi * min(share, 0.9))
            rows.append(place + (puff + wobble)[:, None] * normal)
        rows.append(rows[-1] - 0.0035 * normal)
    v = np.concatenate(rows)
    t = []
    for r in range(len(rows) - 1):
        for k in range(AROUND):
            a, b = r * AROUND + k, r * AROUND + (k + 1) % AROUND
            c, d = a + AROUND, b + AROUND
            t += [(a, b, d), (a, d, c)]
    t = np.array(t)
    face = np.cross(v[t[:, 1]] - v[t[:, 0]], v[t[:, 2]] - v[t[:, 0]])
    outer = t[:, 0] >= 4 * AROUND
    facing = (face[outer] * (v[t[outer, 0]] - [-0.01, 0, 1.40])).sum()
    return v, (t if facing > 0 else t[:, ::-1])
