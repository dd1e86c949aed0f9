"""Houses of a town street: walls with windows, doors, roofs. Origin on the ground below the middle of
the front, which looks along +x; the house lies behind it."""

import numpy as np

from . import noise, surfaces
from .solid import Machine

STOREY = 2.9


def brick(colour, seed, size=512):
    """Running bond, 0.25 m x 0.0833 m a brick on a 2 m picture."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[0:size, 0:size] / size * 2.0
    row = (y / 0.0833).astype(int)
    along = x / 0.25 + 0.5 * (row % 2)
    tone = rng.normal(1.0, 0.13, (32, 16))[row % 24, along.astype(int) % 8]
    joint = np.minimum(np.abs((y / 0.0833) % 1 - 0.5), np.abs(along % 1 - 0.5) * 3)
    mortar = ((y / 0.0833) % 1 < 0.14) | (along % 1 < 0.05)
    grain = noise.picture((size, size), 1.0, seed)
    image = np.array(colour) * (tone * (1 + 0.05 * grain))[..., None] * (0.94 + 0.1 * joint[..., None])
    image[mortar] = np.array((0.62, 0.60, 0.56)) * (1 + 0.04 * grain[mortar][:, None])
    return np.clip(image, 0, 1)


def plaster(colour, seed, size=512):
    """Rendered wall with streaks of rain and a few cracks, 2.9 m a picture."""
    stain = noise.picture((size, size), 1.8, seed, stretch=(0.35, 1.0))
    grain = noise.picture((size, size), 0.6, seed + 1)
    image = np.array(colour) * (1 + 0.05 * stain + 0.035 * grain)[..., None]
    return np.clip(image, 0, 1)


def tiles(colour, seed, size=512):
    """Roof tiles in rows, 2 m a picture."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[0:size, 0:size] / size * 2.0
    row, column = (y / 0.25).astype(int), (x / 0.2 + 0.5 * ((y / 0.25).astype(int) % 2)).astype(int)
    tone = rng.normal(1.0, 0.12, (8, 11))[row % 8, column % 10]
    shade = 0.55 + 0.45 * np.minimum(1, 3 * ((y / 0.25) % 1))
    round_ = 0.8 + 0.2 * np.sin(np.pi * ((x / 0.2 + 0.5 * (row % 2)) % 1))
    return np.clip(np.array(colour) * (tone * shade * round_)[..., None], 0, 1)


def window_pictures(seed, size=(256, 1024)):
    """Four window panes side by side: dark rooms with curtains, blinds, a lamp, reflections."""
    rng = np.random.default_rng(seed)
    image = np.zeros((*size, 3))
    y, x = np.mgrid[0 : size[0], 0:256] / 256.0
    for k in range(4):
        pane = np.ones((size[0], 256, 3)) * (0.05 + 0.05 * rng.random())
        pane += (0.16 * np.clip(1 - 1.6 * y - 0.5 * x + 0.3 * k, 0, 1))[..., None]
        if k in (0, 2):  # curtains to the sides
            folds = 0.55 + 0.14 * np.sin(2 * np.pi * (11 * x + 0.6 * np.sin(3 * y)))
            side = (np.abs(x - 0.5) > 0.26 + 0.05 * k * (1 - y))
            pane[side] = folds[side][:, None] * np.array((0.95, 0.93, 0.86))
        if k == 1:  # blind half down
            down = y < 0.42
            slats = 0.62 + 0.12 * np.sin(2 * np.pi * 18 * y)
            pane[down] = slats[down][:, None]
        if k == 3:  # plants on the sill
            for cx in (0.25, 0.6, 0.78):
                leaf = (x - cx) ** 2 / 0.012 + (y - 0.86) ** 2 / 0.03 < 1 + 0.5 * np.sin(40 * x + 31 * y)
                pane[leaf] = (0.13, 0.26, 0.10)
        image[:, 256 * k : 256 * (k + 1)] = pane
    return np.clip(image, 0, 1)


HOUSES = {
    "house_brick": dict(wall="brick", colour=(0.50, 0.25, 0.18), roof=(0.33, 0.30, 0.30), width=11.0, storeys=2, columns=4, gable=True, seed=1),
    "house_plaster": dict(wall="plaster", colour=(0.80, 0.74, 0.60), roof=(0.50, 0.24, 0.17), width=12.5, storeys=3, columns=5, gable=False, seed=2),
    "house_grey": dict(wall="plaster", colour=(0.56, 0.60, 0.62), roof=(0.26, 0.26, 0.28), width=9.0, storeys=2, columns=3, gable=True, seed=3),
    "house_shop": dict(wall="brick", colour=(0.62, 0.50, 0.38), roof=(0.30, 0.29, 0.29), width=14.0, storeys=3, columns=6, gable=False, seed=4),
    "house_tall": dict(wall="plaster", colour=(0.68, 0.46, 0.36), roof=(0.28, 0.22, 0.20), width=10.0, storeys=4, columns=4, gable=False, seed=5),
}
DEPTH = 9.0


def house(name, folder, path, wall, colour, roof, width, storeys, columns, gable, seed):
    m = Machine(name, folder)
    picture = brick if wall == "brick" else plaster
    m.material("wall", picture(colour, seed), 2.0 if wall == "brick" else 2.9, 0.95)
    m.material("plinth", plaster((0.38, 0.37, 0.36), seed + 9, 256), 1.7)
    m.material("roof", tiles(roof, seed + 2), 2.0)
    m.material("trim", surfaces.paint((0.86, 0.85, 0.82), seed + 3, (256, 256), 1.2), 0.8)
    m.material("door", surfaces.paint([(0.16, 0.26, 0.20), (0.40, 0.12, 0.10), (0.15, 0.20, 0.34)][seed % 3], seed, (256, 256)), 1.1)
    m.material("metal", surfaces.metal((0.30, 0.31, 0.32), seed + 5, (256, 256)), 0.8)
    m.material("panes", window_pictures(seed + 6), None, 0.15)
    top = 0.5 + storeys * STOREY
    m.box(m.name, "wall", (-DEPTH / 2, 0, top / 2), (DEPTH, width, top), 0.01, segments=1)
    m.box(m.name, "plinth", (-DEPTH / 2, 0, 0.25), (DEPTH + 0.10, width + 0.10, 0.5), 0.02, segments=1)
    openings(m, width, storeys, columns, seed, name == "house_shop")
    roofing(m, width, top, gable, seed)
    m.bar(m.name, "metal", (0.09, width / 2 - 0.25, 0.2), (0.09, width / 2 - 0.25, top), 0.05, 8)
    for side in (-1, 1):  # the back and the sides have windows too
        for k in range(2):
            for s in range(storeys):
                y = side * (width / 2 + 0.03)
                at = (-DEPTH * (0.3 + 0.4 * k), y, 0.5 + STOREY * s + 1.55)
                pane(m, at, (-side, 0, 0), (0, side, 0), 0.9, 1.25, (seed + k + s) % 4)
    m.finish(path, {"footprint_m": [DEPTH, width], "height_m": top})


def openings(m, width, storeys, columns, seed, shop):
    rng = np.random.default_rng(seed)
    pitch = width / columns
    door = int(rng.integers(0, columns))
    for s in range(storeys):
        for c in range(columns):
            y = (c + 0.5) * pitch - width / 2
            if s == 0 and c == door:
                entrance(m, y)
            elif s == 0 and shop:
                pane(m, (0.03, y, 1.75), (0, 1, 0), (1, 0, 0), pitch - 0.5, 2.0, int(rng.integers(4)))
            else:
                pane(m, (0.03, y, 0.5 + STOREY * s + 1.55), (0, 1, 0), (1, 0, 0), 1.15, 1.45, int(rng.integers(4)))
    if shop:
        m.box(m.name, "door", (0.10, 0, 3.08), (0.20, width - 0.4, 0.50), 0.03)
        m.box(m.name, "trim", (0.55, 0, 2.80), (0.9, width - 1.0, 0.06), 0.02)
    for s in range(1, storeys):
        m.box(m.name, "trim", (0.02, 0, 0.5 + STOREY * s), (0.10, width + 0.02, 0.14), 0.02, segments=1)


def pane(m, centre, right, out, w, h, which):
    """A window: glass a hand behind a white frame with a bar, a sill below."""
    centre, right, out, up = (np.array(v, float) for v in (centre, right, out, (0, 0, 1)))

    def bar(at, along, across):
        size = np.abs(right) * along + np.abs(out) * 0.09 + up * across
        m.box(m.name, "trim", tuple(centre + at), tuple(size), 0.01, segments=1)

    for s in (-1, 1):
        bar(right * s * (w / 2), 0.09, h + 0.09)
        bar(up * s * (h / 2), w, 0.09)
    bar(right * 0.0, 0.05, h)
    bar(up * 0.18 * h, w, 0.05)
    bar(up * -(h / 2 + 0.08) + out * 0.06, w + 0.24, 0.06)
    m.decal(m.name, "panes", tuple(centre - 0.005 * out), tuple(right * w), tuple(up * h), (256 * which, 0, 256, 256), (256, 1024))


def entrance(m, y):
    m.box(m.name, "door", (0.03, y, 1.55), (0.10, 1.05, 2.1), 0.02)
    for s in (-1, 1):
        m.box(m.name, "trim", (0.05, y + s * 0.60, 1.55), (0.14, 0.14, 2.2), 0.015)
        m.box(m.name, "door", (0.085, y + s * 0.24, 2.05), (0.03, 0.34, 0.70), 0.02)
        m.box(m.name, "door", (0.085, y + s * 0.24, 1.05), (0.03, 0.34, 0.70), 0.02)
    m.box(m.name, "trim", (0.10, y, 2.70), (0.24, 1.5, 0.14), 0.03)
    m.box(m.name, "plinth", (0.42, y, 0.16), (0.84, 1.7, 0.32), 0.03)
    m.box(m.name, "plinth", (0.24, y, 0.40), (0.48, 1.5, 0.18), 0.03)
    m.box(m.name, "metal", (0.11, y + 0.40, 1.5), (0.06, 0.05, 0.16), 0.015)


def roofing(m, width, top, gable, seed):
    rise, over = 3.0 if gable else 2.4, 0.45
    if gable:  # the gable looks to the street
        for s in (-1, 1):
            slope = [(-(width / 2 + over) * s, top - 0.25), (0.0, top + rise), (0.0, top + rise + 0.16), (-(width / 2 + over) * s, top - 0.07)]
            m.prism(m.name, "roof", slope, -DEPTH - over, over, "x", 0.004, 1)
        m.prism(m.name, "wall", [(-width / 2, top - 0.01), (width / 2, top - 0.01), (0.0, top + rise - 0.05)], -DEPTH, 0.0, "x", 0.002, 1)
        pane(m, (0.03, 0, top + 1.0), (0, 1, 0), (1, 0, 0), 0.95, 1.1, 0)
    else:
        for a, b in ((over, -DEPTH / 2), (-DEPTH - over, -DEPTH / 2)):
            slope = [(a, top - 0.1), (b, top + rise), (b, top + rise + 0.16), (a, top + 0.08)]
            m.prism(m.name, "roof", slope, -width / 2 - 0.1, width / 2 + 0.1, "y", 0.004, 1)
        m.prism(m.name, "wall", [(0.0, top - 0.01), (-DEPTH, top - 0.01), (-DEPTH / 2, top + rise - 0.1)], -width / 2, width / 2, "y", 0.002, 1)
        m.bar(m.name, "metal", (over + 0.05, -width / 2, top - 0.05), (over + 0.05, width / 2, top - 0.05), 0.07, 8)
    m.box(m.name, "wall", (-DEPTH * 0.55, width * (0.2 if seed % 2 else -0.25), top + rise), (0.55, 0.9, 1.8), 0.02, segments=1)
    m.box(m.name, "plinth", (-DEPTH * 0.55, width * (0.2 if seed % 2 else -0.25), top + rise + 0.95), (0.7, 1.05, 0.14), 0.02, segments=1)
