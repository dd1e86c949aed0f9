"""Strokes of paint in space: bands, lines, mixtures and the unevenness of materials."""

import numpy as np

from .noise import fractal, lattice, step

SILVER = np.array([0.74, 0.75, 0.76])
DARK = np.array([0.07, 0.07, 0.08])


def band(x, lo, hi, soft=0.0015):
    """1 where lo < x < hi."""
    return step(lo - soft, lo + soft, x) * step(hi + soft, hi - soft, x)


def line(x, width=0.0016, soft=0.0012):
    """1 where |x| < width."""
    return step(width + soft, width, np.abs(x))


def over(base, colour, alpha):
    return base + (np.asarray(colour) - base) * np.asarray(alpha)[:, None]


def flat(colour, count):
    return np.tile(np.array(colour, float), (count, 1))


def weave(q, seed, grain=0.04):
    """Fine and coarse unevenness of cloth as a factor about 1."""
    fine = lattice(q * 420.0, seed) - 0.5
    middle = fractal(q * 60.0, 3, seed + 1) - 0.5
    worn = fractal(q * 9.0, 3, seed + 2) - 0.5
    return 1.0 + grain * fine * 1.6 + 0.08 * middle + 0.12 * worn


def dirt(rgb, q, amount, seed):
    """Stains and dust."""
    spot = step(0.62, 0.76, fractal(q * 14.0, 4, seed))
    smear = step(0.58, 0.72, fractal(q * (22.0, 22.0, 6.0), 3, seed + 4))
    rgb = over(rgb, np.array([0.20, 0.17, 0.14]), amount * spot)
    return over(rgb, np.array([0.62, 0.58, 0.52]), 0.6 * amount * smear)


def plate(x, y, half_x, half_y):
    """Distance outside a rectangle (negative inside)."""
    return np.maximum(np.abs(x) - half_x, np.abs(y) - half_y)


def raised(d, height, soft=0.002):
    """Something flat of a height lying where d < 0."""
    return height * step(soft, -soft, d)
