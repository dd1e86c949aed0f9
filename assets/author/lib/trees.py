"""Trees and hedges: boughs that fork towards the places of their twigs, and leaves, each of them two
triangles folded along the rib. Origin on the ground."""

import numpy as np

from . import noise
from .solid import Machine

CELLS = 4  # leaf pictures a side of their sheet


def bark(seed, size=(256, 128)):
    """Furrowed bark, 0.8 m high."""
    rough = noise.picture(size, 1.3, seed, 2, stretch=(0.22, 1.0))
    fine = noise.picture(size, 0.8, seed + 1, 4)
    tone = np.clip(1 + 0.30 * rough - 0.25 * (rough < -0.6) + 0.07 * fine, 0.25, 1.8)
    return np.clip(np.array((0.30, 0.265, 0.225)) * tone[..., None], 0, 1)


def leaf_sheet(colour, seed, cell=64):
    """Sixteen leaves of several greens, ribs paler, rims darker; each fills its cell."""
    rng = np.random.default_rng(seed)
    sheet = np.zeros((CELLS * cell, CELLS * cell, 3))
    y, x = (np.mgrid[0:cell, 0:cell] + 0.5) / cell
    v = np.abs(y - 0.5)
    rib = np.exp(-((v / 0.018) ** 2))
    veins = np.exp(-((np.abs(((x - 0.9 * v) * 7) % 1 - 0.5) / 0.10) ** 2)) * (v < 0.42)
    for k in range(CELLS * CELLS):
        tone = np.array(colour) * rng.uniform(0.72, 1.28) * (1 + 0.10 * rng.standard_normal(3))
        patch = 1 + 0.10 * noise.picture((cell, cell), 1.8, seed + k, 2)
        light = patch * (1 - 0.25 * (v / 0.5) ** 2) + 0.30 * rib + 0.10 * veins
        r, c = divmod(k, CELLS)
        sheet[r * cell : (r + 1) * cell, c * cell : (c + 1) * cell] = tone * light[..., None]
    return np.clip(sheet, 0, 1)


def thicket(colour, seed, size=256):
    """Many small leaves over dark gaps, 0.5 m wide: what one sees between a hedge's outer leaves."""
    rng = np.random.default_rng(seed)
    image = np.ones((size, size, 3)) * np.array(colour) * 0.16
    y, x = np.mgrid[0:size, 0:size]
    for k in range(330):
        cx, cy, a = rng.random() * size, rng.random() * size, rng.random() * np.pi
        dx, dy = (x - cx + size / 2) % size - size / 2, (y - cy + size / 2) % size - size / 2
        u, v = dx * np.cos(a) + dy * np.sin(a), dy * np.cos(a) - dx * np.sin(a)
        inside = (np.abs(u) / 20 + (v / 8) ** 2) < 1
        image[inside] = np.array(colour) * (0.25 + 0.5 * k / 330 + 0.15 * rng.random()) * (0.85 + 0.3 * (np.abs(v[inside]) > 1)[:, None])
    return np.clip(image, 0, 1)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-9)


def leaves(m, node, places, outward, length, rng, droop=0.55, ball=0.55):
    """A leaf at each place, its stalk towards the twig, hanging somewhat. Their shading leans towards
    the crown's surface by `ball`, as light that passes from leaf to leaf does."""
    n = len(places)
    along = unit(0.9 * outward + 0.75 * rng.standard_normal((n, 3)) + [0, 0, -droop])
    face = unit(np.array([0, 0, 0.9]) + 0.5 * outward + 0.55 * rng.standard_normal((n, 3)))
    face = unit(face - (face * along).sum(1, keepdims=True) * along)
    side = np.cross(face, along)
    size = length * rng.uniform(0.65, 1.15, (n, 1))
    wide = size * rng.uniform(0.30, 0.40, (n, 1))
    fold = 0.25 * wide
    root, tip = places, places + along * size - face * 0.12 * size
    middle = places + along * 0.45 * size
    left, right = middle + side * wide + face * fold, middle - side * wide + face * fold
    v = np.stack([root, left, tip, right], 1).reshape(-1, 3)
    normal = unit((1 - ball) * face + ball * outward)
    tilt = np.stack([normal, unit(normal - 0.3 * side), normal, unit(normal + 0.3 * side)], 1)
    cell = rng.integers(0, CELLS * CELLS, n)
    corner = np.stack([cell % CELLS, cell // CELLS], 1)[:, None] + np.array([(0.02, 0.5), (0.45, 0.98), (0.98, 0.5), (0.45, 0.02)])
    uv = corner / CELLS
    start = 4 * np.arange(n)[:, None]
    faces = np.concatenate([start + [0, 2, 1], start + [0, 3, 2]])
    m.mesh(node, "leaves", v, faces, uv.reshape(-1, 2), tilt.reshape(-1, 3))


class Boughs:
    """A tree grown from its trunk towards the places of its twigs, the near ones first."""

    def __init__(self, trunk, rng):
        self.at, self.parent = [np.array(trunk[0], float)], [-1]
        self.rng = rng
        for p in trunk[1:]:
            self.at.append(np.array(p, float))
            self.parent.append(len(self.at) - 2)
        self.first = len(trunk) - 1
        self.ends = []

    def reach(self, place, low):
        """Adds a bough to a place from where it is shortest without turning back."""
        at = np.array(self.at)
        to = place - at
        far = np.linalg.norm(to, axis=1)
        way = np.array([self.way(i) for i in range(len(at))])
        rise = to[:, 2] / np.maximum(far, 1e-6)
        cost = far + 0.28 * way + 0.8 * np.maximum(0.1 - rise, 0) * far
        cost[at[:, 2] < low] = np.inf
        start = int(np.argmin(cost))
        a, d = self.at[start], place - self.at[start]
        size = np.linalg.norm(d)
        ahead = unit(self.at[start] - self.at[self.parent[start]]) if self.parent[start] >= 0 else np.array([0, 0, 1.0])
        steps = max(2, int(np.ceil(size / 0.55)))
        last = start
        bend = self.rng.standard_normal(3) * 0.05 * size
        for k in range(1, steps + 1):
            t = k / steps
            p = a + d * t + ahead * size * 0.28 * t * (1 - t) * (1 - t) * 2 + bend * np.sin(np.pi * t) + [0, 0, -0.06 * size * np.sin(np.pi * t)]
            self.at.append(p)
            self.parent.append(last)
            last = len(self.at) - 1
        self.ends.append(last)

    def way(self, i):
        total = 0.0
        while self.parent[i] >= 0:
            total += np.linalg.norm(self.at[i] - self.at[self.parent[i]])
            i = self.parent[i]
        return total

    def radii(self, twig, power=2.35):
        """What a bough carries decides its girth (da Vinci's rule)."""
        load = np.zeros(len(self.at))
        for end in self.ends:
            i = end
            while i >= 0:
                load[i] += 1
                i = self.parent[i]
        return twig * np.maximum(load, 1) ** (1 / power)

    def wood(self, m, node, twig, thick=0.016):
        """Pipes from each fork to the next; thin ones have three sides."""
        r = self.radii(twig)
        kids = {}
        for i, p in enumerate(self.parent):
            kids.setdefault(p, []).append(i)
        for i in range(1, len(self.at)):
            p = self.parent[i]
            if p > 0 and max(kids[p], key=lambda k: r[k]) == i and kids[p] != [i] or p > 0 and kids[p] == [i]:
                continue  # in the middle of a run
            run = [p, i]
            while run[-1] in kids:
                run.append(max(kids[run[-1]], key=lambda k: r[k]))
            radii = [min(r[run[0]], 1.25 * r[i])] + [r[k] for k in run[1:]]
            sides = 10 if radii[0] > 0.06 else 6 if radii[0] > thick else 3
            m.stem(node, "bark", [self.at[k] for k in run], radii, sides)


def crown_places(rng, count, radii, centre, lumps):
    """Places of twigs in the crown's shell, no two close together."""
    out = []
    directions = unit(rng.standard_normal((lumps, 3)))
    gap = 0.9 * (radii[0] * radii[1] * radii[2] / count) ** (1 / 3) * 1.18
    for _ in range(count * 60):
        d = unit(rng.standard_normal(3))
        if d[2] < -0.72:
            continue
        bulge = 0.80 + 0.26 * np.max(directions @ d) ** 6
        r = bulge * rng.uniform(0.42, 1.0) ** 0.5
        p = centre + d * r * radii
        if all(np.linalg.norm(p - q) > gap for q in out):
            out.append(p)
            if len(out) == count:
                break
    return np.array(out)


def tree(name, folder, path, seed, height, spread, colour, leaf_m=0.165, twigs=150, each=58):
    m = Machine(name, folder)
    rng = np.random.default_rng(seed)
    m.material("bark", bark(seed), 0.8, 0.95)
    m.material("leaves", leaf_sheet(colour, seed), None, 0.6)
    low = 0.25 * height
    tall = (height - low) / 2
    radii, centre = np.array([spread / 2, spread / 2, tall * 0.96]), np.array([0, 0, low + tall])
    trunk = [np.array([0.06 * np.sin(1.4 * z), 0.05 * np.cos(1.1 * z + seed) - 0.05 * np.cos(seed), z]) for z in np.linspace(-0.05, low + 0.25 * tall, 7)]
    boughs = Boughs(trunk, rng)
    places = crown_places(rng, twigs, radii, centre, 9)
    order = np.argsort(np.linalg.norm(places - trunk[-1], axis=1))
    for place in places[order]:
        boughs.reach(place, 0.85 * low)
    boughs.wood(m, name, 0.0088 * height / 7)
    root = boughs.radii(0.0088 * height / 7)[1]
    m.lathe(name, "bark", (0, -0.0, 0), (0, 0, 1), [(-0.05, 1.9 * root), (0.04, 1.55 * root), (0.15, 1.2 * root), (0.35, 0.9 * root)], 12)
    at = np.array(boughs.at)
    ends = np.repeat(np.array(boughs.ends), each)
    back = at[np.array(boughs.parent)[ends]]
    along = rng.uniform(-0.1, 1.12, (len(ends), 1))
    cloud = rng.standard_normal((len(ends), 3)) * [0.20, 0.20, 0.15]
    where = back + (at[ends] - back) * along + cloud * spread / 4.4
    outward = unit((where - centre) / radii**1.5)
    leaves(m, name, where, outward, leaf_m, rng)
    m.finish(path, {"height_m": height})


def hedge(name, folder, path, count=3400):
    """Three metres of clipped hedge: twigs within, leaves over all of it."""
    m = Machine(name, folder)
    rng = np.random.default_rng(4)
    m.material("leaves", leaf_sheet((0.20, 0.30, 0.12), 8), None, 0.6)
    m.material("shade", thicket((0.18, 0.27, 0.11), 8), 0.5, 0.95)
    m.material("bark", bark(3), 0.8, 0.95)
    half = np.array([0.29, 1.5, 0.52])
    m.box(name, "shade", (0, 0, 0.50), tuple(2 * half - [0.14, 0.06, 0.14]), 0.06)
    for k in range(22):
        y = rng.uniform(-1.4, 1.4)
        foot, top = np.array([rng.uniform(-0.1, 0.1), y, -0.03]), np.array([rng.uniform(-0.25, 0.25), y + rng.uniform(-0.2, 0.2), 0.5])
        m.stem(name, "bark", [foot, top], [0.016, 0.008], 5)
    d = rng.uniform(-1, 1, (count, 3))
    face = rng.choice(5, count, p=[0.30, 0.30, 0.05, 0.05, 0.30])
    for k, (axis, sign) in enumerate(((0, 1), (0, -1), (1, 1), (1, -1), (2, 1))):
        d[face == k, axis] = sign
    d[:, 2] = np.maximum(d[:, 2], -0.97)
    outward = np.zeros((count, 3))
    for k, (axis, sign) in enumerate(((0, 1), (0, -1), (1, 1), (1, -1), (2, 1))):
        outward[face == k, axis] = sign
    rough = 0.05 * np.sin(5.1 * d[:, 1:2]) * np.cos(6.0 * d[:, 2:3] + 2 * d[:, 1:2])
    corner = 1 - 0.06 * (np.abs(d[:, :1]) > 0.85) * (d[:, 2:3] > 0.85)
    where = d * half * corner + [0, 0, 0.53] - outward * rng.uniform(0.0, 0.09, (count, 1)) + outward * rough
    outward = unit(outward + 0.35 * rng.standard_normal((count, 3)))
    leaves(m, name, where, outward, 0.092, rng, 0.15, 0.35)
    m.finish(path, {"length_m": 3.0})
