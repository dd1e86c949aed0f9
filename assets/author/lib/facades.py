"""Houses of a town street: walls with windows, doors, roofs. Origin on the ground below the middle of
the front, which looks along +x; the house lies behind it."""

import numpy as np

from . import noise, surfaces
from .house_parts import SHEET, Wall, downpipe, gutter, slope
from .solid import Machine, around

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


def window_pictures(seed, size=(256, 1280)):
    """Five panes side by side: dark rooms with curtains, a blind, a lamp, plants; the last is frosted."""
    rng = np.random.default_rng(seed)
    image = np.zeros((*size, 3))
    y, x = np.mgrid[0 : size[0], 0:256] / 256.0
    for k in range(5):
        room = 0.045 + 0.05 * np.exp(-(((x - 0.6) / 0.5) ** 2 + ((y - 0.35) / 0.4) ** 2))
        pane = np.repeat(room[..., None], 3, 2)
        if k in (0, 2):  # curtains to the sides, gathered, deep in shade at their edges
            gather = 0.22 + 0.07 * k - 0.10 * np.abs(y - 0.62) * (y > 0.3)
            near = np.abs(x - 0.5) - (0.5 - gather)
            folds = 0.50 + 0.17 * np.sin(2 * np.pi * (13 * x + 0.35 * np.sin(2.2 * y + k))) * np.clip(1.2 - 0.4 * y, 0, 1)
            tone = folds * (1 - 0.45 * (y < 0.06)) * (0.85 - 0.25 * y)
            colour = np.array((0.92, 0.90, 0.83) if k == 0 else (0.62, 0.52, 0.44))
            pane[near > 0] = (tone[..., None] * colour)[near > 0]
            edge = (near <= 0) & (near > -0.02)
            pane[edge] *= 0.5
        if k == 1:  # a blind half down
            down = y < 0.46
            slats = 0.50 + 0.16 * ((y * 24) % 1) - 0.30 * (((y * 24) % 1) > 0.9)
            cord = np.abs(np.abs(x - 0.5) - 0.3) < 0.006
            pane[down] = slats[down][:, None] * np.array((0.95, 0.94, 0.90))
            pane[down & cord] *= 0.7
        if k == 3:  # net curtain above, plants on the sill
            net = (y < 0.55 + 0.04 * np.cos(4 * np.pi * x)) & (y > 0.02)
            veil = 0.40 + 0.08 * np.sin(2 * np.pi * 17 * x + np.sin(5 * y))
            pane[net] = 0.35 * pane[net] + 0.65 * veil[net][:, None]
            for cx in (0.22, 0.52, 0.80):
                for _ in range(46):
                    px, py = cx + 0.07 * rng.standard_normal(), 0.84 + 0.075 * rng.standard_normal()
                    leaf = ((x - px) / 0.022) ** 2 + ((y - py) / 0.012) ** 2 < 1
                    pane[leaf] = np.array((0.10, 0.20, 0.07)) * rng.uniform(0.6, 1.8)
                pot = (np.abs(x - cx) < 0.065 - 0.15 * (y - 0.92)) & (y > 0.91)
                pane[pot] = (0.36, 0.19, 0.12)
        if k == 4:
            pane = np.ones((size[0], 256, 3)) * 0.30 + 0.05 * noise.picture((256, 256), 1.0, seed)[..., None]
        image[:, 256 * k : 256 * (k + 1)] = pane
    return np.clip(image, 0, 1)


HOUSES = {
    "house_brick": dict(wall="brick", colour=(0.50, 0.25, 0.18), roof=(0.33, 0.30, 0.30), width=11.0, storeys=2, columns=4, gable=True, seed=1),
    "house_plaster": dict(wall="plaster", colour=(0.80, 0.74, 0.60), roof=(0.50, 0.24, 0.17), width=12.5, storeys=3, columns=5, gable=False, seed=2),
    "house_grey": dict(wall="plaster", colour=(0.56, 0.60, 0.62), roof=(0.26, 0.26, 0.28), width=9.0, storeys=2, columns=3, gable=True, seed=3),
    "house_shop": dict(wall="brick", colour=(0.62, 0.50, 0.38), roof=(0.30, 0.29, 0.29), width=14.0, storeys=3, columns=6, gable=False, seed=4),
    "house_tall": dict(wall="plaster", colour=(0.68, 0.46, 0.36), roof=(0.28, 0.22, 0.20), width=10.0, storeys=4, columns=4, gable=False, seed=5),
}  # fmt: skip
DEPTH, BASE = 9.0, 0.5
DOORS = ((0.16, 0.26, 0.20), (0.40, 0.12, 0.10), (0.15, 0.20, 0.34))


def house(name, folder, path, wall, colour, roof, width, storeys, columns, gable, seed):
    m = Machine(name, folder)
    picture = brick if wall == "brick" else plaster
    m.material("wall", picture(colour, seed), 2.0 if wall == "brick" else 2.9, 0.95)
    m.material("plinth", plaster((0.38, 0.37, 0.36), seed + 9, 256), 1.7)
    m.material("roof", tiles(roof, seed + 2), 1.0)
    m.material("door", surfaces.paint(DOORS[seed % 3], seed, (256, 256), 0.4), 1.1, 0.35)
    m.material("panes", window_pictures(seed + 6), None, 0.05, 0.05)
    stone = (0.66, 0.63, 0.57) if wall == "brick" else tuple(min(1.0, 1.12 * c) for c in colour)
    m.material("stone", plaster(stone, seed + 4, 256), 1.3, 0.9)
    m.plain("trim", (0.86, 0.855, 0.84), 0.5)
    m.plain("sill", (0.60, 0.59, 0.56) if seed % 2 else (0.34, 0.35, 0.37), 0.6)
    m.plain("reveal", tuple(0.95 * c for c in (colour if wall != "brick" else stone)), 0.95)
    m.plain("metal", (0.36, 0.37, 0.38), 0.38, 0.4)
    top = BASE + storeys * STOREY
    front(m, width, storeys, columns, seed, top, name == "house_shop", wall)
    rest(m, width, storeys, columns, seed, top)
    m.box(m.name, "plinth", (-DEPTH / 2, 0, BASE / 2), (DEPTH + 0.10, width + 0.10, BASE), 0.015, segments=1)
    roofing(m, width, top, gable, seed)
    m.finish(path, {"footprint_m": [DEPTH, width], "height_m": top})


def front(m, width, storeys, columns, seed, top, shop, kind):
    """The side to the street: door, windows, string courses, perhaps a shop."""
    rng = np.random.default_rng(seed)
    wall = Wall(m, (0, 0, 0), (1, 0, 0), width)
    pitch, door = width / columns, int(rng.integers(0, columns))
    holes, doors, panes = [], [], []
    for s in range(storeys):
        for c in range(columns):
            u = (c + 0.5) * pitch - width / 2
            v = BASE + STOREY * s + 1.55
            if s == 0 and c == door:
                doors.append((u - 0.60, u + 0.60, BASE, BASE + 2.45))
            elif s == 0 and shop:
                panes.append(((u - pitch / 2 + 0.22, u + pitch / 2 - 0.22, 0.85, 2.75), int(rng.integers(4)), 0))
            else:
                panes.append(((u - 0.58, u + 0.58, v - 0.73, v + 0.73), int(rng.integers(4)), 1))
    holes = doors + [p[0] for p in panes]
    wall.face("wall", top, [(a, b, c, d) for a, b, c, d in holes])
    for k, hole in enumerate(doors):
        wall.door(hole, seed, True)
        wall.surround(hole, out=0.05, t=0.16)
    for k, (hole, which, bars) in enumerate(panes):
        big = hole[1] - hole[0] > 1.3
        wall.window(hole, which, bars=0 if big else bars, transom=not big or seed % 2 == 0)
        if seed % 3 != 0 and not big:
            wall.surround(hole, key=seed % 2 == 0 and kind != "brick")
        if seed == 2 and not big and k % 5 in (1, 3):
            wall.shutters(hole)
    for s in range(1, storeys):
        wall.block("stone", (-width / 2 - 0.02, width / 2 + 0.02), (BASE + STOREY * s - 0.09, BASE + STOREY * s + 0.09), (-0.02, 0.05), 0.02, 2)
    for k, dz in enumerate((0.30, 0.20, 0.10)):  # the cornice grows outwards
        wall.block("stone", (-width / 2 - 0.02, width / 2 + 0.02), (top - dz - 0.08, top - dz + 0.04), (-0.02, 0.05 + 0.05 * k), 0.015, 2)
    if kind == "brick" or seed == 5:  # quoins
        for side in (-1, 1):
            for j, v in enumerate(np.arange(BASE + 0.05, top - 0.5, 0.36)):
                long = 0.48 if j % 2 else 0.30
                u = sorted((side * width / 2, side * (width / 2 - long)))
                wall.block("stone", (u[0] - 0.022 * (side < 0), u[1] + 0.022 * (side > 0)), (v, v + 0.33), (-0.05, 0.024), 0.010)
    if shop:
        wall.block("door", (-width / 2 + 0.1, width / 2 - 0.1), (2.86, 3.34), (-0.01, 0.10), 0.02, 2)
        wall.block("trim", (-width / 2 + 0.05, width / 2 - 0.05), (3.34, 3.42), (-0.01, 0.18), 0.02, 2)
        awning(wall, (-width / 2 + 0.3, width / 2 - 0.3), 2.84)
        for k in range(columns + 1):
            u = np.clip(k * pitch - width / 2, -width / 2 + 0.14, width / 2 - 0.14)
            wall.block("door", (u - 0.13, u + 0.13), (0.0, 2.86), (-0.01, 0.06), 0.012)
    bell = doors[0][1] + 0.30
    wall.block("metal", (bell, bell + 0.10), (BASE + 1.20, BASE + 1.42), (0.0, 0.02), 0.004)
    m.bar(m.name, "metal", tuple(wall.at(bell + 0.05, BASE + 2.05, 0)), tuple(wall.at(bell + 0.05, BASE + 2.05, 0.12)), 0.015, 8)
    m.lathe(m.name, "trim", tuple(wall.at(bell + 0.05, BASE + 1.90, 0.14)), (0, 0, 1), [(0.0, 0.0), (0.02, 0.05), (0.09, 0.07), (0.16, 0.05), (0.19, 0.0)], 14)


def awning(wall, u, v):
    """A sunblind rolled half out, with a scalloped edge."""
    out, drop = 0.95, 0.42
    n = int((u[1] - u[0]) / 0.35)
    us = np.linspace(*u, n + 1)
    for k, (a, b) in enumerate(zip(us, us[1:])):
        material = "door" if k % 2 else "trim"
        w = [0.05, out / 2, out]
        z = [v, v - drop * 0.45, v - drop]
        quads = [[(a, z[i + 1], w[i + 1]), (b, z[i + 1], w[i + 1]), (b, z[i], w[i]), (a, z[i], w[i])] for i in range(2)]
        mid = (a + b) / 2
        quads += [[(a, z[2] - 0.12, out), (mid, z[2] - 0.17, out), (mid, z[2], out), (a, z[2], out)], [(mid, z[2] - 0.17, out), (b, z[2] - 0.12, out), (b, z[2], out), (mid, z[2], out)]]
        wall.quads(material, quads)
    for a in u:
        wall.m.bar(wall.m.name, "metal", tuple(wall.at(a, v - 0.5, 0.02)), tuple(wall.at(a, v - drop, out)), 0.014, 6)


def rest(m, width, storeys, columns, seed, top):
    """The other three walls, with fewer windows."""
    for foot, out, wide, count in (
        ((-DEPTH / 2, width / 2, 0), (0, 1, 0), DEPTH, 2),
        ((-DEPTH / 2, -width / 2, 0), (0, -1, 0), DEPTH, 2),
        ((-DEPTH, 0, 0), (-1, 0, 0), width, columns),
    ):
        wall = Wall(m, foot, out, wide)
        holes = [
            ((c + 0.5) * wide / count - wide / 2 - 0.48, (c + 0.5) * wide / count - wide / 2 + 0.48, BASE + STOREY * s + 0.95, BASE + STOREY * s + 2.2)
            for s in range(storeys)
            for c in range(count)
        ]
        wall.face("wall", top, holes)
        for k, hole in enumerate(holes):
            wall.window(hole, (seed + k) % 4, bars=1, transom=False, sashes=False)


def roofing(m, width, top, gable, seed):
    rise, over = 3.0 if gable else 2.4, 0.45
    n = m.name
    if gable:  # the gable looks to the street
        half = DEPTH / 2 + over
        lean = (rise + 0.10) / (width / 2)
        for s in (-1, 1):
            eave = (width / 2 + over, top - over * lean + 0.05)
            slope_at(m, eave, (0.0, top + rise + 0.15), half, ((0, s, 0), (1, 0, 0)), (-DEPTH / 2, 0))
            y = s * (width / 2 + over + 0.05)
            gutter(m, (-DEPTH - over, y, eave[1] - 0.02), (over, y, eave[1] - 0.02))
            downpipe(m, (-0.3, y, eave[1] - 0.06), (-0.3, s * (width / 2 + 0.06), 0.15), (0, s, 0))
            for x in (0.0, -DEPTH):  # barge boards
                m.beam(n, "trim", (x + (over - 0.02 if x == 0 else -over + 0.02), s * (width / 2 + over), eave[1] - 0.10), (x + (over - 0.02 if x == 0 else -over + 0.02), 0, top + rise + 0.02), 0.03, 0.20)
        m.prism(n, "wall", [(-width / 2, top - 0.01), (width / 2, top - 0.01), (0.0, top + rise)], -DEPTH, -0.001, "x", 0.0, 1)
        wall = Wall(m, (0.001, 0, 0), (1, 0, 0), width)
        c = top + 1.0
        wall.surround((-0.42, 0.42, c - 0.5, c + 0.5), t=0.09)
        wall.pane(-0.42, 0.42, c - 0.5, c + 0.5, 0.006, 0)
        for u, v in (((-0.42, -0.36), (c - 0.5, c + 0.5)), ((0.36, 0.42), (c - 0.5, c + 0.5)), ((-0.03, 0.03), (c - 0.5, c + 0.5)), ((-0.36, 0.36), (c - 0.5, c - 0.43)), ((-0.36, 0.36), (c + 0.43, c + 0.5)), ((-0.36, 0.36), (c + 0.12, c + 0.17))):
            wall.block("trim", u, v, (0.0, 0.035), 0.004)
        wall.block("sill", (-0.52, 0.52), (c - 0.57, c - 0.5), (0, 0.10), 0.008)
        ridge(m, (-DEPTH - over, 0, top + rise + 0.17), (over, 0, top + rise + 0.17))
        stack = (-DEPTH * 0.55, width * (0.2 if seed % 2 else -0.25))
        foot = top + rise * (1 - abs(stack[1]) / (width / 2)) - 0.2
    else:
        half = width / 2 + 0.16
        lean = (rise + 0.10) / (DEPTH / 2)
        for s, x in ((1, 0.0), (-1, -DEPTH)):
            eave = (DEPTH / 2 + over, top - over * lean + 0.05)
            slope_at(m, eave, (0.0, top + rise + 0.15), half, ((s, 0, 0), (0, 1, 0)), (-DEPTH / 2, 0))
            at = x + s * (over + 0.05)
            gutter(m, (at, -half, eave[1] - 0.02), (at, half, eave[1] - 0.02))
            downpipe(m, (at, width / 2 - 0.25, eave[1] - 0.06), (x + s * 0.09, width / 2 - 0.25, 0.15), (s, 0, 0))
            m.box(n, "trim", (x + s * over / 2, 0, top - over * lean * 0.5 - 0.06), (over, 2 * half - 0.02, 0.04), 0.004)
            m.box(n, "trim", (x + s * over, 0, eave[1] - 0.06), (0.03, 2 * half - 0.02, 0.18), 0.006)
        m.prism(n, "wall", [(0.0, top - 0.01), (-DEPTH, top - 0.01), (-DEPTH / 2, top + rise)], -width / 2, width / 2, "y", 0.0, 1)
        for s in (-1, 1):
            for a in (over, -DEPTH - over):
                m.beam(n, "trim", (a, s * half, top - over * lean - 0.02), (-DEPTH / 2, s * half, top + rise + 0.04), 0.03, 0.16)
        ridge(m, (-DEPTH / 2, -half, top + rise + 0.17), (-DEPTH / 2, half, top + rise + 0.17))
        skylights(m, width, top, rise, seed)
        stack = (-DEPTH * 0.55, width * (0.2 if seed % 2 else -0.25))
        foot = top + rise * (1 - abs(stack[0] + DEPTH / 2) / (DEPTH / 2)) - 0.2
    chimney(m, stack, foot, top + rise + 1.0)


def slope_at(m, eave, ridge_at, half, axis, middle):
    """A slope about the house's middle line instead of about the origin."""
    before = m.at[m.name].copy()
    m.at[m.name] = before - np.array([middle[0], middle[1], 0.0])
    slope(m, eave, ridge_at, half, axis)
    m.at[m.name] = before


def ridge(m, a, b):
    """Half-round ridge tiles, each over the next."""
    a, b = np.array(a, float), np.array(b, float)
    count = int(np.linalg.norm(b - a) / 0.36)
    for k in range(count):
        p, q = a + (b - a) * k / count, a + (b - a) * (k + 1.06) / count
        m.stem(m.name, "roof", [p - [0, 0, 0.05], q - [0, 0, 0.065]], [0.115, 0.095], 8)


def chimney(m, at, foot, top):
    x, y = at
    n = m.name
    m.box(n, "wall", (x, y, (foot + top) / 2), (0.55, 0.95, top - foot), 0.01, segments=1)
    m.box(n, "stone", (x, y, top - 0.14), (0.66, 1.06, 0.10), 0.012)
    m.box(n, "stone", (x, y, top + 0.02), (0.72, 1.12, 0.10), 0.02)
    m.box(n, "metal", (x, y, foot + 0.32), (0.64, 1.04, 0.05), 0.005)
    for s in (-1, 1):
        m.lathe(n, "reveal", (x, y + s * 0.24, top + 0.06), (0, 0, 1), [(0, 0.13), (0.08, 0.12), (0.34, 0.10), (0.36, 0.125), (0.42, 0.125), (0.42, 0.09), (0.2, 0.085), (0.2, 0.0)], 14)


def skylights(m, width, top, rise, seed):
    """Windows in the roof's slope."""
    lean = np.arctan2(rise + 0.10, DEPTH / 2)
    for k, y in enumerate(np.linspace(-0.3 * width, 0.3 * width, 2 + seed % 2)):
        d = 1.7
        c = np.array([-d * np.cos(lean) + 0.0, y, top + 0.18 + d * np.sin(lean)])
        turn = around("Y", np.degrees(lean))
        m.box(m.name, "metal", tuple(c), (1.18, 0.80, 0.16), 0.012, turn)
        u, n = np.array([-np.cos(lean), 0, np.sin(lean)]), np.array([np.sin(lean), 0, np.cos(lean)])
        m.decal(m.name, "panes", tuple(c + 0.083 * n), (0, 0.62, 0), tuple(u * 1.0), (256 * 4 + 20, 20, 40, 40), SHEET)
