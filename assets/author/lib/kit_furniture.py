"""Furniture of the warehouse: conveyors, doors, guards, ladders, bins. Origin on the floor below the
middle."""

import bmesh
import numpy as np
from mathutils import Vector

import textures

from . import cartons, parts, signs, solid, surfaces
from .kit_goods import carton, shell
from .kit_parts import common
from .solid import around


def conveyor(m):
    """Two metres of roller conveyor, 0.75 m high."""
    common(m)
    n = m.name
    for s in (-1, 1):
        m.prism(
            n,
            "yellow",
            [
                (s * 0.33, 0.60),
                (s * 0.36, 0.60),
                (s * 0.36, 0.78),
                (s * 0.30, 0.78),
                (s * 0.30, 0.77),
                (s * 0.33, 0.77),
            ],
            -1.0,
            1.0,
            "x",
            0.004,
            1,
        )
        for x in (-0.8, 0.0, 0.8):
            m.box(n, "dark", (x, s * 0.345, 0.31), (0.07, 0.05, 0.60), 0.006)
            m.box(n, "steel", (x, s * 0.345, 0.008), (0.14, 0.12, 0.016), 0.003)
    for x in (-0.8, 0.0, 0.8):
        m.box(n, "dark", (x, 0, 0.25), (0.05, 0.66, 0.05), 0.004)
    for i in range(20):
        m.bar(
            n, "steel", (-0.95 + 0.1 * i, -0.33, 0.735), (-0.95 + 0.1 * i, 0.33, 0.735), 0.025, 14
        )
    m.box(n, "dark", (0.4, -0.25, 0.52), (0.32, 0.20, 0.18), 0.02)


def conveyor_loaded(m):
    conveyor(m)
    image, rects = cartons.sheet()
    m.material("cartons", image[::2, ::2], None)
    for x, size, k in (
        (-0.62, (0.40, 0.32, 0.30), 1),
        (0.05, (0.52, 0.40, 0.22), 9),
        (0.66, (0.34, 0.34, 0.38), 3),
    ):
        carton(m, m.name, (x, 0.02 * k - 0.08, 0.761), size, f"side_{k}", f"top_{k % 4}", rects)


def dock_door(m):
    """A sectional door in its frame with bumpers and a lamp: 3.4 m wide along y, faces +x."""
    common(m)
    m.material("door", textures.dock_door()[0], None)
    m.material("rubber", surfaces.rubber(5), 0.3)
    m.material("lens", surfaces.plastic((0.9, 0.9, 0.86), 6, (128, 128)), 0.2)
    m.material("red", surfaces.plastic((0.7, 0.08, 0.06), 7, (128, 128)), 0.2)
    n = m.name
    m.decal(n, "door", (0.02, 0, 1.60), (0, 3.0, 0), (0, 0, 3.2), (0, 0, 1024, 1024), (1024, 1024))
    m.box(n, "steel", (-0.03, 0, 1.60), (0.08, 3.0, 3.2), 0.005)
    for s in (-1, 1):
        m.box(n, "steel", (0.05, s * 1.58, 1.68), (0.12, 0.16, 3.36), 0.01)
        m.box(n, "yellow", (0.13, s * 1.58, 0.55), (0.05, 0.18, 1.1), 0.01)
        m.box(n, "rubber", (0.16, s * 1.30, 0.35), (0.14, 0.22, 0.42), 0.02)
    m.box(n, "steel", (0.05, 0, 3.32), (0.16, 3.32, 0.24), 0.02)
    m.bar(n, "dark", (0.12, -1.6, 3.52), (0.12, 1.6, 3.52), 0.07, 16)
    parts.lamp(m, n, (0.16, 1.58, 2.30), (1, 0, 0), 0.07, "red")
    m.box(n, "yellow", (0.12, -1.58, 1.35), (0.10, 0.14, 0.22), 0.01)


def bollard(m):
    m.material("stripes", surfaces.hazard((256, 512), 64, seed=3), None)
    m.material("steel", surfaces.metal((0.40, 0.40, 0.41), 4), 0.5)
    shell(
        m,
        m.name,
        "stripes",
        [(0.0, 0.085), (0.05, 0.084), (0.94, 0.084), (0.975, 0.074), (1.0, 0.045), (1.008, 0.001)],
        1.0,
        28,
    )
    m.box(m.name, "steel", (0, 0, 0.008), (0.30, 0.30, 0.016), 0.003)
    for x in (-0.11, 0.11):
        for y in (-0.11, 0.11):
            m.bar(m.name, "steel", (x, y, 0.01), (x, y, 0.035), 0.014, 6)


def guard_rail(m):
    """Rack protection, 1.6 m along x."""
    common(m)
    m.material("stripes", surfaces.hazard((128, 1024), 64, seed=5), None)
    for x in (-0.74, 0.74):
        m.box(m.name, "yellow", (x, 0, 0.22), (0.12, 0.12, 0.44), 0.012)
        m.box(m.name, "steel", (x, 0, 0.008), (0.24, 0.22, 0.016), 0.003)
    m.box(m.name, "yellow", (0, 0, 0.32), (1.48, 0.08, 0.18), 0.012)
    for s in (-1, 1):
        m.decal(
            m.name,
            "stripes",
            (0, s * 0.0415, 0.32),
            (-s * 1.30, 0, 0),
            (0, 0, 0.16),
            (0, 0, 1024, 128),
            (128, 1024),
        )


def roll_cage(m):
    """A wire roll container with cartons, 0.8 m by 0.7 m by 1.7 m."""
    common(m)
    m.material("rubber", surfaces.rubber(9), 0.2)
    image, rects = cartons.sheet()
    m.material("cartons", image[::2, ::2], None)
    n = m.name
    m.box(n, "steel", (0, 0, 0.19), (0.80, 0.70, 0.03), 0.005)
    for x in (-0.34, 0.34):
        for y in (-0.28, 0.28):
            m.lathe(
                n,
                "rubber",
                (x, y, 0.065),
                (0, 1, 0),
                [
                    (-0.018, 0),
                    (-0.018, 0.058),
                    (-0.01, 0.065),
                    (0.01, 0.065),
                    (0.018, 0.058),
                    (0.018, 0),
                ],
                18,
            )
            m.box(n, "steel", (x, y, 0.14), (0.06, 0.05, 0.08), 0.004)
    for s in (-1, 1):
        y = 0.34 * s
        m.pipe(
            n,
            "steel",
            [
                (-0.38, y, 0.19),
                (-0.38, y, 1.66),
                (-0.34, y, 1.70),
                (0.34, y, 1.70),
                (0.38, y, 1.66),
                (0.38, y, 0.19),
            ],
            0.014,
            8,
        )
        for i in range(7):
            m.bar(n, "steel", (-0.285 + 0.095 * i, y, 0.2), (-0.285 + 0.095 * i, y, 1.69), 0.004, 5)
        for i in range(6):
            m.bar(n, "steel", (-0.38, y, 0.42 + 0.25 * i), (0.38, y, 0.42 + 0.25 * i), 0.005, 5)
    for i in range(6):
        m.bar(n, "steel", (-0.38, -0.34, 0.42 + 0.25 * i), (-0.38, 0.34, 0.42 + 0.25 * i), 0.005, 5)
    rng, z = np.random.default_rng(5), 0.206
    for h in (0.34, 0.30, 0.36, 0.22):
        for y in (-0.165, 0.165):
            size = (rng.uniform(0.5, 0.7), 0.31, h - rng.uniform(0.005, 0.06))
            carton(
                m,
                n,
                (rng.uniform(-0.05, 0.02), y, z),
                size,
                f"side_{rng.integers(0, 12)}",
                f"top_{rng.integers(0, 4)}",
                rects,
            )
        z += h


def floor_sign(m):
    """A folding warning board, faces +x and -x."""
    common(m)
    image, rects = signs.sheet()
    x, y, w, h = rects["hazard"]
    m.material("face", image[y : y + h, x : x + w], None)
    for s in (-1, 1):
        turn = around("Y", s * -14.0)
        m.box(m.name, "yellow", (s * 0.078, 0, 0.31), (0.014, 0.30, 0.62), 0.006, turn)
        up = np.array(turn @ Vector((0, 0, 0.27)))
        out = np.array(turn @ Vector((s * 0.0085, 0, 0)))
        m.decal(
            m.name,
            "face",
            np.array([s * 0.078, 0, 0.36]) + out + np.array([-s * 0.0125, 0, 0]),
            (0, s * 0.27, 0),
            up,
            (0, 0, w, h),
            (h, w),
        )


def cone(m):
    image = surfaces.plastic((0.90, 0.32, 0.07), 3, (256, 512))
    image[90:130] = surfaces.plastic((0.90, 0.90, 0.88), 4, (40, 512))
    image[160:200] = surfaces.plastic((0.90, 0.90, 0.88), 5, (40, 512))
    m.material("cone", image, None)
    m.material("rubber", surfaces.rubber(6), 0.3)
    shell(
        m,
        m.name,
        "cone",
        [(0.02, 0.14), (0.04, 0.13), (0.48, 0.034), (0.50, 0.028), (0.501, 0.001)],
        0.5,
        28,
    )
    m.box(m.name, "rubber", (0, 0, 0.012), (0.36, 0.36, 0.024), 0.006)


def step_ladder(m):
    """A rolling platform ladder of four steps, climbs towards -x."""
    common(m)
    n = m.name
    for s in (-1, 1):
        y = 0.30 * s
        m.pipe(
            n,
            "yellow",
            [
                (0.55, y, 0.05),
                (-0.25, y, 1.10),
                (-0.25, y, 1.95),
                (-0.60, y, 1.95),
                (-0.60, y, 0.05),
            ],
            0.020,
            10,
        )
        m.bar(n, "yellow", (0.50, y, 0.10), (-0.60, y, 0.10), 0.018, 10)
        m.bar(n, "yellow", (-0.25, y, 1.55), (-0.60, y, 1.55), 0.016, 10)
        m.bar(n, "yellow", (0.45, y, 0.85), (-0.25, y, 1.90), 0.016, 10)
        m.bar(n, "yellow", (0.45, y, 0.85), (0.40, y, 0.25), 0.016, 10)
        for x in (0.50, -0.58):
            m.lathe(
                n,
                "dark",
                (x, y, 0.05),
                (0, 1, 0),
                [(-0.015, 0), (-0.015, 0.05), (0.015, 0.05), (0.015, 0)],
                16,
            )
    for k in range(4):
        m.box(n, "steel", (0.42 - 0.205 * k, 0, 0.24 + 0.27 * k), (0.20, 0.58, 0.03), 0.005)
    m.box(n, "steel", (-0.42, 0, 1.10), (0.36, 0.60, 0.03), 0.005)


def waste_bin(m):
    """A wheeled bin of 240 l."""
    m.material("plastic", surfaces.plastic((0.15, 0.32, 0.20), 11), 0.4)
    m.material("rubber", surfaces.rubber(12), 0.3)
    m.material("label", cartons.side(5)[200:440, 140:460], None)
    n = m.name
    levels = ((0.08, 0.21, 0.22), (0.50, 0.25, 0.26), (0.94, 0.285, 0.28))
    for (z0, a0, b0), (z1, a1, b1) in zip(levels, levels[1:]):
        b = bmesh.new()
        bmesh.ops.create_cube(b, size=1.0)
        for v in b.verts:
            low = v.co.z < 0
            v.co = (
                np.sign(v.co.x) * (a0 if low else a1),
                np.sign(v.co.y) * (b0 if low else b1),
                z0 if low else z1,
            )
        solid.chamfer(b, 0.03, 3)
        m.add(n, b, "plastic")
    m.box(n, "plastic", (0, 0, 0.965), (0.62, 0.60, 0.06), 0.025, around("Y", 3), 3)
    m.box(n, "plastic", (-0.33, 0, 0.98), (0.06, 0.50, 0.05), 0.015)
    m.decal(
        n, "label", (0.277, 0, 0.66), (0, 0.26, 0), (-0.018, 0, 0.20), (0, 0, 320, 240), (240, 320)
    )
    for s in (-1, 1):
        m.lathe(
            n,
            "rubber",
            (-0.22, s * 0.27, 0.10),
            (0, 1, 0),
            [(-0.025, 0), (-0.025, 0.08), (-0.015, 0.10), (0.015, 0.10), (0.025, 0.08), (0.025, 0)],
            24,
        )
