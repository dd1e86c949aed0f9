"""Deterministic noise for shapes and paint: lattice noise in space, periodic noise in pictures."""

import numpy as np

_LATTICE = np.random.default_rng(7).random((64, 64, 64)).astype(np.float32)


def lattice(points, seed=0):
    """Smooth value noise in [0, 1] at points (N, 3); one feature per unit of length."""
    p = np.asarray(points, np.float32) + np.float32(17.31 * seed + 100.0)
    cell = np.floor(p).astype(np.int32)
    t = p - cell
    t = t * t * (3.0 - 2.0 * t)
    lo, hi = cell & 63, (cell + 1) & 63
    out = np.zeros(len(p), np.float32)
    for ix, wx in ((lo[:, 0], 1 - t[:, 0]), (hi[:, 0], t[:, 0])):
        for iy, wy in ((lo[:, 1], 1 - t[:, 1]), (hi[:, 1], t[:, 1])):
            for iz, wz in ((lo[:, 2], 1 - t[:, 2]), (hi[:, 2], t[:, 2])):
                out += _LATTICE[ix, iy, iz] * wx * wy * wz
    return out


def fractal(points, octaves=4, seed=0):
    """Sum of octaves of lattice noise, in [0, 1] with mean 0.5."""
    p = np.asarray(points, np.float32)
    total, weight = np.zeros(len(p), np.float32), 0.0
    for octave in range(octaves):
        total += lattice(p * 2.0**octave, seed + octave) * 0.5**octave
        weight += 0.5**octave
    return total / weight


def ridged(points, seed=0):
    """Noise with soft crests, in [0, 1]: cloth folds."""
    return 1.0 - np.abs(2.0 * lattice(points, seed) - 1.0)


def picture(shape, beta, seed, low=1.0, stretch=(1.0, 1.0)):
    """Tileable noise picture with spectrum 1/f^beta above `low` cycles, zero mean, unit deviation.

    stretch makes features longer along rows (first number) or columns (second number).
    """
    height, width = shape
    rng = np.random.default_rng(seed)
    spectrum = np.fft.rfft2(rng.standard_normal(shape))
    fy = np.fft.fftfreq(height)[:, None] * height * stretch[0]
    fx = np.fft.rfftfreq(width)[None, :] * width * stretch[1]
    f = np.hypot(fy, fx)
    gain = np.where(f < low, 0.0, np.maximum(f, 1e-9) ** (-beta / 2.0))
    gain[0, 0] = 0.0
    out = np.fft.irfft2(spectrum * gain, s=shape)
    return (out - out.mean()) / out.std()


def step(lo, hi, x):
    """Smooth step from 0 at lo to 1 at hi."""
    t = np.clip((x - lo) / (hi - lo), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
