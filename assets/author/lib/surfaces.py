"""Tileable surfaces as pictures: paint, metal, rubber, plastic, wood, concrete, with honest wear."""

import numpy as np

from . import noise, picture


def flat(size, colour):
    return np.tile(np.asarray(colour, float), (*size, 1))


def mix(image, colour, alpha):
    return image + (np.asarray(colour) - image) * np.clip(alpha, 0, 1)[..., None]


def threshold(field, lo, hi):
    return noise.step(lo, hi, field)


def scratches(size, count, seed, length=(20, 160), width=(0.6, 1.6), lean=None):
    """Coverage of fine scratches that wrap round the tile's edges."""
    rng = np.random.default_rng(seed)
    h, w = size
    sheet = np.zeros((h * 3, w * 3, 1))
    for _ in range(count):
        x, y = rng.random(2) * [w, h] + [w, h]
        angle = rng.random() * np.pi if lean is None else lean + rng.normal() * 0.15
        step = rng.uniform(*length) * np.array([np.cos(angle), np.sin(angle)])
        bow = rng.normal(size=2) * 0.05 * np.linalg.norm(step)
        wide = rng.uniform(*width)
        a, m, b = np.array([x, y]), np.array([x, y]) + 0.5 * step + bow, np.array([x, y]) + step
        picture.line(sheet, a, m, wide, rng.uniform(0.4, 1.0))
        picture.line(sheet, m, b, wide, 0.7)
    return sheet.reshape(3, h, 3, w).max((0, 2))


def paint(colour, seed, size=(512, 512), wear=1.0):
    """Machine paint: blotches, dust, scratches to primer and a few chips to bare metal."""
    image = flat(size, colour)
    image *= (1.0 + 0.045 * noise.picture(size, 2.2, seed, 2))[..., None]
    image = mix(
        image,
        np.array(colour) * 0.55,
        0.55 * wear * threshold(noise.picture(size, 2.4, seed + 1, 2), 0.9, 2.0),
    )
    image = mix(
        image,
        (0.55, 0.52, 0.48),
        0.35 * wear * threshold(noise.picture(size, 2.0, seed + 2, 3), 0.8, 2.2),
    )
    runs = noise.picture(size, 2.0, seed + 3, 3, stretch=(0.12, 1.0))
    image = mix(image, np.array(colour) * 0.45, 0.40 * wear * threshold(runs, 1.2, 2.4))
    image = mix(
        image, np.array(colour) * 0.45 + 0.08, 0.7 * scratches(size, int(46 * wear), seed + 4)
    )
    chips = threshold(noise.picture(size, 1.7, seed + 5, 8), 2.3, 2.5)
    image = mix(image, (0.20, 0.17, 0.15), 0.85 * wear * chips)
    return image * (1.0 + 0.02 * noise.picture(size, 0.4, seed + 6))[..., None]


def metal(colour, seed, size=(512, 512), lean=np.pi / 2, grease=0.6):
    """Steel with rolling marks, grease and rust tints."""
    image = flat(size, colour)
    brushed = noise.picture(size, 1.2, seed, 4, stretch=(0.10, 1.0))
    image *= (1.0 + 0.07 * brushed + 0.06 * noise.picture(size, 2.2, seed + 1, 2))[..., None]
    image = mix(
        image,
        np.array(colour) * 0.35,
        grease * threshold(noise.picture(size, 2.3, seed + 2, 2), 0.6, 1.8),
    )
    image = mix(
        image, (0.36, 0.24, 0.17), 0.45 * threshold(noise.picture(size, 1.9, seed + 3, 5), 1.5, 2.4)
    )
    image = mix(
        image,
        np.minimum(np.array(colour) * 1.9 + 0.08, 1),
        0.6 * scratches(size, 60, seed + 4, lean=lean),
    )
    return image * (1.0 + 0.03 * noise.picture(size, 0.3, seed + 5))[..., None]


def rubber(seed, size=(256, 256)):
    """Tyre rubber with dust in it."""
    image = flat(size, (0.105, 0.105, 0.108))
    image = mix(
        image, (0.34, 0.32, 0.29), 0.75 * threshold(noise.picture(size, 2.0, seed, 2), 0.1, 2.0)
    )
    image = mix(
        image, (0.05, 0.05, 0.05), 0.6 * threshold(noise.picture(size, 1.6, seed + 1, 6), 1.0, 2.0)
    )
    return image * (1.0 + 0.10 * noise.picture(size, 0.6, seed + 2))[..., None]


def plastic(colour, seed, size=(256, 256)):
    """Grained plastic or vinyl with rubbed patches."""
    image = flat(size, colour)
    image *= (
        1.0 + 0.05 * noise.picture(size, 0.8, seed) + 0.06 * noise.picture(size, 2.4, seed + 1, 2)
    )[..., None]
    image = mix(image, np.array(colour) * 1.5 + 0.04, 0.5 * scratches(size, 26, seed + 2, (8, 60)))
    return mix(
        image, (0.45, 0.43, 0.40), 0.25 * threshold(noise.picture(size, 2.2, seed + 3, 2), 0.8, 2.2)
    )


def hazard(size, stripe, a=(0.93, 0.76, 0.08), b=(0.07, 0.07, 0.07), seed=0, wear=1.0):
    """Diagonal stripes that tile when size is a multiple of the stripe pair in both directions."""
    h, w = size
    y, x = np.mgrid[0:h, 0:w] + 0.5
    t = ((x + y) / (2.0 * stripe)) % 1.0
    edge = 0.7 / (2.0 * stripe)
    cover = noise.step(0.25 - edge, 0.25 + edge, np.abs(t - 0.5))
    image = np.asarray(a) + (np.asarray(b) - np.asarray(a)) * cover[..., None]
    image = image * (1.0 + 0.05 * noise.picture(size, 2.0, seed, 2))[..., None]
    image = mix(
        image,
        (0.36, 0.35, 0.34),
        0.8 * wear * threshold(noise.picture(size, 1.8, seed + 1, 5), 1.5, 2.0),
    )
    image = mix(image, (0.45, 0.44, 0.42), 0.6 * wear * scratches(size, 40, seed + 2))
    return image
