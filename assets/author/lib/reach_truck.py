"""A reach truck with its driver; origin on the floor below the middle of the load wheels."""

import numpy as np

from . import forklift, parts, seated
from .solid import Machine

WHEELBASE, TRACK = 1.45, 1.06
LOAD, DRIVE = 0.155, 0.17
SEAT, WHEEL = (-1.62, 0.08, 0.62), (-1.20, 0.08, 0.95)


def build(name, folder, path, driver=None):
    m = Machine(name, folder)
    parts.materials(m, "AISLE R16", "21", (0.82, 0.80, 0.74), (0.62, 0.10, 0.09), seed=7)
    body(m, name)
    cab(m, name)
    legs(m, name)
    mast(m, name)
    signs(m, name)
    m.node("beacon", name, (-1.55, -0.30, 2.24))
    parts.beacon(m, "beacon")
    if driver:
        seated.add(m, name, driver, SEAT, WHEEL, 0.34)
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the middle of the load wheels' axle (front, not steered)",
        "wheelbase_m": WHEELBASE,
        "track_m": TRACK,
        "steered": ["rear"],
        "max_steer_deg": 85.0,
        "wheel_radius_m": {
            "wheel_front_left": LOAD,
            "wheel_front_right": LOAD,
            "wheel_rear": DRIVE,
        },
        "steer_nodes": ["steer_rear"],
        "lift": {"mast_inner": 0.5, "carriage": 0.5, "travel_m": 4.0, "speed_mps": 0.4},
        "forks": {"node": "carriage", "length_m": 1.07, "top_z_m": 0.085, "heel_x_m": -0.355},
        "max_speed_mps": 3.0,
    }


def body(m, n):
    shell = [
        (-2.02, 0.09),
        (-2.05, 0.30),
        (-2.04, 0.86),
        (-1.96, 1.06),
        (-1.86, 1.10),
        (-1.82, 0.60),
        (-1.40, 0.58),
        (-1.38, 0.34),
        (-0.92, 0.34),
        (-0.92, 0.09),
    ]
    m.prism(n, "paint", shell, -0.60, 0.60, "y", 0.035, 3)
    m.box(n, "grey_paint", (-0.86, 0, 0.55), (0.34, 1.16, 0.86), 0.03)
    m.box(n, "plastic", (-1.15, 0, 0.345), (0.44, 1.10, 0.03), 0.006)
    dash = [
        (-1.04, 0.62),
        (-1.16, 0.86),
        (-1.10, 1.08),
        (-0.96, 1.12),
        (-0.72, 1.02),
        (-0.70, 0.62),
    ]
    m.prism(n, "plastic", dash, -0.52, 0.52, "y", 0.025, 3)
    m.box(n, "grey_paint", (-1.93, 0, 0.20), (0.20, 1.21, 0.18), 0.03)
    for s in (-1, 1):
        for i in range(7):
            m.box(n, "plastic", (-1.62 + 0.05 * i, s * 0.602, 0.44), (0.028, 0.014, 0.16), 0.003)


def cab(m, n):
    top = 2.18
    for s in (-1, 1):
        m.beam(n, "plastic", (-0.78, s * 0.55, 1.0), (-0.84, s * 0.52, top), 0.05, 0.09)
        m.beam(n, "plastic", (-1.94, s * 0.55, 1.05), (-1.86, s * 0.52, top), 0.05, 0.10)
        m.beam(n, "plastic", (-0.82, s * 0.52, top), (-1.88, s * 0.52, top), 0.05, 0.07)
        parts.lamp(m, n, (-0.74, s * 0.50, 2.06), (1, 0, -0.2), 0.05)
        m.bar(n, "plastic", (-0.81, s * 0.50, 2.08), (-0.78, s * 0.50, 2.06), 0.014, 8)
    for x in np.linspace(-0.84, -1.86, 8):
        m.beam(n, "plastic", (x, -0.52, top), (x, 0.52, top), 0.03, 0.045)
    parts.seat(m, n, *SEAT, scale=0.95)
    parts.steering_wheel(m, n, WHEEL, (-0.55, 0, 0.84), 0.15)
    for i in range(3):
        m.bar(
            n, "steel", (-1.08, -0.20 - 0.08 * i, 1.08), (-1.11, -0.20 - 0.08 * i, 1.20), 0.009, 6
        )
        m.lathe(
            n,
            "plastic",
            (-1.11, -0.20 - 0.08 * i, 1.19),
            (-0.2, 0, 1),
            [(0, 0.012), (0.02, 0.022), (0.05, 0.02), (0.06, 0)],
            10,
        )


def legs(m, n):
    for side, s in (("left", 1), ("right", -1)):
        y = s * TRACK / 2
        m.box(n, "grey_paint", (-0.42, y, 0.20), (1.06, 0.14, 0.17), 0.012)
        nose = [
            (0.06, 0.285),
            (0.18, 0.25),
            (0.30, 0.14),
            (0.30, 0.06),
            (0.24, 0.06),
            (0.20, 0.16),
            (0.10, 0.20),
            (-0.12, 0.20),
            (-0.20, 0.12),
            (-0.24, 0.115),
            (-0.24, 0.285),
        ]
        m.prism(n, "grey_paint", nose, y - 0.075, y + 0.075, "y", 0.008, 1)
        wheel = m.node(f"wheel_front_{side}", n, (0.0, y, LOAD))
        parts.wheel(m, wheel, LOAD, 0.115, s, 0, 0.70, 6)
    m.node("steer_rear", n, (-WHEELBASE, 0.10, DRIVE))
    wheel = m.node("wheel_rear", "steer_rear", (-WHEELBASE, 0.10, DRIVE))
    parts.wheel(m, wheel, DRIVE, 0.13, 1, 0, 0.65, 6)


def mast(m, n):
    x = -0.53
    for s in (-1, 1):
        forklift.channel(m, n, x, s * 0.40, 0.10, 2.45, -s, 0.14)
        m.bar(n, "mast_steel", (x - 0.08, s * 0.28, 0.16), (x - 0.08, s * 0.28, 2.2), 0.032, 14)
    for z in (0.16, 1.35, 2.41):
        m.box(n, "mast_steel", (x - 0.05, 0, z), (0.04, 0.80, 0.09), 0.006)
    inner = m.node("mast_inner", n, (x, 0.0, 0.0))
    for s in (-1, 1):
        forklift.channel(m, inner, x + 0.01, s * 0.335, 0.10, 2.42, -s, 0.12, 0.045)
        m.bar(inner, "chrome", (x - 0.08, s * 0.28, 0.4), (x - 0.08, s * 0.28, 2.42), 0.019, 12)
        forklift.chain(m, inner, x + 0.105, s * 0.085, 0.5, 2.25)
        m.pipe(
            inner,
            "rubber",
            [
                (x + 0.10, s * 0.17, 0.5),
                (x + 0.10, s * 0.17, 2.2),
                (x + 0.03, s * 0.17, 2.3),
                (x - 0.05, s * 0.17, 2.2),
                (x - 0.05, s * 0.17, 1.3),
            ],
            0.012,
            6,
        )
    for z in (0.60, 1.5, 2.38):
        m.box(inner, "mast_steel", (x - 0.01, 0, z), (0.05, 0.68, 0.07), 0.006)
    m.bar(inner, "chrome", (x + 0.02, 0, 0.2), (x + 0.02, 0, 2.3), 0.030, 14)
    forklift.carriage(m, x - 0.0)


def signs(m, n):
    for s in (-1, 1):
        parts.label(m, n, "name", (-1.62, s * 0.6015, 0.30), (s * -0.60, 0, 0), (0, 0, 0.10))
        parts.label(m, n, "number", (-1.93, s * 0.6015, 0.72), (s * -0.18, 0, 0), (0, 0, 0.18))
        parts.label(m, n, "warning", (-0.86, s * 0.5815, 0.78), (s * -0.16, 0, 0), (0, 0, 0.16))
        parts.label(m, n, "no_riders", (-0.86, s * 0.5815, 0.52), (s * -0.15, 0, 0), (0, 0, 0.15))
        parts.label(
            m, n, "hazard", (-0.44, s * (TRACK / 2 + 0.0715), 0.20), (s * -0.80, 0, 0), (0, 0, 0.10)
        )
        parts.label(m, n, "lamp", (-2.0535, s * 0.50, 0.78), (0, -0.08, 0), (0, 0, 0.16))
        parts.label(m, n, "fork_warning", (-0.53, s * 0.4015, 1.5), (s * -0.12, 0, 0), (0, 0, 0.10))
    parts.label(m, n, "name", (-2.0535, 0, 0.70), (0, -0.70, 0), (0, 0, 0.12))
    parts.label(m, n, "stripes_red", (-2.036, 0, 0.20), (0, -1.05, 0), (0, 0, 0.12))
    parts.label(m, n, "panel", (-1.135, -0.05, 0.975), (0, -0.22, 0), (0.03, 0, 0.10))
