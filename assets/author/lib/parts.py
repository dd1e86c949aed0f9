"""Parts that several machines share: wheels, seats, lamps, materials."""

import math

import bmesh
import numpy as np
from mathutils import Vector

from . import labels, surfaces
from .solid import around


def materials(m, name, number, colour, second=(0.16, 0.165, 0.17), seed=1):
    """The usual materials of an industrial truck."""
    m.material("paint", surfaces.paint(colour, seed), 0.9, 0.5)
    m.material("grey_paint", surfaces.paint(second, seed + 10, (256, 256)), 0.8, 0.5)
    m.material("mast_steel", surfaces.metal((0.27, 0.27, 0.275), seed + 20, (256, 256)), 0.5, 0.6)
    m.material("steel", surfaces.metal((0.46, 0.46, 0.47), seed + 30, (256, 256), grease=0.4), 0.5, 0.5)
    m.material("rubber", surfaces.rubber(seed + 50, (128, 128)), 0.3, 0.9)
    m.material("labels", labels.sheet(name, number, colour, seed + 90), None)
    m.plain("chrome", (0.80, 0.80, 0.80), 0.12, 1.0)
    m.plain("mirror", (0.90, 0.90, 0.90), 0.05, 1.0)
    m.plain("plastic", (0.20, 0.20, 0.21), 0.5)
    m.plain("seal", (0.13, 0.13, 0.135), 0.5)
    m.plain("vinyl", (0.25, 0.245, 0.24), 0.6)
    m.plain("rim", (0.78, 0.77, 0.73), 0.5)
    m.plain("amber", (0.95, 0.52, 0.08), 0.15)
    m.plain("lens", (0.94, 0.94, 0.92), 0.06)
    m.plain("red", (0.66, 0.06, 0.05), 0.12)
    m.plain("belt", (0.80, 0.36, 0.08), 0.7)


def label(m, node, which, centre, right, up):
    """A label of the sheet, right and up in metres."""
    m.decal(node, "labels", centre, right, up, labels.RECTS[which], labels.SHEET)


def wheel(m, node, radius, width, outward, lugs=24, hub=0.55, bolts=8):
    """Wheel about the node's origin, axle along y; outward is +1 or -1 for the disc's side."""
    c = m.at[node]
    w, r = width / 2, radius
    shoulder = 0.022 if lugs else 0.012
    tyre = [
        (-w + 0.03, hub * r),
        (-w + 0.008, hub * r + 0.02),
        (-w, 0.80 * r),
        (-w + shoulder, 0.97 * r),
        (-w + 2.2 * shoulder, r),
        (w - 2.2 * shoulder, r),
        (w - shoulder, 0.97 * r),
        (w, 0.80 * r),
        (w - 0.008, hub * r + 0.02),
        (w - 0.03, hub * r),
    ]
    if lugs:
        tyre = [(a, b if b < 0.9 * r else b - 0.014) for a, b in tyre]
    m.lathe(node, "rubber", c, (0, 1, 0), tyre, 40)
    for i in range(lugs):
        for side in (-1, 1):
            turn = 360.0 * (i + (0.5 if side > 0 else 0.0)) / lugs
            rotate = around("Y", turn) @ around("Z", 16 * side)
            at = around("Y", turn) @ Vector((0, side * w * 0.47, r - 0.014))
            m.box(
                node,
                "rubber",
                np.array(c) + np.array(at),
                (2 * np.pi * r / lugs * 0.52, w * 0.90, 0.028),
                0.0,
                rotate,
            )
    face = outward * (w - 0.035)
    dish = [
        (outward * (w - 0.028), hub * r),
        (outward * (w - 0.03), hub * r - 0.012),
        (face, 0.45 * r),
        (face - outward * 0.03, 0.34 * r),
        (face - outward * 0.02, 0.26 * r),
        (face + outward * 0.012, 0.24 * r),
        (face + outward * 0.03, 0.12 * r),
        (face + outward * 0.03, 0.0),
    ]
    back = [
        (-outward * (w - 0.03), hub * r),
        (-outward * (w - 0.05), 0.3 * r),
        (-outward * (w - 0.05), 0.0),
    ]
    for profile in (dish, back):
        m.lathe(node, "rim", c, (0, 1, 0), profile, 28)
    for i in range(bolts):
        a = 2 * np.pi * i / bolts
        p = np.array(c) + [0.31 * r * np.cos(a), face - outward * 0.03, 0.31 * r * np.sin(a)]
        m.bar(node, "steel", p, p + [0, outward * 0.024, 0], 0.011, 6)


def seat(m, node, x, y, z, scale=1.0):
    """Operator's seat: cushion, back, side bolsters, belt; (x, y, z) is the middle of the base."""
    s = scale
    m.box(node, "plastic", (x, y, z + 0.04 * s), (0.44 * s, 0.46 * s, 0.08 * s), 0.015)
    m.box(
        node,
        "vinyl",
        (x + 0.01, y, z + 0.12 * s),
        (0.48 * s, 0.48 * s, 0.12 * s),
        0.045,
        around("Y", -5),
        4,
    )
    m.box(
        node,
        "vinyl",
        (x - 0.27 * s, y, z + 0.42 * s),
        (0.12 * s, 0.46 * s, 0.56 * s),
        0.05,
        around("Y", -12),
        4,
    )
    for side in (-1, 1):
        m.box(
            node,
            "vinyl",
            (x - 0.22 * s, y + side * 0.20 * s, z + 0.40 * s),
            (0.12 * s, 0.08 * s, 0.44 * s),
            0.03,
            around("Y", -12),
            3,
        )
        m.box(
            node,
            "plastic",
            (x - 0.02 * s, y + side * 0.29 * s, z + 0.28 * s),
            (0.30 * s, 0.06 * s, 0.05 * s),
            0.02,
        )
        m.box(
            node,
            "plastic",
            (x - 0.12 * s, y + side * 0.29 * s, z + 0.16 * s),
            (0.05 * s, 0.04 * s, 0.22 * s),
            0.01,
        )
    m.box(node, "red", (x + 0.02, y - 0.245 * s, z + 0.12 * s), (0.05, 0.03, 0.07), 0.005)


def steering_wheel(m, node, centre, axis, radius=0.18):
    """Rim, three spokes, knob and column."""
    axis = Vector(axis).normalized()
    side = Vector((0, 1, 0))
    other = axis.cross(side).normalized()
    c = Vector(centre)
    ring = [
        c + radius * (math.cos(t) * side + math.sin(t) * other)
        for t in np.linspace(0, 2 * np.pi, 25)
    ]
    m.pipe(node, "plastic", ring, 0.014, 8, False)
    for a in (0.5, 0.5 + 2.1, 0.5 + 4.2):
        m.bar(
            node,
            "plastic",
            c - 0.02 * axis,
            c + radius * (math.cos(a) * side + math.sin(a) * other),
            0.010,
            6,
        )
    m.lathe(node, "plastic", c - 0.03 * axis, axis, [(0, 0.05), (0.03, 0.045), (0.04, 0.0)], 16)
    knob = c + radius * (math.cos(1.2) * side + math.sin(1.2) * other)
    m.lathe(
        node, "plastic", knob, axis, [(0, 0.012), (0.02, 0.022), (0.045, 0.020), (0.055, 0.0)], 12
    )
    m.bar(node, "plastic", c - 0.03 * axis, c - 0.42 * axis, 0.035, 12)


def lamp(m, node, centre, forward, radius=0.06, glass="lens"):
    """Round work lamp looking along `forward`: housing, bright bowl, lens within, rim."""
    r = radius
    housing = [(-0.075, 0.0), (-0.075, 0.40 * r), (-0.05, 0.78 * r), (-0.02, r), (0.012, 1.06 * r), (0.020, 1.03 * r), (0.020, 0.93 * r)]
    m.lathe(node, "plastic", centre, forward, housing, 24)
    m.lathe(node, "chrome", centre, forward, [(0.018, 0.93 * r), (0.004, 0.80 * r), (-0.016, 0.45 * r)], 24)
    m.lathe(node, glass, centre, forward, [(-0.016, 0.46 * r), (-0.004, 0.40 * r), (0.004, 0.22 * r), (0.006, 0.0)], 20)


def mirror(m, node, centre, size=(0.07, 0.19, 0.14), back=-1):
    """A rear-view mirror: shell, rim and glass that looks backwards."""
    x, y, z = centre
    egg(m, node, "seal", centre, size, 3.2, cut=0.45 * back if back < 0 else None)
    egg(m, node, "mirror", (x + back * 0.27 * size[0], y, z), (0.010, 0.86 * size[1], 0.84 * size[2]), 4.5)


def egg(m, n, material, centre, size, power=2.6, rings=11, sides=16, cut=None):
    """A rounded box: a superellipsoid; cut flattens it behind x = cut (relative, -1..1)."""
    b = bmesh.new()
    grid = []
    put = lambda v, e: np.sign(v) * np.abs(v) ** (2 / e)  # noqa: E731
    for lat in np.linspace(-np.pi / 2, np.pi / 2, rings):
        row = []
        for lon in np.linspace(0, 2 * np.pi, sides, endpoint=False):
            x = put(np.cos(lat), power) * put(np.cos(lon), power)
            y = put(np.cos(lat), power) * put(np.sin(lon), power)
            z = put(np.sin(lat), power)
            if cut is not None:
                x = max(x, cut)
            row.append(b.verts.new(Vector(np.array(centre) + np.array(size) / 2 * (x, y, z))))
        grid.append(row)
    for a, c in zip(grid, grid[1:]):
        for i in range(sides):
            b.faces.new([a[i], a[(i + 1) % sides], c[(i + 1) % sides], c[i]])
    bmesh.ops.remove_doubles(b, verts=b.verts, dist=1e-5)
    m.add(n, b, material)


def beacon(m, node):
    """Flashing lamp about the node's origin (its foot)."""
    c = m.at[node]
    m.lathe(node, "plastic", c, (0, 0, 1), [(0, 0.0), (0, 0.075), (0.03, 0.072), (0.035, 0.06)], 24)
    m.lathe(
        node,
        "amber",
        c,
        (0, 0, 1),
        [(0.033, 0.062), (0.06, 0.066), (0.10, 0.062), (0.13, 0.045), (0.142, 0.02), (0.145, 0.0)],
        24,
    )
    for i in range(8):
        a = np.pi * i / 4
        p = np.array(c) + [0.0645 * np.cos(a), 0.0645 * np.sin(a), 0]
        m.bar(node, "amber", p + [0, 0, 0.04], p + [0, 0, 0.105], 0.004, 4)
