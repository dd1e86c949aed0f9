"""A city bus: a long rounded box with bands of glass, two doors on its right. Origin on the floor below
the middle of the rear axle; x ahead."""

import numpy as np

from . import car_parts, panels, picture, road_wheel, surfaces
from .panels import grown, profile, rounded, smax
from .solid import Machine

LENGTH, HALF, HEIGHT = 10.6, 1.25, 3.02
REAR, FRONT = -2.35, 2.55  # axles, from the middle
RADIUS, TRACK, ARCH = 0.48, 2.06, 0.56
DEPTHS = {"gap": 0.012, "glass": 0.008, "frame": 0.005, "lamp": 0.05, "tail": 0.006, "tail_amber": 0.008, "tail_white": 0.008, "lip": -0.005, "skirt": 0.004, "grille": 0.02, "display": 0.02, "door": 0.012}
MATERIAL = {"body": "body", "gap": "gap", "glass": "glass", "frame": "seal", "lamp": "bowl", "tail": "red", "tail_amber": "amber", "tail_white": "lens", "lip": "body", "skirt": "plastic", "grille": "shade", "display": "shade", "door": "seal", "band": "band"}  # fmt: skip


def field(shift):
    waist = profile([(0.2, 1.20), (0.5, 1.245), (1.0, 1.25), (2.0, 1.235), (2.6, 1.205), (3.1, 1.15)], 0.15)
    nose = profile([(0.2, 0.12), (0.45, 0.02), (0.8, 0.0), (1.2, 0.03), (2.4, 0.20), (2.8, 0.30), (3.2, 0.45)], 0.18)
    tail = profile([(0.2, 0.08), (0.5, 0.0), (1.2, 0.0), (2.2, 0.05), (3.0, 0.12)], 0.15)

    def f(x, y, z):
        x, y = x - shift, np.abs(y)
        v = y / HALF
        flare = sum(0.018 * np.exp(-(((np.hypot(x - a, z - RADIUS) - ARCH - 0.02) / 0.06) ** 2)) for a in (REAR, FRONT))
        side = y - waist(z) - flare * (z < 1.3)
        top = z - HEIGHT + 0.04 * v**2
        front = x - (LENGTH / 2 - nose(z) - 0.10 * v**2 - 0.16 * v**6)
        rear = -x - (LENGTH / 2 - tail(z) - 0.03 * v**2 - 0.05 * v**8)
        box = smax(smax(side, top, k=0.28), smax(side, front, k=0.30), smax(side, rear, k=0.22), k=0.02)
        return smax(box, smax(front, top, k=0.40), smax(rear, top, k=0.25), 0.20 - z, k=0.03)

    return f


def build(name, folder, path, colour, second, seed):
    m = Machine(name, folder)
    car_parts.materials(m, colour, seed)
    over = lambda p: (p[0] / 12 + 0.3, p[2] / 3.3)  # noqa: E731
    m.material("body", livery(colour, second, seed), over, 0.24)
    m.material("glass", car_parts.tinted(seed), over, 0.05)
    m.material("display", words(), None, 0.4)
    shift = -REAR
    f = field(shift)
    for side in (1, -1):
        p = panels.Panels(f, (shift - LENGTH / 2 + 1.15, shift + LENGTH / 2 - 1.2, 1.35))
        draw(p, shift, side)
        mesh = p.mesh(DEPTHS, drop=("under", "arch"), colours={"lamp": "frame", "glass": "frame"}, sides=(side,), coarse=0.28, turn_deg=13, fine=0.06, rounds=3)
        panels.hang(m, name, mesh, MATERIAL.get, lambda v: np.stack(over(v.T), 1))
    trim(m, name, p, shift)
    for end, x in (("rear", 0.0), ("front", FRONT + shift)):
        for label, s in (("left", 1), ("right", -1)):
            at = (x, s * TRACK / 2, RADIUS)
            parent = m.node(f"steer_front_{label}", name, at) if end == "front" else name
            node = m.node(f"wheel_{end}_{label}", parent, (x, s * (TRACK / 2 + 0.03), RADIUS))
            if end == "rear":
                road_wheel.wheel(m, node, RADIUS, 0.29, s, rim=0.58, spokes=7, sides=32, grooves=3)
            else:
                m.same(node, f"wheel_rear_{label}")
    m.finish(path, facts())


def facts():
    return {
        "origin": "floor below the middle of the rear axle (driven, not steered)",
        "wheelbase_m": FRONT - REAR,
        "track_m": TRACK,
        "steered": ["front"],
        "max_steer_deg": 50.0,
        "wheel_radius_m": {f"wheel_{e}_{s}": RADIUS for e in ("front", "rear") for s in ("left", "right")},
        "steer_nodes": ["steer_front_left", "steer_front_right"],
        "max_speed_mps": 14.0,
    }


def livery(colour, second, seed, size=(256, 512)):
    """Paint over the whole side, 12 m x 3.3 m: a band that sweeps upwards to the rear, dirt below."""
    y, x = np.mgrid[0 : size[0], 0 : size[1]]
    z, along = 3.3 * (1 - (y + 0.5) / size[0]), 12 * (x + 0.5) / size[1] - 3.6
    image = surfaces.flat(size, colour)
    sweep = z < 1.02 - 0.9 * np.clip((along + 1.2) / 8, 0, 1) ** 0.8 + 2.4 * np.clip((0.2 - along) / 4, 0, 1) ** 2
    image[sweep] = second
    dirt = np.clip((0.75 - z) / 0.5, 0, 1) ** 1.6
    return np.clip(surfaces.mix(image, (0.33, 0.30, 0.27), 0.5 * dirt), 0, 1)


def words(size=(64, 512)):
    image = surfaces.flat(size, (0.03, 0.03, 0.03))
    picture.text(image, "7  HARBOUR", 256, 50, 50, (0.95, 0.62, 0.10), "middle")
    image[:, ::4] *= 0.55
    image[::4] *= 0.55
    return image


def draw(p, shift, side):
    at = lambda points: np.array(points, float) + [shift, 0]  # noqa: E731
    p.belt("skirt", lambda x: 0.40 + 0 * x)
    for axle in (REAR, FRONT):
        a = np.radians(np.linspace(-30, 210, 30))
        for name, r in (("lip", ARCH), ("arch", ARCH - 0.02)):
            p.region(name, "side", at(np.stack([axle + r * np.cos(a), RADIUS + r * np.sin(a)], 1)), 0.06)
    p.region("frame", "side", rounded(at([(4.10, 1.12), (3.95, 2.42), (-4.85, 2.42), (-4.85, 1.22), (3.0, 1.22)]), 0.10), 0.1)
    xs = [3.98, 2.95, 1.50, 0.10, -1.30, -2.70, -3.80, -4.80]
    for b, a in zip(xs, xs[1:]):
        low = 1.17 if b > 3.5 else 1.27
        p.region("glass", "side", rounded(at([(a + 0.025, low + 0.05 * (b > 3.5)), (b - 0.025, low), (b - 0.03 - 0.09 * (b > 3.5), 2.37), (a + 0.025, 2.37)]), 0.06), 0.1)
        if b < 2.9:
            p.gap("side", at([(a + 0.03, 2.02), (b - 0.03, 2.02)]), 0.014, 0.1)
    if side < 0:
        for a, b in ((3.28, 4.40), (-0.55, 0.75)):
            if a > 3:
                a, b = 3.14, 4.12
            p.region("door", "side", rounded(at([(a, 0.36), (b, 0.36), (b, 2.46), (a, 2.46)]), 0.05), 0.08)
            mid = (a + b) / 2
            for c, d in ((a, mid), (mid, b)):
                p.region("glass", "side", rounded(at([(c + 0.06, 0.56), (d - 0.05, 0.56), (d - 0.05, 2.38), (c + 0.06, 2.38)]), 0.05), 0.08)
            p.gap("side", at([(mid, 0.38), (mid, 2.44)]), 0.02, 0.1)
    for x in (-4.3, -3.3, -1.4, -0.6, 1.0, 1.75):
        p.gap("side", at([(x, 0.42), (x, 1.16)]), 0.008, 0.1)
    p.gap("side", at([(-4.9, 0.78), (-3.2, 0.78)]), 0.008, 0.1)
    p.region("frame", "front", open_at([(0, 0.92), (1.02, 0.94), (1.13, 1.05), (1.07, 2.86), (0.95, 2.92), (0, 2.93)]), 0.06)
    p.region("glass", "front", open_at([(0, 0.98), (0.98, 1.0), (1.075, 1.09), (1.02, 2.48), (0, 2.52)]), 0.06)
    p.region("display", "front", open_at([(0, 2.58), (0.86, 2.56), (0.82, 2.82), (0, 2.84)]), 0.06)
    p.region("lamp", "front", rounded([(0.66, 0.62), (1.02, 0.62), (1.10, 0.68), (1.06, 0.80), (0.70, 0.78)], 0.03), 0.03)
    p.region("grille", "front", open_at([(0, 0.44), (0.55, 0.44), (0.50, 0.56), (0, 0.56)]), 0.05)
    p.gap("front", [(0.0, 0.84), (0.6, 0.85), (1.10, 0.87)], 0.008, 0.08)
    p.region("frame", "rear", open_at([(0, 1.50), (0.90, 1.50), (0.98, 1.58), (0.93, 2.42), (0.85, 2.48), (0, 2.5)]), 0.06)
    p.region("glass", "rear", open_at([(0, 1.56), (0.88, 1.56), (0.93, 1.62), (0.885, 2.39), (0.82, 2.43), (0, 2.45)]), 0.06)
    p.gap("rear", [(0.0, 1.32), (0.95, 1.32), (0.98, 0.62), (0.0, 0.60)], 0.008, 0.08)
    for k in range(5):
        p.region("grille", "rear", rounded([(0.15, 0.74 + 0.09 * k), (0.75, 0.74 + 0.09 * k), (0.75, 0.785 + 0.09 * k), (0.15, 0.785 + 0.09 * k)], 0.015), 0.05)
    p.region("tail", "rear", rounded([(1.00, 0.78), (1.12, 0.78), (1.12, 1.30), (1.00, 1.30)], 0.03), 0.04)
    for name, z in (("tail_amber", 1.16), ("tail_white", 0.86)):
        p.region(name, "rear", rounded([(1.015, z), (1.105, z), (1.105, z + 0.09), (1.015, z + 0.09)], 0.03), 0.03)
    p.belt("under", lambda x: 0.28 + 0 * x)


def open_at(outline):
    out = rounded(outline, [0] + [0.05] * (len(outline) - 2) + [0])
    out[:, 0] = np.where(out[:, 0] < 0.012, 0.0, out[:, 0])
    return out


def trim(m, n, p, shift):
    for x in (0.0, FRONT + shift):
        for s in (-1, 1):
            car_parts.arch(m, n, x, s, RADIUS, ARCH, HALF)
    m.box(n, "shade", (shift, 0, 0.36), (LENGTH - 0.6, 1.3, 0.06), 0.0)
    m.box(n, "shade", (shift + (REAR + FRONT) / 2, 0, 0.33), (FRONT - REAR - 1.25, 2 * HALF - 0.2, 0.05), 0.0)
    for a, b in ((REAR - 0.6, -LENGTH / 2 + 0.2), (FRONT + 0.6, LENGTH / 2 - 0.3)):
        m.box(n, "shade", (shift + (a + b) / 2, 0, 0.33), (abs(b - a), 2.1, 0.05), 0.0)
    for s in (1, -1):
        for k, (y, z) in enumerate(((0.78, 0.70), (0.96, 0.715))):
            on = p.cast("front", [(y, z)])[0]
            c = (on[0] - 0.02, s * y, z)
            m.lathe(n, "chrome", c, (1, 0, 0), [(-0.05, 0.062), (0.0, 0.066), (0.004, 0.062), (-0.02, 0.05)], 22)
            m.lathe(n, "lens", c, (1, 0, 0), [(-0.025, 0.052), (-0.008, 0.045), (0.004, 0.025), (0.006, 0.0)], 22)
        arm = p.cast("front", [(1.05, 2.62)])[0]
        m.pipe(n, "seal", [(arm[0] - 0.05, s * 1.03, 2.66), (arm[0] + 0.28, s * 1.20, 2.70), (arm[0] + 0.36, s * 1.33, 2.60), (arm[0] + 0.36, s * 1.34, 2.45)], 0.028, 10)
        car_parts.egg(m, n, "seal", (arm[0] + 0.36, s * 1.34, 2.22), (0.16, 0.24, 0.52), 3.4, cut=-0.55)
        car_parts.egg(m, n, "mirror", (arm[0] + 0.312, s * 1.34, 2.22), (0.012, 0.20, 0.46), 4.5)
        car_parts.egg(m, n, "amber", (shift + FRONT + 0.9, s * 1.255, 1.05), (0.14, 0.03, 0.05), 3.0)
    on = p.cast("front", [(0.0, 2.70), (0.7, 2.70)])
    m.decal(n, "display", (min(on[:, 0]) - 0.03, 0, 2.70), (0, 1.42, 0), (-0.02, 0, 0.20), (0, 0, 512, 64), (64, 512))
    for s in (1, -1):
        t = np.linspace(0, 1, 8)
        line = p.cast("front", np.stack([0.95 - 0.80 * t, 1.03 + 0.10 * t], 1))
        line = line + 0.014 * p.normal(line)
        m.pipe(n, "seal", [tuple(q * [1, s, 1]) for q in line], 0.010, 6)
    for view, z, ahead in (("front", 0.50, 1), ("rear", 0.66, -1)):
        on = p.cast(view, [(0.0, z), (0.26, z)])
        face = max(on[:, 0] * ahead) * ahead + ahead * 0.008
        m.box(n, "seal", (face, 0, z), (0.012, 0.535, 0.125), 0.004)
        m.decal(n, "plate", (face + ahead * 0.0065, 0, z), (0, ahead * 0.52, 0), (0, 0, 0.11), (0, 0, 256, 64), (64, 256))
    for x, size in ((-2.6, 2.2), (1.6, 1.6)):
        m.box(n, "body", (shift + x, 0, HEIGHT + 0.06), (size, 1.5, 0.20), 0.07, segments=3)
    for y in (-0.45, 0.45):
        car_parts.egg(m, n, "red", (shift - LENGTH / 2 + 0.17, y, 2.72), (0.03, 0.22, 0.05), 3.5)
