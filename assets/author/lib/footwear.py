"""Shoes as a signed distance field: boots, trainers or leather shoes."""

import numpy as np

from . import sdf
from .body import mirrored
from .noise import step

# kind: (height of the shaft, thickness of the sole, welt, how much the upper leans in)
KINDS = {
    "boots": (0.085, 0.030, 0.0045, 0.26),
    "trainers": (0.020, 0.028, 0.0030, 0.30),
    "leather": (0.012, 0.018, 0.0035, 0.34),
}


def frame(shapes, q):
    """Points in the left shoe's frame: (forward from the heel, outward, up), and its length."""
    u = shapes.unit
    heel, toe = u["ankle_left"] + [-0.055, 0, 0], u["toe_left"]
    ahead = (toe - heel) * [1, 1, 0]
    length = np.linalg.norm(ahead) + 0.056
    ahead /= np.linalg.norm(ahead)
    out = np.array([-ahead[1], ahead[0], 0.0])
    return np.stack([(q - heel) @ ahead + 0.018, (q - heel) @ out, q[:, 2]], -1), length


def shoes(shapes, q):
    q = mirrored(q)
    shaft_m, sole_m, welt, lean = KINDS[shapes.person.shoes]
    u = shapes.unit
    local, length = frame(shapes, q)
    x, z = local[:, 0], local[:, 2]
    t = np.clip(x / length, 0.0, 1.0)
    half = np.interp(
        t,
        [0, 0.03, 0.10, 0.25, 0.45, 0.60, 0.72, 0.84, 0.93, 0.98, 1.0],
        [0.012, 0.023, 0.031, 0.034, 0.0345, 0.041, 0.0465, 0.043, 0.031, 0.018, 0.006],
    )
    bend = np.interp(t, [0, 0.4, 0.7, 1.0], [0, -0.004, -0.002, 0.006])
    top = np.interp(
        t,
        [0, 0.12, 0.3, 0.42, 0.55, 0.75, 0.92, 1.0],
        [0.090, 0.112, 0.116, 0.104, 0.080, 0.060, 0.052, 0.036],
    )
    if shapes.person.shoes != "boots":
        top = np.interp(
            t,
            [0, 0.12, 0.3, 0.42, 0.55, 0.75, 0.92, 1.0],
            [0.078, 0.080, 0.078, 0.086, 0.074, 0.054, 0.045, 0.032],
        )
    y = local[:, 1] - bend
    side = np.abs(y) - half * (1.0 - lean * step(0.02, 0.11, z))
    ends = np.maximum(-x, x - length)
    upper = sdf.common(sdf.common(side, ends, 0.02), z - top, 0.032)
    sole = sdf.common(sdf.common(np.abs(y) - half - welt, ends - welt, 0.012), z - sole_m, 0.004)
    d = sdf.union(upper, sole, 0.002)
    a = u["ankle_left"]
    shaft = sdf.capsule(q, a + [-0.010, 0, 0.005], a + [-0.014, 0, shaft_m], 0.041, 0.045)
    shaft = np.maximum(shaft, z - a[2] - shaft_m)
    d = sdf.union(d, shaft, 0.016)
    heel = sdf.box(local, (0.085, 0, 0.0), (0.012, 0.06, 0.008), 0.004)  # the arch before the heel
    if shapes.person.shoes != "trainers":
        d = sdf.cut(d, heel, 0.003)
    spring = 0.010 * step(0.74, 1.0, t) ** 1.5
    under = spring + 0.006 * step(0.03, 0.0, x) ** 2 - z
    return sdf.common(d, under, 0.005)
