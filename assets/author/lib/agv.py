"""A differential-drive AGV with a lifting plate and a sensor column; origin between its drive wheels."""

from . import kit_parts, parts
from .solid import Machine

# The castors are bodywork: they neither swivel nor roll, so they stay clear of the floor.
DRIVE, CASTOR, CASTOR_GAP, TRACK = 0.10, 0.050, 0.006, 0.62


def build(name, folder, path):
    m = Machine(name, folder)
    parts.materials(m, "AISLE M6", "A4", (0.86, 0.87, 0.88), (0.10, 0.33, 0.55), seed=17)
    hull(m, name)
    wheels(m, name)
    column(m, name)
    load(m, name)
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the middle of the drive wheels' axle; turns on the spot",
        "wheelbase_m": 0.0,
        "track_m": TRACK,
        "steered": [],
        "drive": "differential",
        "wheel_radius_m": {"wheel_left": DRIVE, "wheel_right": DRIVE},
        "steer_nodes": [],
        "lift": {"plate": 1.0, "travel_m": 0.06, "speed_mps": 0.03},
        "max_speed_mps": 1.6,
        "max_yaw_rate_dps": 90.0,
    }


def hull(m, n):
    outline = [
        (-0.62, -0.30),
        (-0.56, -0.37),
        (-0.30, -0.39),
        (0.30, -0.39),
        (0.56, -0.37),
        (0.66, -0.26),
        (0.68, 0.0),
        (0.66, 0.26),
        (0.56, 0.37),
        (0.30, 0.39),
        (-0.30, 0.39),
        (-0.56, 0.37),
        (-0.62, 0.30),
    ]
    m.prism(n, "paint", outline, 0.17, 0.30, "z", 0.03, 3)
    inset = [(0.97 * x, 0.97 * y) for x, y in outline]
    m.prism(n, "plastic", inset, 0.115, 0.18, "z", 0.01, 1)
    m.prism(n, "plastic", [(1.02 * x, 1.02 * y) for x, y in outline], 0.05, 0.12, "z", 0.018, 2)
    m.prism(
        n, "grey_paint", [(0.90 * x, 0.90 * y) for x, y in outline], 0.295, 0.315, "z", 0.006, 1
    )
    for x, y in ((0.60, 0.30), (-0.56, -0.32)):
        m.lathe(
            n,
            "plastic",
            (x, y, 0.145),
            (0, 0, 1),
            [(-0.03, 0.0), (-0.03, 0.06), (0.03, 0.06), (0.03, 0.0)],
            24,
        )
        m.lathe(n, "red", (x, y, 0.145), (0, 0, 1), [(-0.012, 0.0605), (0.012, 0.0605)], 24)
    for s in (-1, 1):
        m.lathe(
            n,
            "red",
            (0.42, s * 0.33, 0.315),
            (0, 0, 1),
            [
                (0, 0.03),
                (0.02, 0.03),
                (0.022, 0.02),
                (0.04, 0.02),
                (0.045, 0.034),
                (0.06, 0.034),
                (0.065, 0),
            ],
            18,
        )
        m.box(n, "amber", (0.0, s * 0.391, 0.25), (0.50, 0.012, 0.02), 0.004)
        parts.label(m, n, "name", (0.0, s * 0.3925, 0.215), (s * -0.36, 0, 0), (0, 0, 0.06))
        parts.label(m, n, "warning", (-0.24, s * 0.3925, 0.235), (s * -0.09, 0, 0), (0, 0, 0.09))
        parts.label(m, n, "hazard", (0.0, s * 0.3995, 0.085), (s * -0.50, 0, 0), (0, 0, 0.05))
    parts.label(m, n, "stripes_red", (0.6965, 0, 0.085), (0, 0.36, 0), (0, 0, 0.05))
    parts.lamp(m, n, (0.665, 0.10, 0.235), (1, 0, 0), 0.028)
    parts.lamp(m, n, (0.665, -0.10, 0.235), (1, 0, 0), 0.028)


def wheels(m, n):
    for side, s in (("left", 1), ("right", -1)):
        wheel = m.node(f"wheel_{side}", n, (0.0, s * TRACK / 2, DRIVE))
        parts.wheel(m, wheel, DRIVE, 0.06, s, 0, 0.72, 5)
    for x, y in ((0.48, 0.24), (0.48, -0.24), (-0.48, 0.24), (-0.48, -0.24)):
        m.lathe(
            n,
            "rubber",
            (x, y, CASTOR + CASTOR_GAP),
            (0, 1, 0),
            [
                (-0.018, 0.0),
                (-0.018, 0.045),
                (-0.012, CASTOR),
                (0.012, CASTOR),
                (0.018, 0.045),
                (0.018, 0.0),
            ],
            20,
        )


def column(m, n):
    m.box(n, "grey_paint", (-0.50, 0, 0.72), (0.12, 0.26, 0.84), 0.025, segments=3)
    m.box(n, "plastic", (-0.47, 0, 1.20), (0.07, 0.34, 0.24), 0.02)
    parts.label(m, n, "panel", (-0.4335, 0, 1.21), (0, 0.28, 0), (0, 0, 0.18))
    parts.label(m, n, "number", (-0.5615, 0, 0.90), (0, -0.18, 0), (0, 0, 0.18))
    parts.label(m, n, "arrow", (-0.5615, 0, 0.62), (0, -0.08, 0), (0, 0, 0.16))
    for s in (-1, 1):
        parts.label(m, n, "hazard", (-0.50, s * 0.1315, 0.55), (0, 0, s * 0.36), (s * 0.09, 0, 0))
    m.bar(n, "plastic", (-0.50, 0.0, 1.14), (-0.50, 0.0, 1.40), 0.02, 12)
    m.node("beacon", n, (-0.50, 0.0, 1.39))
    parts.beacon(m, "beacon")


def load(m, n):
    """The plate with a stack of totes on it."""
    plate = m.node("plate", n, (0.10, 0.0, 0.315))
    m.box(plate, "steel", (0.10, 0, 0.33), (0.84, 0.58, 0.025), 0.006)
    m.material("tote", kit_parts.tote_picture(), None)
    for x in (-0.10, 0.31):
        for k in range(2 if x < 0 else 1):
            kit_parts.tote(m, plate, (x, 0.0, 0.343 + 0.29 * k), across=True)
