"""A counterbalance forklift of 2.5 t; origin on the floor below the middle of the front axle."""

import numpy as np

from . import parts, seated
from .solid import Machine, around

WHEELBASE, TRACK = 1.60, 0.92
FRONT, REAR = 0.335, 0.270  # wheel radii
SEAT = (-0.80, 0.0, 0.95)  # middle of the seat's base
WHEEL = (-0.36, 0.0, 1.27)  # middle of the steering wheel
COLOUR = (0.90, 0.47, 0.07)


def build(name, folder, path, driver=None):
    """The truck; with a driver (a body.Person) it is manned."""
    m = Machine(name, folder)
    parts.materials(m, "AISLE 25E", "07", COLOUR, (0.36, 0.365, 0.37))
    chassis(m, name)
    counterweight(m, name)
    guard(m, name)
    cockpit(m, name, driver is not None)
    wheels(m, name)
    mast(m, name)
    signs(m, name)
    m.node("beacon", name, (-0.85, 0.0, 2.238))
    parts.beacon(m, "beacon")
    if driver:
        seated.add(m, name, driver, SEAT, WHEEL, 0.62)
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the middle of the front axle (driven, not steered)",
        "wheelbase_m": WHEELBASE,
        "track_m": TRACK,
        "steered": ["rear"],
        "max_steer_deg": 70.0,
        "wheel_radius_m": {
            "wheel_front_left": FRONT,
            "wheel_front_right": FRONT,
            "wheel_rear_left": REAR,
            "wheel_rear_right": REAR,
        },
        "steer_nodes": ["steer_rear_left", "steer_rear_right"],
        "lift": {"mast_inner": 0.5, "carriage": 0.5, "travel_m": 2.8, "speed_mps": 0.4},
        "forks": {"node": "carriage", "length_m": 1.07, "top_z_m": 0.085, "heel_x_m": 0.605},
        "max_speed_mps": 4.5,
    }


def chassis(m, n):
    side = [
        (-1.20, 0.20),
        (-1.20, 0.60),
        (-0.42, 0.60),
        (-0.36, 0.44),
        (0.02, 0.44),
        (0.10, 0.62),
        (0.33, 0.62),
        (0.33, 0.24),
        (0.20, 0.20),
    ]
    m.prism(n, "grey_paint", side, -0.36, 0.36, "y", 0.015)
    for s in (-1, 1):
        step = [(-0.42, 0.30), (-0.42, 0.585), (-1.18, 0.60), (-1.18, 0.26), (-0.50, 0.26)]
        m.prism(n, "paint", step, s * 0.34, s * 0.54, "y", 0.02)
        m.box(n, "plastic", (-0.40, s * 0.46, 0.325), (0.16, 0.16, 0.03), 0.006)
        m.box(n, "plastic", (-0.18, s * 0.40, 0.46), (0.56, 0.20, 0.035), 0.006)
        fender = [
            (-0.44, 0.56),
            (-0.42, 0.66),
            (-0.25, 0.745),
            (0.10, 0.765),
            (0.30, 0.70),
            (0.36, 0.60),
            (0.33, 0.59),
            (0.27, 0.67),
            (0.10, 0.73),
            (-0.23, 0.71),
            (-0.38, 0.63),
            (-0.41, 0.55),
        ]
        m.prism(n, "plastic", fender, s * 0.33, s * 0.60, "y", 0.008)
    hood = [
        (-1.36, 0.58),
        (-1.36, 0.99),
        (-1.30, 1.02),
        (-1.12, 0.965),
        (-0.60, 0.95),
        (-0.50, 0.90),
        (-0.46, 0.58),
    ]
    m.prism(n, "paint", hood, -0.44, 0.44, "y", 0.035, 3)
    m.box(n, "grey_paint", (-0.92, 0, 0.80), (0.70, 0.892, 0.012), 0.004)
    for s in (-1, 1):
        m.box(n, "plastic", (-1.20, s * 0.445, 0.82), (0.06, 0.02, 0.035), 0.006)
        for i in range(6):
            m.box(n, "plastic", (-0.72, s * 0.445, 0.66 + 0.028 * i), (0.22, 0.014, 0.012), 0.003)
    cowl = [(0.12, 0.58), (0.02, 0.75), (0.06, 1.16), (0.16, 1.22), (0.26, 1.16), (0.30, 0.62)]
    m.prism(n, "plastic", cowl, -0.42, 0.42, "y", 0.03, 3)
    m.box(n, "paint", (0.285, 0, 0.88), (0.03, 0.70, 0.40), 0.012)
    m.bar(n, "steel", (0.0, -0.36, FRONT), (0.0, 0.36, FRONT), 0.075, 16)
    m.box(n, "mast_steel", (0.0, 0.0, FRONT), (0.26, 0.40, 0.24), 0.03)
    m.box(n, "mast_steel", (-WHEELBASE, 0.0, REAR), (0.16, 0.66, 0.12), 0.02)


def counterweight(m, n):
    upper = [
        (-1.18, 0.60),
        (-1.18, 1.02),
        (-1.30, 1.07),
        (-1.70, 1.06),
        (-1.98, 0.99),
        (-2.09, 0.86),
        (-2.12, 0.66),
        (-2.10, 0.56),
        (-1.95, 0.56),
        (-1.90, 0.60),
        (-1.78, 0.655),
        (-1.60, 0.675),
        (-1.42, 0.655),
        (-1.28, 0.60),
    ]
    m.prism(n, "grey_paint", upper, -0.56, 0.56, "y", 0.05, 4)
    lower = [
        (-1.20, 0.24),
        (-1.20, 0.70),
        (-2.02, 0.70),
        (-2.10, 0.58),
        (-2.09, 0.30),
        (-1.98, 0.22),
    ]
    m.prism(n, "grey_paint", lower, -0.30, 0.30, "y", 0.03, 3)
    tail = [(-1.93, 0.24), (-1.93, 0.60), (-2.11, 0.60), (-2.10, 0.36), (-2.03, 0.24)]
    m.prism(n, "grey_paint", tail, -0.54, 0.54, "y", 0.03, 3)
    m.box(n, "mast_steel", (-2.115, 0, 0.42), (0.06, 0.20, 0.14), 0.015)
    m.bar(n, "chrome", (-2.12, 0, 0.36), (-2.12, 0, 0.56), 0.018, 12)
    m.box(n, "plastic", (-1.60, 0, 1.075), (0.46, 0.50, 0.03), 0.01)
    for i in range(8):
        m.box(n, "mast_steel", (-1.76 + 0.045 * i, 0, 1.095), (0.016, 0.44, 0.012), 0.003)
    for s in (-1, 1):
        m.box(n, "plastic", (-2.03, s * 0.45, 0.955), (0.10, 0.13, 0.14), 0.02)
        for dz, glass in ((0.035, "amber"), (0.0, "red"), (-0.035, "lens")):
            parts.egg(m, n, glass, (-2.083, s * 0.45, 0.955 + dz), (0.020, 0.10, 0.030), 3.2, 8, 14)


def guard(m, n):
    top = 2.20
    for s in (-1, 1):
        m.beam(n, "grey_paint", (0.24, s * 0.47, 0.70), (0.10, s * 0.47, 1.30), 0.055, 0.075)
        m.beam(n, "grey_paint", (0.10, s * 0.47, 1.28), (-0.16, s * 0.46, top), 0.055, 0.075)
        m.beam(n, "grey_paint", (-1.30, s * 0.47, 1.00), (-1.22, s * 0.46, top), 0.055, 0.085)
        m.beam(n, "grey_paint", (-0.10, s * 0.46, top), (-1.30, s * 0.46, top + 0.03), 0.055, 0.07)
        m.pipe(
            n,
            "grey_paint",
            [
                (-1.17, s * 0.40, 1.55),
                (-1.12, s * 0.38, 1.62),
                (-1.12, s * 0.38, 1.85),
                (-1.17, s * 0.40, 1.92),
            ],
            0.014,
            8,
        )
    for i, x in enumerate(np.linspace(-0.13, -1.26, 9)):
        m.beam(
            n,
            "grey_paint",
            (x, -0.46, top + 0.005 + 0.003 * i),
            (x, 0.46, top + 0.005 + 0.003 * i),
            0.03 if 0 < i < 8 else 0.06,
            0.05,
        )
    for s in (-1, 1):
        parts.lamp(m, n, (-0.04, s * 0.50, 2.05), (1, 0, -0.15))
        m.bar(n, "grey_paint", (-0.14, s * 0.47, 2.05), (-0.08, s * 0.50, 2.05), 0.015, 8)
        m.pipe(n, "seal", [(0.07, s * 0.48, 1.45), (0.10, s * 0.60, 1.52), (0.10, s * 0.66, 1.62)], 0.010, 8)
        parts.mirror(m, n, (0.105, s * 0.67, 1.70), (0.05, 0.13, 0.19))
        # A strip of light along the roof's edge.
        m.box(n, "lens", (-0.70, s * 0.492, top + 0.02), (0.90, 0.008, 0.018), 0.003)
    parts.lamp(m, n, (-1.33, 0.0, 2.16), (-1, 0, -0.3), 0.05)


def cockpit(m, n, belted):
    parts.seat(m, n, *SEAT)
    x, y, z = SEAT
    m.pipe(n, "belt", [(x - 0.10, 0.25, z + 0.16), (x + 0.14, 0.22, z + 0.30), (x + 0.18, 0.0, z + 0.33), (x + 0.14, -0.22, z + 0.30), (x - 0.06, -0.25, z + 0.16)], 0.016, 6) if belted else None
    parts.steering_wheel(m, n, WHEEL, (-0.62, 0, 0.78))
    m.box(n, "rubber", (-0.20, 0, 0.61), (0.60, 0.80, 0.03), 0.006)
    m.box(n, "plastic", (-0.20, 0, 0.53), (0.58, 0.70, 0.14), 0.01)
    for i in range(4):
        y = -0.12 - 0.07 * i
        m.bar(n, "steel", (0.08, y, 1.16), (0.02, y, 1.32), 0.008, 6)
        m.lathe(
            n,
            "plastic",
            (0.02, y, 1.31),
            (-0.35, 0, 1),
            [(0, 0.012), (0.02, 0.022), (0.05, 0.02), (0.06, 0.0)],
            10,
        )
    for y, x in ((-0.18, 0.02), (-0.02, 0.02), (0.14, 0.0)):
        m.box(n, "rubber", (x - 0.02, y, 0.70), (0.03, 0.10, 0.12), 0.008, around("Y", -35))
    m.lathe(
        n,
        "red",
        (-1.44, 0.40, 1.06),
        (0, 0, 1),
        [(0, 0.045), (0.24, 0.045), (0.28, 0.028), (0.30, 0.015), (0.30, 0.0)],
        18,
    )
    m.bar(n, "plastic", (-1.44, 0.40, 1.36), (-1.38, 0.40, 1.37), 0.012, 8)


def wheels(m, n):
    for side, s in (("left", 1), ("right", -1)):
        front = m.node(f"wheel_front_{side}", n, (0.0, s * TRACK / 2, FRONT))
        parts.wheel(m, front, FRONT, 0.225, s)
        steer = m.node(f"steer_rear_{side}", n, (-WHEELBASE, s * TRACK / 2, REAR))
        m.box(
            steer,
            "mast_steel",
            (-WHEELBASE, s * (TRACK / 2 - 0.10), REAR),
            (0.10, 0.05, 0.16),
            0.01,
        )
        rear = m.node(f"wheel_rear_{side}", steer, (-WHEELBASE, s * TRACK / 2, REAR))
        parts.wheel(m, rear, REAR, 0.185, s, 20)


def channel(m, node, x, y, z0, z1, inward, depth=0.13, flange=0.05):
    """An upright C profile that opens inwards."""
    t = 0.016
    o = [
        (-depth / 2, 0),
        (depth / 2, 0),
        (depth / 2, flange),
        (depth / 2 - t, flange),
        (depth / 2 - t, t),
        (-depth / 2 + t, t),
        (-depth / 2 + t, flange),
        (-depth / 2, flange),
    ]
    outline = [(x + a, y + inward * b) for a, b in (o if inward > 0 else o)]
    m.prism(node, "mast_steel", outline, z0, z1, "z", 0.003, 1)


def mast(m, n):
    x = 0.43
    for s in (-1, 1):
        channel(m, n, x, s * 0.40, 0.08, 2.08, -s)
        m.bar(n, "mast_steel", (0.30, s * 0.34, 0.30), (x - 0.05, s * 0.36, 0.36), 0.045, 12)
        m.bar(n, "mast_steel", (0.02, s * 0.28, 0.62), (0.22, s * 0.31, 0.66), 0.035, 14)
        m.bar(n, "chrome", (0.20, s * 0.31, 0.655), (x - 0.04, s * 0.33, 0.70), 0.020, 12)
    m.box(n, "mast_steel", (x - 0.03, 0, 2.04), (0.05, 0.80, 0.09), 0.008)
    m.box(n, "mast_steel", (x - 0.05, 0, 1.25), (0.03, 0.80, 0.10), 0.006)
    m.box(n, "mast_steel", (x - 0.02, 0, 0.14), (0.09, 0.80, 0.10), 0.008)
    for s in (-1, 1):
        m.bar(n, "mast_steel", (x - 0.075, s * 0.29, 0.16), (x - 0.075, s * 0.29, 1.90), 0.034, 14)
    inner = m.node("mast_inner", n, (x, 0.0, 0.0))
    for s in (-1, 1):
        channel(m, inner, x + 0.01, s * 0.335, 0.10, 2.05, -s, 0.115, 0.045)
        m.bar(inner, "chrome", (x - 0.075, s * 0.29, 0.40), (x - 0.075, s * 0.29, 2.06), 0.020, 12)
        m.lathe(
            inner,
            "steel",
            (x + 0.05, s * 0.085, 1.95),
            (0, 1, 0),
            [
                (-0.02, 0.03),
                (-0.02, 0.06),
                (-0.012, 0.06),
                (-0.012, 0.05),
                (0.012, 0.05),
                (0.012, 0.06),
                (0.02, 0.06),
                (0.02, 0.03),
            ],
            20,
        )
        chain(m, inner, x + 0.108, s * 0.085, 0.55, 1.95)
        m.pipe(
            inner,
            "rubber",
            [
                (x + 0.10, s * 0.16, 0.5),
                (x + 0.10, s * 0.16, 1.90),
                (x + 0.04, s * 0.16, 1.98),
                (x - 0.04, s * 0.16, 1.90),
                (x - 0.05, s * 0.16, 1.2),
            ],
            0.012,
            6,
        )
    m.box(inner, "mast_steel", (x - 0.01, 0, 2.02), (0.09, 0.70, 0.07), 0.008)
    m.box(inner, "mast_steel", (x - 0.02, 0, 0.62), (0.05, 0.64, 0.09), 0.006)
    m.box(inner, "mast_steel", (x - 0.02, 0, 1.40), (0.04, 0.64, 0.07), 0.006)
    m.bar(inner, "mast_steel", (x + 0.02, 0, 0.14), (x + 0.02, 0, 1.24), 0.050, 18)
    m.bar(inner, "chrome", (x + 0.02, 0, 1.20), (x + 0.02, 0, 1.93), 0.030, 14)
    carriage(m, x)


def chain(m, node, x, y, z0, z1):
    """Leaf chain: alternate plates."""
    pitch = 0.05
    for i in range(int((z1 - z0) / pitch)):
        z = z0 + pitch * (i + 0.5)
        w = 0.034 if i % 2 else 0.022
        m.box(node, "steel", (x, y, z), (0.010, w, pitch * 0.92), 0.0)


def carriage(m, x):
    c = m.node("carriage", "mast_inner", (x + 0.10, 0.0, 0.0))
    for z in (0.16, 0.53):
        m.box(c, "mast_steel", (x + 0.10, 0, z), (0.045, 1.02, 0.10), 0.008)
        for i in range(17):
            m.box(c, "steel", (x + 0.125, -0.48 + 0.06 * i, z + 0.045), (0.012, 0.018, 0.02), 0.002)
    for s in (-1, 1):
        m.box(c, "mast_steel", (x + 0.05, s * 0.24, 0.345), (0.10, 0.05, 0.50), 0.008)
        for z in (0.20, 0.48):
            m.bar(c, "steel", (x + 0.03, s * 0.26, z), (x + 0.03, s * 0.31, z), 0.045, 16)
    rest = [(-0.50, 0.56), (-0.50, 1.24), (0.50, 1.24), (0.50, 0.56)]
    for (a, b), (d, e) in zip(rest, rest[1:]):
        m.beam(c, "mast_steel", (x + 0.10, a, b), (x + 0.10, d, e), 0.03, 0.04, 0.005, (1, 0, 0))
    for i in range(7):
        y = -0.375 + 0.125 * i
        m.beam(
            c, "mast_steel", (x + 0.10, y, 0.56), (x + 0.10, y, 1.24), 0.014, 0.03, 0.003, (1, 0, 0)
        )
    m.beam(c, "mast_steel", (x + 0.10, -0.5, 0.90), (x + 0.10, 0.5, 0.90), 0.02, 0.03, 0.003)
    for s in (-1, 1):
        y = 0.27 * s
        blade = [
            (x + 0.13, 0.60),
            (x + 0.175, 0.60),
            (x + 0.18, 0.11),
            (x + 0.21, 0.085),
            (x + 1.17, 0.075),
            (x + 1.24, 0.064),
            (x + 1.24, 0.055),
            (x + 0.75, 0.042),
            (x + 0.17, 0.038),
            (x + 0.13, 0.06),
        ]
        m.prism(c, "steel", blade, y - 0.06, y + 0.06, "y", 0.005, 1)
        m.box(c, "mast_steel", (x + 0.15, y, 0.60), (0.07, 0.13, 0.05), 0.008)


def signs(m, n):
    for s in (-1, 1):
        parts.label(m, n, "name", (-0.92, s * 0.4425, 0.885), (s * -0.62, 0, 0), (0, 0, 0.105))
        parts.label(m, n, "number", (-1.42, s * 0.5615, 0.86), (s * -0.20, 0, 0), (0, 0, 0.20))
        parts.label(m, n, "warning", (-1.72, s * 0.5615, 0.86), (s * -0.15, 0, 0), (0, 0, 0.15))
        parts.label(m, n, "plate", (-0.62, s * 0.5415, 0.46), (s * -0.18, 0, 0), (0, 0, 0.12))
        parts.label(m, n, "no_riders", (-0.95, s * 0.5415, 0.46), (s * -0.14, 0, 0), (0, 0, 0.14))
        parts.label(m, n, "fork_warning", (0.43, s * 0.4015, 1.55), (s * -0.11, 0, 0), (0, 0, 0.09))
        parts.label(m, n, "hazard", (0.43, s * 0.4015, 0.75), (0, 0, s * 0.90), (s * 0.12, 0, 0))
    parts.label(m, n, "hazard", (-2.1165, 0, 0.74), (0, -0.86, 0), (-0.012, 0, 0.10))
    parts.label(m, n, "load", (0.07, 0.25, 1.10), (0, -0.16, 0), (0.02, 0, 0.13))
    parts.label(m, n, "panel", (0.115, 0.0, 1.2135), (0, -0.22, 0), (0.09, 0, 0.052))
    parts.label(m, n, "name", (0.301, 0, 0.92), (0, 0.60, 0), (0, 0, 0.10))
