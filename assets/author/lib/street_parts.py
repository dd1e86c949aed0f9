"""What stands along a street: lamp posts and traffic signs. Origin on the ground."""

import numpy as np

from . import surfaces
from .solid import Machine


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
