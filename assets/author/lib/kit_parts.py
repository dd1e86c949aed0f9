"""Small goods that several assets use."""

import textures

from . import surfaces

YELLOW, BLUE, GREY = (0.90, 0.70, 0.08), (0.12, 0.30, 0.55), (0.45, 0.46, 0.47)


def common(m, seed=1):
    """Materials most pieces share."""
    m.material("plastic", surfaces.plastic((0.16, 0.30, 0.52), seed), 0.3)
    m.material("steel", surfaces.metal((0.48, 0.48, 0.49), seed + 1), 0.5)
    m.material("dark", surfaces.paint((0.15, 0.15, 0.16), seed + 2, (256, 256)), 0.5)
    m.material("yellow", surfaces.paint(YELLOW, seed + 3), 0.7)


def tote_picture():
    return textures.tote()[0]


def tote(m, node, at, across=False, size=(0.60, 0.40, 0.29)):
    """A crate with its floor at `at`; across turns its long side along y."""
    x, y, z = at
    l, w, h = (size[1], size[0], size[2]) if across else size
    sheet = (256, 512)
    for s in (-1, 1):
        m.box(
            node,
            "plastic",
            (x + s * (l / 2 - 0.012), y, z + h / 2),
            (0.016, w - 0.01, h - 0.03),
            0.002,
        )
        m.box(
            node,
            "plastic",
            (x, y + s * (w / 2 - 0.012), z + h / 2),
            (l - 0.01, 0.016, h - 0.03),
            0.002,
        )
        m.decal(
            node,
            "tote",
            (x, y + s * (w / 2 - 0.003), z + h / 2),
            (s * -(l - 0.012), 0, 0),
            (0, 0, h - 0.03),
            (0, 0, 512, 256),
            sheet,
        )
        m.decal(
            node,
            "tote",
            (x + s * (l / 2 - 0.003), y, z + h / 2),
            (0, s * (w - 0.012), 0),
            (0, 0, h - 0.03),
            (0, 0, 512, 256),
            sheet,
        )
        m.box(
            node, "plastic", (x, y + s * (w / 2 - 0.008), z + h - 0.014), (l, 0.026, 0.022), 0.006
        )
        m.box(
            node, "plastic", (x + s * (l / 2 - 0.008), y, z + h - 0.014), (0.026, w, 0.022), 0.006
        )
    m.box(node, "plastic", (x, y, z + 0.012), (l - 0.04, w - 0.04, 0.02), 0.004)
    m.box(node, "plastic", (x, y, z + 0.55 * h), (l - 0.06, w - 0.06, 0.01), 0.003)
