"""Surfaces of halls other than a warehouse: floors, walls, worn machines, curtains."""

import numpy as np

from . import noise, picture, surfaces
from .surfaces import flat, mix, scratches, threshold


def floor_blocks():
    """End-grain wood blocks on edge, 8 cm by 16 cm, oiled by decades of machines; 2.56 m."""
    size = (1024, 1024)
    y, x = np.mgrid[0:1024, 0:1024] + 0.5
    row = (y // 32).astype(int)
    along = x + 32 * (row % 2)
    column = (along // 64).astype(int) % 16
    rng = np.random.default_rng(211)
    shade = rng.normal(size=(32, 16))
    lean = rng.normal(size=(32, 16))
    image = flat(size, (0.40, 0.33, 0.25))
    u, v = along % 64 - 32, y % 32 - 16
    centre = 30 * lean[row, column]
    rings = np.sin(np.hypot(u - centre, v + 34) * 1.1 + 6 * shade[row, column])
    image *= (1.0 + 0.13 * shade[row, column] + 0.05 * rings)[..., None]
    image *= (1.0 + 0.06 * noise.picture(size, 0.9, 212))[..., None]
    rim = np.minimum(32 - np.abs(u), 16 - np.abs(v)) + 0.7 * noise.picture(size, 1.2, 213, 40)
    image = mix(image, (0.07, 0.06, 0.05), 0.85 * noise.step(2.2, 0.4, rim))
    image = mix(image, (0.16, 0.13, 0.11), 0.60 * threshold(noise.picture(size, 2.5, 214, 1), 0.2, 1.7))
    image = mix(image, (0.10, 0.09, 0.08), 0.70 * threshold(noise.picture(size, 2.2, 215, 3), 1.4, 1.9))
    chips = threshold(noise.picture(size, 0.6, 216), 2.6, 3.2)
    image = mix(image, (0.72, 0.71, 0.69), 0.7 * chips)
    return mix(image, (0.55, 0.48, 0.38), 0.5 * scratches(size, 70, 217, (20, 150))), {
        "tile_m": [2.56, 2.56]
    }


def floor_resin():
    """Sprinkled epoxy, pale: quartz grains under a clear coat, wheel polish, a few repairs; 2.5 m."""
    size = (1024, 1024)
    image = flat(size, (0.70, 0.71, 0.72))
    grain = noise.picture(size, 0.1, 221)
    image *= (1.0 + 0.075 * grain)[..., None]
    image = mix(image, (0.34, 0.35, 0.37), 0.6 * threshold(grain, 1.9, 2.6))
    image = mix(image, (0.92, 0.92, 0.92), 0.6 * threshold(-grain, 2.0, 2.7))
    image *= (1.0 + 0.035 * noise.picture(size, 2.6, 222, 1))[..., None]
    image = mix(image, (0.52, 0.53, 0.55), 0.35 * threshold(noise.picture(size, 2.4, 223, 2, (0.3, 1.0)), 0.8, 2.0))
    return mix(image, (0.40, 0.41, 0.42), 0.4 * scratches(size, 60, 224, (20, 220))), {
        "tile_m": [2.5, 2.5]
    }


def wall_insulated():
    """Cold-store sandwich panels 1.15 m wide: fine lining, sealed joints, rub marks; 4.6 m by 4 m."""
    size = (1024, 1024)
    y, x = (np.mgrid[0:1024, 0:1024] + 0.5) * np.array([1, 1.125]).reshape(2, 1, 1)  # 4.6 m by 4 m
    image = flat(size, (0.86, 0.87, 0.87))
    image *= (1.0 + 0.012 * np.cos(x * 2 * np.pi / 12.0))[..., None]
    rng = np.random.default_rng(231)
    panel = (x // 288).astype(int)
    image *= (1.0 + np.array([0.0, -0.025, 0.012, -0.012])[panel])[..., None]
    seam = np.minimum(x % 288, 288 - x % 288)
    wobble = 0.4 * noise.picture(size, 1.6, 232, 12)
    image = mix(image, (0.50, 0.50, 0.50), 0.85 * noise.step(2.6, 1.2, seam + wobble))
    image = mix(image, (0.97, 0.97, 0.97), 0.7 * noise.step(1.3, 0.6, np.abs(seam - 4.2)))
    low = noise.step(600, 1010, y)
    rubs = scratches(size, 46, 233, (60, 420), (1.5, 6.0), 0.0)
    image = mix(image, (0.42, 0.42, 0.42), 0.45 * low * rubs)
    drips = noise.picture(size, 2.0, 234, 5, (0.05, 1.0))
    image = mix(image, (0.66, 0.66, 0.64), 0.30 * threshold(drips, 1.4, 2.5))
    frost = noise.picture(size, 2.3, 235, 2)
    image = mix(image, (0.97, 0.98, 0.98), 0.5 * threshold(frost, 1.2, 2.2) * noise.step(420, 60, y))
    for at in rng.integers(20, 1000, 9):
        picture.disc(image, float(rng.integers(12, 1012)), float(at), 4.0, (0.72, 0.72, 0.72))
    return image, {"tile_m": [4.6, 4.0]}


def wall_concrete():
    """Precast concrete, formwork marks: boards' joints, tie holes, pores, water streaks; 4.8 m by 4 m."""
    size = (1024, 1024)
    y, x = (np.mgrid[0:1024, 0:1024] + 0.5) * np.array([1, 1228 / 1024]).reshape(2, 1, 1)  # 4.8 m by 4 m
    image = flat(size, (0.60, 0.595, 0.58))
    image *= (1.0 + 0.05 * noise.picture(size, 2.5, 241, 1) + 0.025 * noise.picture(size, 1.5, 242, 8))[..., None]
    lift = (y // 341.4).astype(int) * 2 + (x // 614).astype(int)
    image *= (1.0 + np.array([0.03, -0.04, 0.0, 0.045, -0.02, 0.02])[lift])[..., None]
    joint = np.minimum(np.minimum(y % 341.4, 341.4 - y % 341.4), np.minimum(x % 614, 614 - x % 614))
    joint = joint + 0.8 * noise.picture(size, 1.4, 243, 20)
    image = mix(image, (0.34, 0.335, 0.33), 0.75 * noise.step(2.0, 0.4, joint))
    for row in range(3):
        for column in range(6):
            cx, cy = 85 + 170.6 * column, 60 + 341.4 * row + (220 if row != 1 else 0)
            picture.disc(image, cx, cy, 7, (0.22, 0.22, 0.21))
            picture.disc(image, cx, cy, 4.6, (0.38, 0.38, 0.37))
    pores = noise.picture(size, 0.3, 244)
    image = mix(image, (0.26, 0.26, 0.25), 0.75 * threshold(pores, 2.7, 3.2))
    streak = noise.picture(size, 2.1, 245, 4, (0.05, 1.0))
    image = mix(image, (0.42, 0.41, 0.39), 0.5 * threshold(streak, 0.9, 2.3) * noise.step(1000, 100, y))
    low = noise.step(720, 1010, y)
    image = mix(image, (0.30, 0.295, 0.29), 0.5 * low * scratches(size, 70, 246, (40, 260), (1.0, 5.0), 0.0))
    return image, {"tile_m": [4.8, 4.0]}


def wall_cassette():
    """New steel cassettes laid lengthwise, 0.5 m high: clean, with shallow ribs and clips; 4 m."""
    size = (1024, 1024)
    y, x = np.mgrid[0:1024, 0:1024] + 0.5
    t = (y / 128.0) % 1.0
    profile = np.interp(t, [0, 0.03, 0.08, 0.47, 0.50, 0.53, 0.92, 0.97, 1.0],
                        [0.55, 0.80, 1.0, 1.02, 0.92, 1.02, 1.04, 1.12, 0.55])
    image = flat(size, (0.80, 0.81, 0.81)) * profile[..., None]
    image *= (1.0 + 0.012 * noise.picture(size, 2.6, 251, 1))[..., None]
    seam = np.abs(x - 512)
    image = mix(image, (0.45, 0.45, 0.45), 0.8 * (seam < 1.6))
    for row in range(8):
        for column in (499, 525):
            picture.disc(image, column, 128 * row + 8, 3.0, (0.45, 0.45, 0.46), 8)
    return mix(image, (0.62, 0.62, 0.61), 0.25 * threshold(noise.picture(size, 2.2, 252, 2, (0.1, 1.0)), 1.4, 2.4)), {
        "tile_m": [4.0, 4.0]
    }


def strip_pvc():
    """A curtain's strip 20 cm wide, 2.4 m long: cloudy, scuffed by loads, dirty towards its foot."""
    size = (1024, 128)
    y, x = np.mgrid[0:1024, 0:128] + 0.5
    image = flat(size, (0.83, 0.85, 0.84))
    image *= (1.0 + 0.05 * noise.picture(size, 2.2, 261, 1))[..., None]
    rim = np.minimum(x, 128 - x)
    image = mix(image, (0.88, 0.89, 0.88), 0.8 * noise.step(5, 2, rim))
    image = mix(image, (0.90, 0.90, 0.90), 0.55 * scratches(size, 120, 262, (40, 300), (0.5, 1.6), np.pi / 2))
    dirt = noise.step(500, 1000, y) * threshold(noise.picture(size, 2.0, 263, 2, (0.3, 1.0)), -0.6, 1.4)
    return mix(image, (0.40, 0.39, 0.38), 0.40 * dirt), {"tile_m": [0.2, 2.4]}


def enamel():
    """Machine enamel, pale grey: oily hand marks, chips along nothing in particular, drips; 1 m."""
    size = (512, 512)
    image = flat(size, (0.64, 0.67, 0.64)) * (1.0 + 0.02 * noise.picture(size, 2.6, 271, 1))[..., None]
    image = mix(image, (0.40, 0.40, 0.37), 0.30 * threshold(noise.picture(size, 2.6, 272, 1), 0.6, 2.2))
    runs = noise.picture(size, 2.2, 273, 2, (0.1, 1.0))
    image = mix(image, (0.33, 0.31, 0.27), 0.30 * threshold(runs, 1.3, 2.6))
    image = mix(image, (0.42, 0.42, 0.40), 0.45 * scratches(size, 22, 274, (10, 70)))
    chips = threshold(noise.picture(size, 1.9, 275, 6), 2.9, 3.1)
    return mix(image, (0.24, 0.21, 0.19), 0.8 * chips), {"tile_m": [1.0, 1.0]}


def checker_plate():
    """Steel plate with raised bars crosswise, worn bright on top; 0.5 m."""
    size = (512, 512)
    image = surfaces.metal((0.34, 0.34, 0.345), 281, size, grease=0.8)
    for row in range(16):
        for column in range(16):
            x, y = 32 * column + 16, 32 * row + 16
            lean = 1 if (row + column) % 2 else -1
            a, b = (x - 9, y - 9 * lean), (x + 9, y + 9 * lean)
            picture.line(image, (a[0] + 1.5, a[1] + 2), (b[0] + 1.5, b[1] + 2), 6, (0.12, 0.12, 0.12))
            picture.line(image, a, b, 5, (0.58, 0.58, 0.57))
    return image, {"tile_m": [0.5, 0.5]}


def pegboard():
    """A tool wall's perforated sheet, square holes at 38 mm, finger-marked; 0.608 m."""
    size = (512, 512)
    image = surfaces.paint((0.55, 0.57, 0.60), 291, size, 0.7)
    for row in range(16):
        for column in range(16):
            picture.rectangle(image, 32 * column + 12, 32 * row + 12, 9, 9, (0.07, 0.07, 0.075))
    return image, {"tile_m": [0.608, 0.608]}


TEXTURES = {
    "floor_blocks": floor_blocks,
    "floor_resin": floor_resin,
    "wall_insulated": wall_insulated,
    "wall_concrete": wall_concrete,
    "wall_cassette": wall_cassette,
    "strip_pvc": strip_pvc,
    "enamel": enamel,
    "checker_plate": checker_plate,
    "pegboard": pegboard,
}
