"""Goods: drums, totes, pallets and what stands on them. Origin on the floor below the middle."""

import bmesh
import numpy as np

import textures

from . import cartons, kit_parts, surfaces
from .kit_parts import common



def drum(m):
    common(m)
    m.material("drum", textures.drum()[0], None)
    m.material("lid", surfaces.paint((0.10, 0.27, 0.48), 5, (256, 256), 1.5), 0.6)
    shell(
        m,
        m.name,
        "drum",
        [
            (0.0, 0.288),
            (0.02, 0.295),
            (0.29, 0.286),
            (0.30, 0.297),
            (0.31, 0.286),
            (0.59, 0.286),
            (0.60, 0.297),
            (0.61, 0.286),
            (0.86, 0.286),
            (0.88, 0.295),
        ],
        0.88,
        40,
    )
    m.lathe(
        m.name,
        "lid",
        (0, 0, 0),
        (0, 0, 1),
        [(0.88, 0.295), (0.885, 0.285), (0.868, 0.278), (0.866, 0.0)],
        40,
    )
    for x, r in ((0.19, 0.035), (-0.20, 0.018)):
        m.lathe(
            m.name,
            "steel",
            (x, 0, 0.866),
            (0, 0, 1),
            [(0, r), (0.018, r), (0.020, 0.8 * r), (0.012, 0.7 * r), (0.012, 0)],
            16,
        )


def shell(m, node, material, profile, height, sides):
    """A lathed wall whose picture runs once around and from floor to height."""
    b = bmesh.new()
    layer = b.loops.layers.uv.verify()
    angles = np.linspace(0, 2 * np.pi, sides + 1)
    rings = [
        [b.verts.new((r * np.cos(t), r * np.sin(t), z)) for t in angles[:-1]] for z, r in profile
    ]
    for k, (low, high) in enumerate(zip(rings, rings[1:])):
        for i in range(sides):
            j = (i + 1) % sides
            face = b.faces.new([low[i], low[j], high[j], high[i]])
            for loop, (a, row) in zip(face.loops, ((i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1))):
                loop[layer].uv = (a / sides, profile[row][0] / height)
    m.add(node, b, material, uv=True)


def tote(m):
    common(m)
    m.material("tote", kit_parts.tote_picture(), None)
    kit_parts.tote(m, m.name, (0, 0, 0))


def pallet(m, node=None):
    """Euro pallet 1.2 m by 0.8 m by 0.144 m."""
    node = node or m.name
    m.material("wood", textures.wood_pallet()[0], 1.2)
    for y, w in ((-0.328, 0.145), (-0.164, 0.10), (0.0, 0.145), (0.164, 0.10), (0.328, 0.145)):
        m.box(node, "wood", (0, y, 0.133), (1.2, w, 0.022), 0.002, segments=1)
    for x in (-0.5275, 0.0, 0.5275):
        m.box(node, "wood", (x, 0, 0.111), (0.145, 0.80, 0.022), 0.002, segments=1)
        for y in (-0.35, 0.0, 0.35):
            m.box(
                node, "wood", (x, y, 0.061), (0.145, 0.10 if y else 0.145, 0.078), 0.002, segments=1
            )
    for y in (-0.35, 0.0, 0.35):
        m.box(node, "wood", (0, y, 0.011), (1.2, 0.10 if y else 0.145, 0.022), 0.002, segments=1)


def carton(m, node, at, size, face, lid, rects):
    """One carton with its floor at `at`, faces from the sheet."""
    (x, y, z), (l, w, h), sheet = at, size, (2048, 2048)
    c = z + h / 2
    for s in (-1, 1):
        m.decal(
            node, "cartons", (x, y + s * w / 2, c), (-s * l, 0, 0), (0, 0, h), rects[face], sheet
        )
        m.decal(
            node, "cartons", (x + s * l / 2, y, c), (0, s * w, 0), (0, 0, h), rects[face], sheet
        )
    m.decal(node, "cartons", (x, y, z + h), (l, 0, 0), (0, w, 0), rects[lid], sheet)
    m.decal(node, "cartons", (x, y, z), (l, 0, 0), (0, -w, 0), rects[lid], sheet)


def pallet_cartons(m):
    """A loaded pallet: four uneven layers of cartons."""
    pallet(m)
    image, rects = cartons.sheet()
    m.material("cartons", image[::2, ::2], None)
    rng = np.random.default_rng(8)
    z = 0.145
    for layer, (h, nx, ny) in enumerate(((0.34, 3, 2), (0.28, 2, 2), (0.34, 3, 2), (0.24, 4, 2))):
        l, w = 1.18 / nx, 0.78 / ny
        for i in range(nx):
            for j in range(ny):
                if layer == 3 and rng.random() < 0.3:
                    continue
                at = (
                    -0.59 + l * (i + 0.5) + rng.normal() * 0.006,
                    -0.39 + w * (j + 0.5) + rng.normal() * 0.006,
                    z,
                )
                carton(
                    m,
                    m.name,
                    at,
                    (l - 0.012, w - 0.012, h - 0.004),
                    f"side_{rng.integers(0, 12)}",
                    f"top_{rng.integers(0, 4)}",
                    rects,
                )
        z += h


def pallet_wrapped(m):
    """A loaded pallet in stretch film."""
    pallet(m)
    m.material("film", textures.wrap()[0], 1.2, 0.35)
    outline = [(-0.59, -0.39), (0.59, -0.39), (0.59, 0.39), (-0.59, 0.39)]
    rng = np.random.default_rng(3)
    levels = np.linspace(0.13, 1.38, 9)
    for low, high in zip(levels, levels[1:]):
        bulge = 1.0 + 0.012 * rng.normal()
        m.prism(
            m.name,
            "film",
            [(x * bulge, y * bulge) for x, y in outline],
            low - 0.012,
            high + 0.012,
            "z",
            0.022,
            2,
        )
