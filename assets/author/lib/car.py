"""Cars: panels over a smooth body, glass in frames, lamps with depth, wheels. Origin on the floor below
the middle of the rear axle; x ahead."""

import numpy as np

from . import car_parts, panels, road_wheel
from .car_forms import ARCH, FORMS, field
from .panels import grown, rounded
from .solid import Machine

RADIUS, TRACK = 0.315, 1.48
GLASS, SEAL = 0.007, 0.004  # m below the metal


def build(name, folder, path, shape, colour, seed):
    m = Machine(name, folder)
    car_parts.materials(m, colour, seed)
    form = FORMS[shape]
    shift = -form["axles"][0]
    f = field(form, RADIUS)
    moved = lambda x, y, z: f(x - shift, y, z)  # noqa: E731
    half = form["length"] / 2
    p = panels.Panels(moved, (shift - half + 0.62, shift + half - 0.62, 0.66))
    draw(p, form, shift)
    mesh = p.mesh(DEPTHS, drop=("under", "arch"), colours={"glass": "frame", "lamp": "bezel", "gap": "gap"}, turn_deg=13.0 if "panels" in form else 10.0)
    count = panels.hang(m, name, mesh, MATERIAL.get, lambda v: np.stack(car_parts.over(v.T), 1))
    trim(m, name, p, form, shift)
    for end, x in (("rear", 0.0), ("front", form["axles"][1] + shift)):
        for side, s in (("left", 1), ("right", -1)):
            wheel(m, name, end, side, s, x)
    m.finish(path, facts(form))
    print(f"{name}: {count} triangles of panels")


DEPTHS = {
    "gap": 0.011,
    "glass": GLASS,
    "frame": SEAL,
    "grille": 0.030,
    "lamp": 0.045,
    "tail": 0.004,
    "tail_amber": 0.006,
    "tail_white": 0.006,
    "pressing": 0.010,
    "lip": -0.004,
    "dish": 0.012,
    "skirt": 0.004,
    "diffuser": 0.008,
}
MATERIAL = {
    "body": "body", "gap": "gap", "glass": "glass", "frame": "seal", "grille": "shade", "lamp": "bowl",
    "bezel": "seal", "tail": "red", "tail_amber": "amber", "tail_white": "lens", "pressing": "body",
    "lip": "body", "dish": "body", "skirt": "plastic", "diffuser": "plastic", "cowl": "seal",
}  # fmt: skip


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


def draw(p, form, shift):
    """Everything that is cut into the body, lower layers first."""
    at = lambda points: np.array(points, float) + [shift, 0]  # noqa: E731
    half = form["length"] / 2
    ends = lambda x: 0.05 * np.clip((np.abs(x - shift) - half + 0.55) / 0.5, 0, 1) ** 2  # noqa: E731
    p.belt("skirt", lambda x: 0.262 + ends(x))
    for axle in form["axles"]:
        a = np.radians(np.linspace(-22, 202, 30))
        for name, r in (("lip", ARCH), ("arch", ARCH - 0.016)):
            p.region(name, "side", at(np.stack([axle + r * np.cos(a), RADIUS + r * np.sin(a)], 1)))
    for outline in form.get("panels", []):
        p.region("pressing", "side", rounded(at(outline), 0.09))
    for x, z in form["handles"]:
        a = np.linspace(0, 2 * np.pi, 20, endpoint=False)
        p.region("dish", "side", at(np.stack([x + 0.075 * np.cos(a), z - 0.002 + 0.034 * np.sin(a)], 1)))
    for line in form["doors"]:
        p.gap("side", soft(at(line)))
    first, last = form["doors"][0][0], form["doors"][min(2, len(form["doors"]) - 1)][-1 if "panels" not in form else 4]
    p.gap("side", at([(first[0], first[1]), (min(last[0], -0.6) if "panels" not in form else 0.32, first[1])]))
    p.gap("top", soft(at(form["bonnet"])))
    p.gap("rear", soft(np.array(form["tailgate"])))
    if "panels" in form:
        p.gap("rear", [(0.004, 0.49), (0.004, 1.795)])
    # Bumpers end in a seam between arch and lamp.
    nose, tail = form["axles"][1] + ARCH, form["axles"][0] - ARCH
    p.gap("side", soft(at([(nose - 0.05, 0.53), (nose + 0.10, 0.60), (nose + 0.22, 0.645)])))
    p.gap("side", soft(at([(tail + 0.06, 0.53), (tail - 0.10, 0.60), (tail - 0.22, 0.665)])))
    for outline in form["windows"]:
        ring = rounded(at(outline), 0.035)
        p.region("frame", "side", grown(ring, 0.020))
        p.region("glass", "side", ring)
    ring = rounded(form["front_glass"], [0, 0.03, 0.05, 0.05, 0.05, 0])
    p.region("frame", "front", open_middle(grown(ring, 0.024)))
    p.region("glass", "front", open_middle(ring))
    ring = rounded(form["rear_glass"], [0, 0.05, 0.05, 0.06, 0.06, 0] if "panels" not in form else 0.05)
    p.region("frame", "rear", open_middle(grown(ring, 0.020)))
    p.region("glass", "rear", open_middle(ring))
    for name, view, key in (("diffuser", "rear", "diffuser"), ("grille", "front", "grille"), ("grille", "front", "intake"), ("lamp", "front", "head_lamp"), ("tail", "rear", "tail_lamp")):
        p.region(name, view, open_middle(rounded(form[key], 0.022)), 0.015)
    lamp = np.array(form["tail_lamp"])
    c = lamp.mean(0)
    for name, low, high in (("tail_amber", -0.30, 0.02), ("tail_white", 0.10, 0.40)):
        size = np.ptp(lamp, axis=0)
        box = [(c[0] - 0.28 * size[0], c[1] + low * size[1]), (c[0] + 0.20 * size[0], c[1] + low * size[1]), (c[0] + 0.20 * size[0], c[1] + high * size[1]), (c[0] - 0.20 * size[0], c[1] + high * size[1])]
        p.region(name, "rear", rounded(box, 0.012), 0.015)
    p.belt("under", lambda x: 0.200 + 0.6 * ends(x))


def soft(line, steps=6):
    """An open line with rounded corners."""
    p = np.array(line, float)
    out = [p[0]]
    for a, b, c in zip(p, p[1:], p[2:]):
        for s in np.linspace(0, 1, steps):
            u, v = b + 0.35 * (a - b), b + 0.35 * (c - b)
            out.append((1 - s) ** 2 * u + 2 * s * (1 - s) * b + s * s * v)
    return np.array(out + [p[-1]])


def open_middle(outline):
    """An outline that ends on the middle of the car, where the other half meets it."""
    out = np.array(outline, float)
    if out[:, 0].min() < 0.03:
        out[:, 0] = np.where(out[:, 0] < 0.012, 0.0, out[:, 0])
    return out


def wheel(m, name, end, side, s, x):
    at = (x, s * TRACK / 2, RADIUS)
    parent = m.node(f"steer_front_{side}", name, at) if end == "front" else name
    node = m.node(f"wheel_{end}_{side}", parent, (x, s * (TRACK / 2 + 0.045), RADIUS))
    if end == "rear":
        road_wheel.wheel(m, node, RADIUS, 0.205, s)
    else:
        m.same(node, f"wheel_rear_{side}")
    road_wheel.brake(m, parent, (x, s * (TRACK / 2 + 0.01), RADIUS), s, RADIUS)


def trim(m, n, p, form, shift):
    """All that is set onto the body or into its holes."""
    for x in (a + shift for a in form["axles"]):
        for s in (-1, 1):
            car_parts.arch(m, n, x, s, RADIUS, ARCH, form["half"])
    car_parts.floor(m, n, shift, form)
    for x, z in form["handles"]:
        car_parts.handle(m, n, p, x + shift, z)
    car_parts.mirrors(m, n, form, shift, p)
    car_parts.head_lamps(m, n, p, form)
    car_parts.grille(m, n, p, form)
    car_parts.plates(m, n, p, form, shift)
    car_parts.wipers(m, n, p, form)
    car_parts.roof(m, n, p, form, shift)
