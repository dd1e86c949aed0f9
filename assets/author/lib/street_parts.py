"""What stands along a street: trees, lamp posts, traffic signs, hedges, bins. Origin on the ground."""

import bmesh
import numpy as np
from mathutils import Vector

from . import noise, surfaces
from .solid import Machine


def bark(seed, size=256):
    rough = noise.picture((size, size), 1.2, seed, stretch=(0.25, 1.0))
    return np.clip(np.array((0.30, 0.25, 0.20)) * (1 + 0.22 * rough)[..., None], 0, 1)


def leaves(colour, seed, size=512):
    """A picture of many small leaves over dark gaps, 0.5 m wide."""
    rng = np.random.default_rng(seed)
    image = np.ones((size, size, 3)) * np.array(colour) * 0.28
    y, x = np.mgrid[0:size, 0:size]
    for k in range(900):
        cx, cy, a = rng.random() * size, rng.random() * size, rng.random() * np.pi
        dx, dy = (x - cx + size / 2) % size - size / 2, (y - cy + size / 2) % size - size / 2
        near = (np.abs(dx) < 26) & (np.abs(dy) < 26)
        u, v = dx[near] * np.cos(a) + dy[near] * np.sin(a), dy[near] * np.cos(a) - dx[near] * np.sin(a)
        inside = (u / 20) ** 2 + (v / 8) ** 2 < 1
        tone = np.array(colour) * (0.55 + 0.75 * k / 900 + 0.2 * rng.random())
        ys, xs = np.nonzero(near)
        image[ys[inside], xs[inside]] = tone * (0.85 + 0.3 * (np.abs(v[inside]) > 1)[:, None])
    return np.clip(image, 0, 1)


def clump(m, node, material, centre, radius, rng, cards):
    """Leafy cards, five-cornered and bent, over a ball of foliage."""
    b = bmesh.new()
    for _ in range(cards):
        out = rng.standard_normal(3)
        out /= np.linalg.norm(out)
        at = np.array(centre) + out * np.array(radius) * rng.uniform(0.72, 1.0)
        face = out + 0.7 * rng.standard_normal(3)
        face /= np.linalg.norm(face)
        side = np.cross(face, rng.standard_normal(3))
        side /= np.linalg.norm(side)
        other = np.cross(face, side)
        size = rng.uniform(0.16, 0.34)
        ring = [
            b.verts.new(Vector(at + size * rng.uniform(0.6, 1.1) * (np.cos(t) * side + np.sin(t) * other)))
            for t in np.arange(5) * 2 * np.pi / 5
        ]
        hub = b.verts.new(Vector(at + 0.3 * size * face))
        for i in range(5):
            b.faces.new([hub, ring[i], ring[(i + 1) % 5]])
    m.add(node, b, material)


def tree(name, folder, path, seed, height, spread, colour):
    m = Machine(name, folder)
    rng = np.random.default_rng(seed)
    m.material("bark", bark(seed), 0.8)
    m.material("leaves", leaves(colour, seed), 0.5)
    fork = 0.36 * height
    trunk = [(0, 0, -0.05), (0.03, 0.02, 0.5 * fork), (-0.02, 0.05, fork)]
    m.lathe(name, "bark", (0, 0, -0.05), (0, 0, 1), [(0, 0.24), (0.15, 0.17), (0.5 * fork, 0.14), (fork, 0.12)], 12)
    crowns = []
    for k in range(13):  # seven boughs around and six above them, nearer to the trunk
        a = 2 * np.pi * k / 7 + rng.uniform(-0.3, 0.3)
        reach = spread * rng.uniform(0.45, 0.62) * (1 if k < 7 else 0.45)
        low, high = (0.58, 0.76) if k < 7 else (0.74, 0.92)
        top = np.array((reach * np.cos(a), reach * np.sin(a), height * rng.uniform(low, high)))
        m.pipe(name, "bark", [trunk[2], tuple(0.5 * (np.array(trunk[2]) + top) + [0, 0, 0.2]), tuple(top)], 0.05, 6, False)
        crowns.append(top)
    for top in crowns:
        clump(m, name, "leaves", top, (0.36 * spread, 0.36 * spread, 0.15 * height), rng, 130)
    m.finish(path, {"height_m": height})


def hedge(name, folder, path):
    m = Machine(name, folder)
    rng = np.random.default_rng(4)
    m.material("leaves", leaves((0.20, 0.33, 0.13), 8), 0.5)
    m.box(name, "leaves", (0, 0, 0.52), (0.55, 3.0, 1.0), 0.12)
    for k in range(8):
        clump(m, name, "leaves", (0, -1.3 + 0.37 * k, 0.62), (0.33, 0.30, 0.50), rng, 14)
    m.finish(path, {"length_m": 3.0})


def lamp_post(name, folder, path):
    m = Machine(name, folder)
    m.material("steel", surfaces.metal((0.40, 0.42, 0.42), 3), 0.7)
    m.material("dark", surfaces.paint((0.16, 0.17, 0.18), 4, (256, 256)), 0.6)
    m.lathe(name, "steel", (0, 0, 0), (0, 0, 1), [(0, 0.11), (0.9, 0.10), (0.95, 0.07), (6.2, 0.05)], 14)
    m.box(name, "dark", (0.085, 0, 0.6), (0.06, 0.10, 0.40), 0.01)
    m.pipe(name, "steel", [(0, 0, 6.1), (0.15, 0, 6.6), (0.7, 0, 6.85), (1.3, 0, 6.9)], 0.04, 10)
    m.box(name, "dark", (1.5, 0, 6.88), (0.75, 0.26, 0.13), 0.04)
    m.finish(path, {"height_m": 6.95})


def sign_pictures():
    """Four traffic signs of 256 px: right of way, speed, parking, crossing."""
    y, x = np.mgrid[-1 : 1 : 256j, -1 : 1 : 256j]
    white, red, blue, black = (0.92, 0.92, 0.90), (0.75, 0.08, 0.09), (0.06, 0.22, 0.55), (0.05, 0.05, 0.05)
    sheet = np.ones((256, 1024, 3)) * 0.45

    def put(k, mask, colour):
        sheet[:, 256 * k : 256 * (k + 1)][mask] = colour

    r = np.hypot(x, y)
    diamond = np.abs(x) + np.abs(y)
    put(0, diamond < 0.98, white)
    put(0, diamond < 0.86, black)
    put(0, diamond < 0.82, white)
    put(0, diamond < 0.60, (0.93, 0.72, 0.08))
    put(1, r < 0.97, red)
    put(1, r < 0.74, white)
    ring = (np.hypot((x - 0.28) / 0.24, y / 0.40) < 1) & (np.hypot((x - 0.28) / 0.12, y / 0.28) > 1)
    three = (np.abs(x + 0.28) < 0.22) & ((np.abs(np.abs(y) - 0.34) < 0.06) | (np.abs(y) < 0.06) | ((x > -0.18) & (np.abs(y) < 0.40)))
    put(1, ring | three, black)
    put(2, (np.abs(x) < 0.92) & (np.abs(y) < 0.92), blue)
    stem = (np.abs(x + 0.28) < 0.11) & (np.abs(y) < 0.6)
    bow = (np.hypot(x + 0.08, (y + 0.24) * 1.05) < 0.40) & (np.hypot(x + 0.08, (y + 0.24) * 1.05) > 0.19) & (x > -0.2)
    put(2, stem | bow, white)
    put(3, (np.abs(x) < 0.92) & (np.abs(y) < 0.92), blue)
    put(3, (y < 0.72) & (y > -0.75) & (np.abs(x) < 0.55 * (y + 0.95)), white)
    for k in range(4):
        put(3, (np.abs(y - 0.60) < 0.08) & (np.abs(x + 0.55 - 0.36 * k) < 0.10), black)
    put(3, (np.hypot(x, y + 0.28) < 0.09) | ((np.abs(x - 0.1 * y) < 0.07) & (y > -0.2) & (y < 0.35)), black)
    return sheet


def traffic_sign(name, folder, path, which):
    m = Machine(name, folder)
    m.material("steel", surfaces.metal((0.52, 0.53, 0.54), 3), 0.7)
    m.material("signs", sign_pictures(), None, 0.4)
    m.bar(name, "steel", (0, 0, 0), (0, 0, 2.75), 0.032, 10)
    if which > 1:
        outline = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        m.box(name, "steel", (0.045, 0, 2.4), (0.012, 0.62, 0.62), 0.004)
    else:
        sides, radius = ((4, 0.98), (40, 0.97))[which]
        outline = [(float(radius * np.cos(a)), float(radius * np.sin(a))) for a in 2 * np.pi * np.arange(sides) / sides]
        rings = [(0, 0), (0, 0.31 * radius), (0.012, 0.31 * radius), (0.012, 0)]
        m.lathe(name, "steel", (0.039, 0, 2.4), (1, 0, 0), rings, sides)
    rect = (256 * which, 0, 256, 256)
    m.decal(name, "signs", (0.055, 0, 2.4), (0, 0.62, 0), (0, 0, 0.62), rect, (256, 1024), outline)
    m.finish(path, {"height_m": 2.75})
