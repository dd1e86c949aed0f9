"""The sheet of labels and warning signs on machines."""

import numpy as np

from . import surfaces
from .picture import disc, line, polygon, rectangle, text

INK, WHITE, YELLOW, RED, BLUE = (
    (0.05, 0.05, 0.06),
    (0.93, 0.93, 0.91),
    (0.95, 0.78, 0.08),
    (0.75, 0.10, 0.08),
    (0.08, 0.25, 0.55),
)
SHEET = (512, 512)
RECTS = {
    "name": (0, 0, 512, 96),
    "number": (0, 96, 128, 128),
    "plate": (128, 96, 192, 128),
    "warning": (320, 96, 128, 128),
    "hazard": (0, 224, 512, 64),
    "load": (0, 288, 160, 128),
    "no_riders": (160, 288, 128, 128),
    "fork_warning": (288, 288, 160, 128),
    "panel": (0, 416, 192, 96),
    "stripes_red": (192, 416, 320, 48),
    "reflector": (192, 464, 96, 48),
    "grille": (288, 464, 224, 48),
    "arrow": (448, 96, 64, 128),
    "lamp": (448, 288, 64, 128),
}


def sheet(name, number, ground, seed=0):
    """All labels for a machine called `name` with a fleet number, on paint of colour `ground`."""
    image = surfaces.flat(SHEET, ground)
    text(image, name, 256, 74, 84, INK, "middle")
    rectangle(image, 20, 84, 472, 5, INK)
    rectangle(image, 0, 96, 128, 128, WHITE)
    rectangle(image, 6, 102, 116, 116, INK)
    text(image, number, 64, 192, 88, WHITE, "middle")
    plate(image, 128, 96)
    triangle_sign(image, 320, 96)
    image[224:288] = surfaces.hazard((64, 512), 32, seed=seed + 1, wear=0.6)
    load_chart(image, 0, 288)
    no_sign(image, 160, 288)
    rectangle(image, 288, 288, 160, 128, YELLOW)
    rectangle(image, 294, 294, 148, 116, WHITE)
    rectangle(image, 294, 294, 148, 34, INK)
    text(image, "DANGER", 368, 320, 28, YELLOW, "middle")
    for i, words in enumerate(("KEEP CLEAR", "OF THE MAST", "AND FORKS")):
        text(image, words, 368, 350 + 24 * i, 20, INK, "middle")
    panel(image, 0, 416)
    image[416:464, 192:512] = surfaces.hazard((48, 320), 20, WHITE, RED, seed + 2, 0.4)
    rectangle(image, 192, 464, 96, 48, (0.55, 0.06, 0.05))
    for i in range(12):
        line(image, (192 + 8 * i, 464), (200 + 8 * i, 512), 1.5, (0.75, 0.2, 0.15))
    rectangle(image, 288, 464, 224, 48, (0.09, 0.09, 0.09))
    for i in range(6):
        rectangle(image, 292, 467 + 8 * i, 216, 3, (0.20, 0.20, 0.20))
    rectangle(image, 448, 96, 64, 128, BLUE)
    polygon(image, [(480, 104), (506, 146), (454, 146)], WHITE)
    rectangle(image, 470, 146, 20, 70, WHITE)
    rectangle(image, 448, 288, 64, 128, (0.12, 0.12, 0.12))
    for y, c in ((310, (0.85, 0.45, 0.06)), (352, (0.75, 0.06, 0.05)), (394, (0.90, 0.90, 0.86))):
        disc(image, 480, y, 18, c)
        disc(image, 475, y - 5, 5, np.minimum(np.array(c) + 0.15, 1))
    scuff = surfaces.scratches(SHEET, 60, seed + 5, (10, 70))
    return np.clip(surfaces.mix(image, (0.4, 0.39, 0.37), 0.5 * scuff), 0, 1)


def plate(image, x, y):
    """Type plate: small lines of data."""
    rectangle(image, x, y, 192, 128, (0.70, 0.71, 0.72))
    rectangle(image, x + 4, y + 4, 184, 120, (0.82, 0.83, 0.84))
    rectangle(image, x + 4, y + 4, 184, 26, INK)
    text(image, "TYPE PLATE", x + 96, y + 25, 20, WHITE, "middle")
    for i, row in enumerate(
        (
            "Serial  A31-0417",
            "Mass    4160 kg",
            "Load    2500 kg",
            "Height  3300 mm",
            "Year    2021",
        )
    ):
        text(image, row, x + 12, y + 48 + 17 * i, 14, INK)


def triangle_sign(image, x, y):
    rectangle(image, x, y, 128, 128, WHITE)
    polygon(image, [(x + 64, y + 6), (x + 124, y + 112), (x + 4, y + 112)], INK)
    polygon(image, [(x + 64, y + 22), (x + 110, y + 104), (x + 18, y + 104)], YELLOW)
    polygon(image, [(x + 58, y + 46), (x + 70, y + 46), (x + 67, y + 80), (x + 61, y + 80)], INK)
    disc(image, x + 64, y + 91, 7, INK)


def no_sign(image, x, y):
    rectangle(image, x, y, 128, 128, WHITE)
    disc(image, x + 64, y + 64, 60, RED)
    disc(image, x + 64, y + 64, 47, WHITE)
    disc(image, x + 60, y + 38, 10, INK)
    polygon(image, [(x + 50, y + 50), (x + 72, y + 50), (x + 76, y + 84), (x + 48, y + 84)], INK)
    polygon(image, [(x + 48, y + 80), (x + 60, y + 80), (x + 56, y + 104), (x + 46, y + 104)], INK)
    polygon(image, [(x + 64, y + 80), (x + 76, y + 80), (x + 84, y + 104), (x + 74, y + 104)], INK)
    line(image, (x + 26, y + 26), (x + 102, y + 102), 12, RED)


def load_chart(image, x, y):
    rectangle(image, x, y, 160, 128, WHITE)
    text(image, "2500 kg", x + 80, y + 30, 28, INK, "middle")
    line(image, (x + 20, y + 112), (x + 148, y + 112), 3, INK)
    line(image, (x + 20, y + 40), (x + 20, y + 112), 3, INK)
    for i, (a, b) in enumerate(
        (((20, 52), (80, 58)), ((80, 58), (144, 92)), ((20, 66), (70, 74)), ((70, 74), (140, 104)))
    ):
        line(image, (x + a[0], y + a[1]), (x + b[0], y + b[1]), 3, BLUE if i < 2 else RED)
    for i in range(5):
        line(image, (x + 20 + 30 * i, y + 108), (x + 20 + 30 * i, y + 116), 2, INK)


def panel(image, x, y):
    """Instrument panel."""
    rectangle(image, x, y, 192, 96, (0.10, 0.10, 0.11))
    rectangle(image, x + 50, y + 14, 92, 52, (0.35, 0.45, 0.40))
    text(image, "7.4", x + 96, y + 54, 36, INK, "middle")
    for i in range(4):
        disc(image, x + 18 + 10 * (i % 2), y + 24 + 18 * (i // 2), 5, (RED, YELLOW, WHITE, BLUE)[i])
        rectangle(image, x + 150, y + 14 + 18 * i, 30, 12, (0.3, 0.3, 0.32))
    text(image, "LIFT  TILT  SHIFT", x + 96, y + 86, 14, WHITE, "middle")
