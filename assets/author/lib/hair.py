"""Hair: a close cap on the skull, and locks that grow from it as ridged ribbons.

Everything in the head's frame (head.py). A lock is a strip of `SEGMENTS` quads on either side of a
ridge; its material coordinates are (across -1..1, along 0..1, number), by which it is painted.
"""

from dataclasses import dataclass

import numpy as np

from . import head, sdf
from .body import mirrored
from .noise import lattice, step

SEGMENTS = 5
KINDS = 10  # differently painted locks


@dataclass
class Style:
    """A cut of hair; lengths in metres."""

    length: tuple = (0.045, 0.020)  # on top, at the sides
    locks: int = 150
    width: float = 0.016
    lift: float = 0.006  # height of the locks over the skull
    low: float = -0.055  # how far down the nape hair grows
    comb: str = "forward"  # forward, side, back, down, bun, tail or curl
    wave: float = 0.0  # metres of curl
    cap: float = 0.006  # thickness of the cap
    hang: float = 0.0  # how much gravity bends the locks
    front: float = 0.070  # height of the hairline over the eyes
    aside: bool = False  # whether the fringe is kept off the face


CUTS = {
    "short": Style(comb="side", locks=170),
    "forward": Style(length=(0.040, 0.016), width=0.013, locks=190),
    "crop": Style(length=(0.010, 0.008), locks=150, width=0.009, lift=0.002, cap=0.0035),
    "back": Style(length=(0.060, 0.028), comb="back", lift=0.009, front=0.076),
    "bob": Style(length=(0.185, 0.150), comb="down", locks=120, width=0.026, lift=0.007, hang=1.0, low=-0.075),
    "long": Style(length=(0.27, 0.25), comb="down", locks=130, width=0.028, lift=0.007, hang=1.0, low=-0.080, wave=0.004, aside=True),
    "bun": Style(length=(0.10, 0.085), comb="bun", locks=110, width=0.020, lift=0.004, front=0.074),
    "tail": Style(length=(0.10, 0.085), comb="tail", locks=110, width=0.020, lift=0.004, front=0.072),
    "curls": Style(length=(0.045, 0.040), comb="curl", locks=230, width=0.014, lift=0.010, wave=0.011, cap=0.012),
    "ring": Style(length=(0.022, 0.022), comb="down", locks=70, width=0.013, lift=0.003, cap=0.003),
}
KNOT = np.array([-0.122, 0.0, 0.026])


def hairline(person, f):
    """Positive where hair grows."""
    s = CUTS[person.hair]
    m = mirrored(f)
    x, y, z = f[:, 0], m[:, 1], f[:, 2]
    temple = 0.012 * np.exp(-(((y - 0.052) / 0.014) ** 2)) * (0.4 if person.female else 1.0)
    recede = 0.020 * person.age * np.exp(-(((y - 0.040) / 0.02) ** 2)) * (0 if person.female else 1)
    front = z - (s.front - 3.2 * y**2) - temple - recede
    # The side: back along the temple, down before the ear, over it and behind it to the nape.
    burns = -0.010 if person.female else -0.022
    edge = np.interp(
        x,
        [-0.13, -0.036, -0.033, -0.022, -0.006, 0.004, 0.006, 0.015, 0.018, 0.040],
        [s.low, s.low + 0.004, -0.020, 0.020, 0.028, 0.022, burns, burns, 0.016, 0.030],
    )
    grows = np.minimum(np.where(x > 0.030, front, 1.0), z - edge)
    if person.hair == "ring":
        grows = np.minimum(grows, 0.036 - z + 0.25 * (-x).clip(-0.02, 0.1))
    return grows


def cap(person, q):
    """The close cap: its edge is ragged and thin, so that it reads as a hairline."""
    f, k = head.face_frame(person, q)
    s = CUTS[person.hair]
    grows = hairline(person, f)
    ragged = 0.005 * (lattice(f * 110.0, person.seed + 8) - 0.5)
    thick = s.cap * step(-0.002, 0.018, grows) + 0.0006
    if person.head_wear != "none":
        thick = np.minimum(thick, 0.004)
    lump = 0.35 * s.cap * (lattice(f * 55.0, person.seed) - 0.5)
    d = head.skull(person, f) - thick - lump * step(0.0, 0.02, grows)
    neck = sdf.capsule(f, (-0.034, 0, -0.235), (-0.012, 0, -0.050), 0.0600, 0.0560)
    d = sdf.union(d, neck - thick, 0.018)
    return sdf.common(d, -grows + ragged, 0.0015) * k


def locks(person):
    """(vertices in the body's unit frame, triangles, material coordinates)."""
    style = CUTS[person.hair]
    rng = np.random.default_rng(person.seed + 300)
    worn = person.head_wear != "none"
    count = int(style.locks * 2.6)
    i = np.arange(count) + 0.5
    polar, turn = np.arccos(1 - 1.62 * i / count), i * np.pi * (1 + 5**0.5)
    way = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], -1)
    root = onto(person, np.array([-0.012, 0, 0.02]) + 0.10 * way, 0.001)
    root = root[hairline(person, root) > 0.003]
    if worn:  # only what shows below the brim
        root = root[root[:, 2] < 0.048]
    root = root[rng.permutation(len(root))[: style.locks // (2 if worn else 1)]]
    order = np.argsort(root[:, 2])  # low ones first: upper ones lie over them
    v, t, material = [], [], []
    for number, p in enumerate(root[order]):
        add(person, style, p, number, rng, v, t, material)
    if style.comb in ("bun", "tail"):
        gathered(person, style, rng, v, t, material)
    v = np.concatenate(v)
    return head.from_face(person, v), np.concatenate(t), np.concatenate(material)


def onto(person, p, height):
    """Points moved to a height over the skull and neck."""
    field = lambda x: np.minimum(
        head.skull(person, x), sdf.capsule(x, (-0.034, 0, -0.25), (-0.012, 0, -0.050), 0.060, 0.0555)
    )
    for _ in range(4):
        d = field(p)
        p = p - (d - height)[:, None] * sdf.gradient(field, p)
    return p


def combed(style, p, normal, rng):
    """Unit direction in which hair lies at p."""
    side = np.sign(p[1]) if abs(p[1]) > 0.004 else 1.0
    if style.comb in ("bun", "tail"):
        d = KNOT - p
    elif style.comb == "back":
        d = np.array([-1.0, 0.15 * side, 0.10])
    elif style.comb == "side":  # parted on the left
        d = np.array([0.35, -1.0 if p[1] < 0.032 else 0.9, 0.0]) if p[2] > 0.06 else np.array([-0.35, 0.0, -1.0])
    elif style.comb == "down":
        out = np.array([p[0] + 0.02, p[1], 0.0])
        d = out / (np.linalg.norm(out) + 1e-3) * 0.8 + [-0.25, 0, -1.0 if p[2] < 0.09 else -0.2]
        if p[0] > 0.03:  # off the face
            d = d * [0.2, 1, 1] + [0, 0.9 * side, 0]
    elif style.comb == "curl":
        d = rng.standard_normal(3)
    else:
        d = np.array([0.9, 0.25 * side, -0.15]) if p[2] > 0.05 else np.array([-0.15, 0, -1.0])
    d = d + 0.22 * rng.standard_normal(3)
    d = d - (d @ normal) * normal
    return d / (np.linalg.norm(d) + 1e-9)


def add(person, style, root, number, rng, v, t, material):
    """One lock from its root."""
    field = lambda x: head.skull(person, x)
    high = step(0.03, 0.085, root[2])
    length = (style.length[1] + (style.length[0] - style.length[1]) * high) * rng.uniform(0.8, 1.15)
    width = style.width * rng.uniform(0.75, 1.25)
    phase = rng.uniform(0, 6.3)
    p = root[None]
    normal = sdf.gradient(field, p)[0]
    d = combed(style, root, normal, rng)
    points, ups = [], []
    lift = style.lift * rng.uniform(0.7, 1.2) * (0.5 if person.head_wear != "none" else 1.0)
    for k in range(SEGMENTS + 1):
        s = k / SEGMENTS
        points.append(p[0] + normal * style.wave * np.sin(phase + 5.0 * s))
        ups.append(normal)
        p = p + length / SEGMENTS * d
        fall = style.hang * (0.5 if s < 0.3 else 1.4)
        if style.aside and p[0, 0] > 0.025:  # a fringe is combed aside before it falls
            fall *= step(0.055, 0.025, p[0, 0])
            d = unit3(d + [-0.6, 1.4 if p[0, 1] > 0 else -1.4, 0.0])
        d = d + fall * np.array([0, 0, -1.0])
        if style.comb in ("bun", "tail"):
            to = KNOT - p[0]
            d = d + 1.5 * to / (np.linalg.norm(to) + 0.01)
        target = lift * np.sin(np.pi * min(0.25 + 0.6 * s, 0.8)) + 0.0015
        if style.hang:
            target = style.lift * (0.6 + 0.6 * s) + 0.002
            p = np.where(onto_needed(person, p, target), onto(person, p, target), p)
        else:
            p = onto(person, p, target * (1.0 if s < 0.7 else 0.75))
        normal = sdf.gradient(field, p)[0]
        if style.hang and p[0, 2] < -0.02:
            normal = unit3(np.array([p[0, 0] + 0.02, p[0, 1], 0.0]))
        d = unit3(d - 0.9 * (d @ normal) * normal)
    ribbon(points, ups, width, number, v, t, material)


def onto_needed(person, p, height):
    """Whether a hanging lock has sunk into head or neck."""
    d = np.minimum(
        head.skull(person, p), sdf.capsule(p, (-0.034, 0, -0.25), (-0.012, 0, -0.050), 0.066, 0.062)
    )
    return ((d < height) | (p[:, 2] > -0.01))[:, None]


def unit3(x):
    return x / (np.linalg.norm(x) + 1e-9)


def ribbon(points, ups, width, number, v, t, material):
    """Left edge, ridge and right edge along a line; narrow at the root, pointed at the tip."""
    points, ups = np.array(points), np.array(ups)
    n = len(points)
    s = np.linspace(0, 1, n)
    along = np.gradient(points, axis=0)
    side = np.cross(ups, along)
    side /= np.linalg.norm(side, axis=1, keepdims=True) + 1e-9
    w = width * np.interp(s, [0, 0.25, 0.7, 1.0], [0.55, 1.0, 0.85, 0.12])[:, None] / 2
    ridge = points + 0.30 * w * ups
    base = sum(len(x) for x in v)
    v.append(np.concatenate([points + side * w - 0.25 * w * ups, ridge, points - side * w - 0.25 * w * ups]))
    across = np.repeat([-1.0, 0.0, 1.0], n)
    material.append(np.stack([across, np.tile(s, 3), np.full(3 * n, float(number))], -1))
    tri = []
    for k in range(n - 1):
        for a in (0, n):
            i, j = base + a + k, base + a + n + k
            tri += [(i, j + 1, i + 1), (i, j, j + 1)]
    t.append(np.array(tri))


def gathered(person, style, rng, v, t, material):
    """The knot, or the tail that falls from it."""
    for number in range(46 if style.comb == "bun" else 34):
        a, b = rng.uniform(0, 2 * np.pi), rng.uniform(-1, 1)
        if style.comb == "bun":
            r = np.array([0.026, 0.032, 0.032])
            turn = a + np.linspace(0, 2.2, SEGMENTS + 1)
            tilt = b * 1.2
            ring = np.stack([np.sin(tilt) + 0 * turn, np.cos(tilt) * np.cos(turn), np.cos(tilt) * np.sin(turn)], -1)
            points, ups = KNOT + [-0.012, 0, 0] + ring * r, ring
        else:
            s = np.linspace(0, 1, SEGMENTS + 1)[:, None]
            out = np.array([0.4 * np.cos(a), np.sin(a), 0.0]) * 0.022
            fall = np.array([-0.045, 0, 0.0]) * np.sin(np.pi * np.minimum(s * 1.2, 0.5)) + [0, 0, -0.17] * s**1.3
            points = KNOT + fall + out * np.sin(np.pi * (0.12 + 0.8 * s)) + 0.004 * b
            ups = np.tile(unit3(out + [-0.003, 0, 0]), (SEGMENTS + 1, 1))
        ribbon(points, ups, 0.020, 500 + number, v, t, material)
