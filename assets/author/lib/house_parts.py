"""Parts of houses: walls with holes, windows set back in them, doors, roofs in courses, gutters.

A Wall is a plane with its own axes: u to the right as one faces it, v up, w out of it.
"""

import bmesh
import numpy as np
from mathutils import Vector

REVEAL = 0.13  # m, how far windows stand behind the wall's face
SHEET = (256, 1280)  # of the pictures behind panes


class Wall:
    """A plane wall of a machine: centre of its foot, direction out, and width."""

    def __init__(self, m, foot, out, width):
        self.m, self.foot = m, np.array(foot, float)
        self.w = np.array(out, float)
        self.u = np.cross([0, 0, 1.0], self.w)
        self.width = width

    def at(self, u, v, w=0.0):
        return self.foot + self.u * u + self.w * w + np.array([0, 0, 1.0]) * v

    def quads(self, material, quads):
        """Flat faces of (u, v, w) corners, counter-clockwise as seen from outside."""
        b = bmesh.new()
        for quad in quads:
            b.faces.new([b.verts.new(Vector(self.at(*c))) for c in quad])
        b.normal_update()
        self.m.add(self.m.name, b, material)

    def block(self, material, u, v, w, bevel=0.006, segments=1):
        """A box from (u0, u1), (v0, v1), (w0, w1)."""
        lo, hi = self.at(u[0], v[0], w[0]), self.at(u[1], v[1], w[1])
        self.m.box(self.m.name, material, tuple((lo + hi) / 2), tuple(np.abs(hi - lo)), bevel, segments=segments)

    def face(self, material, height, holes, reveal="reveal"):
        """The wall with rectangular holes (u0, u1, v0, v1) and their reveals."""
        us = sorted({-self.width / 2, self.width / 2, *(h[0] for h in holes), *(h[1] for h in holes)})
        vs = sorted({0.0, height, *(h[2] for h in holes), *(h[3] for h in holes)})
        out = []
        for a, b in zip(us, us[1:]):
            start = None
            for c, d in zip(vs, vs[1:]):
                hole = any(h[0] < (a + b) / 2 < h[1] and h[2] < (c + d) / 2 < h[3] for h in holes)
                start = c if start is None and not hole else start
                if start is not None and (hole or d == vs[-1]):
                    top = c if hole else d
                    out.append([(a, start, 0), (b, start, 0), (b, top, 0), (a, top, 0)])
                    start = None
        self.quads(material, out)
        r = -REVEAL
        sides = []
        for a, b, c, d in holes:
            sides += [[(a, c, 0), (a, c, r), (a, d, r), (a, d, 0)], [(b, c, r), (b, c, 0), (b, d, 0), (b, d, r)]]
            sides += [[(a, d, r), (b, d, r), (b, d, 0), (a, d, 0)], [(a, c, 0), (b, c, 0), (b, c, r), (a, c, r)]]
        if sides:
            self.quads(reveal, sides)

    def window(self, hole, which, bars=1, transom=True, sill="sill", sashes=True):
        """Frame, sashes, panes a little behind them, a sill that throws off water."""
        a, b, c, d = hole
        w0, w1 = -REVEAL - 0.03, -REVEAL + 0.045
        f = 0.055
        for u in ((a, a + f), (b - f, b)):
            self.block("trim", u, (c, d), (w0, w1), 0.0)
        for v in ((c, c + f + 0.015), (d - f, d)):
            self.block("trim", (a + f, b - f), v, (w0, w1), 0.0)
        split = d - 0.30 * (d - c) if transom else d - f
        if transom:
            self.block("trim", (a + f, b - f), (split - 0.028, split + 0.028), (w0, w1 + 0.004), 0.0)
        inner = np.linspace(a + f, b - f, bars + 2)
        for u in inner[1:-1]:
            self.block("trim", (u - 0.038, u + 0.038), (c + f, split), (w0, w1 + 0.006), 0.0)
        sash = w1 - 0.022
        for u, v in zip(inner, inner[1:]) if sashes else ():
            self.sash(u, v, c + f + 0.015, split, sash)
        if transom and sashes:
            self.sash(a + f, b - f, split, d - f, sash)
        self.pane(a + f, b - f, c + f, d - f, sash - 0.024, which)
        if sill:
            b_ = bmesh.new()
            q = [(a - 0.05, c - 0.01, -REVEAL), (b + 0.05, c - 0.01, -REVEAL), (b + 0.05, c - 0.035, 0.06), (a - 0.05, c - 0.035, 0.06)]
            low = [(u, c - 0.085, w) for u, _, w in q]
            top = [b_.verts.new(Vector(self.at(*p))) for p in q]
            bottom = [b_.verts.new(Vector(self.at(*p))) for p in low]
            b_.faces.new(top[::-1])
            for i in range(4):
                b_.faces.new([top[i], top[(i + 1) % 4], bottom[(i + 1) % 4], bottom[i]])
            b_.faces.new(bottom)
            bmesh.ops.recalc_face_normals(b_, faces=b_.faces)
            self.m.add(self.m.name, b_, sill)

    def sash(self, a, b, c, d, w):
        """The thin wing that holds a pane."""
        t = 0.032
        for u in ((a, a + t), (b - t, b)):
            self.block("trim", u, (c, d), (w - 0.03, w + 0.008), 0.0)
        for v in ((c, c + t), (d - t, d)):
            self.block("trim", (a + t, b - t), v, (w - 0.03, w + 0.008), 0.0)

    def pane(self, a, b, c, d, w, which):
        self.m.decal(
            self.m.name, "panes", tuple(self.at((a + b) / 2, (c + d) / 2, w)), tuple(self.u * (b - a)), (0, 0, d - c), (256 * which, 0, 256, 256), SHEET
        )

    def surround(self, hole, material="stone", t=0.11, out=0.035, key=True):
        """A moulded frame on the wall round a hole, with a lintel that stands out."""
        a, b, c, d = hole
        for u in ((a - t, a), (b, b + t)):
            self.block(material, u, (c, d), (-0.01, out))
        self.block(material, (a - t - 0.03, b + t + 0.03), (d, d + 0.16), (-0.01, out + 0.03), 0.012)
        if key:
            self.block(material, (a - t - 0.06, b + t + 0.06), (d + 0.16, d + 0.20), (-0.01, out + 0.08), 0.010)

    def shutters(self, hole, material="door"):
        """Open wooden shutters beside a window, with slats."""
        a, b, c, d = hole
        wide = (b - a) / 2 - 0.02
        for s, u in ((-1, a - 0.03), (1, b + 0.03)):
            u0, u1 = sorted((u, u + s * wide))
            for v in ((c, c + 0.07), (d - 0.07, d), ((c + d) / 2 - 0.035, (c + d) / 2 + 0.035)):
                self.block(material, (u0, u1), v, (0.012, 0.046), 0.0)
            for t in ((u0, u0 + 0.05), (u1 - 0.05, u1)):
                self.block(material, t, (c, d), (0.012, 0.046), 0.0)
            slats = []
            for v in np.arange(c + 0.09, d - 0.09, 0.05):
                slats.append([(u0 + 0.05, v, 0.042), (u1 - 0.05, v, 0.042), (u1 - 0.05, v + 0.05, 0.018), (u0 + 0.05, v + 0.05, 0.018)])
            self.quads(material, slats)

    def door(self, hole, kind=0, light=True):
        """Panelled wing with handle, letter plate and a light above; two steps in front."""
        a, b, c, d = hole
        w0, w1 = -REVEAL - 0.02, -REVEAL + 0.05
        for u in ((a, a + 0.07), (b - 0.07, b)):
            self.block("trim", u, (c, d), (w0, w1))
        self.block("trim", (a, b), (d - 0.07, d), (w0, w1))
        top = d - 0.07
        if light:
            self.block("trim", (a + 0.07, b - 0.07), (d - 0.50, d - 0.44), (w0, w1))
            self.pane(a + 0.07, b - 0.07, d - 0.44, d - 0.07, w0 + 0.03, 4)
            top = d - 0.50
        a, b = a + 0.07, b - 0.07
        self.block("door", (a, b), (c, top), (w0, w0 + 0.035), 0.004)
        rail = 0.11
        mid = c + 0.42 * (top - c)
        for u in ((a, a + rail), (b - rail, b), ((a + b) / 2 - 0.05, (a + b) / 2 + 0.05)):
            self.block("door", u, (c, top), (w0 + 0.03, w0 + 0.052), 0.004)
        for v in ((c, c + 0.2), (mid - 0.07, mid + 0.07), (top - rail, top)):
            self.block("door", (a, b), v, (w0 + 0.03, w0 + 0.052), 0.004)
        if kind % 2:
            for s in (0, 1):
                u0 = a + rail + s * ((b - a) / 2 - rail + 0.05)
                self.pane(u0, u0 + (b - a) / 2 - rail - 0.05, mid + 0.07, top - rail, w0 + 0.038, 4)
        knob = self.at(b - 0.055, mid + 0.02, w0 + 0.052)
        self.m.lathe(self.m.name, "metal", tuple(knob), tuple(self.w), [(0, 0.028), (0.01, 0.028), (0.02, 0.012), (0.05, 0.012), (0.06, 0.028), (0.08, 0.022), (0.085, 0.0)], 12)
        self.block("metal", ((a + b) / 2 - 0.13, (a + b) / 2 + 0.13), (mid - 0.02, mid + 0.025), (w0 + 0.052, w0 + 0.058), 0.002)
        self.block("stone", (a - 0.35, b + 0.35), (c - 0.16, c), (-0.02, 0.40), 0.012, 2)
        self.block("stone", (a - 0.55, b + 0.55), (c - 0.34, c - 0.16), (-0.02, 0.75), 0.012, 2)


def slope(m, eave, ridge, half, axis, thick=0.05, course=0.32):
    """A roof's slope in overlapping courses of tiles. eave and ridge: (out, z); half: half its length;
    axis: the horizontal axis it faces, as (direction out, direction along)."""
    out, side = (np.array(v, float) for v in axis)
    a, b = np.array(eave, float), np.array(ridge, float)
    size = np.linalg.norm(b - a)
    count = max(1, int(round(size / course)))
    n = np.array([-(b - a)[1], (b - a)[0]]) / size
    n = n if n[1] > 0 else -n
    mesh, layer = bmesh.new(), None
    layer = mesh.loops.layers.uv.verify()

    def put(q, t):
        return mesh.verts.new(Vector(out * q[0] + side * t + np.array([0, 0, q[1]])))

    def quad(corners, uvs):
        face = mesh.faces.new(corners)
        for loop, uv in zip(face.loops, uvs):
            loop[layer].uv = uv

    for k in range(count):
        p, q = a + (b - a) * k / count, a + (b - a) * (k + 1) / count
        p1, q1 = p + n * thick, q + n * 0.012
        v0, v1 = k * 0.25 / 2, (k + 1) * 0.25 / 2
        u0, u1 = -half / 2, half / 2
        quad([put(p1, -half), put(p1, half), put(q1, half), put(q1, -half)], [(u0, v0 + 0.01), (u1, v0 + 0.01), (u1, v1), (u0, v1)])
        quad([put(p, -half), put(p, half), put(p1, half), put(p1, -half)], [(u0, v0), (u1, v0), (u1, v0 + 0.01), (u0, v0 + 0.01)])
        for t in (-half, half):
            quad([put(p, t), put(p1, t), put(q1, t), put(q, t)], [(u0, v0), (u0, v0 + 0.02), (u0 + 0.1, v1), (u0 + 0.1, v1)])
    bmesh.ops.recalc_face_normals(mesh, faces=mesh.faces)
    m.add(m.name, mesh, "roof", uv=True)
    under = bmesh.new()
    under.faces.new([under.verts.new(Vector(out * q[0] + side * t + np.array([0, 0, q[1] - 0.01]))) for q, t in ((a, -half), (b, -half), (b, half), (a, half))])
    m.add(m.name, under, "trim")


def gutter(m, a, b, radius=0.065):
    """A half-round gutter from a to b with brackets."""
    a, b = np.array(a, float), np.array(b, float)
    along = (b - a) / np.linalg.norm(b - a)
    side = np.cross([0, 0, 1.0], along)
    mesh = bmesh.new()
    rings = []
    for p in (a, b):
        rings.append([mesh.verts.new(Vector(p + radius * (np.cos(t) * side + np.sin(t) * np.array([0, 0, 1.0])))) for t in np.linspace(np.pi, 2 * np.pi, 9)])
    for i in range(8):
        mesh.faces.new([rings[0][i], rings[0][i + 1], rings[1][i + 1], rings[1][i]])
    for ring in rings:
        mesh.faces.new(ring)
    m.add(m.name, mesh, "metal")
    for s in (-1, 1):
        m.bar(m.name, "metal", tuple(a + side * s * radius), tuple(b + side * s * radius), 0.008, 5)


def downpipe(m, top, foot, out):
    """From the gutter with a swan neck to the wall, and down."""
    top, foot, out = (np.array(v, float) for v in (top, foot, out))
    wall = np.array([foot[0], foot[1], top[2] - 0.45])
    m.pipe(m.name, "metal", [tuple(top), tuple(top - [0, 0, 0.10]), tuple(wall), tuple(wall - [0, 0, 0.15]), tuple(foot), tuple(foot + out * 0.10 - [0, 0, 0.08])], 0.042, 10)
    for z in np.arange(foot[2] + 0.8, wall[2], 1.9):
        m.box(m.name, "metal", (foot[0], foot[1], z), (0.10, 0.10, 0.035), 0.004)
