"""A ride-on scrubber-drier: tanks as one moulded skin, brush deck, squeegee, driver. Origin on the floor
below the rear axle; it steers with its single front wheel, which drives."""

import bmesh
import numpy as np
from mathutils import Vector

from . import car_parts, panels, parts, seated
from .panels import profile, rounded, smax
from .solid import Machine

BASE, TRACK, REAR, DRIVE = 1.02, 0.64, 0.15, 0.14
SEAT, WHEEL = (0.16, 0.0, 0.66), (0.60, 0.0, 1.06)
COLOUR = (0.80, 0.82, 0.82)


def build(name, folder, path, driver):
    m = Machine(name, folder)
    parts.materials(m, "AISLE S90", "31", COLOUR, (0.10, 0.36, 0.52), seed=31)
    car_parts.materials(m, COLOUR, 31)
    m.plain("steel", (0.48, 0.48, 0.48), 0.5)
    m.plain("rim", (0.70, 0.705, 0.71), 0.5)
    m.plain("blue", (0.08, 0.34, 0.52), 0.35)
    m.plain("brush", (0.10, 0.20, 0.42), 0.9)
    m.plain("water", (0.30, 0.31, 0.30), 0.15)
    tanks(m, name)
    deck(m, name)
    squeegee(m, name)
    controls(m, name)
    wheels(m, name)
    m.bar(name, "steel", (-0.30, -0.28, 0.98), (-0.30, -0.28, 1.72), 0.014, 10)
    m.node("beacon", name, (-0.30, -0.28, 1.72))
    parts.beacon(m, "beacon")
    seated.add(m, name, driver, SEAT, WHEEL, 0.32)
    m.finish(
        path,
        {
            "origin": "floor below the middle of the rear axle (not steered)",
            "wheelbase_m": BASE,
            "track_m": TRACK,
            "steered": ["front"],
            "max_steer_deg": 80.0,
            "wheel_radius_m": {"wheel_rear_left": REAR, "wheel_rear_right": REAR, "wheel_front": DRIVE},
            "steer_nodes": ["steer_front"],
            "max_speed_mps": 1.9,
        },
    )


def field():
    top = profile([(-0.62, 0.94), (-0.30, 0.99), (0.02, 0.95), (0.06, 0.74), (0.34, 0.68), (0.38, 0.35), (0.68, 0.34), (0.74, 0.50), (0.80, 0.95), (0.92, 1.0), (1.16, 0.90), (1.30, 0.70)], 0.03)
    half = profile([(-0.70, 0.33), (-0.35, 0.39), (0.6, 0.40), (1.0, 0.37), (1.30, 0.28)], 0.2)

    def f(x, y, z):
        y = np.abs(y)
        belly = 0.035 * np.exp(-(((z - 0.58) / 0.09) ** 2)) * (1 / (1 + np.exp((x - 0.30) / 0.04)))
        side = y - half(x) + belly - 0.03 * np.clip((z - 0.7) / 0.3, 0, 1)
        front = x - 1.27 + 0.20 * (y / 0.38) ** 2 + 0.12 * np.clip((z - 0.4) / 0.6, 0, 1.2) ** 2
        rear = -x - 0.58 + 0.05 * (y / 0.38) ** 4 + 0.06 * np.clip((z - 0.6) / 0.4, 0, 1) ** 2 + 0.08 * np.clip((0.45 - z) / 0.3, 0, 1)
        hood = (z - top(x) + 0.035 * (y / 0.4) ** 2) * 0.5
        out = smax(smax(side, front, k=0.18), smax(side, rear, k=0.14), k=0.02)
        return smax(smax(out, hood, k=0.06), 0.12 - z, k=0.05)

    return f


def tanks(m, n):
    p = panels.Panels(field(), (-0.25, 0.90, 0.28))
    p.belt("blue", lambda x: 0.42 + 0 * x)
    p.belt("skirt", lambda x: 0.26 + 0 * x)
    a = np.radians(np.linspace(-30, 210, 24))
    for name, r in (("lip", REAR + 0.045), ("arch", REAR + 0.03)):
        p.region(name, "side", np.stack([r * np.cos(a), REAR + r * np.sin(a)], 1))
    p.gap("side", [(-0.54, 0.74), (-0.2, 0.735), (0.03, 0.74)])
    p.region("pressing", "side", rounded([(-0.46, 0.78), (-0.06, 0.78), (-0.06, 0.90), (-0.42, 0.90)], 0.04))
    p.region("pressing", "side", rounded([(0.82, 0.52), (1.06, 0.50), (1.00, 0.72), (0.85, 0.80)], 0.05))
    p.gap("top", [(-0.50, 0.28), (-0.2, 0.30), (-0.02, 0.28), (0.0, 0.0)])
    p.region("water", "top", rounded([(-0.42, 0.06), (-0.22, 0.06), (-0.22, 0.20), (-0.42, 0.20)], 0.04), 0.02)
    p.region("lamp", "front", rounded([(0.12, 0.60), (0.24, 0.60), (0.22, 0.68), (0.13, 0.68)], 0.025), 0.02)
    p.region("tail", "rear", rounded([(0.24, 0.80), (0.31, 0.80), (0.31, 0.88), (0.24, 0.88)], 0.02), 0.02)
    p.belt("under", lambda x: 0.15 + 0 * x)
    depths = {"gap": 0.008, "lamp": 0.03, "tail": 0.004, "lip": -0.004, "pressing": 0.007, "skirt": 0.004, "water": 0.012, "blue": 0.001}
    mesh = p.mesh(depths, drop=("under", "arch"), coarse=0.12, turn_deg=10, fine=0.03, rounds=4)
    names = {"body": "body", "gap": "gap", "lamp": "bowl", "tail": "red", "lip": "plastic", "pressing": "blue", "skirt": "plastic", "water": "water", "blue": "blue"}
    panels.hang(m, n, mesh, names.get, lambda v: np.stack(car_parts.over(v.T), 1))
    for s in (-1, 1):
        c = p.cast("front", [(0.18, 0.64)])[0]
        at = (c[0] - 0.010, s * 0.18, 0.64)
        m.lathe(n, "chrome", at, (1, 0, 0), [(-0.03, 0.030), (0.0, 0.034), (0.004, 0.030), (-0.012, 0.026)], 18)
        m.lathe(n, "lens", at, (1, 0, 0), [(-0.014, 0.026), (-0.004, 0.020), (0.002, 0.0)], 18)
        car_parts.arch(m, n, 0.0, s, REAR, REAR + 0.02, 0.42)
        on = p.cast("side", [(x, z) for x in (-0.42, -0.25, -0.08) for z in (0.47, 0.53)])
        parts.label(m, n, "name", (-0.25, s * (max(on[:, 1]) + 0.003), 0.50), (s * -0.36, 0, 0), (0, 0, 0.06))
        parts.label(m, n, "number", (0.93, s * 0.385, 0.64), (s * -0.11, s * 0.02, 0), (0, 0, 0.11))
    m.lathe(n, "blue", (1.00, 0.16, 0.93), (0.25, 0, 1), [(0.0, 0.055), (0.03, 0.055), (0.035, 0.045), (0.035, 0.0)], 20)


def deck(m, n):
    """Two disc brushes under a rounded cover before the rear wheels."""
    cover = rounded([(0.30, -0.44), (0.30, 0.44), (0.82, 0.44), (0.90, 0.20), (0.90, -0.20), (0.82, -0.44)], 0.10)
    m.prism(n, "blue", [tuple(q) for q in cover], 0.10, 0.21, "z", 0.03, 3)
    m.prism(n, "rubber", [tuple(q * [1.0, 1.03]) for q in cover], 0.035, 0.10, "z", 0.006, 1)
    for s in (-1, 1):
        c = (0.58, s * 0.21, 0.0)
        m.lathe(n, "brush", c, (0, 0, 1), [(0.004, 0.05), (0.004, 0.215), (0.05, 0.205), (0.055, 0.05)], 30)
        m.lathe(n, "steel", (0.58, s * 0.21, 0.20), (0, 0, 1), [(0.0, 0.075), (0.09, 0.075), (0.10, 0.06), (0.10, 0.0)], 20)
        for x in (0.36, 0.80):
            m.lathe(n, "rubber", (x, s * 0.475, 0.11), (0, 0, 1), [(-0.02, 0.0), (-0.02, 0.032), (0.02, 0.032), (0.02, 0.0)], 16)


def squeegee(m, n):
    """The curved rubber lip behind, its arms and the suction hose to the tank."""
    a = np.radians(np.linspace(118, 242, 25))
    arc = [(-0.12 + 0.58 * np.cos(t) * 0.95, 0.62 * np.sin(t)) for t in a]
    m.pipe(n, "steel", [(x, y, 0.115) for x, y in arc], 0.018, 8)
    for r, material in ((0.0, "rubber"), (0.03, "rubber")):
        b = bmesh.new()
        rows = [[b.verts.new(Vector((x + r, y, z))) for x, y in arc] for z in (0.004, 0.11)]
        for i in range(len(arc) - 1):
            b.faces.new([rows[0][i], rows[0][i + 1], rows[1][i + 1], rows[1][i]])
        m.add(n, b, material)
    for y in (-0.53, 0.53):
        m.lathe(n, "blue", (-0.40, y * 1.02, 0.075), (0, 1, 0), [(-0.02, 0.0), (-0.02, 0.05), (0.02, 0.05), (0.02, 0.0)], 16)
    for y in (-0.16, 0.16):
        m.beam(n, "steel", (-0.28, y, 0.24), (-0.66, y, 0.14), 0.02, 0.05, 0.004)
    m.box(n, "steel", (-0.66, 0, 0.15), (0.06, 0.38, 0.05), 0.01)
    line = [(-0.67, 0.0, 0.16), (-0.72, 0.02, 0.32), (-0.68, 0.10, 0.60), (-0.58, 0.14, 0.80)]
    t = np.linspace(0, 1, 26)
    p = np.array(line)
    curve = [(1 - u) ** 3 * p[0] + 3 * u * (1 - u) ** 2 * p[1] + 3 * u * u * (1 - u) * p[2] + u**3 * p[3] for u in t]
    m.pipe(n, "rubber", [tuple(c) for c in curve], 0.030, 12)
    for c, d in zip(curve[::2], curve[1::2]):  # the hose is ribbed
        m.pipe(n, "plastic", [tuple(c), tuple(c + 0.35 * (d - c))], 0.034, 12)


def controls(m, n):
    parts.seat(m, n, *SEAT, scale=0.9)
    parts.steering_wheel(m, n, WHEEL, (-0.55, 0, 0.84), 0.155)
    m.bar(n, "plastic", (0.78, 0, 0.80), (0.88, 0, 0.60), 0.05, 14)
    m.prism(n, "plastic", [(0.80, 0.90), (0.88, 1.06), (0.97, 1.03), (0.95, 0.90)], -0.24, 0.24, "y", 0.025, 3)
    parts.label(m, n, "panel", (0.836, 0.0, 0.985), (0, -0.20, 0), (0.05, 0, 0.09))
    m.box(n, "rubber", (0.53, 0, 0.352), (0.28, 0.62, 0.012), 0.003)
    for y in (-0.12, 0.14):
        m.box(n, "rubber", (0.70, y, 0.42), (0.03, 0.09, 0.12), 0.008)
    for s in (-1, 1):
        m.pipe(n, "steel", [(0.90, s * 0.30, 0.95), (0.92, s * 0.40, 1.10), (0.93, s * 0.44, 1.22)], 0.010, 8)
        car_parts.egg(m, n, "seal", (0.94, s * 0.46, 1.30), (0.06, 0.17, 0.12), 3.2, cut=-0.5)
        car_parts.egg(m, n, "mirror", (0.922, s * 0.46, 1.30), (0.01, 0.15, 0.10), 4.5)
    m.pipe(n, "steel", [(-0.52, 0.30, 0.90), (-0.54, 0.30, 1.00), (-0.54, -0.10, 1.00), (-0.52, -0.10, 0.90)], 0.014, 10)
    parts.label(m, n, "warning", (-0.575, 0.12, 0.72), (0, -0.13, 0), (0, 0, 0.13))
    parts.label(m, n, "stripes_red", (-0.545, 0, 0.50), (0, -0.46, 0), (0, 0, 0.06))


def wheels(m, n):
    for side, s in (("left", 1), ("right", -1)):
        wheel = m.node(f"wheel_rear_{side}", n, (0.0, s * TRACK / 2, REAR))
        parts.wheel(m, wheel, REAR, 0.09, s, 0, 0.62, 5)
    steer = m.node("steer_front", n, (BASE, 0.0, DRIVE))
    m.box(steer, "steel", (BASE, 0, DRIVE + 0.08), (0.12, 0.18, 0.10), 0.02)
    wheel = m.node("wheel_front", steer, (BASE, 0.0, DRIVE))
    parts.wheel(m, wheel, DRIVE, 0.10, 1, 0, 0.60, 5)
