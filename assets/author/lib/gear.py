"""What is worn on the head: helmets, caps, beanies and spectacles."""

import numpy as np

from . import head, sdf
from .body import mirrored
from .noise import step


def head_wear(person, q):
    f, k = head.face_frame(person, q)
    return {"helmet": helmet, "cap": cap, "beanie": beanie}[person.head_wear](person, f) * k


def helmet(person, f):
    """An industrial helmet: shell with a ridge, grooves, gutter, peak; tilted a little back."""
    m = mirrored(f)
    shell = sdf.ellipsoid(f, (-0.010, 0, 0.046), (0.128, 0.105, 0.098))
    ridge = sdf.ellipsoid(f, (-0.010, 0, 0.046), (0.132, 0.030, 0.1015))
    shell = sdf.union(shell, ridge, 0.006)
    for y in (0.046, 0.068):
        groove = sdf.capsule(m, (-0.085, y, 0.138 - 0.35 * (y - 0.046)), (0.060, y, 0.142 - 0.35 * (y - 0.046)), 0.007, 0.007)
        shell = sdf.cut(shell, groove, 0.006)
    tilt = 0.050 + 0.11 * f[:, 0]
    d = sdf.common(shell, tilt - f[:, 2], 0.003)
    ahead = step(0.02, 0.11, f[:, 0])
    rim = sdf.ellipsoid(f * [1, 1, 0], (-0.006, 0, 0), (0.136, 0.113, 1.0))
    peak = sdf.ellipsoid(f * [1, 1, 0], (0.045, 0, 0), (0.128, 0.092, 1.0))
    brim = sdf.union(rim, np.maximum(peak, 0.03 - f[:, 0]), 0.02)
    droop = tilt + 0.001 - 0.22 * (f[:, 0] - 0.09).clip(0) - 2.2 * m[:, 1] ** 2 * ahead
    leaf = sdf.common(brim, np.abs(f[:, 2] - droop) - 0.0042, 0.003)
    return sdf.union(d, leaf, 0.006)


def cap(person, f):
    """A cap of six panels with a curved peak."""
    m = mirrored(f)
    crown = head.skull(person, f) - 0.010
    crown = sdf.union(crown, sdf.ellipsoid(f, (0.010, 0, 0.062), (0.094, 0.080, 0.070)), 0.02)
    tilt = 0.040 + 0.10 * f[:, 0]
    d = sdf.common(crown, tilt - f[:, 2], 0.003)
    button = sdf.ellipsoid(f, (-0.008, 0, 0.134), (0.008, 0.008, 0.004))
    d = sdf.union(d, button, 0.002)
    peak = sdf.ellipsoid(f * [1, 1, 0], (0.082, 0, 0), (0.086, 0.078, 1.0))
    droop = tilt + 0.003 - 0.28 * (f[:, 0] - 0.085).clip(0) - 5.0 * m[:, 1] ** 2
    leaf = sdf.common(np.maximum(peak, 0.05 - f[:, 0]), np.abs(f[:, 2] - droop) - 0.0040, 0.003)
    return sdf.union(d, leaf, 0.004)


def beanie(person, f):
    """A knitted hat with a turned-up edge."""
    tilt = 0.040 + 0.22 * f[:, 0]
    d = head.skull(person, f) - 0.011 - 0.006 * step(0.09, 0.13, f[:, 2])
    d = sdf.union(d, sdf.ellipsoid(f, (-0.035, 0, 0.100), (0.060, 0.058, 0.040)), 0.03)
    d = sdf.common(d, tilt - f[:, 2], 0.004)
    edge = np.maximum(head.skull(person, f) - 0.017, np.abs(f[:, 2] - tilt - 0.026) - 0.028)
    return sdf.union(d, sdf.common(edge, tilt - 0.001 - f[:, 2], 0.004), 0.003)


def glasses(person):
    """(vertices in the body's unit frame, triangles): rims, bridge and temples of wire."""
    apart = 0.0325 * person.face.apart
    round_lens = person.seed % 2 == 0
    a = np.linspace(0, 2 * np.pi, 22, endpoint=False)
    e = 2.0 if round_lens else 3.4
    ring = np.stack(
        [
            0 * a,
            0.0235 * np.sign(np.cos(a)) * np.abs(np.cos(a)) ** (2 / e),
            0.0190 * np.sign(np.sin(a)) * np.abs(np.sin(a)) ** (2 / e),
        ],
        -1,
    )
    lines = []
    for side in (1.0, -1.0):
        lens = ring + [0.1005, side * apart, -0.003]
        lens[:, 0] -= 5.0 * (np.abs(lens[:, 1]) - 0.01).clip(0) ** 2
        lines.append(np.concatenate([lens, lens[:1]]))
        hinge = np.array([0.0860, side * (apart + 0.0245), 0.006])
        ear = np.array([-0.012, side * 0.0810, 0.010])
        bend = hinge + [-0.006, side * 0.009, 0.0]
        hook = ear + [-0.016, 0, -0.028]
        lines.append(np.array([hinge, bend, (bend + ear) / 2 + [0, side * 0.004, 0.001], ear, hook]))
    lines.append(np.array([[0.0995, apart - 0.0215, 0.003], [0.1035, 0, 0.006], [0.0995, -apart + 0.0215, 0.003]]))
    v, t = [], []
    for line in lines:
        wire(line, 0.0013 if round_lens else 0.0017, v, t)
    return head.from_face(person, np.concatenate(v)), np.concatenate(t)


def wire(line, radius, v, t, sides=5):
    """A thin tube along a polyline."""
    base = sum(len(x) for x in v)
    along = np.gradient(line, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.cross(along, [0.0, 0.1, 1.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-9
    third = np.cross(along, across)
    a = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    ring = radius * (np.cos(a)[None, :, None] * across[:, None] + np.sin(a)[None, :, None] * third[:, None])
    v.append((line[:, None] + ring).reshape(-1, 3))
    tri = []
    for i in range(len(line) - 1):
        for k in range(sides):
            n = (k + 1) % sides
            p, q = base + i * sides, base + (i + 1) * sides
            tri += [(p + k, p + n, q + n), (p + k, q + n, q + k)]
    t.append(np.array(tri))
