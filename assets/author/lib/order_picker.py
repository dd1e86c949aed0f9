"""A high-level order picker: the operator's cabin rises with the forks on the mast. Origin on the floor
below the load wheels; it steers with the drive wheel behind."""

import numpy as np

from . import car_parts, forklift, parts, standing
from .solid import Machine

WHEELBASE, TRACK = 1.50, 0.84
LOAD, DRIVE = 0.075, 0.16
FLOOR = 0.24  # of the cabin, lowered
COLOUR = (0.88, 0.66, 0.08)
MAST = -0.62


def build(name, folder, path, driver):
    m = Machine(name, folder)
    parts.materials(m, "AISLE P10", "44", COLOUR, (0.36, 0.37, 0.38), seed=44)
    m.plain("mirror", (0.90, 0.90, 0.90), 0.05, 1.0)
    m.plain("seal", (0.12, 0.12, 0.125), 0.5)
    m.plain("bowl", (0.62, 0.63, 0.64), 0.25, 0.6)
    m.plain("glass", (0.30, 0.33, 0.34), 0.06)
    chassis(m, name)
    mast(m, name)
    cabin(m, driver)
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the middle of the load wheels' axle (front, not steered)",
        "wheelbase_m": WHEELBASE,
        "track_m": TRACK,
        "steered": ["rear"],
        "max_steer_deg": 90.0,
        "wheel_radius_m": {"wheel_front_left": LOAD, "wheel_front_right": LOAD, "wheel_rear": DRIVE},
        "steer_nodes": ["steer_rear"],
        "lift": {"mast_inner": 0.5, "carriage": 0.5, "travel_m": 3.0, "speed_mps": 0.3},
        "forks": {"node": "carriage", "length_m": 1.10, "top_z_m": 0.085, "heel_x_m": 0.46},
        "max_speed_mps": 2.5,
    }


def chassis(m, n):
    side = [(-1.86, 0.06), (-1.90, 0.20), (-1.90, 0.80), (-1.84, 0.92), (-1.00, 0.92), (-0.94, 0.86), (-0.94, 0.06)]
    m.prism(n, "paint", side, -0.44, 0.44, "y", 0.045, 4)
    m.box(n, "grey_paint", (-1.40, 0, 0.93), (0.70, 0.70, 0.03), 0.012, segments=2)
    for s in (-1, 1):
        for i in range(7):
            m.box(n, "seal", (-1.60 + 0.055 * i, s * 0.441, 0.62), (0.026, 0.012, 0.20), 0.003)
        m.box(n, "grey_paint", (-0.42, s * TRACK / 2, 0.10), (1.10, 0.11, 0.11), 0.015)
        nose = [(-0.02, 0.155), (0.06, 0.14), (0.11, 0.09), (0.11, 0.03), (-0.02, 0.03)]
        m.prism(n, "grey_paint", nose, s * TRACK / 2 - 0.055, s * TRACK / 2 + 0.055, "y", 0.008, 1)
        parts.label(m, n, "hazard", (-0.45, s * (TRACK / 2 + 0.0565), 0.10), (s * -0.80, 0, 0), (0, 0, 0.08))
        parts.label(m, n, "name", (-1.42, s * 0.4415, 0.36), (s * -0.62, 0, 0), (0, 0, 0.105))
        parts.label(m, n, "number", (-1.10, s * 0.4415, 0.62), (s * -0.16, 0, 0), (0, 0, 0.16))
        parts.label(m, n, "lamp", (-1.9015, s * 0.36, 0.70), (0, -0.08, 0), (0, 0, 0.16))
        wheel = m.node(f"wheel_front_{'left' if s > 0 else 'right'}", n, (0.0, s * TRACK / 2, LOAD))
        parts.wheel(m, wheel, LOAD, 0.085, s, 0, 0.70, 5)
    parts.label(m, n, "stripes_red", (-1.9015, 0, 0.30), (0, -0.70, 0), (0, 0, 0.09))
    parts.label(m, n, "warning", (-1.9015, 0.0, 0.62), (0, -0.16, 0), (0, 0, 0.16))
    m.box(n, "rubber", (-1.90, 0, 0.13), (0.05, 0.80, 0.09), 0.02, segments=3)
    m.node("steer_rear", n, (-WHEELBASE, 0.0, DRIVE))
    wheel = m.node("wheel_rear", "steer_rear", (-WHEELBASE, 0.0, DRIVE))
    parts.wheel(m, wheel, DRIVE, 0.11, 1, 0, 0.65, 6)
    m.node("beacon", n, (-1.72, 0.30, 0.93))
    parts.beacon(m, "beacon")


def mast(m, n):
    x = MAST
    for s in (-1, 1):
        forklift.channel(m, n, x, s * 0.38, 0.08, 2.35, -s, 0.14)
        m.beam(n, "grey_paint", (x - 0.30, s * 0.38, 0.92), (x - 0.06, s * 0.38, 1.70), 0.05, 0.06)
        m.bar(n, "mast_steel", (x - 0.085, s * 0.25, 0.16), (x - 0.085, s * 0.25, 2.05), 0.032, 14)
        parts.label(m, n, "fork_warning", (x, s * 0.3815, 1.5), (s * -0.12, 0, 0), (0, 0, 0.10))
    for z in (0.14, 1.25, 2.31):
        m.box(n, "mast_steel", (x - 0.055, 0, z), (0.04, 0.76, 0.09), 0.006)
    inner = m.node("mast_inner", n, (x, 0.0, 0.0))
    for s in (-1, 1):
        forklift.channel(m, inner, x + 0.01, s * 0.315, 0.10, 2.30, -s, 0.12, 0.045)
        m.bar(inner, "chrome", (x - 0.085, s * 0.25, 0.4), (x - 0.085, s * 0.25, 2.30), 0.019, 12)
        forklift.chain(m, inner, x + 0.08, s * 0.10, 0.5, 2.15)
        m.pipe(inner, "rubber", [(x + 0.05, s * 0.18, 0.5), (x + 0.05, s * 0.18, 2.05), (x, s * 0.18, 2.16), (x - 0.05, s * 0.18, 2.05), (x - 0.05, s * 0.18, 1.2)], 0.013, 8)
    for z in (0.55, 1.45, 2.26):
        m.box(inner, "mast_steel", (x - 0.01, 0, z), (0.05, 0.64, 0.07), 0.006)


def cabin(m, driver):
    """Platform, console, side gates, roof and forks: all that goes up."""
    c = m.node("carriage", "mast_inner", (MAST + 0.10, 0.0, 0.0))
    back, front, wide, top = MAST + 0.10, 0.40, 0.46, 2.42
    m.box(c, "grey_paint", ((back + front) / 2, 0, FLOOR - 0.04), (front - back, 2 * wide, 0.08), 0.012)
    m.box(c, "rubber", ((back + front) / 2, 0, FLOOR + 0.006), (front - back - 0.06, 2 * wide - 0.06, 0.014), 0.003)
    for s in (-1, 1):
        m.beam(c, "paint", (back + 0.03, s * (wide - 0.03), FLOOR - 0.04), (back + 0.03, s * (wide - 0.03), top), 0.05, 0.06)
        m.beam(c, "paint", (front - 0.04, s * (wide - 0.03), FLOOR), (front - 0.04, s * (wide - 0.03), FLOOR + 1.0), 0.045, 0.05)
        m.beam(c, "paint", (back + 0.03, s * (wide - 0.03), top), (front - 0.06, s * (wide - 0.03), top), 0.05, 0.05)
        m.beam(c, "paint", (front - 0.04, s * (wide - 0.03), FLOOR + 1.0), (front - 0.10, s * (wide - 0.03), top), 0.045, 0.05)
        for z in (0.55, 1.05):
            m.pipe(c, "amber", [(back + 0.06, s * (wide - 0.02), FLOOR + z), (front - 0.08, s * (wide - 0.02), FLOOR + z)], 0.018, 10)
        parts.lamp(m, c, (front - 0.03, s * (wide - 0.10), top - 0.10), (1, 0, -0.25), 0.05)
        car_parts.egg(m, c, "seal", (front - 0.02, s * (wide + 0.06), FLOOR + 1.42), (0.06, 0.13, 0.18), 3.2, cut=-0.5)
        car_parts.egg(m, c, "mirror", (front - 0.038, s * (wide + 0.06), FLOOR + 1.42), (0.01, 0.11, 0.155), 4.5)
        m.bar(c, "seal", (front - 0.05, s * (wide - 0.03), FLOOR + 1.34), (front - 0.02, s * (wide + 0.05), FLOOR + 1.38), 0.010, 8)
    for t in np.linspace(back + 0.10, front - 0.12, 7):
        m.beam(c, "paint", (t, -wide + 0.03, top + 0.01), (t, wide - 0.03, top + 0.01), 0.025, 0.04)
    # The console before the operator, towards the mast the back rest.
    console = [(front - 0.26, FLOOR + 0.82), (front - 0.22, FLOOR + 1.02), (front - 0.06, FLOOR + 1.08), (front, FLOOR + 1.02), (front - 0.01, FLOOR + 0.62), (front - 0.14, FLOOR + 0.62)]
    m.prism(c, "grey_paint", console, -wide + 0.06, wide - 0.06, "y", 0.025, 3)
    m.box(c, "grey_paint", (front - 0.03, 0, FLOOR + 0.34), (0.05, 2 * wide - 0.08, 0.60), 0.015)
    parts.label(m, c, "panel", (front - 0.243, 0.0, FLOOR + 0.93), (0, -0.24, 0), (0.03, 0, 0.13))
    for s in (-1, 1):
        m.bar(c, "plastic", (front - 0.20, s * 0.17, FLOOR + 1.00), (front - 0.235, s * 0.17, FLOOR + 1.13), 0.017, 10)
        car_parts.egg(m, c, "red" if s > 0 else "plastic", (front - 0.24, s * 0.17, FLOOR + 1.15), (0.05, 0.05, 0.06), 2.4, 8, 12)
    m.box(c, "vinyl", (back + 0.09, 0, FLOOR + 0.90), (0.07, 0.50, 0.26), 0.03, segments=3)
    parts.label(m, c, "name", (front - 0.003, 0, FLOOR + 0.36), (0, 0.62, 0), (0, 0, 0.10))
    for s in (-1, 1):
        y = 0.20 * s
        blade = [(front + 0.0, 0.22), (front + 0.05, 0.22), (front + 0.06, 0.085), (front + 1.08, 0.078), (front + 1.14, 0.066), (front + 1.14, 0.05), (front + 0.70, 0.036), (front + 0.04, 0.034), (front, 0.06)]
        m.prism(c, "steel", blade, y - 0.075, y + 0.075, "y", 0.005, 1)
    m.box(c, "mast_steel", (front + 0.01, 0, 0.20), (0.04, 0.62, 0.10), 0.008)
    standing.add(m, c, driver, (back + 0.30, 0.0, FLOOR + 0.014), (front - 0.235, 0.0, FLOOR + 1.12))
