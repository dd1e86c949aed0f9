"""Paint of skin, faces, eyes and hair."""

import dataclasses

import numpy as np

from . import hair, head
from .body import mirrored, near
from .brush import band, flat, line, over
from .noise import fractal, lattice, ridged, step
from .pose import unit


class Skin:
    def __init__(self, person, shapes):
        self.person, self.shapes = person, shapes

    def bare(self, q):
        c = self.person
        rgb = flat(c.skin, len(q))
        tone = fractal(q * 30.0, 4, c.seed + 400) - 0.5
        fine = lattice(q * 420.0, c.seed + 401) - 0.5
        freckle = step(0.72, 0.85, lattice(q * 260.0, c.seed + 402)) * c.age
        return rgb * (1.0 + 0.10 * tone + 0.04 * fine - 0.10 * freckle)[:, None]

    def arms(self, q):
        c = self.person
        rgb = self.bare(q)
        if c.seed % 4 == 0:  # a tattoo on the left forearm
            patch = step(0.52, 0.56, fractal(q * (26.0, 26.0, 18.0), 3, c.seed + 7))
            rgb = over(rgb, np.array([0.16, 0.22, 0.28]), 0.7 * patch * band(q[:, 2], 1.02, 1.16, 0.01) * (q[:, 1] > 0))
        return rgb

    def fingers(self, q):
        """(along the hand from the knuckles, towards its back) in metres."""
        u = self.shapes.unit
        m = mirrored(q)
        down = unit(u["fingertip_left"] - u["knuckle_left"])
        ahead = unit(np.array([1.0, 0, 0]) - down[0] * down)
        palm = np.cross(down, ahead)
        palm *= -np.sign(palm[1])
        k = m - u["knuckle_left"]
        return k @ down, -(k @ palm)

    def hands(self, q):
        rgb = self.bare(q) * np.array([1.02, 0.96, 0.94])
        s, back = self.fingers(q)
        for at in (0.0, 0.038, 0.064):
            rgb = over(rgb, rgb * [0.80, 0.70, 0.68], 0.35 * line(s - at, 0.003, 0.005) * (back > 0))
        return rgb

    def head(self, q):
        c, fc = self.person, self.person.face
        f, _ = head.face_frame(c, q)
        rgb = self.bare(q)
        x, y, z = f.T
        a = np.abs(y)
        skin = np.array(c.skin)
        front = step(0.03, 0.05, x)
        flush = near(a, 0.044, 0.022) * near(z, -0.030, 0.022) * front
        rgb = over(rgb, skin * [1.0, 0.80, 0.76], 0.40 * flush)
        tip = near(a, 0, 0.014) * near(z, -0.031 * fc.nose_length, 0.014) * (x > 0.09)
        rgb = over(rgb, skin * [0.98, 0.80, 0.76], 0.4 * tip)
        ears = near(a, 0.082, 0.012) * near(z, -0.006, 0.03) * near(x, -0.010, 0.02)
        rgb = over(rgb, skin * [0.98, 0.80, 0.76], 0.4 * ears)
        m = mirrored(f) - head.eye_centre(c)
        socket = np.exp(-((m[:, 1] / 0.021) ** 2 + ((m[:, 2] + 0.002) / 0.013) ** 2)) * front
        rgb = over(rgb, skin * [0.74, 0.60, 0.58], (0.25 + 0.2 * c.age) * socket)
        mask = head.beard_mask(c, f)
        if c.beard:
            strength = {"stubble": 0.42, "full": 0.95, "moustache": 0.95}[c.beard]
            hairs = 0.65 + 0.7 * (lattice(f * (420.0, 420.0, 160.0), 3) - 0.5)
            rgb = over(rgb, np.array(c.hair_colour) * 1.05, np.clip(strength * mask * hairs, 0, 1))
        elif not c.female:  # shaven
            shade = head.beard_mask(shaven(c), f)
            rgb = over(rgb, np.array(c.hair_colour) * 0.5 + skin * 0.42, 0.11 * shade)
        zm, wide = head.mouth_height(c), 0.0225 * fc.mouth
        thick = np.where(z > zm, 0.0066, 0.0088) * fc.lips * np.sqrt(np.clip(1 - (a / (wide + 0.002)) ** 2, 0, 1))
        lips = step(0.0012, -0.0012, np.abs(z - zm) - thick) * (x > 0.07) * (a < wide + 0.002)
        tint = skin * ([0.84, 0.56, 0.56] if c.female else [0.88, 0.68, 0.66])
        rgb = over(rgb, tint, 0.75 * lips * (1 - 0.6 * mask))
        rgb = over(rgb, np.array([0.20, 0.09, 0.08]), 0.75 * line(z - zm, 0.0006, 0.0012) * (a < wide) * (x > 0.075))
        nostril = np.exp(-(((a - 0.0066 * fc.nose_width) / 0.0036) ** 2 + ((z + 0.0425 * fc.nose_length) / 0.003) ** 2))
        rgb = over(rgb, np.array([0.14, 0.07, 0.06]), 0.85 * nostril * (x > 0.09))
        edge = head.opening(c, m)
        lash = line(edge - 0.0004, 0.0007, 0.0011) * (np.abs(m[:, 1]) < 0.017) * front
        upper = np.where(m[:, 2] > 0.0008, 0.95 if c.female else 0.75, 0.35)
        rgb = over(rgb, np.array([0.09, 0.06, 0.05]), lash * upper)
        rgb = over(rgb, np.array(c.hair_colour) * 0.75, np.clip(self.brows(f) * (0.75 if c.female else 0.92), 0, 1))
        if c.hair == "bald":
            return rgb
        grown = 0.006 * (lattice(f * 150.0, 12) - 0.5)
        scalp = step(-0.004, 0.003, hair.hairline(c, f) + grown)
        return over(rgb, np.array(c.hair_colour) * 0.8, scalp * (0.5 if c.hair == "ring" else 0.95))

    def brows(self, f):
        c = self.person
        a, z = np.abs(f[:, 1]), f[:, 2]
        arch = z - 0.0195 - (0.0060 if c.female else 0.0035) * np.cos((a - 0.038 * c.face.apart) * 62) + 0.0025
        half = (0.0020 if c.female else 0.0034) * c.face.brow * np.interp(a, [0.012, 0.02, 0.036, 0.055], [0.8, 1.1, 1.0, 0.25])
        brow = step(half + 0.0016, half - 0.0012, np.abs(arch)) * band(a, 0.013, 0.053, 0.003) * (f[:, 0] > 0.04)
        return brow * (0.55 + 0.6 * ridged(f * (60, 380, 120), 8))

    def eyes(self, q):
        c = self.person
        f, _ = head.face_frame(c, q)
        m = mirrored(f) - head.eye_centre(c)
        r = np.hypot(m[:, 1], m[:, 2])
        turn = np.arctan2(m[:, 2], m[:, 1])
        rgb = flat((0.80, 0.775, 0.75), len(q))
        veins = step(0.78, 0.9, ridged(f * (150, 300, 300), 5)) * step(0.006, 0.011, r)
        rgb = over(rgb, (0.72, 0.45, 0.42), 0.35 * veins)
        rgb *= (1.0 - 0.45 * step(0.0025, 0.0060, m[:, 2] * 1.0) - 0.25 * step(0.008, 0.0125, r))[:, None]
        streak = 0.75 + 0.5 * lattice(np.stack([np.cos(turn) * 9, np.sin(turn) * 9, 40 * r], -1), 4)
        iris = flat(c.eye_colour, len(q)) * (streak * np.interp(r, [0.002, 0.0045, 0.0062], [1.15, 1.0, 0.45]))[:, None]
        rgb = over(rgb, iris, step(0.0063, 0.0057, r))
        return over(rgb, (0.015, 0.015, 0.018), step(0.0027, 0.0021, r))

    def strands(self, q):
        """Brightness of strands of the close cap: they run from the crown down."""
        f, _ = head.face_frame(self.person, q)
        angle = np.arctan2(f[:, 1], f[:, 0] + 0.035)
        flow = np.stack([np.cos(angle), np.sin(angle), f[:, 2]], -1)
        flow = flow + 0.03 * (lattice(f * 45.0, self.person.seed)[:, None] - 0.5)
        return 0.6 * ridged(flow * (34, 34, 14), self.person.seed + 5) + 0.4 * ridged(flow * (70, 70, 18), 9)

    def cap(self, q):
        c = self.person
        f, _ = head.face_frame(c, q)
        tone = 0.45 + 0.55 * self.strands(q) + 0.15 * fractal(f * 16.0, 3, c.seed + 7)
        return flat(c.hair_colour, len(q)) * tone[:, None]

    def locks(self, q):
        """q: (across, along, number)."""
        c = self.person
        fine = lattice(np.stack([q[:, 0] * 5.0, q[:, 1] * 2.0, q[:, 2] * 7.31], -1), c.seed)
        tone = 0.85 + 0.30 * (lattice(np.stack([0 * q[:, 0], 0 * q[:, 0], q[:, 2] * 3.7], -1), 5) - 0.5)
        grey = step(0.55, 0.8, lattice(np.stack([0 * q[:, 0], 0 * q[:, 0], q[:, 2] * 9.1], -1), 6)) * (c.age > 0.55)
        rgb = flat(c.hair_colour, len(q)) * (tone * (0.62 + 0.62 * fine) * np.interp(q[:, 1], [0, 0.35, 1], [0.62, 1.0, 1.08]))[:, None]
        return over(rgb, (0.55, 0.54, 0.52), 0.45 * grey)

    def relief(self, part, q):
        c = self.person
        if part == "eyes":
            return np.zeros(len(q))
        if part == "locks":
            return 0.05 * lattice(np.stack([q[:, 0] * 5.0, q[:, 1] * 2.0, q[:, 2] * 7.31], -1), c.seed)
        if part == "cap":
            return 0.0022 * self.strands(q)
        pores = 0.00012 * lattice(q * 500.0, 5) + 0.0004 * fractal(q * 90.0, 3, c.seed)
        if part == "hands":
            s, back = self.fingers(q)
            tendon = 0.0009 * near(s, -0.035, 0.03) * ridged(mirrored(q) * (52.0, 20.0, 4.0), 3) * (back > 0)
            folds = sum(line(s - at, 0.001, 0.0022) for at in (0.036, 0.040, 0.062, 0.066))
            return pores + tendon - 0.0005 * folds * (0.6 + c.age)
        if part != "head":
            return pores + 0.0006 * ridged(q * (30, 30, 9), 4) * c.muscle
        f, _ = head.face_frame(c, q)
        x, y, z = f.T
        a = np.abs(y)
        deep = 0.0006 + 0.0012 * c.age
        forehead = band(z, 0.036, 0.070, 0.006) * step(0.045, 0.03, a) * (x > 0.05)
        lines = deep * forehead * c.age * ridged(np.stack([0 * x, y * 4, z * 120 + 0.5 * np.cos(a * 60)], -1), c.seed)
        crow = near(a, 0.056, 0.008) * near(z, -0.001, 0.011) * (x > 0.03)
        lines = lines + deep * c.age * crow * ridged(np.stack([0 * x, 0 * x, (z + 0.001) * 260], -1), 2)
        brow = 0.0010 * self.brows(f)
        lips = 0.0004 * ridged(f * (40, 420, 30), 6) * near(z, head.mouth_height(c), 0.007) * (a < 0.022) * (x > 0.08)
        beard = 0.0011 * head.beard_mask(c, f) * ridged(f * (260, 260, 90), 7) * (c.beard in ("full", "moustache"))
        return pores - lines + brow - lips + beard


def shaven(person):
    """The same person with a beard, to know where it would grow."""
    return dataclasses.replace(person, beard="full")
