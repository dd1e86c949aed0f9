"""A hand pallet jack; origin on the floor below the fork rollers. It is pushed along +x by its handle."""

import numpy as np

from . import parts
from .solid import Machine

WHEELBASE, STEER, ROLLER = 1.20, 0.100, 0.040
HANDLE = (-1.62, 1.05)  # x and z of the handle bar


def build(name, folder, path):
    m = Machine(name, folder)
    parts.materials(m, "AISLE P25", "P3", (0.86, 0.62, 0.08), (0.16, 0.16, 0.17), seed=13)
    frame(m, name)
    rollers(m, name)
    tiller(m)
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the fork rollers' axle (not steered)",
        "wheelbase_m": WHEELBASE,
        "track_m": 0.36,
        "steered": ["rear"],
        "max_steer_deg": 90.0,
        "wheel_radius_m": {
            "wheel_rear_left": STEER,
            "wheel_rear_right": STEER,
            "wheel_front_left": ROLLER,
            "wheel_front_right": ROLLER,
        },
        "steer_nodes": ["steer_rear"],
        "handle_m": [HANDLE[0], 0.0, HANDLE[1]],
        "forks": {"node": "pallet_jack", "length_m": 1.15, "top_z_m": 0.085, "heel_x_m": -0.98},
        "max_speed_mps": 1.6,
    }


def frame(m, n):
    for s in (-1, 1):
        y = s * 0.19
        blade = [
            (-1.02, 0.085),
            (0.12, 0.085),
            (0.18, 0.06),
            (0.18, 0.045),
            (-0.10, 0.045),
            (-1.02, 0.040),
        ]
        m.prism(n, "paint", blade, y - 0.08, y + 0.08, "y", 0.006, 2)
        for x in (-0.16, 0.10):
            m.box(n, "mast_steel", (x, y, 0.055), (0.03, 0.12, 0.05), 0.004)
        parts.label(m, n, "hazard", (-0.40, y, 0.0865), (0.50, 0, 0), (0, 0.08, 0))
        m.bar(n, "steel", (-0.95, y, 0.052), (-0.10, y, 0.052), 0.012, 8)
    m.box(n, "paint", (-1.04, 0, 0.17), (0.07, 0.54, 0.22), 0.02)
    hump = [
        (-1.06, 0.10),
        (-1.06, 0.44),
        (-1.12, 0.48),
        (-1.24, 0.46),
        (-1.26, 0.30),
        (-1.16, 0.20),
    ]
    m.prism(n, "paint", hump, -0.11, 0.11, "y", 0.02, 3)
    m.bar(n, "mast_steel", (-WHEELBASE, 0, 0.20), (-WHEELBASE, 0, 0.52), 0.055, 18)
    m.bar(n, "chrome", (-WHEELBASE, 0, 0.50), (-WHEELBASE, 0, 0.58), 0.030, 14)
    parts.label(m, n, "warning", (-1.003, 0.16, 0.19), (0, 0.12, 0), (0, 0, 0.12))
    parts.label(m, n, "load", (-1.003, -0.16, 0.19), (0, 0.14, 0), (0, 0, 0.12))


def rollers(m, n):
    for side, s in (("left", 1), ("right", -1)):
        wheel = m.node(f"wheel_front_{side}", n, (0.0, s * 0.19, ROLLER))
        m.lathe(
            wheel,
            "lens",
            (0.0, s * 0.19, ROLLER),
            (0, 1, 0),
            [
                (-0.045, 0.0),
                (-0.045, 0.034),
                (-0.04, 0.040),
                (0.04, 0.040),
                (0.045, 0.034),
                (0.045, 0.0),
            ],
            24,
        )
    m.node("steer_rear", n, (-WHEELBASE, 0.0, STEER))
    for side, s in (("left", 1), ("right", -1)):
        wheel = m.node(f"wheel_rear_{side}", "steer_rear", (-WHEELBASE, s * 0.085, STEER))
        parts.wheel(m, wheel, STEER, 0.05, s, 0, 0.72, 5)
    m.bar("steer_rear", "steel", (-WHEELBASE, -0.08, STEER), (-WHEELBASE, 0.08, STEER), 0.02, 10)
    m.box("steer_rear", "mast_steel", (-WHEELBASE, 0, 0.15), (0.12, 0.07, 0.14), 0.015)


def tiller(m):
    """The handle turns with the steered wheels: it hangs below their node."""
    t = "steer_rear"
    foot, x, z = np.array([-1.25, 0.0, 0.40]), *HANDLE
    m.box(t, "mast_steel", foot + [0.02, 0, 0.0], (0.10, 0.14, 0.10), 0.012)
    m.bar(t, "paint", foot, (x + 0.06, 0, z - 0.16), 0.024, 14)
    loop = [
        (x + 0.06, 0.0, z - 0.17),
        (x + 0.045, 0.10, z - 0.10),
        (x + 0.01, 0.185, z - 0.02),
        (x, 0.19, z),
        (x, 0.15, z + 0.015),
        (x, -0.15, z + 0.015),
        (x, -0.19, z),
        (x + 0.01, -0.185, z - 0.02),
        (x + 0.045, -0.10, z - 0.10),
        (x + 0.06, 0.0, z - 0.17),
    ]
    m.pipe(t, "paint", loop, 0.015, 10)
    for s in (-1, 1):
        m.bar(t, "rubber", (x, s * 0.06, z + 0.015), (x, s * 0.16, z + 0.015), 0.020, 12)
    m.bar(t, "red", (x + 0.03, 0.0, z - 0.02), (x + 0.055, 0.0, z - 0.12), 0.012, 8)
    m.box(t, "plastic", (x + 0.055, 0, z - 0.14), (0.05, 0.07, 0.09), 0.012)
