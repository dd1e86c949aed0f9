"""Cars: a body lofted over a side view and a plan, glass house, wheels. Origin on the floor below the
middle of the rear axle; x ahead."""

import bmesh
import numpy as np

from . import parts
from .solid import Machine

RADIUS, TRACK = 0.315, 1.48

# Side views, (x, z) from tail to nose with x measured from the middle of the car; `rear` and
# `front` are the axles, `belt` the lower edge of the windows.
SHAPES = {
    "hatch": {
        "length": 4.05,
        "axles": (-1.26, 1.29),
        "deck": [(-2.02, 0.70), (-1.98, 0.95), (-1.2, 1.0), (0.85, 0.97), (1.55, 0.86), (1.92, 0.72), (2.02, 0.52)],
        "roof": [(-1.97, 0.97), (-1.68, 1.33), (-1.3, 1.43), (-0.5, 1.49), (0.05, 1.48), (0.35, 1.41), (1.02, 0.96)],
        "solid": (-1.50, 0.28),
    },
    "saloon": {
        "length": 4.62,
        "axles": (-1.38, 1.36),
        "deck": [(-2.31, 0.62), (-2.27, 0.93), (-1.7, 1.0), (0.95, 0.95), (1.8, 0.83), (2.2, 0.70), (2.31, 0.50)],
        "roof": [(-1.75, 0.99), (-1.25, 1.33), (-0.8, 1.42), (-0.3, 1.44), (0.1, 1.43), (0.4, 1.36), (1.12, 0.94)],
        "solid": (-1.10, 0.32),
    },
    "van": {
        "length": 4.90,
        "axles": (-1.55, 1.50),
        "deck": [(-2.45, 0.60), (-2.44, 1.05), (-1.0, 1.10), (1.15, 1.08), (1.9, 0.98), (2.32, 0.80), (2.45, 0.52)],
        "roof": [(-2.43, 1.08), (-2.36, 1.80), (-2.0, 1.94), (-0.5, 1.98), (0.45, 1.96), (0.85, 1.86), (1.55, 1.06)],
        "solid": (-2.30, 0.80),
    },
}
WIDTH = 0.88
SILL = 0.22
PANE_ROWS = 10  # of faces up the side windows; slanted pillars are stairs of these


def build(name, folder, path, shape, colour, seed):
    m = Machine(name, folder)
    parts.materials(m, "", "", colour, (0.10, 0.10, 0.105), seed)
    m.material("body", shine(colour, seed), 1.2, 0.25)
    m.material("glass", tinted(seed), 1.5, 0.08)
    form = SHAPES[shape]
    shift = -form["axles"][0]
    shell(m, name, form, shift)
    glass_house(m, name, form, shift)
    trim(m, name, form, shift)
    wheels(m, name, form)
    m.finish(path, facts(form))


def facts(form):
    return {
        "origin": "floor below the middle of the rear axle (driven, not steered)",
        "wheelbase_m": form["axles"][1] - form["axles"][0],
        "track_m": TRACK,
        "steered": ["front"],
        "max_steer_deg": 35.0,
        "wheel_radius_m": {f"wheel_{e}_{s}": RADIUS for e in ("front", "rear") for s in ("left", "right")},
        "steer_nodes": ["steer_front_left", "steer_front_right"],
        "max_speed_mps": 14.0,
    }


def shine(colour, seed):
    """Car paint: even, with a little dust towards the sills (the picture repeats every 1.2 m)."""
    rng = np.random.default_rng(seed)
    image = np.ones((256, 256, 3)) * np.array(colour)
    return np.clip(image * (1 + 0.015 * rng.standard_normal((256, 256, 1))), 0, 1)


def tinted(seed):
    """Window glass in daylight: dark, with a pale slanted reflection."""
    y, x = np.mgrid[0:256, 0:256] / 256.0
    sky = 0.5 + 0.5 * np.sin(2 * np.pi * (x + 0.6 * y) + seed)
    tone = 0.045 + 0.10 * sky**3
    return np.repeat(tone[..., None], 3, 2) * np.array([0.9, 1.0, 1.05])


def plan(x, length, width=WIDTH):
    """Half the width of the car at x: full along the sides, drawn in towards both ends."""
    u = np.clip(np.abs(2 * x / length), 0, 1)
    return width * (1 - 0.16 * u**4 - 0.18 * u**16)


def loft(m, node, material, points, keep=None):
    """Faces of a grid of points (stations, around, 3), mirrored to the other side."""
    for mirror in (1, -1):
        b = bmesh.new()
        verts = [[b.verts.new((p[0], mirror * p[1], p[2])) for p in row] for row in points]
        for i in range(len(verts) - 1):
            for j in range(len(verts[0]) - 1):
                if keep is not None and not keep(points[i : i + 2, j : j + 2].mean((0, 1)), i, j):
                    continue
                quad = [verts[i][j], verts[i + 1][j], verts[i + 1][j + 1], verts[i][j + 1]]
                b.faces.new(quad if mirror < 0 else quad[::-1])
        bmesh.ops.delete(b, geom=[v for v in b.verts if not v.link_faces], context="VERTS")
        m.add(node, b, material)


def shell(m, node, form, shift):
    """Sills, doors, bonnet and deck."""
    xs, zs = np.array(form["deck"]).T
    half = form["length"] / 2
    stations = np.unique(np.concatenate([np.linspace(-half, half, 41), xs]))
    rows = []
    for x in stations:
        top = max(np.interp(x, xs, zs), SILL + 0.12)
        w = plan(x, form["length"])
        rise = 0.10 * np.clip((abs(2 * x / form["length"]) - 0.86) / 0.14, 0, 1)
        low = SILL + rise
        section = [(0.0, low), (0.90 * w, low), (0.97 * w, low + 0.06)]
        section += [(w, low + t * (top - low)) for t in (0.35, 0.5, 0.62)]
        section += [(0.985 * w, low + 0.80 * (top - low)), (0.95 * w, low + 0.93 * (top - low))]
        section += [(0.88 * w, top - 0.012), (0.6 * w, top + 0.005), (0.0, top + 0.018)]
        rows.append([(x + shift, y, z) for y, z in section])
    points = np.array(rows)
    loft(m, node, "body", points)
    for end in (0, -1):  # the ends are closed by flat bumpers
        ring = points[end]
        cap = np.stack([ring * [1, 0, 1], ring])
        loft(m, node, "body", cap if end == 0 else cap[::-1])


def glass_house(m, node, form, shift):
    """Roof, pillars and panes over the belt line."""
    xs, zs = np.array(form["roof"]).T
    deck_x, deck_z = np.array(form["deck"]).T
    stations = np.unique(np.concatenate([np.linspace(xs[0], xs[-1], 113), xs]))
    rows, roofs = [], []
    for x in stations:
        roof, belt = np.interp(x, xs, zs), np.interp(x, deck_x, deck_z) - 0.02
        roof = max(roof, belt + 0.01)
        w = 0.93 * plan(x, form["length"])
        lean = 0.22 * (roof - belt) / 0.5
        top = w - min(lean, 0.24)
        gutter = roof - min(0.06, 0.2 * (roof - belt))
        section = [
            (w - (0.8 * t + 0.2 * t * t) * (w - top), belt + t * (gutter - belt))
            for t in np.linspace(0, 1, PANE_ROWS + 1)
        ]
        section += [(top - 0.05, roof - 0.012)]
        section += [(0.6 * top, roof + 0.012), (0.0, roof + 0.02)]
        rows.append([(x + shift, y, z) for y, z in section])
        roofs.append(roof)
    points = np.array(rows)
    lo, hi = form["solid"]
    span = hi - lo

    def painted(p, i, j):
        x = p[0] - shift
        if j > PANE_ROWS:
            return lo <= x <= hi
        if j == PANE_ROWS:
            return True
        middle = [lo + 0.38 * span, lo + 0.68 * span] if span > 2 else [lo + 0.58 * span]
        front = np.interp(p[2], [0.95, 1.4], [xs[-1] - 0.05, hi + 0.02])
        back = np.interp(p[2], [0.95, 1.4], [xs[0] + 0.05, lo - 0.02])
        pillar = min(abs(x - c) for c in middle) < 0.045 or x > front - 0.10 or x < back + 0.16
        return pillar or (span > 2 and x < lo + 0.4 * span)

    loft(m, node, "body", points, painted)
    loft(m, node, "glass", points, lambda p, i, j: not painted(p, i, j))


def trim(m, node, form, shift):
    """Arches, lamps, plates, handles, mirrors, bumpers."""
    half = form["length"] / 2
    nose, tail = shift + half, shift - half
    for x in (0.0, form["axles"][1] - form["axles"][0]):
        w = plan(x - shift, form["length"])
        for s in (-1, 1):
            rings = [(-0.14, 0.365), (0.006, 0.365), (0.006, 0.30), (-0.02, 0.0)]
            m.lathe(node, "plastic", (x, s * w, RADIUS + 0.07), (0, s, 0), rings, 28)
    deck = dict(form["deck"])
    z = np.interp(half - 0.12, *np.array(form["deck"]).T) - 0.10
    for s in (-1, 1):
        m.box(node, "lens", (nose - 0.10, s * 0.58, z), (0.16, 0.34, 0.11), 0.03)
        m.box(node, "red", (tail + 0.05, s * 0.60, 0.80), (0.10, 0.24, 0.16), 0.03)
        mirror = form["roof"][-1][0] - 0.28 + shift
        m.box(node, "body", (mirror, s * 0.95, 1.02), (0.12, 0.16, 0.11), 0.03)
        for x in (form["solid"][0] * 0.45 + shift + 0.1, form["solid"][1] * 0.4 + shift + 0.2):
            w = plan(x - shift, form["length"])
            m.box(node, "plastic", (x, s * (w + 0.004), 0.80), (0.17, 0.03, 0.03), 0.01)
        for x in (form["solid"][0] * 0.55 + shift, form["solid"][1] - 0.9 + shift, form["roof"][-1][0] - 0.12 + shift):
            w = plan(x - shift, form["length"])
            m.box(node, "plastic", (x, s * (w - 0.008), 0.62), (0.012, 0.02, 0.52), 0.002)
        w = plan(0, form["length"])
        m.box(node, "plastic", (shift, s * (w - 0.012), 0.27), (1.7, 0.03, 0.07), 0.01)
    m.box(node, "plastic", (nose - 0.045, 0, 0.33), (0.12, 1.34, 0.14), 0.03)
    m.box(node, "plastic", (tail + 0.045, 0, 0.36), (0.12, 1.36, 0.14), 0.03)
    m.box(node, "plastic", (nose - 0.06, 0, 0.53), (0.10, 0.72, 0.13), 0.02)
    for x in (nose + 0.012, tail - 0.012):
        m.box(node, "lens", (x, 0, 0.46 if x > 0 else 0.62), (0.012, 0.52, 0.11), 0.004)
    m.box(node, "plastic", (shift, 0, 0.24), (2 * half - 0.5, 1.45, 0.10), 0.02)


def wheels(m, n, form):
    for end, x in (("rear", 0.0), ("front", form["axles"][1] - form["axles"][0])):
        for side, s in (("left", 1), ("right", -1)):
            parent = n
            at = (x, s * TRACK / 2, RADIUS)
            if end == "front":
                parent = m.node(f"steer_front_{side}", n, at)
            wheel = m.node(f"wheel_{end}_{side}", parent, (x, s * (TRACK / 2 + 0.045), RADIUS))
            parts.wheel(m, wheel, RADIUS, 0.20, s, 0, 0.66, 5)
