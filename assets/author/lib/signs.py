"""Warehouse signs on one sheet: pictograms, aisle letters, bay numbers, dock numbers, notices."""

import numpy as np

from . import noise, surfaces
from .cartons import matrix
from .picture import disc, line, polygon, rectangle, text

INK, WHITE, YELLOW = (0.05, 0.05, 0.06), (0.95, 0.95, 0.93), (0.96, 0.80, 0.08)
RED, BLUE, GREEN = (0.76, 0.09, 0.08), (0.07, 0.27, 0.60), (0.03, 0.45, 0.22)


def person(image, x, y, s, c, stride=0.0):
    """A walking figure s pixels tall, feet at (x, y)."""
    disc(image, x, y - 0.90 * s, 0.09 * s, c)
    line(image, (x, y - 0.78 * s), (x + 0.02 * s, y - 0.42 * s), 0.17 * s, c)
    line(image, (x, y - 0.44 * s), (x + (0.12 + stride) * s, y), 0.09 * s, c)
    line(image, (x, y - 0.44 * s), (x - (0.10 + stride) * s, y), 0.09 * s, c)
    line(image, (x, y - 0.74 * s), (x + (0.18 + stride) * s, y - 0.46 * s), 0.065 * s, c)
    line(image, (x, y - 0.74 * s), (x - (0.16 + stride) * s, y - 0.48 * s), 0.065 * s, c)


def truck(image, x, y, s, c):
    """A forklift in profile, s pixels wide, floor at y, forks left."""
    polygon(
        image,
        [
            (x + 0.35 * s, y - 0.12 * s),
            (x + 0.35 * s, y - 0.36 * s),
            (x + 0.85 * s, y - 0.40 * s),
            (x + 0.95 * s, y - 0.30 * s),
            (x + 0.95 * s, y - 0.12 * s),
        ],
        c,
    )
    for a, b in (
        ((0.40, 0.36), (0.46, 0.74)),
        ((0.46, 0.74), (0.80, 0.74)),
        ((0.80, 0.74), (0.84, 0.40)),
        ((0.27, 0.80), (0.27, 0.04)),
        ((0.27, 0.08), (0.02, 0.08)),
    ):
        line(image, (x + a[0] * s, y - a[1] * s), (x + b[0] * s, y - b[1] * s), 0.045 * s, c)
    for w in (0.46, 0.82):
        disc(image, x + w * s, y - 0.09 * s, 0.095 * s, c)
    disc(image, x + 0.62 * s, y - 0.60 * s, 0.06 * s, c)
    line(image, (x + 0.63 * s, y - 0.54 * s), (x + 0.66 * s, y - 0.38 * s), 0.09 * s, c)


def plate(image, x, y, w, h, ground, rim):
    rectangle(image, x, y, w, h, rim)
    rectangle(image, x + 6, y + 6, w - 12, h - 12, ground)


def exit_sign(i, x, y):
    plate(i, x, y, 512, 256, GREEN, WHITE)
    person(i, x + 130, y + 222, 190, WHITE, 0.12)
    rectangle(i, x + 205, y + 40, 70, 182, WHITE)
    polygon(i, [(x + 490, y + 128), (x + 400, y + 60), (x + 400, y + 196)], WHITE)
    rectangle(i, x + 310, y + 104, 96, 48, WHITE)


def warning(i, x, y, draw, words):
    plate(i, x, y, 256, 256, WHITE, INK)
    polygon(i, [(x + 128, y + 12), (x + 244, y + 206), (x + 12, y + 206)], INK)
    polygon(i, [(x + 128, y + 36), (x + 224, y + 195), (x + 32, y + 195)], YELLOW)
    draw()
    text(i, words, x + 128, y + 242, 30, INK, "middle")


def mandatory(i, x, y, draw, words):
    plate(i, x, y, 256, 256, WHITE, BLUE)
    disc(i, x + 128, y + 108, 96, BLUE)
    draw()
    text(i, words, x + 128, y + 242, 28, INK, "middle")


def prohibited(i, x, y, draw, words):
    plate(i, x, y, 256, 256, WHITE, INK)
    disc(i, x + 128, y + 108, 98, RED)
    disc(i, x + 128, y + 108, 78, WHITE)
    draw()
    line(i, (x + 70, y + 50), (x + 186, y + 166), 20, RED)
    text(i, words, x + 128, y + 242, 28, INK, "middle")


def vest(i, x, y, c):
    polygon(i, [(x - 40, y - 60), (x - 12, y - 60), (x, y - 20), (x, y + 66), (x - 44, y + 66)], c)
    polygon(i, [(x + 40, y - 60), (x + 12, y - 60), (x, y - 20), (x, y + 66), (x + 44, y + 66)], c)
    rectangle(i, x - 46, y + 10, 92, 14, BLUE)
    rectangle(i, x - 46, y + 36, 92, 14, BLUE)


def helmet(i, x, y, c):
    disc(i, x, y + 10, 52, c)
    rectangle(i, x - 60, y + 18, 120, 60, BLUE)
    rectangle(i, x - 70, y + 14, 140, 14, c)


def extinguisher(i, x, y):
    plate(i, x, y, 256, 256, RED, WHITE)
    rectangle(i, x + 60, y + 80, 66, 140, WHITE)
    disc(i, x + 93, y + 82, 33, WHITE)
    rectangle(i, x + 82, y + 34, 22, 24, WHITE)
    line(i, (x + 93, y + 44), (x + 140, y + 70), 10, WHITE)
    for r, c in ((30, WHITE), (20, RED)):
        disc(i, x + 188, y + 180, r, c)
    polygon(i, [(x + 188, y + 90), (x + 224, y + 186), (x + 152, y + 186)], WHITE)


def first_aid(i, x, y):
    plate(i, x, y, 256, 256, GREEN, WHITE)
    rectangle(i, x + 98, y + 40, 60, 176, WHITE)
    rectangle(i, x + 40, y + 98, 176, 60, WHITE)


def speed(i, x, y, value):
    plate(i, x, y, 256, 256, WHITE, INK)
    disc(i, x + 128, y + 110, 100, RED)
    disc(i, x + 128, y + 110, 78, WHITE)
    text(i, value, x + 128, y + 158, 130, INK, "middle")
    text(i, "km/h", x + 128, y + 246, 34, INK, "middle")


def aisle(i, x, y, letter):
    plate(i, x, y, 256, 256, BLUE, WHITE)
    text(i, letter, x + 128, y + 206, 220, WHITE, "middle")


def bay(i, x, y, words):
    plate(i, x, y, 256, 128, YELLOW, INK)
    text(i, words, x + 128, y + 78, 58, INK, "middle")
    for k in range(36):
        rectangle(i, x + 40 + 5 * k, y + 92, 2 + (k * 7 % 3), 24, INK)


def notice(i, x, y, head, seed):
    """A poster: heading, lines of small print, a code."""
    plate(i, x, y, 256, 384, WHITE, (0.5, 0.5, 0.5))
    rectangle(i, x + 6, y + 6, 244, 60, (BLUE, RED, GREEN, INK)[seed % 4])
    text(i, head, x + 128, y + 50, 38, WHITE, "middle")
    rng = np.random.default_rng(seed)
    for k in range(16):
        rectangle(i, x + 20, y + 84 + 12 * k, rng.uniform(120, 216), 5, (0.25, 0.25, 0.27))
    matrix(i, x + 24, y + 290, 76, seed)
    rectangle(i, x + 120, y + 290, 112, 76, (0.70, 0.74, 0.78))
    line(i, (x + 126, y + 350), (x + 160, y + 310), 5, RED)
    line(i, (x + 160, y + 310), (x + 226, y + 340), 5, RED)


def dock(i, x, y, number):
    plate(i, x, y, 256, 256, WHITE, INK)
    text(i, "DOCK", x + 128, y + 78, 62, INK, "middle")
    text(i, number, x + 128, y + 232, 170, INK, "middle")


def sheet():
    """(picture 1024 x 2048, {name: [x, y, w, h]})."""
    i = surfaces.flat((1024, 2048), (0.75, 0.75, 0.74))
    rects = {}

    def put(name, x, y, w, h, draw, *rest):
        draw(i, x, y, *rest)
        rects[name] = [x, y, w, h]

    put("exit", 0, 0, 512, 256, exit_sign)
    put("forklifts", 512, 0, 256, 256, warning, lambda: truck(i, 592, 186, 96, INK), "FORKLIFTS")
    put(
        "hazard",
        768,
        0,
        256,
        256,
        warning,
        lambda: (rectangle(i, 886, 90, 20, 60, INK), disc(i, 896, 174, 12, INK)),
        "CAUTION",
    )
    put("vest", 1024, 0, 256, 256, mandatory, lambda: vest(i, 1152, 106, WHITE), "WEAR VEST")
    put("helmet", 1280, 0, 256, 256, mandatory, lambda: helmet(i, 1408, 86, WHITE), "HARD HAT")
    put(
        "no_walking",
        1536,
        0,
        256,
        256,
        prohibited,
        lambda: person(i, 1664, 166, 118, INK, 0.05),
        "NO ENTRY",
    )
    put(
        "no_trucks",
        1792,
        0,
        256,
        256,
        prohibited,
        lambda: truck(i, 1862, 150, 116, INK),
        "NO TRUCKS",
    )
    put("extinguisher", 0, 256, 256, 256, extinguisher)
    put("first_aid", 256, 256, 256, 256, first_aid)
    put("speed", 512, 256, 256, 256, speed, "5")
    for k, number in enumerate("1234"):
        put(f"dock_{number}", 768 + 256 * k, 256, 256, 256, dock, number)
    put("speed_10", 1792, 256, 256, 256, speed, "10")
    for k, letter in enumerate("ABCDEFGH"):
        put(f"aisle_{letter.lower()}", 256 * k, 512, 256, 256, aisle, letter)
    for k in range(8):
        put(
            f"bay_{k + 1}",
            256 * (k % 4),
            768 + 128 * (k // 4),
            256,
            128,
            bay,
            f"{'AABBCCDD'[k]}-{14 + 7 * k:02d}-{1 + k % 4}",
        )
    for k, head in enumerate(("NOTICE", "FIRE PLAN", "RULES", "SHIFT 2")):
        i_y = 768
        rects[f"poster_{k + 1}"] = [1024 + 256 * k, i_y, 256, 256]
        small = surfaces.flat((384, 256), WHITE)
        notice(small, 0, 0, head, k)
        rows = np.linspace(0, 383, 256).astype(int)
        i[i_y : i_y + 256, 1024 + 256 * k : 1280 + 256 * k] = small[rows]
    i *= (1.0 + 0.03 * noise.picture((1024, 2048), 2.4, 2, 3))[..., None]
    dirt = surfaces.scratches((1024, 2048), 60, 9, (20, 120))
    return np.clip(surfaces.mix(i, (0.45, 0.44, 0.42), 0.45 * dirt), 0, 1), rects
