"""Sixteen faces of cardboard cartons on one sheet: tape, labels, barcodes, arrows, prints, dents."""

import numpy as np

from . import noise, surfaces
from .picture import disc, line, polygon, rectangle, text

CELL = 512
INK, WHITE = (0.13, 0.10, 0.08), (0.94, 0.93, 0.90)
KRAFT = ((0.66, 0.50, 0.34), (0.60, 0.45, 0.31), (0.71, 0.56, 0.40), (0.56, 0.42, 0.28))


def board(colour, seed):
    """Corrugated board: flutes, fibres, scuffs and darkened edges."""
    size = (CELL, CELL)
    image = surfaces.flat(size, colour)
    y, x = np.mgrid[0:CELL, 0:CELL]
    image *= (1.0 + 0.018 * np.sin(x * 2 * np.pi / 5.1))[..., None]
    image *= (
        1.0 + 0.05 * noise.picture(size, 2.2, seed, 2) + 0.012 * noise.picture(size, 0.9, seed + 1)
    )[..., None]
    fibre = noise.picture(size, 1.0, seed + 2, 12, stretch=(1.0, 0.25))
    image = surfaces.mix(image, np.array(colour) * 0.62, 0.5 * surfaces.threshold(fibre, 1.7, 2.6))
    image = surfaces.mix(
        image,
        np.minimum(np.array(colour) * 1.25, 1),
        0.5 * surfaces.scratches(size, 16, seed + 3, (15, 110)),
    )
    dents = noise.picture(size, 3.6, seed + 4, 2)
    slope = np.roll(dents, 4, 0) - dents
    image *= (1.0 + 0.028 * slope / slope.std())[..., None]
    edge = np.minimum(np.minimum(x, CELL - 1 - x), np.minimum(y, CELL - 1 - y)).astype(float)
    wobble = 5.0 * noise.picture(size, 1.8, seed + 5, 3)
    image *= (1.0 - 0.30 * np.exp(-np.maximum(edge + wobble, 0) / 7.0))[..., None]
    return np.clip(image, 0, 1)


def tape(image, seed, vertical=False, at=256, width=56, colour=(0.70, 0.55, 0.33)):
    """Packing tape with wrinkles and a torn end."""
    rng = np.random.default_rng(seed)
    size = image.shape[:2]
    y, x = np.mgrid[0:CELL, 0:CELL]
    across, along = (x, y) if vertical else (y, x)
    ragged = width / 2 + 1.5 * noise.picture(size, 1.0, seed, 6)
    cover = (np.abs(across - at) < ragged) * 0.72
    gloss = 1.0 + 0.10 * noise.picture(
        size, 1.6, seed + 1, 4, (0.3, 1.0) if vertical else (1.0, 0.3)
    )
    image[:] = (
        surfaces.mix(image, np.array(colour), cover) * np.where(cover > 0, gloss, 1.0)[..., None]
    )
    for side in (-1, 1):
        rim = np.abs(across - at - side * width / 2) < 1.5
        image[rim] *= 0.72
    if rng.random() < 0.6:
        for _ in range(3):
            p = at + rng.uniform(-20, 20)
            image[(np.abs(across - p) < 1.2) & (along % 97 < 70)] *= 1.12


def barcode(image, x, y, w, h, seed):
    """Bars of random widths between quiet zones, with a number below."""
    rng = np.random.default_rng(seed)
    rectangle(image, x, y, w, h, WHITE)
    at, digits = x + 0.06 * w, "".join(str(d) for d in rng.integers(0, 10, 12))
    while at < x + 0.93 * w:
        bar = rng.choice([2, 2, 3, 4, 6]) * w / 190.0
        rectangle(image, at, y + 0.08 * h, bar, 0.68 * h, (0.04, 0.04, 0.04))
        at += bar + rng.choice([2, 2, 3, 5]) * w / 190.0
    text(image, digits, x + w / 2, y + 0.95 * h, 0.20 * h, (0.05, 0.05, 0.05), "middle")


def matrix(image, x, y, size, seed, n=21):
    """A two-dimensional code."""
    rng = np.random.default_rng(seed)
    on = rng.random((n, n)) < 0.5
    for cy, cx in ((0, 0), (0, n - 7), (n - 7, 0)):
        on[cy : cy + 7, cx : cx + 7] = True
        on[cy + 1 : cy + 6, cx + 1 : cx + 6] = False
        on[cy + 2 : cy + 5, cx + 2 : cx + 5] = True
    s = size / n
    rectangle(image, x - s, y - s, size + 2 * s, size + 2 * s, WHITE)
    for j, i in zip(*np.nonzero(on)):
        rectangle(image, x + i * s, y + j * s, s, s, (0.05, 0.05, 0.05))


def address(image, x, y, w, h, seed):
    """A despatch label: blocks of small print, a big route code, codes."""
    rng = np.random.default_rng(seed)
    rectangle(image, x + 2, y + 3, w, h, np.array(image[int(y), int(x)]) * 0.55)
    rectangle(image, x, y, w, h, WHITE)
    for k in range(5):
        text(
            image,
            (
                "From: Nordlager 4",
                "Gate 12, Hall C",
                "To: Depot East",
                "Ref 8841-" + str(seed),
                "1 of 3   12.4 kg",
            )[k],
            x + 8,
            y + 18 + 0.105 * h * k,
            0.085 * h,
            INK,
        )
    rectangle(image, x, y + 0.57 * h, w, 2, INK)
    rectangle(image, x + 0.66 * w, y, 2, 0.57 * h, INK)
    text(
        image,
        rng.choice(["R4", "K7", "E2", "B9"]),
        x + 0.83 * w,
        y + 0.38 * h,
        0.34 * h,
        INK,
        "middle",
    )
    barcode(image, x + 0.03 * w, y + 0.60 * h, 0.94 * w, 0.38 * h, seed + 1)


def up_arrows(image, x, y, s, ink):
    """THIS SIDE UP: two arrows on a bar."""
    for dx in (0.28, 0.72):
        polygon(
            image,
            [
                (x + dx * s, y),
                (x + (dx + 0.16) * s, y + 0.28 * s),
                (x + (dx - 0.16) * s, y + 0.28 * s),
            ],
            ink,
        )
        rectangle(image, x + (dx - 0.055) * s, y + 0.28 * s, 0.11 * s, 0.50 * s, ink)
    rectangle(image, x + 0.05 * s, y + 0.86 * s, 0.90 * s, 0.09 * s, ink)


def glass(image, x, y, s, ink):
    """FRAGILE: a wine glass."""
    polygon(
        image,
        [
            (x + 0.25 * s, y),
            (x + 0.75 * s, y),
            (x + 0.66 * s, y + 0.42 * s),
            (x + 0.34 * s, y + 0.42 * s),
        ],
        ink,
    )
    rectangle(image, x + 0.47 * s, y + 0.40 * s, 0.07 * s, 0.42 * s, ink)
    polygon(
        image,
        [
            (x + 0.24 * s, y + 0.94 * s),
            (x + 0.76 * s, y + 0.94 * s),
            (x + 0.55 * s, y + 0.80 * s),
            (x + 0.45 * s, y + 0.80 * s),
        ],
        ink,
    )


def umbrella(image, x, y, s, ink):
    a = np.linspace(np.pi, 2 * np.pi, 14)
    polygon(
        image,
        np.stack([x + 0.5 * s + 0.45 * s * np.cos(a), y + 0.45 * s + 0.40 * s * np.sin(a)], -1),
        ink,
    )
    rectangle(image, x + 0.47 * s, y + 0.42 * s, 0.06 * s, 0.48 * s, ink)
    for i in range(3):
        line(
            image,
            (x + (0.1 + 0.35 * i) * s, y + 0.50 * s),
            (x + (0.04 + 0.35 * i) * s, y + 0.66 * s),
            0.03 * s,
            ink,
        )


def frame(image, x, y, w, h, t, ink):
    for a, b, c, d in ((x, y, w, t), (x, y + h - t, w, t), (x, y, t, h), (x + w - t, y, t, h)):
        rectangle(image, a, b, c, d, ink)


def handle(image, x, y):
    """A hand hole."""
    disc(image, x - 34, y, 17, (0.10, 0.08, 0.06))
    disc(image, x + 34, y, 17, (0.10, 0.08, 0.06))
    rectangle(image, x - 34, y - 17, 68, 34, (0.10, 0.08, 0.06))


def side(index):
    """One carton face."""
    seed, ink = 1000 + 37 * index, INK
    colour = KRAFT[index % 4]
    if index in (4, 11):
        colour = (0.84, 0.82, 0.78)
    image = board(colour, seed)
    if index == 0:
        tape(image, seed)
        address(image, 36, 318, 236, 164, seed)
        up_arrows(image, 360, 40, 104, ink)
        glass(image, 376, 340, 110, ink)
    elif index == 1:
        text(image, "NORDWARE", 256, 150, 86, (0.50, 0.10, 0.08), "middle")
        rectangle(image, 40, 172, 432, 8, (0.50, 0.10, 0.08))
        text(image, "pumps & fittings", 256, 222, 40, ink, "middle")
        barcode(image, 280, 360, 190, 104, seed)
        text(image, "ART. 40-771  QTY 24", 40, 420, 24, ink)
        text(image, "LOT 0931 / B", 40, 456, 24, ink)
    elif index == 2:
        tape(image, seed, True, 256, 62)
        handle(image, 256, 150)
        matrix(image, 60, 330, 120, seed)
        for k, icon in enumerate((up_arrows, glass, umbrella)):
            frame(image, 300 + 66 * k, 420, 60, 66, 3, ink)
            icon(image, 306 + 66 * k, 428, 48, ink)
    elif index == 3:
        rectangle(image, 0, 60, 512, 120, (0.10, 0.22, 0.38))
        text(image, "HELIX", 40, 158, 110, WHITE)
        text(image, "Model HX-200", 330, 110, 22, WHITE)
        text(image, "230 V  50 Hz", 330, 146, 22, WHITE)
        address(image, 250, 260, 230, 180, seed)
        up_arrows(image, 50, 300, 130, (0.10, 0.22, 0.38))
    elif index == 4:
        frame(image, 24, 24, 464, 464, 6, (0.15, 0.35, 0.20))
        text(image, "VERDE", 256, 190, 120, (0.15, 0.35, 0.20), "middle")
        for k in range(6):
            disc(image, 96 + 64 * k, 270, 22, (0.20, 0.45, 0.24))
        barcode(image, 150, 350, 212, 110, seed)
    elif index == 5:
        tape(image, seed, at=120)
        address(image, 150, 210, 300, 220, seed)
        text(image, "7", 60, 460, 150, (0.20, 0.16, 0.14))
    elif index == 6:
        for k in range(4):
            text(
                image, "CARE  CARE  CARE", 256, 110 + 112 * k, 50, np.array(colour) * 0.62, "middle"
            )
        rectangle(image, 300, 60, 180, 90, (0.86, 0.20, 0.12))
        text(image, "FRAGILE", 390, 122, 42, WHITE, "middle")
        barcode(image, 40, 370, 220, 100, seed)
    elif index == 7:
        handle(image, 256, 120)
        text(image, "STAHLKONTOR", 256, 270, 56, ink, "middle")
        line(image, (40, 300), (472, 300), 5, ink)
        text(image, "M12 x 60   ISO 4017", 256, 345, 34, ink, "middle")
        text(image, "500 pcs   18.2 kg", 256, 395, 34, ink, "middle")
        matrix(image, 400, 410, 76, seed)
        up_arrows(image, 30, 400, 90, ink)
    elif index == 8:
        tape(image, seed, at=256, width=70, colour=(0.82, 0.80, 0.74))
        for k in range(5):
            text(image, "SECURITY SEAL", 10 + 104 * k, 264, 13, (0.6, 0.1, 0.1))
        address(image, 40, 36, 220, 150, seed)
        umbrella(image, 370, 350, 110, ink)
    elif index == 9:
        rectangle(image, 0, 300, 512, 212, (0.72, 0.46, 0.10))
        text(image, "ORANJE", 256, 180, 104, (0.62, 0.28, 0.05), "middle")
        text(image, "fruit juice 12 x 1 l", 256, 240, 38, ink, "middle")
        for k in range(5):
            disc(image, 80 + 88 * k, 380, 36, (0.90, 0.60, 0.14))
            disc(image, 72 + 88 * k, 372, 12, (0.97, 0.78, 0.35))
        barcode(image, 160, 430, 192, 72, seed)
    elif index == 10:
        address(image, 60, 60, 260, 190, seed)
        address(image, 180, 290, 240, 170, seed + 5)
        text(image, "CHECKED", 350, 250, 44, (0.12, 0.28, 0.52), turned=True)
    elif index == 11:
        rectangle(image, 0, 0, 512, 96, (0.10, 0.10, 0.12))
        text(image, "TECHLINE 27", 30, 72, 62, WHITE)
        frame(image, 120, 150, 272, 190, 10, (0.12, 0.12, 0.14))
        rectangle(image, 138, 168, 236, 154, (0.30, 0.42, 0.55))
        rectangle(image, 220, 340, 72, 40, (0.12, 0.12, 0.14))
        rectangle(image, 180, 380, 152, 12, (0.12, 0.12, 0.14))
        barcode(image, 300, 420, 190, 80, seed)
        up_arrows(image, 40, 410, 80, INK)
    return np.clip(image, 0, 1)


def top(index):
    """A closed lid: the slot between the flaps, tape over it."""
    seed = 3000 + 91 * index
    image = board(KRAFT[(index + 1) % 4], seed)
    rectangle(image, 0, 254, 512, 4, (0.16, 0.12, 0.08))
    tape(image, seed, at=256, width=64 + 10 * index)
    if index == 0:
        address(image, 290, 310, 200, 150, seed)
    elif index == 1:
        text(image, "OPEN HERE", 256, 130, 46, INK, "middle")
    elif index == 2:
        matrix(image, 40, 40, 110, seed)
        text(image, "C-118", 330, 440, 60, INK)
    return np.clip(image, 0, 1)


def sheet():
    """(picture 2048 x 2048, {name: [x, y, w, h]})."""
    cells = [side(i) for i in range(12)] + [top(i) for i in range(4)]
    names = [f"side_{i}" for i in range(12)] + [f"top_{i}" for i in range(4)]
    image = np.zeros((4 * CELL, 4 * CELL, 3))
    rects = {}
    for k, (name, cell) in enumerate(zip(names, cells)):
        y, x = CELL * (k // 4), CELL * (k % 4)
        image[y : y + CELL, x : x + CELL] = cell
        rects[name] = [x, y, CELL, CELL]
    return image, rects
