"""Pictures as float arrays (H, W, 3 or 1) in sRGB 0..1: drawing, PNG and JPEG files."""

import os
import struct
import zlib

import bpy
import numpy as np

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"


def write_png(path, image):
    """8-bit PNG, grey when the picture has one channel; best row filter by total variation."""
    data = np.clip(np.rint(np.atleast_3d(image) * 255.0), 0, 255).astype(np.uint8)
    height, width, channels = data.shape
    rows = data.reshape(height, -1).astype(np.int16)
    up = np.vstack([np.zeros_like(rows[:1]), rows[:-1]])
    left = np.hstack([np.zeros((height, channels), np.int16), rows[:, :-channels]])
    choices = np.stack([rows, rows - left, rows - up, rows - (left + up) // 2]) & 255
    cost = np.minimum(choices, 256 - choices).sum(2)
    best = cost.argmin(0)
    kind = np.array([0, 1, 2, 3], np.uint8)[best]
    lines = choices[best, np.arange(height)].astype(np.uint8)
    raw = np.hstack([kind[:, None], lines]).tobytes()

    def chunk(name, body):
        return (
            struct.pack(">I", len(body))
            + name
            + body
            + struct.pack(">I", zlib.crc32(name + body) & 0xFFFFFFFF)
        )

    header = struct.pack(">IIBBBBB", width, height, 8, 0 if channels == 1 else 2, 0, 0, 0)
    with open(path + ".part", "wb") as f:
        f.write(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", header)
            + chunk(b"sRGB", b"\0")
            + chunk(b"IDAT", zlib.compress(raw, 9))
            + chunk(b"IEND", b"")
        )
    os.replace(path + ".part", path)


def luminance(image):
    """One channel, sRGB encoded, of a colour picture: what a monochrome camera sees of it."""
    c = np.rint(np.clip(image, 0, 1) * 255.0) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    grey = linear @ np.array([0.2126, 0.7152, 0.0722])
    return np.where(grey <= 0.0031308, 12.92 * grey, 1.055 * grey ** (1 / 2.4) - 0.055)[..., None]


def to_blender(image, name):
    """The picture as a Blender image (rows from the bottom up)."""
    data = np.atleast_3d(image)
    if data.shape[2] == 1:
        data = np.repeat(data, 3, 2)
    height, width, _ = data.shape
    full = np.ones((height, width, 4), np.float32)
    full[..., :3] = np.clip(data, 0, 1)
    out = bpy.data.images.new(name, width, height)
    out.pixels.foreach_set(np.ascontiguousarray(full[::-1]).ravel())
    return out


def jpeg_image(image, name, folder, quality=88):
    """The picture as a Blender image that lives in a JPEG file, so that exports embed that file."""
    path = os.path.join(folder, name + ".jpg")
    scene = bpy.context.scene
    settings = scene.render.image_settings
    settings.file_format, settings.quality, settings.color_mode = "JPEG", quality, "RGB"
    scene.view_settings.view_transform = "Standard"
    raw = to_blender(image, name + "_raw")
    raw.save_render(path, scene=scene)
    bpy.data.images.remove(raw)
    out = bpy.data.images.load(path)
    out.name = name
    return out


def fill(image, triangles, colour, samples=3):
    """Fills triangles (T, 3, 2) in pixel coordinates (x right, y down) with antialiased edges."""
    height, width = image.shape[:2]
    lo = np.floor(triangles.reshape(-1, 2).min(0)).astype(int)
    hi = np.ceil(triangles.reshape(-1, 2).max(0)).astype(int) + 1
    x0, y0 = max(lo[0], 0), max(lo[1], 0)
    x1, y1 = min(hi[0], width), min(hi[1], height)
    if x1 <= x0 or y1 <= y0:
        return
    cover = np.zeros(((y1 - y0) * samples, (x1 - x0) * samples), bool)
    for tri in triangles:
        t = (tri - [x0, y0]) * samples
        a, b = np.floor(t.min(0)).astype(int), np.ceil(t.max(0)).astype(int) + 1
        a = np.maximum(a, 0)
        b = np.minimum(b, cover.shape[::-1])
        if np.any(b <= a):
            continue
        gx, gy = np.meshgrid(np.arange(a[0], b[0]) + 0.5, np.arange(a[1], b[1]) + 0.5)
        e = []
        for i in range(3):
            p, q = t[i], t[(i + 1) % 3]
            e.append((q[0] - p[0]) * (gy - p[1]) - (q[1] - p[1]) * (gx - p[0]))
        e = np.stack(e)
        cover[a[1] : b[1], a[0] : b[0]] |= np.all(e >= 0, 0) | np.all(e <= 0, 0)
    alpha = cover.reshape(y1 - y0, samples, x1 - x0, samples).mean((1, 3))[..., None]
    patch = image[y0:y1, x0:x1]
    image[y0:y1, x0:x1] = patch + (np.asarray(colour) - patch) * alpha


def polygon(image, points, colour):
    """Fills a convex polygon."""
    p = np.asarray(points, float)
    fill(image, np.stack([np.stack([p[0], p[i], p[i + 1]]) for i in range(1, len(p) - 1)]), colour)


def rectangle(image, x, y, w, h, colour):
    polygon(image, [(x, y), (x + w, y), (x + w, y + h), (x, y + h)], colour)


def disc(image, x, y, r, colour, n=40):
    a = np.linspace(0, 2 * np.pi, n, endpoint=False)
    polygon(image, np.stack([x + r * np.cos(a), y + r * np.sin(a)], -1), colour)


def line(image, a, b, width, colour):
    a, b = np.asarray(a, float), np.asarray(b, float)
    d = (b - a) / (np.linalg.norm(b - a) + 1e-9)
    n = np.array([-d[1], d[0]]) * width / 2
    polygon(image, [a + n, b + n, b - n, a - n], colour)


_TEXT = {}
EM = 1.3  # the font's capitals fill 0.56 of its em; make them 0.73 of the size


def text_triangles(text):
    """Triangles of a line of text, one em high, origin at the left of the base line, y down."""
    if text not in _TEXT:
        curve = bpy.data.curves.new("text", "FONT")
        curve.body = text
        curve.resolution_u = 3
        if os.path.exists(FONT):
            curve.font = bpy.data.fonts.load(FONT, check_existing=True)
        thing = bpy.data.objects.new("text", curve)
        bpy.context.scene.collection.objects.link(thing)
        bpy.context.view_layer.update()
        mesh = thing.to_mesh()
        mesh.calc_loop_triangles()
        v = np.array([v.co[:2] for v in mesh.vertices]).reshape(-1, 2)
        t = np.array([t.vertices[:] for t in mesh.loop_triangles], int).reshape(-1, 3)
        _TEXT[text] = (v * [1, -1])[t] if len(t) else np.zeros((0, 3, 2))
        bpy.data.objects.remove(thing)
        bpy.data.curves.remove(curve)
    return _TEXT[text]


def text(image, words, x, y, size, colour, anchor="left", stretch=1.0, turned=False):
    """Writes words with capitals about 0.73 size tall, base line at y; turned runs upwards."""
    t = text_triangles(words)
    if not len(t):
        return 0.0
    t = t * [size * stretch * EM, size * EM]
    width = t[..., 0].max()
    shift = {"left": 0.0, "middle": width / 2, "right": width}[anchor]
    t = t - [shift, 0]
    if turned:
        t = np.stack([t[..., 1], -t[..., 0]], -1)
    fill(image, t + [x, y], colour)
    return width


def sample(image, u, v):
    """Bilinear look-up with u right and v down in 0..1, clamped; returns (N, channels)."""
    h, w = image.shape[:2]
    x, y = np.clip(u * w - 0.5, 0, w - 1.001), np.clip(v * h - 0.5, 0, h - 1.001)
    i, j = x.astype(int), y.astype(int)
    a, b = (x - i)[:, None], (y - j)[:, None]
    return (image[j, i] * (1 - a) + image[j, i + 1] * a) * (1 - b) + (
        image[j + 1, i] * (1 - a) + image[j + 1, i + 1] * a
    ) * b
