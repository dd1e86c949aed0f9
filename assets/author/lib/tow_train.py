"""A tow train: an electric tractor with its driver, and a trailer that follows in its track. The trailer's
four wheels steer, so that its middle runs along the tractor's way. Origins on the floor: of the tractor
below its rear axle, of the trailer below its middle."""

import numpy as np

from . import car_parts, kit_parts, noise, panels, parts, seated
from .panels import profile, rounded, smax
from .solid import Machine

BASE, TRACK, RADIUS = 1.10, 0.86, 0.20
HITCH = -0.48  # of the tractor's pin, x
SEAT, WHEEL = (0.06, 0.0, 0.56), (0.50, 0.0, 0.98)
COLOUR = (0.16, 0.36, 0.62)
LENGTH, WIDTH, DECK = 1.60, 0.90, 0.32  # of the trailer
AXLE, BAR, TAIL = 0.52, 0.92, -0.92  # of the trailer: wheels from its middle, hooks before and behind


def tractor(name, folder, path, driver):
    m = Machine(name, folder)
    parts.materials(m, "AISLE T30", "12", COLOUR, (0.34, 0.35, 0.36), seed=23)
    car_parts.materials(m, COLOUR, 23)
    m.plain("steel", (0.48, 0.48, 0.48), 0.5)
    m.plain("rim", (0.70, 0.705, 0.71), 0.5)
    body(m, name)
    fittings(m, name)
    for side, s in (("left", 1), ("right", -1)):
        wheel = m.node(f"wheel_rear_{side}", name, (0.0, s * TRACK / 2, RADIUS))
        parts.wheel(m, wheel, RADIUS, 0.14, s, 0, 0.60, 5)
    steer = m.node("steer_front", name, (BASE, 0.0, RADIUS))
    m.box(steer, "steel", (BASE, 0, RADIUS + 0.12), (0.10, 0.20, 0.10), 0.02)
    wheel = m.node("wheel_front", steer, (BASE, 0.0, RADIUS))
    parts.wheel(m, wheel, RADIUS, 0.13, 1, 0, 0.60, 5)
    m.node("beacon", name, (-0.34, 0.30, 1.30))
    m.bar(name, "steel", (-0.34, 0.30, 0.80), (-0.34, 0.30, 1.30), 0.016, 10)
    parts.beacon(m, "beacon")
    seated.add(m, name, driver, SEAT, WHEEL, 0.30)
    m.finish(
        path,
        {
            "origin": "floor below the middle of the rear axle (driven, not steered)",
            "wheelbase_m": BASE,
            "track_m": TRACK,
            "steered": ["front"],
            "max_steer_deg": 80.0,
            "wheel_radius_m": {"wheel_rear_left": RADIUS, "wheel_rear_right": RADIUS, "wheel_front": RADIUS},
            "steer_nodes": ["steer_front"],
            "hitch_m": {"behind": -HITCH},
            "max_speed_mps": 3.5,
        },
    )


def body(m, n):
    """Bonnet with its nose, footwell, seat box and battery case: one skin."""
    top = profile([(-0.55, 0.60), (-0.40, 0.62), (0.18, 0.60), (0.26, 0.56), (0.34, 0.31), (0.72, 0.30), (0.80, 0.36), (0.88, 0.84), (0.98, 0.90), (1.20, 0.83), (1.40, 0.70), (1.52, 0.55)], 0.035)
    half = profile([(-0.60, 0.44), (-0.2, 0.485), (0.8, 0.485), (1.25, 0.44), (1.55, 0.34)], 0.20)

    def f(x, y, z):
        y = np.abs(y)
        side = y - half(x) + 0.03 * np.clip((z - 0.5) / 0.4, 0, 1) ** 2 + 0.03 * np.clip((0.25 - z) / 0.15, 0, 1)
        front = x - 1.50 + 0.22 * (y / 0.45) ** 2 + 0.10 * np.clip((z - 0.35) / 0.5, 0, 1.2) ** 2
        rear = -x - 0.45 + 0.04 * (y / 0.45) ** 4
        hood = (z - top(x) + 0.03 * (y / 0.45) ** 2) * 0.55
        out = smax(smax(side, front, k=0.16), smax(side, rear, k=0.10), k=0.02)
        out = smax(out, hood, k=0.05)
        return smax(out, 0.11 - z, k=0.03)

    p = panels.Panels(f, (-0.15, 1.12, 0.26))
    p.belt("skirt", lambda x: 0.20 + 0 * x)
    for x in (0.0,):
        a = np.radians(np.linspace(-30, 210, 24))
        for name, r in (("lip", RADIUS + 0.045), ("arch", RADIUS + 0.032)):
            p.region(name, "side", np.stack([x + r * np.cos(a), RADIUS + r * np.sin(a)], 1))
    p.region("pressing", "side", rounded([(0.92, 0.50), (1.24, 0.46), (1.20, 0.66), (0.95, 0.74)], 0.05))
    p.gap("side", [(-0.44, 0.50), (-0.2, 0.50), (0.24, 0.50)])
    p.gap("top", [(0.84, 0.40), (1.1, 0.37), (1.30, 0.31), (1.36, 0.15), (1.375, 0.0)])
    p.region("lamp", "front", rounded([(0.17, 0.50), (0.33, 0.50), (0.31, 0.60), (0.18, 0.61)], 0.03), 0.02)
    p.region("grille", "front", rounded([(0.0, 0.28), (0.24, 0.28), (0.22, 0.40), (0.0, 0.41)], [0, 0.03, 0.03, 0]), 0.02)
    p.region("tail", "rear", rounded([(0.30, 0.44), (0.40, 0.44), (0.40, 0.54), (0.30, 0.54)], 0.02), 0.02)
    p.belt("under", lambda x: 0.13 + 0 * x)
    depths = {"gap": 0.008, "lamp": 0.035, "grille": 0.02, "tail": 0.004, "lip": -0.004, "pressing": 0.006, "skirt": 0.003}
    mesh = p.mesh(depths, drop=("under", "arch"), coarse=0.12, turn_deg=10, fine=0.03, rounds=4)
    names = {"body": "body", "gap": "gap", "lamp": "bowl", "grille": "shade", "tail": "red", "lip": "body", "pressing": "body", "skirt": "plastic"}
    panels.hang(m, n, mesh, names.get, lambda v: np.stack(car_parts.over(v.T), 1))
    for s in (-1, 1):
        c = p.cast("front", [(0.25, 0.555)])[0]
        at = (c[0] - 0.012, s * 0.25, 0.555)
        m.lathe(n, "chrome", at, (1, 0, 0), [(-0.04, 0.042), (0.0, 0.046), (0.004, 0.042), (-0.015, 0.034)], 20)
        m.lathe(n, "lens", at, (1, 0, 0), [(-0.018, 0.035), (-0.006, 0.028), (0.002, 0.0)], 20)
        car_parts.arch(m, n, 0.0, s, RADIUS, RADIUS + 0.03, 0.49)
        parts.label(m, n, "name", (-0.10, s * 0.4865, 0.555), (s * -0.50, 0, 0), (0, 0, 0.07))
        parts.label(m, n, "number", (1.08, s * 0.462, 0.58), (s * -0.14, s * 0.03, 0), (0, 0, 0.14))


def fittings(m, n):
    m.box(n, "rubber", (0.53, 0, 0.312), (0.36, 0.78, 0.012), 0.003)
    parts.seat(m, n, *SEAT, scale=0.92)
    parts.steering_wheel(m, n, WHEEL, (-0.55, 0, 0.84), 0.16)
    m.bar(n, "plastic", (0.68, 0, 0.72), (0.84, 0, 0.50), 0.045, 14)
    dash = [(0.74, 0.80), (0.84, 0.95), (0.92, 0.93), (0.90, 0.80)]
    m.prism(n, "plastic", dash, -0.30, 0.30, "y", 0.02, 2)
    parts.label(m, n, "panel", (0.785, 0.0, 0.885), (0, -0.22, 0), (0.05, 0, 0.075))
    for s in (-1, 1):
        m.pipe(n, "steel", [(0.88, s * 0.44, 0.62), (0.86, s * 0.46, 1.00), (0.90, s * 0.45, 1.06), (0.98, s * 0.44, 1.02)], 0.014, 10)
        car_parts.egg(m, n, "seal", (0.90, s * 0.52, 1.12), (0.07, 0.19, 0.12), 3.2, cut=-0.5)
        car_parts.egg(m, n, "mirror", (0.880, s * 0.52, 1.12), (0.01, 0.165, 0.10), 4.5)
        m.bar(n, "steel", (0.87, s * 0.455, 0.98), (0.90, s * 0.50, 1.08), 0.010, 8)
        m.box(n, "mast_steel", (-0.42, s * 0.16, 0.28), (0.10, 0.03, 0.22), 0.006)
    for z in (0.20, 0.26, 0.32):
        m.box(n, "mast_steel", (-0.47, 0, z), (0.09, 0.16, 0.018), 0.004)
    m.bar(n, "chrome", (HITCH, 0, 0.17), (HITCH, 0, 0.37), 0.014, 10)
    parts.label(m, n, "hazard", (-0.4535, 0, 0.45), (0, -0.50, 0), (0, 0, 0.06))
    m.box(n, "rubber", (1.46, 0, 0.20), (0.10, 0.56, 0.09), 0.03, segments=3)


def trailer(name, folder, path, load):
    """A low trailer with a roll cage or totes on it."""
    m = Machine(name, folder)
    parts.materials(m, "AISLE T30", "12", COLOUR, (0.34, 0.35, 0.36), seed=24)
    x, y = LENGTH / 2, WIDTH / 2
    for s in (-1, 1):
        m.beam(name, "paint", (-x, s * (y - 0.03), DECK - 0.05), (x, s * (y - 0.03), DECK - 0.05), 0.06, 0.10, 0.008)
    for t in np.linspace(-x + 0.03, x - 0.03, 5):
        m.beam(name, "paint", (t, -y, DECK - 0.05), (t, y, DECK - 0.05), 0.05, 0.08, 0.006)
    m.box(name, "steel", (0, 0, DECK), (LENGTH, WIDTH, 0.012), 0.003)
    m.box(name, "mast_steel", (0, 0, DECK - 0.11), (2 * AXLE, 0.10, 0.06), 0.01)
    for s in (-1, 1):
        m.bar(name, "mast_steel", (-AXLE, s * 0.05, DECK - 0.12), (AXLE, -s * 0.05, DECK - 0.12), 0.012, 8)
        for t in (-x + 0.02, x - 0.02):
            m.pipe(name, "steel", [(t, s * (y - 0.04), DECK), (t, s * (y - 0.04), DECK + 0.07), (t * 0.97, s * (y - 0.04), DECK + 0.085)], 0.014, 8)
        parts.label(m, name, "hazard", (0, s * (y + 0.0015), DECK - 0.05), (s * -0.9, 0, 0), (0, 0, 0.07))
        for t in (-0.6, 0.6):
            parts.label(m, name, "reflector", (t, s * (y + 0.0015), DECK - 0.05), (s * -0.09, 0, 0), (0, 0, 0.045))
    for end, ex in (("front", AXLE), ("rear", -AXLE)):
        for side, s in (("left", 1), ("right", -1)):
            steer = m.node(f"steer_{end}_{side}", name, (ex, s * 0.36, 0.125))
            m.box(steer, "mast_steel", (ex, s * 0.36, 0.225), (0.11, 0.09, 0.03), 0.004)
            for k in (-1, 1):
                m.box(steer, "mast_steel", (ex, s * 0.36 + k * 0.035, 0.165), (0.07, 0.010, 0.11), 0.002)
            wheel = m.node(f"wheel_{end}_{side}", steer, (ex, s * 0.36, 0.125))
            if end == "front":
                parts.wheel(m, wheel, 0.125, 0.05, s, 0, 0.68, 5)
            else:
                m.same(wheel, f"wheel_front_{side}")
    bar = m.node("steer_drawbar", name, (AXLE, 0.0, 0.20))
    m.beam(bar, "steel", (AXLE, 0, 0.20), (BAR + 0.36, 0, 0.26), 0.05, 0.035, 0.006)
    m.lathe(bar, "steel", (BAR + 0.38, 0, 0.245), (0, 0, 1), [(0.0, 0.022), (0.0, 0.05), (0.03, 0.05), (0.03, 0.022), (0.0, 0.022)], 20)
    m.box(name, "mast_steel", (-x - 0.05, 0, 0.24), (0.12, 0.08, 0.06), 0.008)
    m.bar(name, "chrome", (TAIL, 0, 0.20), (TAIL, 0, 0.31), 0.014, 10)
    (cage if load == "cage" else totes)(m, name)
    steers = [f"steer_{e}_{s}" for e in ("front", "rear") for s in ("left", "right")]
    m.finish(
        path,
        {
            "origin": "floor below its middle; both axles steer, so that the middle runs along the way",
            "wheelbase_m": 2 * AXLE,
            "track_m": 0.72,
            "steered": ["front", "rear"],
            "max_steer_deg": 45.0,
            "wheel_radius_m": {f"wheel_{e}_{s}": 0.125 for e in ("front", "rear") for s in ("left", "right")},
            "steer_nodes": steers + ["steer_drawbar"],
            "hitch_m": {"ahead": BAR + 0.38, "behind": -TAIL},
            "max_speed_mps": 3.5,
        },
    )


def cage(m, n):
    """A wire cage with cartons behind its bars."""
    x, y, z0, z1 = 0.66, 0.38, DECK + 0.02, DECK + 1.45
    for a in (-x, x):
        for b in (-y, y):
            m.bar(n, "steel", (a, b, z0), (a, b, z1), 0.016, 8)
    for z in (z0 + 0.03, (z0 + z1) / 2, z1):
        for b in (-y, y):
            m.bar(n, "steel", (-x, b, z), (x, b, z), 0.010, 6)
        for a in (-x, x):
            m.bar(n, "steel", (a, -y, z), (a, y, z), 0.010, 6)
    for b in (-y, y):
        for a in np.linspace(-x, x, 15)[1:-1]:
            m.bar(n, "steel", (a, b, z0), (a, b, z1), 0.0035, 4, False)
    for a in (-x, x):
        for b in np.linspace(-y, y, 9)[1:-1]:
            m.bar(n, "steel", (a, b, z0), (a, b, z1), 0.0035, 4, False)
    m.material("card", card(3), 0.6, 0.9)
    rng = np.random.default_rng(5)
    z = z0 + 0.01
    for row in range(4):
        high = rng.uniform(0.26, 0.34)
        edges = [-x + 0.03, -0.22 + rng.uniform(-0.06, 0.06), 0.2 + rng.uniform(-0.06, 0.06), x - 0.03]
        for a, b in zip(edges, edges[1:]):
            inset = rng.uniform(0.0, 0.08)
            m.box(n, "card", ((a + b) / 2, rng.uniform(-0.02, 0.02), z + high / 2), (b - a - 0.012, 2 * y - 0.06 - inset, high - 0.006), 0.004)
        z += high


def card(seed):
    grain = noise.picture((256, 256), 1.2, seed, 2, stretch=(0.3, 1.0))
    image = np.array((0.62, 0.48, 0.33)) * (1 + 0.05 * grain)[..., None]
    image[120:136] *= 1.18
    image[40:70, 150:214] = (0.88, 0.88, 0.86)
    image[46:64:4, 158:206] = (0.15, 0.15, 0.15)
    return np.clip(image, 0, 1)


def totes(m, n):
    m.material("tote", kit_parts.tote_picture(), None)
    m.plain("plastic", (0.16, 0.30, 0.52), 0.5)
    for k, (count, x) in enumerate(((3, -0.51), (4, 0.0), (2, 0.51))):
        for level in range(count):
            for y in (-0.215,):
                kit_parts.tote(m, n, (x, y + 0.215, DECK + 0.008 + 0.285 * level), across=True)
