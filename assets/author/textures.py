"""Makes assets/textures/*.png with their facts (*.json: metres a tile covers, rectangles of a sheet).

Run: blender -b --factory-startup -P assets/author/textures.py -- [name ...]
"""

import json
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import cartons, hall_surfaces, noise, picture, signs, surfaces  # noqa: E402
from lib.surfaces import flat, mix, scratches, threshold  # noqa: E402


def wander(size, count, steps, seed, bend=0.25, stroke=1.0):
    """Coverage of wandering lines that wrap round the tile: cracks, drips, tyre marks."""
    rng = np.random.default_rng(seed)
    h, w = size
    out = np.zeros(size)
    for _ in range(count):
        drift = np.convolve(rng.normal(size=steps), np.exp(-np.arange(60) / 20.0), "same")
        angle = rng.random() * 2 * np.pi + bend * drift
        x = rng.random() * w + np.cumsum(np.cos(angle)) * stroke
        y = rng.random() * h + np.cumsum(np.sin(angle)) * stroke
        fade = np.minimum(
            1.0, np.minimum(np.arange(steps), steps - np.arange(steps)) / (0.15 * steps)
        )
        for dx, dy in ((0, 0), (0.5, 0), (0, 0.5)):
            np.maximum.at(out, ((y + dy).astype(int) % h, (x + dx).astype(int) % w), fade)
    return out


def blur(field, sigma):
    """Periodic Gaussian blur."""
    h, w = field.shape
    fy, fx = np.fft.fftfreq(h)[:, None], np.fft.rfftfreq(w)[None, :]
    return np.fft.irfft2(
        np.fft.rfft2(field) * np.exp(-2 * (np.pi * sigma) ** 2 * (fy**2 + fx**2)), s=field.shape
    )


def blobs(size, count, radius, seed):
    """Soft round stains with ragged rims, periodic."""
    rng = np.random.default_rng(seed)
    h, w = size
    y, x = np.mgrid[0:h, 0:w].astype(np.float32)
    ragged = 0.25 * noise.picture(size, 2.2, seed, 4).astype(np.float32)
    out = np.zeros(size, np.float32)
    for _ in range(count):
        cx, cy, r = rng.random() * w, rng.random() * h, rng.uniform(*radius)
        dx = np.abs(x - cx)
        dy = np.abs(y - cy)
        d = np.hypot(np.minimum(dx, w - dx), np.minimum(dy, h - dy)) / r + ragged
        out = np.maximum(out, np.clip(1.4 - d, 0, 1) * rng.uniform(0.4, 1.0))
    return out


def floor_concrete():
    """Power-floated slab of 5 m with saw-cut joints along its edges."""
    size = (2048, 2048)
    image = flat(size, (0.545, 0.535, 0.515))
    cloud = noise.picture(size, 3.0, 1, 1)
    mottle = noise.picture(size, 1.9, 2, 8)
    image *= (1.0 + 0.060 * cloud + 0.055 * mottle)[..., None]
    swirl = noise.picture(size, 1.4, 3, 10, (0.35, 1.0)) * noise.step(-1, 1, cloud) + noise.picture(
        size, 1.4, 4, 10, (1.0, 0.35)
    ) * noise.step(1, -1, cloud)
    image *= (1.0 + 0.025 * swirl)[..., None]
    grit = blur(noise.picture(size, 0.0, 5), 0.8)
    grit /= grit.std()
    image = mix(image, (0.30, 0.29, 0.28), 0.55 * threshold(grit, 2.3, 3.0))
    image = mix(image, (0.74, 0.73, 0.70), 0.45 * threshold(-grit, 2.4, 3.1))
    image = mix(image, (0.24, 0.22, 0.20), 0.40 * blobs(size, 9, (18, 70), 6))
    image = mix(image, (0.66, 0.65, 0.63), 0.30 * blobs(size, 8, (40, 150), 7))
    image = mix(
        image, (0.22, 0.21, 0.20), 0.8 * np.clip(2.2 * blur(blobs(size, 60, (2, 6), 8), 0.6), 0, 1)
    )
    tyre = wander(size, 10, 1500, 9, 0.03, 1.0)
    tyre = np.clip(blur(tyre, 9.0) * 14.0, 0, 1) * noise.step(
        -0.6, 1.0, noise.picture(size, 1.6, 10, 6)
    )
    image = mix(image, (0.27, 0.265, 0.26), 0.38 * tyre)
    crack = np.clip(blur(wander(size, 5, 800, 11, 0.30, 1.0), 0.7) * 2.6, 0, 1)
    image = mix(image, (0.20, 0.19, 0.18), 0.75 * crack)
    image = mix(
        image,
        (0.70, 0.69, 0.67),
        0.45 * np.clip(1.8 * blur(wander(size, 70, 140, 12, 0.03, 1.0), 0.6), 0, 1),
    )
    y, x = np.mgrid[0:2048, 0:2048]
    edge = np.minimum(np.minimum(x, 2047 - x), np.minimum(y, 2047 - y))
    chip = 1.2 * noise.picture(size, 1.6, 13, 20)
    image = mix(image, (0.20, 0.19, 0.185), 0.85 * (edge < 1.6 + np.maximum(chip, 0)))
    image = mix(image, (0.43, 0.42, 0.40), 0.35 * np.exp(-edge / 14.0))
    return image, {"tile_m": [5.0, 5.0]}


def floor_polished():
    """The same slab, ground and sealed: fewer marks, for glossy floors."""
    size = (1024, 1024)
    image = flat(size, (0.60, 0.595, 0.58))
    image *= (1.0 + 0.05 * noise.picture(size, 2.6, 21, 2))[..., None]
    stones = noise.picture(size, 1.0, 22, 40)
    image = mix(image, (0.42, 0.41, 0.40), 0.55 * threshold(stones, 0.9, 1.6))
    image = mix(image, (0.76, 0.75, 0.72), 0.50 * threshold(-stones, 1.0, 1.7))
    return image, {"tile_m": [2.5, 2.5]}


def wall_painted():
    """Painted block work: courses of 20 cm, scuffs below 1.2 m; 4 m wide and 4 m high."""
    size = (1024, 1024)
    image = flat(size, (0.79, 0.785, 0.76))
    y, x = np.mgrid[0:1024, 0:1024] + 0.5
    course = y / 51.2
    row = course.astype(int)
    col = x / 102.4 + 0.5 * (row % 2)
    rng = np.random.default_rng(31)
    shade = rng.normal(size=(20, 10))
    image *= (1.0 + 0.018 * shade[row % 20, col.astype(int) % 10])[..., None]
    joint = np.minimum(
        np.abs(course - np.round(course)) * 51.2, np.abs(col - np.round(col)) * 102.4
    )
    wobble = 0.8 * noise.picture(size, 1.4, 32, 20)
    image = mix(image, (0.55, 0.545, 0.53), 0.75 * noise.step(2.4, 0.6, joint + wobble))
    pores = noise.picture(size, 0.5, 33, 60)
    image = mix(image, (0.58, 0.57, 0.55), 0.55 * threshold(pores, 2.2, 3.0))
    image *= (1.0 + 0.035 * noise.picture(size, 2.3, 34, 1))[..., None]
    low = noise.step(650, 1000, y)
    image = mix(
        image, (0.40, 0.39, 0.37), 0.55 * low * scratches(size, 110, 35, (20, 180), (1.0, 4.0), 0.0)
    )
    image = mix(
        image, (0.52, 0.50, 0.47), 0.40 * low * threshold(noise.picture(size, 2.0, 36, 3), 0.3, 1.6)
    )
    streak = noise.picture(size, 2.2, 37, 4, (0.08, 1.0))
    return mix(image, (0.60, 0.58, 0.54), 0.25 * threshold(streak, 1.2, 2.4)), {
        "tile_m": [4.0, 4.0]
    }


def wall_panel():
    """Trapezoidal sheet: ribs every 25 cm, rows of screws, 4 m wide and high."""
    size = (1024, 1024)
    y, x = np.mgrid[0:1024, 0:1024] + 0.5
    t = (x / 64.0) % 1.0
    profile = np.interp(
        t, [0, 0.12, 0.22, 0.50, 0.60, 0.72, 1.0], [0.98, 0.98, 1.10, 1.04, 1.04, 0.66, 0.92]
    )
    image = flat(size, (0.66, 0.69, 0.71)) * profile[..., None]
    image = mix(image, (0.30, 0.31, 0.32), 0.8 * (np.abs(t - 0.665) < 0.02))
    image *= (1.0 + 0.03 * noise.picture(size, 2.4, 41, 1))[..., None]
    lap = np.minimum(np.abs(y - 512), np.minimum(y, 1024 - y))
    image = mix(image, (0.36, 0.36, 0.37), 0.8 * (lap < 2.2))
    for row in (40, 300, 552, 812):
        for k in range(16):
            picture.disc(image, 64 * k + 24, row, 3.6, (0.34, 0.34, 0.35), 10)
            picture.disc(image, 64 * k + 23.2, row - 0.8, 1.8, (0.85, 0.85, 0.85), 8)
    streak = noise.picture(size, 2.0, 42, 5, (0.06, 1.0))
    image = mix(image, (0.45, 0.41, 0.37), 0.35 * threshold(streak, 1.1, 2.3))
    image = mix(image, (0.40, 0.40, 0.40), 0.5 * scratches(size, 70, 43, (10, 120)))
    return image, {"tile_m": [4.0, 4.0]}


def wood_pallet():
    """Sawn softwood: grain along x, knots, nails, dirt; a board of 1.2 m."""
    size = (512, 1024)
    grain = noise.picture(size, 1.5, 51, 2, (1.0, 14.0))
    rings = noise.picture(size, 2.4, 52, 1, (1.0, 9.0))
    image = flat(size, (0.66, 0.52, 0.36))
    image *= (1.0 + 0.10 * grain + 0.09 * np.sin(rings * 9.0))[..., None]
    rng = np.random.default_rng(53)
    for _ in range(9):
        x, y, r = rng.random() * 1024, 40 + rng.random() * 430, rng.uniform(8, 17)
        picture.disc(image, x, y, r, (0.36, 0.24, 0.14))
        picture.disc(image, x, y, r * 0.55, (0.25, 0.16, 0.09))
    for x in (60, 110, 490, 540, 915, 965):
        for y in (60, 200, 320, 450):
            picture.disc(
                image, x + rng.normal() * 6, y + rng.normal() * 10, 4.5, (0.20, 0.18, 0.17), 10
            )
    image = mix(
        image, (0.34, 0.29, 0.24), 0.55 * threshold(noise.picture(size, 2.0, 54, 2), 0.5, 2.0)
    )
    image = mix(
        image,
        (0.22, 0.17, 0.12),
        0.8 * threshold(noise.picture(size, 1.4, 55, 3, (1.0, 22.0)), 1.9, 2.5),
    )
    return mix(image, (0.80, 0.70, 0.54), 0.5 * scratches(size, 40, 56, (20, 160))), {
        "tile_m": [1.2, 0.6]
    }


def wrap():
    """A stretch-wrapped load: pale film with diagonal creases and glints over dim cartons."""
    size = (1024, 1024)
    under = np.zeros((1024, 1024, 3))
    rng = np.random.default_rng(61)
    for j in range(4):
        for k in range(3):
            cell = cartons.board(cartons.KRAFT[rng.integers(0, 4)], 600 + 7 * j + k)
            rows, cols = np.linspace(0, 511, 256).astype(int), np.linspace(0, 511, 342).astype(int)
            block = cell[rows][:, cols][:, : min(342, 1024 - 342 * k)]
            under[256 * j : 256 * j + 256, 342 * k : 342 * k + block.shape[1]] = block
    for j in range(4):
        for k in range(3):
            x, y = 342 * k + rng.uniform(20, 180), 256 * j + rng.uniform(30, 110)
            cartons.address(under, int(x), int(y), 120, 90, 70 + 5 * j + k)
    image = mix(under, (0.72, 0.74, 0.75), np.full(size, 0.42))
    for k, (sy, sx) in enumerate(((1.0, 5.0), (3.0, 4.0), (2.0, 6.0))):
        crease = noise.picture(size, 1.7, 62 + k, 3, (sy, sx) if k != 2 else (sy, sx))
        image = mix(
            image, (0.94, 0.95, 0.95), 0.40 * threshold(1 - np.abs(crease) * 2.2, 0.55, 1.0)
        )
        image = mix(image, (0.42, 0.42, 0.42), 0.22 * threshold(crease, 1.3, 2.2))
    y = np.mgrid[0:1024, 0:1024][0]
    bands = (y + 14 * noise.picture(size, 2.6, 66, 1)) % 205
    image = mix(image, (0.90, 0.91, 0.92), 0.30 * np.exp(-bands / 5.0))
    return image, {"tile_m": [1.2, 1.2]}


def rack(colour, seed):
    """An upright's face, 10 cm wide and 40 cm high: key-hole perforation at 5 cm pitch, chipped paint."""
    image = surfaces.paint(colour, seed, (1024, 256), 1.3)
    for k in range(8):
        for x in (64, 192):
            y = 64 + 128 * k
            picture.polygon(
                image,
                [(x - 20, y - 30), (x + 20, y - 30), (x + 9, y + 30), (x - 9, y + 30)],
                (0.06, 0.06, 0.065),
            )
            picture.line(
                image, (x - 21, y - 31), (x + 21, y - 31), 3, np.minimum(np.array(colour) * 1.5, 1)
            )
    y, x = np.mgrid[0:1024, 0:256]
    image *= (0.78 + 0.22 * noise.step(0, 10, np.minimum(x, 255 - x)))[..., None]
    return image, {"tile_m": [0.1, 0.4]}


def column_stripes():
    """Yellow and black impact guard."""
    return surfaces.hazard((512, 512), 64, seed=71), {"tile_m": [0.6, 0.6]}


def drum():
    """A steel drum unrolled: beads, label, dents; 1.8 m round and 0.9 m high."""
    size = (512, 1024)
    image = surfaces.paint((0.10, 0.27, 0.48), 81, size, 1.5)
    y = np.mgrid[0:512, 0:1024][0]
    for at in (10, 170, 342, 502):
        image *= (
            1.0
            + 0.30 * np.exp(-(((y - at + 5) / 5.0) ** 2))
            - 0.35 * np.exp(-(((y - at - 6) / 5.0) ** 2))
        )[..., None]
    cartons.address(image, 90, 196, 190, 126, 83)
    picture.polygon(image, [(700, 190), (764, 254), (700, 318), (636, 254)], (0.90, 0.45, 0.08))
    picture.text(image, "3", 700, 304, 44, (0.05, 0.05, 0.05), "middle")
    picture.text(image, "LUBRICANT ISO VG 46", 470, 440, 40, (0.92, 0.92, 0.9), "middle")
    return image, {"tile_m": [1.8, 0.9]}


def tote():
    """A plastic crate's side 0.6 m by 0.3 m: ribs, rim, card holder."""
    size = (256, 512)
    image = surfaces.plastic((0.18, 0.33, 0.55), 91, size)
    rib = np.mgrid[0:256, 0:512][1] % 64
    image *= (
        1.0 + 0.22 * np.exp(-(((rib - 8) / 3.0) ** 2)) - 0.25 * np.exp(-(((rib - 14) / 3.5) ** 2))
    )[..., None]
    image[:34] = surfaces.plastic((0.21, 0.37, 0.60), 92, (34, 512))
    image[34:40] *= 0.5
    picture.rectangle(image, 196, 12, 120, 14, (0.05, 0.07, 0.10))
    cartons.barcode(image, 40, 130, 130, 70, 94)
    picture.text(image, "T-0417", 350, 190, 44, (0.88, 0.90, 0.92))
    return image, {"tile_m": [0.6, 0.3]}


def dock_door():
    """A sectional door 3 m by 3.2 m: panels, window row, handle, rub marks."""
    size = (1024, 1024)
    image = surfaces.paint((0.72, 0.73, 0.73), 101, size, 0.8)
    y, x = np.mgrid[0:1024, 0:1024]
    seam = y % 171
    image *= (1.0 - 0.50 * np.exp(-(seam / 3.0)) + 0.12 * np.exp(-(((seam - 8) / 4.0) ** 2)))[
        ..., None
    ]
    image *= (1.0 + 0.04 * np.cos(x * 2 * np.pi / 16.0) * (np.abs(seam - 86) > 60))[..., None]
    for k in range(4):
        picture.rectangle(image, 90 + 225 * k, 360, 170, 100, (0.16, 0.17, 0.18))
        picture.rectangle(image, 100 + 225 * k, 370, 150, 80, (0.80, 0.86, 0.90))
        picture.line(image, (110 + 225 * k, 440), (160 + 225 * k, 376), 8, (0.93, 0.96, 0.97))
    image[940:] = surfaces.hazard((84, 1024), 32, seed=102)
    picture.rectangle(image, 480, 880, 64, 18, (0.10, 0.10, 0.10))
    return image, {"tile_m": [3.0, 3.2]}


def cloth_plain():
    """A plain wall or coat without corners: a faint gradient only."""
    size = (256, 256)
    return flat(size, (0.62, 0.62, 0.61)) * (1.0 + 0.006 * noise.picture(size, 3.2, 111, 1))[
        ..., None
    ], {"tile_m": [4.0, 4.0]}


def asphalt():
    """Yard and road surface: chippings, patches, cracks; 5 m."""
    size = (1024, 1024)
    image = flat(size, (0.30, 0.30, 0.305))
    image *= (1.0 + 0.05 * noise.picture(size, 2.6, 121, 1))[..., None]
    stone = blur(noise.picture(size, 0.0, 122), 0.9)
    stone /= stone.std()
    image *= (1.0 + 0.16 * stone)[..., None]
    image = mix(image, (0.60, 0.59, 0.57), 0.5 * threshold(stone, 2.0, 2.8))
    image = mix(
        image,
        (0.12, 0.12, 0.12),
        0.8 * np.clip(2.0 * blur(wander(size, 5, 700, 123, 0.3), 1.0), 0, 1),
    )
    return mix(image, (0.17, 0.17, 0.17), 0.5 * blobs(size, 7, (20, 60), 124)), {
        "tile_m": [5.0, 5.0]
    }


def with_rects(made):
    image, rects = made
    return image, {"rects_px": rects}


TEXTURES = {
    "floor_concrete": floor_concrete,
    "floor_polished": floor_polished,
    "wall_painted": wall_painted,
    "wall_panel": wall_panel,
    "wood_pallet": wood_pallet,
    "shrink_wrap": wrap,
    "rack_blue": lambda: rack((0.10, 0.25, 0.50), 131),
    "rack_orange": lambda: rack((0.86, 0.38, 0.08), 141),
    "rack_beam": lambda: (
        surfaces.paint((0.86, 0.38, 0.08), 151, (256, 1024), 1.2),
        {"tile_m": [1.35, 0.34]},
    ),
    "steel": lambda: (surfaces.metal((0.45, 0.45, 0.46), 161), {"tile_m": [0.6, 0.6]}),
    "column_stripes": column_stripes,
    "drum": drum,
    "tote": tote,
    "dock_door": dock_door,
    "plain": cloth_plain,
    "asphalt": asphalt,
    "cartons": lambda: with_rects(cartons.sheet()),
    "signs": lambda: with_rects(signs.sheet()),
    **hall_surfaces.TEXTURES,
}


# Stored in grey: nearly so by nature, and the camera is monochrome.
GREY = {"floor_concrete", "floor_polished", "wall_painted", "wall_panel", "shrink_wrap", "steel", "dock_door",
        "plain", "asphalt", "wood_pallet", "cartons", *hall_surfaces.TEXTURES}


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    folder = os.path.abspath(os.path.join(HERE, "..", "textures"))
    os.makedirs(folder, exist_ok=True)
    for name, make in TEXTURES.items():
        if wanted and name not in wanted:
            continue
        image, facts = make()
        if name in GREY:
            image = picture.luminance(image)
        picture.write_png(os.path.join(folder, name + ".png"), np.clip(image, 0, 1))
        with open(os.path.join(folder, name + ".json"), "w", encoding="utf-8") as f:
            json.dump(facts, f)
            f.write("\n")
        print("wrote", name)


if __name__ == "__main__":
    main()
