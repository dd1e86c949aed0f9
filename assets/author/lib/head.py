"""The head as a signed distance field: skull, face, lids and ears; and the eyes.

Metres of an average head: x forward, y left, z up from eye height between the eyes.
"""

import numpy as np

from . import sdf
from .body import mirrored, near
from .noise import lattice, step

EYE_RADIUS = 0.0124


def face_frame(person, q):
    """Points in the head's frame, and the head's scale: tall people have relatively small heads."""
    k = (1.75 / person.height_m) ** 0.4
    return (q - [0.0, 0.0, 1.755]) / k + [0.0, 0.0, 0.118], k


def from_face(person, f):
    """Inverse of face_frame."""
    k = (1.75 / person.height_m) ** 0.4
    return (f - [0.0, 0.0, 0.118]) * k + [0.0, 0.0, 1.755]


def eye_centre(person):
    """Of the left eye, in the head's frame."""
    return np.array([0.0735, 0.0315 * person.face.apart, 0.0])


def skull(person, f):
    """Cranium and forehead: what hair and helmets sit on."""
    g = person.girth**0.3
    deep = person.face.skull
    d = sdf.ellipsoid(f, (-0.012 * deep, 0, 0.026), (0.097 * deep, 0.0755 * g, 0.092))
    return sdf.union(d, sdf.ellipsoid(f, (0.030, 0, 0.042), (0.060, 0.060 * g, 0.058)), 0.022)


def beard_mask(person, f):
    """Share of beard at points of the face, 0 to 1."""
    if not person.beard:
        return np.zeros(len(f))
    L, m = person.face.length, mirrored(f)
    x, a, z = f[:, 0], m[:, 1], f[:, 2]
    zm = mouth_height(person)
    lip = step(zm + 0.003, zm + 0.007, z) * step(-0.036 * person.face.nose_length, zm + 0.014, z)
    lip = lip * step(0.034, 0.024, a) * step(0.07, 0.085, x)
    if person.beard == "moustache":
        return lip
    top = -0.050 * L + 0.75 * (0.060 - x).clip(0, 0.1)
    jaw = step(top + 0.008, top - 0.010, z) * step(-0.012, 0.006, x) * step(-0.150, -0.125, z)
    bare = near(a, 0, 0.024) ** 2 * step(0.010, 0.006, np.abs(z - zm)) * step(0.06, 0.08, x)
    corner = step(zm + 0.02, zm - 0.004, z)
    return np.clip(np.maximum(jaw * np.maximum(corner, step(0.026, 0.034, a)) * (1 - bare), lip), 0, 1)


def mouth_height(person):
    return -0.0650 * person.face.length - 0.002 * (person.face.nose_length - 1)


def opening(person, m):
    """Almond between the lids: below 0 inside; m is mirrored and relative to the eye's centre."""
    e = person.face.eyes
    y, z = m[:, 1], m[:, 2]
    half = 0.0148
    t = np.clip(np.abs(y) / half, 0, 1)
    up = 0.0062 * e * (1 - t**2.2) ** 0.9
    down = -0.0046 * e * (1 - t**2.0)
    tilt = 0.05 * y
    return np.maximum(np.maximum(z - tilt - up, down - z + tilt), np.abs(y) - half)


def head(person, q):
    f, k = face_frame(person, q)
    c, g, age = person.face, person.girth**0.4, person.age
    m = mirrored(f)
    L = c.length
    d = skull(person, f)
    d = sdf.union(d, sdf.ellipsoid(f, (0.036, 0, -0.036 * L), (0.052, 0.057 * c.cheeks * g, 0.074 * L)), 0.026)
    jaw = sdf.capsule(m, (-0.004, 0.0490 * c.jaw * g, -0.060 * L), (0.066 + c.chin, 0.015, -0.099 * L), 0.0195, 0.0165)
    d = sdf.union(d, jaw, 0.026)
    d = sdf.union(d, sdf.ellipsoid(f, (0.0815 + c.chin, 0, -0.099 * L), (0.0175, 0.021 * c.jaw, 0.0155)), 0.018)
    d = sdf.union(d, sdf.ellipsoid(m, (0.063, 0.0425 * c.cheeks, -0.022), (0.021, 0.019, 0.016)), 0.022)
    soft = 0.018 + c.full
    d = sdf.union(d, sdf.ellipsoid(m, (0.052, 0.042, -0.058 * L), (soft, soft, soft + 0.006)), 0.024)
    if c.full > 0.006:  # under the chin
        d = sdf.union(d, sdf.ellipsoid(f, (0.030, 0, -0.112 * L), (0.040, 0.040, 0.018 + c.full)), 0.02)
    # Brows, temples, sockets.
    ridge = sdf.capsule(m, (0.0895, 0.007, 0.0205), (0.073, 0.047, 0.0180), 0.0072 * c.brow, 0.0062 * c.brow)
    d = sdf.union(d, ridge, 0.016)
    d = sdf.cut(d, sdf.ellipsoid(m, (0.050, 0.083 * g, 0.020), (0.026, 0.014, 0.026)), 0.02)
    e = eye_centre(person)
    d = sdf.cut(d, sdf.ellipsoid(m, e + [0.0265, 0.0, 0.0005], (0.018, 0.0205, 0.0125)), 0.011)
    inner = sdf.ellipsoid(m, (0.094, 0.0150 * c.apart, 0.002), (0.010, 0.0060, 0.011))
    d = sdf.cut(d, inner, 0.008)
    # Nose: bridge, tip, wings, nostrils.
    n, w, b = c.nose_length, c.nose_width, c.nose_bridge
    tip = np.array([0.1085 + 0.5 * b, 0, -0.0310 * n])
    d = sdf.union(d, sdf.capsule(f, (0.0868 + b, 0, 0.012), tip - [0.006, 0, -0.004], 0.0066, 0.0080 * w), 0.010)
    d = sdf.union(d, sdf.ellipsoid(f, tip, (0.0098, 0.0098 * w, 0.0088)), 0.006)
    d = sdf.union(d, sdf.ellipsoid(m, tip + [-0.0125, 0.0118 * w, -0.0040], (0.0100, 0.0070, 0.0074)), 0.004)
    d = sdf.cut(d, sdf.ellipsoid(m, tip + [-0.0060, 0.0066 * w, -0.0110], (0.0060, 0.0034, 0.0046)), 0.002)
    # Mouth.
    zm = mouth_height(person)
    wide = 0.0225 * c.mouth
    d = sdf.union(d, sdf.ellipsoid(f, (0.0815, 0, zm + 0.002), (0.0165, 0.0270, 0.0200)), 0.014)
    full = c.lips * (1 - 0.25 * age)
    upper = sdf.tube(m, [(0.0982, 0.0, zm + 0.0040), (0.0976, 0.006, zm + 0.0048), (0.0876, wide, zm + 0.0006)], np.array([0.0034, 0.0040, 0.0016]) * full, 0.002)
    lower = sdf.tube(m, [(0.0960, 0.0, zm - 0.0052), (0.0946, 0.009, zm - 0.0047), (0.0872, wide - 0.002, zm - 0.0008)], np.array([0.0054, 0.0048, 0.0016]) * full, 0.002)
    d = sdf.union(d, upper, 0.0032)
    d = sdf.union(d, lower, 0.0032)
    d = sdf.cut(d, sdf.ellipsoid(f, (0.0975, 0, zm - 0.0155), (0.007, 0.016, 0.0055)), 0.007)
    slit = sdf.tube(m, [(0.1036, 0, zm - 0.0004), (0.1007, 0.010, zm + 0.0004), (0.0910, wide + 0.001, zm - 0.0004)], [0.0016, 0.0016, 0.0012], 0.001)
    d = sdf.cut(d, slit, 0.0018)
    d = sdf.cut(d, sdf.capsule(f, (0.1046, 0, zm + 0.011), (0.1036, 0, zm + 0.017), 0.0022, 0.0022), 0.005)
    # Folds of age: from the nose to the mouth, bags under the eyes, hollow cheeks.
    fold = sdf.tube(m, [(0.0985, 0.0185 * w, -0.034 * n), (0.0935, 0.0270, zm + 0.006), (0.0850, 0.0300, zm - 0.010)], [0.002, 0.0022, 0.001], 0.002)
    d = sdf.cut(d, fold - 0.0012 * age, 0.006)
    d = sdf.union(d, sdf.ellipsoid(m, e + [0.0075, 0.001, -0.0135], (0.006, 0.0125, 0.0035 + 0.002 * age)), 0.008)
    # Lids: a ball round the eye, slit open.
    ball = m - e
    lid = np.sqrt((ball * ball).sum(1)) - EYE_RADIUS - 0.0017
    upper = sdf.ellipsoid(ball, (0.0010, 0, 0.0062), (0.0142, 0.0165, 0.0088))
    d = sdf.union(d, sdf.union(lid, upper, 0.004), 0.0045)
    crease = sdf.tube(ball, [(0.0125, -0.0125, 0.0050), (0.0150, 0.0, 0.0100), (0.0085, 0.0135, 0.0060)], [0.0009, 0.0011, 0.0009], 0.001)
    d = sdf.cut(d, crease, 0.0022)
    slot = np.maximum(opening(person, ball), 0.002 - ball[:, 0])
    d = sdf.cut(d, slot, 0.0012)
    d = np.maximum(d, -(np.sqrt((ball * ball).sum(1)) - EYE_RADIUS - 0.0001))
    if person.beard in ("full", "moustache"):
        tufts = 0.6 + 0.8 * lattice(f * 130.0, person.seed)
        d = d - 0.0055 * beard_mask(person, f) * tufts
    d = sdf.union(d, ear(c, m, g), 0.005)
    neck = sdf.capsule(f, (-0.034, 0, -0.235), (-0.012, 0, -0.050), 0.0590 * g, 0.0545 * g)
    if not person.female:
        throat = sdf.capsule(f, (0.037, 0, -0.150), (0.042, 0, -0.165), 0.010, 0.009)
        neck = sdf.union(neck, throat, 0.015)
    floor = sdf.capsule(f, (0.060, 0, -0.093 * L), (0.016, 0, -0.124 * L), 0.019, 0.032)
    d = sdf.union(d, floor, 0.02)
    muscle = sdf.capsule(m, (-0.030, 0.052, -0.055), (0.030, 0.016, -0.215), 0.011, 0.010)
    neck = sdf.union(neck, muscle, 0.016)
    return sdf.union(d, neck, 0.018) * k


def ear(c, m, g):
    """The outer ear: a dish with a rim and a lobe, turned out from the head."""
    size = c.ears
    p = (m - np.array([-0.012, 0.0760 * g, -0.006])) / size
    turned = 0.42  # radians the ear stands out
    x, y = p[:, 0] * np.cos(turned) + p[:, 1] * np.sin(turned), p[:, 1] * np.cos(turned) - p[:, 0] * np.sin(turned) - 0.006
    x = x + 0.22 * p[:, 2]
    r = np.stack([x, y, p[:, 2]], -1)
    plate = sdf.ellipsoid(r, (0.002, 0.002, 0.003), (0.0175, 0.0085, 0.0285))
    bowl = sdf.ellipsoid(r, (0.005, 0.0105, -0.001), (0.0095, 0.0060, 0.0150))
    groove = sdf.ellipsoid(r, (-0.001, 0.0110, 0.014), (0.0100, 0.0045, 0.0085))
    d = sdf.cut(sdf.cut(plate, bowl, 0.003), groove, 0.003)
    lobe = sdf.ellipsoid(r, (0.006, 0.002, -0.026), (0.0080, 0.0060, 0.0085))
    tragus = sdf.ellipsoid(r, (0.0150, 0.0040, -0.004), (0.0045, 0.0040, 0.0060))
    return sdf.union(sdf.union(d, lobe, 0.005), tragus, 0.004) * size


def eyes(person, around=14, rings=7):
    """Both eyeballs' front halves: (vertices in the body's unit frame, triangles, side index).

    The cornea's bulge is what catches the light.
    """
    a = np.linspace(0, 2 * np.pi, around, endpoint=False)
    polar = np.radians([0, 9, 17, 25, 38, 55, 75, 95][: rings + 1])
    v, t = [np.array([1.0, 0, 0]) * (EYE_RADIUS + 0.0006)], []
    for p in polar[1:]:
        bulge = EYE_RADIUS + 0.0006 * np.exp(-((p / 0.42) ** 4))
        ring = np.stack([np.full(around, np.cos(p)), np.sin(p) * np.cos(a), np.sin(p) * np.sin(a)], -1)
        v.extend(ring * bulge)
    for k in range(around):
        n = (k + 1) % around
        t.append((0, 1 + k, 1 + n))
        for r in range(len(polar) - 2):
            i, j = 1 + r * around, 1 + (r + 1) * around
            t += [(i + k, j + k, j + n), (i + k, j + n, i + n)]
    v, t = np.array(v), np.array(t)
    centre = eye_centre(person)
    left = from_face(person, v + centre)
    right = from_face(person, v + centre * [1, -1, 1])
    side = np.repeat([1.0, -1.0], len(v))
    return np.concatenate([left, right]), np.concatenate([t, t + len(v)]), side
