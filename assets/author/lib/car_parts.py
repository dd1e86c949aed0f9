"""What is set onto a car's body: lamps, mirrors, handles, plates, wipers, wheel houses."""

import bmesh
import numpy as np
from mathutils import Vector

from . import noise, picture, surfaces
from .parts import egg


def materials(m, colour, seed):
    metallic = 0.10 if 0.3 < min(colour) and max(colour) < 0.7 else 0.0
    m.material("body", dusty(colour, seed), over, 0.24, metallic)  # broad enough for even highlights of lamps
    m.material("glass", tinted(seed), over, 0.05)
    m.plain("gap", tuple(0.04 + 0.30 * c for c in colour), 0.9)
    m.plain("shade", (0.03, 0.03, 0.03), 0.9)
    m.plain("seal", (0.055, 0.055, 0.06), 0.5)
    m.plain("plastic", (0.13, 0.13, 0.135), 0.6)
    m.plain("chrome", (0.80, 0.80, 0.80), 0.12, 1.0)
    m.plain("mirror", (0.90, 0.90, 0.90), 0.05, 1.0)
    m.plain("bowl", (0.62, 0.63, 0.64), 0.25, 0.6)
    m.plain("lens", (0.88, 0.89, 0.90), 0.08)
    m.plain("red", (0.52, 0.03, 0.03), 0.08)
    m.plain("amber", (0.80, 0.38, 0.05), 0.08)
    m.plain("steel", (0.48, 0.48, 0.48), 0.35, 0.6)
    m.plain("disc", (0.50, 0.49, 0.48), 0.3, 0.7)
    m.plain("rim", (0.70, 0.705, 0.71), 0.22, 0.35)
    m.plain("rubber", (0.095, 0.095, 0.097), 0.8)
    m.plain("groove", (0.045, 0.045, 0.046), 0.95)
    m.material("plate", number_plate(seed), None, 0.3)


def over(p):
    """Where a point of a car lies in the pictures that cover its whole side, 6 m x 2.2 m."""
    return p[0] / 6 + 0.2, p[2] / 2.2


def dusty(colour, seed, size=(128, 256)):
    """Paint over the whole side of a car: even, road dirt towards the sills. The picture covers 6 m x 2.2 m."""
    y, x = np.mgrid[0 : size[0], 0 : size[1]]
    z = 2.2 * (1 - (y + 0.5) / size[0])
    cloud = noise.picture(size, 1.9, seed, 3)
    dirt = np.clip((0.52 - z) / 0.4, 0, 1) ** 1.5 * np.clip(0.65 + 0.25 * cloud, 0, 1)
    image = surfaces.flat(size, colour) * (1 + 0.006 * cloud)[..., None]
    return np.clip(surfaces.mix(image, (0.34, 0.31, 0.28), 0.55 * dirt), 0, 1)


def tinted(seed, size=(64, 256)):
    """A car's inside through its windows: dark, paler where seats and sky behind stand. 6 m x 2.2 m."""
    y, x = np.mgrid[0 : size[0], 0 : size[1]]
    z = 2.2 * (1 - (y + 0.5) / size[0])
    tone = 0.055 + 0.10 * np.clip((z - 1.12) / 0.35, 0, 1)
    return np.clip(tone[..., None] * np.array([0.95, 1.0, 1.02]), 0, 1)


def number_plate(seed, size=(64, 256)):
    """Black on white, a made-up number."""
    rng = np.random.default_rng(seed)
    letters = "ABCDEFHKLMNPRSTUVWXZ"
    words = "".join(rng.choice(list(letters), 2)) + " " + "".join(rng.choice(list(letters), 2)) + f" {rng.integers(100, 999)}"
    image = surfaces.flat(size, (0.90, 0.90, 0.88))
    picture.rectangle(image, 0, 0, 256, 64, (0.08, 0.08, 0.08))
    picture.rectangle(image, 3, 3, 250, 58, (0.90, 0.90, 0.88))
    picture.text(image, words, 132, 49, 46, (0.05, 0.05, 0.06), "middle")
    return image


def arch(m, n, x, s, radius, size, half):
    """A wheel house: a dark half drum."""
    b = bmesh.new()
    rings = []
    for y in (half - 0.035, half - 0.30, half - 0.42):
        rings.append([b.verts.new(Vector((x + (size + 0.02) * np.cos(a), s * y, radius + (size + 0.02) * np.sin(a)))) for a in np.radians(np.linspace(-35, 215, 25))])
    for p, q in zip(rings, rings[1:]):
        for i in range(len(p) - 1):
            b.faces.new([p[i], p[i + 1], q[i + 1], q[i]])
    hub = b.verts.new(Vector((x, s * (half - 0.42), radius)))
    for i in range(len(rings[-1]) - 1):
        b.faces.new([rings[-1][i], rings[-1][i + 1], hub])
    m.add(n, b, "shade")


def floor(m, n, shift, form):
    """The underside, between the wheels and under both ends."""
    half, (rear, front) = form["length"] / 2, form["axles"]
    m.box(n, "shade", (shift + (rear + front) / 2, 0, 0.235), (front - rear - 0.70, 2 * form["half"] - 0.16, 0.03), 0.0)
    m.box(n, "shade", (shift + (rear + front) / 2, 0, 0.27), (form["length"] - 0.5, 0.92, 0.03), 0.0)
    for a, b in ((rear - 0.36, -half + 0.16), (front + 0.36, half - 0.22)):
        m.box(n, "shade", (shift + (a + b) / 2, 0, 0.255), (abs(b - a), 1.38, 0.02), 0.0)
    m.bar(n, "steel", (shift + rear, -0.6, 0.30), (shift + rear, 0.6, 0.30), 0.035, 10)
    m.bar(n, "steel", (shift + front, -0.6, 0.30), (shift + front, 0.6, 0.30), 0.03, 10)
    m.pipe(n, "steel", [(shift - half + 0.10, 0.48, 0.245), (shift - half + 0.55, 0.46, 0.25)], 0.028, 12)


def bridge(m, n, p, material, places, lifts, radius, flatten=0.6, sides=10):
    """A rod that follows the body at given heights above it, on both sides; places are (x, z)."""
    on = p.cast("side", places)
    normal = p.normal(on)
    middle = on + normal * np.array(lifts)[:, None]
    for s in (1, -1):
        b = bmesh.new()
        rings = []
        for i, c in enumerate(middle):
            ahead = middle[min(i + 1, len(middle) - 1)] - middle[max(i - 1, 0)]
            ahead /= np.linalg.norm(ahead)
            up = np.cross(ahead, normal[i])
            up /= np.linalg.norm(up)
            ring = []
            for t in np.linspace(0, 2 * np.pi, sides, endpoint=False):
                q = c + radius * (np.cos(t) * up + flatten * np.sin(t) * normal[i])
                ring.append(b.verts.new(Vector((q[0], s * q[1], q[2]))))
            rings.append(ring)
        for a, d in zip(rings, rings[1:]):
            for i in range(sides):
                quad = [a[i], a[(i + 1) % sides], d[(i + 1) % sides], d[i]]
                b.faces.new(quad)
        b.faces.new(rings[0])
        b.faces.new(rings[-1])
        bmesh.ops.recalc_face_normals(b, faces=b.faces)
        m.add(n, b, material)


def handle(m, n, p, x, z):
    """A bow handle over its dish, both feet in the door."""
    t = np.linspace(-1, 1, 13)
    lift = 0.021 * (1 - t**6) - 0.004
    bridge(m, n, p, "body", np.stack([x + 0.108 * t, z + 0.006 - 0.002 * t**2], 1), lift, 0.0125, 0.62)


def mirrors(m, n, form, shift, p):
    x, y, z = form["mirror"]
    x += shift
    tall = 0.15 if form["half"] < 0.9 else 0.24
    foot = p.cast("side", [(x + 0.02, z - 0.075)])[0]
    for s in (-1, 1):
        egg(m, n, "body", (x, s * (y + 0.06), z), (0.17, 0.23, tall), 2.9, cut=-0.55)
        egg(m, n, "seal", (x - 0.036, s * (y + 0.06), z), (0.03, 0.205, tall - 0.03), 4.0)
        egg(m, n, "mirror", (x - 0.050, s * (y + 0.06), z), (0.012, 0.185, tall - 0.045), 4.5)
        m.pipe(n, "seal", [(foot[0], s * (foot[1] - 0.02), foot[2]), (x + 0.01, s * (foot[1] + 0.03), z - 0.07), (x + 0.005, s * (y + 0.03), z - 0.05)], 0.020, 10)
        egg(m, n, "amber", (x + 0.060, s * (y + 0.135), z - 0.005), (0.05, 0.075, 0.014), 3.0)


def head_lamps(m, n, p, form):
    """Two projectors in each bowl and a light strip below."""
    outline = np.array(form["head_lamp"])
    lo, hi = outline.min(0), outline.max(0)
    for k, share in enumerate((0.30, 0.62)):
        y = lo[0] + share * (hi[0] - lo[0])
        z = (lo[1] + hi[1]) / 2 - 0.006 + 0.014 * k
        on = p.cast("front", [(y, z)])[0]
        for s in (-1, 1):
            c = (on[0] - 0.012, s * y, z)
            m.lathe(n, "chrome", c, (1, 0, 0), [(-0.05, 0.040), (-0.006, 0.043), (0.0, 0.041), (-0.008, 0.034), (-0.02, 0.032)], 24)
            m.lathe(n, "lens", c, (1, 0, 0), [(-0.022, 0.033), (-0.010, 0.029), (-0.002, 0.018), (0.001, 0.0)], 24)
    low = outline[np.argsort(outline[:, 1])[:2]].mean(0)
    ys = np.linspace(lo[0] + 0.03, hi[0] - 0.09, 8)
    zs = np.interp(ys, *outline[np.argsort(outline[:, 0])][[0, 2]].T) * 0 + low[1] + 0.016 + 0.10 * (ys - ys[0]) ** 1.6
    on = p.cast("front", np.stack([ys, zs], 1))
    inner = on - 0.018 * p.normal(on)
    for s in (-1, 1):
        m.pipe(n, "lens", [tuple(q * [1, s, 1]) for q in inner], 0.008, 8)


def grille(m, n, p, form):
    """Bars across the openings, along the bumper's bow."""
    for key, count in (("grille", 3), ("intake", 3)):
        outline = np.array(form[key])
        lo, hi = outline.min(0), outline.max(0)
        for z in np.linspace(lo[1], hi[1], count + 2)[1:-1]:
            reach = 0.94 * max(q[0] for q in outline if abs(q[1] - z) < 0.6 * (hi[1] - lo[1])) - 0.03
            ys = np.linspace(0, reach, 8)
            on = p.cast("front", np.stack([ys, z + 0 * ys], 1))
            line = on - [0.012, 0, 0]
            whole = np.concatenate([line[::-1], line[1:] * [1, -1, 1]])
            m.pipe(n, "chrome" if key == "grille" else "plastic", [tuple(q) for q in whole], 0.007, 8)


def plates(m, n, p, form, shift):
    for (x, z), view, ahead in zip(form["plates"], ("front", "rear"), (1, -1)):
        on = p.cast(view, [(y, z + dz) for y in (0.0, 0.26) for dz in (-0.062, 0.0, 0.055)])
        face = max(on[:, 0] * ahead) * ahead + ahead * 0.006
        m.box(n, "seal", (face, 0, z), (0.012, 0.535, 0.125), 0.004)
        m.decal(n, "plate", (face + ahead * 0.0065, 0, z), (0, ahead * 0.52, 0), (0, 0, 0.11), (0, 0, 256, 64), (64, 256))


def wipers(m, n, p, form):
    glass = np.array(form["front_glass"])
    low = glass[0, 1]
    for y0, y1, rise in ((0.52, -0.05, 0.055), (-0.02, -0.56, 0.05)):
        t = np.linspace(0, 1, 8)
        ys, zs = y0 + (y1 - y0) * t, low + 0.012 + rise * t * (1.4 - 0.4 * t)
        on = p.cast("front", np.stack([np.abs(ys), zs], 1))
        normal = p.normal(on)
        line = on + 0.010 * normal
        line[:, 1] *= np.where(ys < 0, -1, 1)
        line[:, 1] = ys
        m.pipe(n, "seal", [tuple(q) for q in line], 0.006, 6)
        m.bar(n, "seal", tuple(line[0] + [0.03, 0, -0.035]), tuple(line[3] + [0.004, 0, 0.004]), 0.007, 6)


def roof(m, n, p, form, shift):
    """A short aerial, a third stop lamp, and a lip over the rear window where there is one."""
    x = shift + form["back"][1][0] + 0.22
    z = p.cast("top", [(x, 0.0)])[0, 2]
    egg(m, n, "body", (x, 0, z + 0.008), (0.12, 0.030, 0.055), 2.0, 8, 12)
    y, z = 0.0, form["rear_glass"][-1][1] + (0.028 if "panels" not in form else 0.06)
    on = p.cast("rear", [(y, z)])[0]
    egg(m, n, "red", (on[0] + 0.002, 0, z), (0.016, 0.26, 0.018), 3.5, 8, 16)
    # The lid's grip over the number plate, with its lamps.
    z = form["plates"][1][1] + 0.085
    on = p.cast("rear", [(0.0, z), (0.22, z)])
    m.box(n, "chrome", (min(on[:, 0]) - 0.002, 0, z), (0.024, 0.46, 0.020), 0.006)
    m.box(n, "seal", (min(on[:, 0]), 0, z - 0.018), (0.016, 0.40, 0.016), 0.004)
