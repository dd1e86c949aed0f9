"""Wheels of road vehicles: tyre with tread and lettered wall, cast rim with spokes, brake behind it."""

import bmesh
import numpy as np
from mathutils import Vector


def wheel(m, node, radius, width, outward, rim=0.665, spokes=5, sides=34, grooves=3):
    """About the node's origin, axle along y; outward (+1 or -1) is the side one sees."""
    c = np.array(m.at[node])
    w, r = width / 2, radius
    rr = rim * r
    bulge = [(-0.78, rr + 0.004), (-0.93, rr + 0.014), (-1.0, 0.5 * (rr + r) - 0.004), (-0.985, 0.78 * r + 0.22 * rr), (-0.94, 0.93 * r + 0.07 * rr), (-0.86, 0.985 * r), (-0.76, 0.9975 * r)]
    tread = []
    for g in np.linspace(-0.5, 0.5, grooves):
        tread += [(g - 0.07, 0.9995 * r), (g - 0.05, r - 0.007), (g + 0.05, r - 0.007), (g + 0.07, 0.9995 * r)]
    profile = bulge + tread + [(-a, b) for a, b in bulge[::-1]]
    m.lathe(node, "rubber", c, (0, 1, 0), [(a * w, b) for a, b in profile], sides)
    sipes(m, node, c, w, r, sides + 20)
    barrel = [(-0.80 * w, rr + 0.005), (-0.86 * w, rr + 0.012), (-0.84 * w, rr - 0.004), (-0.6 * w, rr - 0.012), (-0.3 * w, rr - 0.03), (0.55 * w, rr - 0.03), (0.75 * w, rr - 0.012), (0.86 * w, rr - 0.004), (0.885 * w, rr + 0.012), (0.84 * w, rr + 0.014)]
    m.lathe(node, "rim", c, (0, outward, 0), barrel[5:], sides)
    m.lathe(node, "disc", c, (0, outward, 0), barrel[:6], sides)
    face = outward * 0.62 * w
    for k in range(spokes):
        for twin in (-0.17, 0.17):
            spoke(m, node, c, 2 * np.pi * k / spokes + twin, twin, 0.17 * r, rr - 0.008, face, outward)
    hub = [(0.30 * w, 0.21 * r), (0.50 * w, 0.205 * r), (0.56 * w, 0.19 * r), (0.565 * w, 0.095 * r), (0.60 * w, 0.09 * r), (0.615 * w, 0.07 * r), (0.62 * w, 0.0)]
    m.lathe(node, "rim", c, (0, outward, 0), hub, 30)
    for k in range(5):
        a = 2 * np.pi * (k + 0.5) / 5
        p = c + [0.145 * r * np.cos(a), outward * 0.50 * w, 0.145 * r * np.sin(a)]
        m.bar(node, "steel", p, p + [0, outward * 0.012, 0], 0.010, 6)
    m.bar(node, "plastic", c + [(rr - 0.02) * 0.98, outward * 0.6 * w, 0], c + [(rr - 0.045) * 0.98, outward * 0.72 * w, 0], 0.004, 6)


def spoke(m, node, c, angle, twin, r0, r1, face, outward):
    """One bar of a forked spoke, crowned to the outside."""
    b = bmesh.new()
    rings = []
    for t in np.linspace(0, 1, 6):
        r = r0 + (r1 - r0) * t
        a = angle - 0.55 * twin * (1 - t)
        e, side = np.array([np.cos(a), 0, np.sin(a)]), np.array([-np.sin(a), 0, np.cos(a)])
        wide, deep = 0.021 - 0.004 * t + 0.012 * t**6, 0.030
        y = face - outward * 0.022 * (1 - (2 * t - 0.9) ** 2) * 0.7
        ring = []
        for u, d in ((-1, 1), (-0.95, 0.25), (-0.6, 0.0), (0, -0.06), (0.6, 0.0), (0.95, 0.25), (1, 1)):
            ring.append(b.verts.new(Vector(c + e * r + side * u * wide + np.array([0, y - outward * d * deep, 0]))))
        rings.append(ring)
    for p, q in zip(rings, rings[1:]):
        for i in range(len(p) - 1):
            quad = [p[i], p[i + 1], q[i + 1], q[i]]
            b.faces.new(quad if outward > 0 else quad[::-1])
    m.add(node, b, "rim")


def sipes(m, node, c, w, r, count):
    """Cuts across the shoulders of the tread, as dark notches standing in the surface."""
    b = bmesh.new()
    for k in range(count):
        a = 2 * np.pi * k / count
        for s in (-1, 1):
            ring = []
            for t, da in ((0.60, -0.010), (0.60, 0.010), (0.93, 0.028), (0.93, 0.008)):
                rr = r * (1.0012 if t < 0.8 else 0.957)
                ring.append(b.verts.new(Vector(c + [rr * np.cos(a + da), s * t * w, rr * np.sin(a + da)])))
            b.faces.new(ring if s > 0 else ring[::-1])
    m.add(node, b, "groove")


def brake(m, node, at, outward, radius):
    """Disc and caliper, which do not turn with the wheel."""
    at = np.array(at)
    m.lathe(node, "disc", at, (0, outward, 0), [(-0.012, 0.2 * radius), (-0.012, 0.42 * radius), (0.010, 0.42 * radius), (0.010, 0.2 * radius), (0.03, 0.18 * radius), (0.03, 0.0)], 30)
    m.box(node, "steel", tuple(at + [-0.36 * radius, 0, 0.02]), (0.05, 0.07, 0.13), 0.01)
