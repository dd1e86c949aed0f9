"""Paint of helmets, caps, shoes and spectacles."""

import numpy as np

from . import footwear, head
from .body import mirrored
from .brush import DARK, band, flat, line, over, weave
from .noise import fractal, lattice, ridged, step


class Gear:
    def __init__(self, person, shapes):
        self.person, self.shapes = person, shapes

    def glasses(self, q, n):
        return flat((0.05, 0.05, 0.06) if self.person.seed % 2 else (0.30, 0.27, 0.24), len(q))

    def helmet(self, q, n):
        c = self.person
        f, _ = head.face_frame(c, q)
        x, y, z = f[:, 0], f[:, 1], f[:, 2]
        rgb = flat(c.helmet_colour, len(q))
        if c.head_wear == "beanie":
            return rgb * (weave(q, c.seed + 500) * (0.80 + 0.25 * self.ribs(f)))[:, None]
        if c.head_wear == "cap":
            seams = line(y, 0.0012) + line(np.abs(y) - 0.8 * np.abs(x + 0.01), 0.001)
            rgb = over(rgb, rgb[0] * 0.6, np.clip(seams, 0, 1) * (z > 0.065))
            badge = np.hypot(y / 0.020, (z - 0.088) / 0.014) - 1
            rgb = over(rgb, (0.85, 0.83, 0.78), (x > 0.05) * step(0.05, -0.05, badge) * (z < 0.11))
            return rgb * weave(q, c.seed + 500)[:, None]
        rgb *= (1.0 + 0.07 * (fractal(f * 40.0, 4, c.seed) - 0.5))[:, None]
        scratch = step(0.80, 0.90, ridged(f * (30, 110, 60), c.seed + 2)) * step(0.5, 0.6, fractal(f * 20, 3, 4))
        rgb = over(rgb, rgb[0] * 0.72, 0.4 * scratch)
        inside = step(0.95, 0.90, np.hypot((x + 0.010) / 0.128, y / 0.105))  # the brim is of the shell's colour
        rgb = over(rgb, np.array((0.10, 0.10, 0.11)), inside * step(-0.3, -0.6, n[:, 2]) * (z < 0.085))
        if c.plain:
            return rgb
        logo = np.maximum(np.abs(y) - 0.022, np.abs(z - 0.094) - 0.012)
        tone = ((0.10, 0.22, 0.45), (0.12, 0.12, 0.13), (0.55, 0.10, 0.08))[c.seed % 3]
        rgb = over(rgb, tone, (x > 0) * step(0.001, 0, logo))
        letters = (lattice(f * (1, 150, 1), 3 + c.seed) > 0.5) * (np.abs(z - 0.094) < 0.006) * (logo < -0.004)
        return over(rgb, (0.93, 0.93, 0.92), (x > 0) * letters)

    def ribs(self, f):
        turn = np.arctan2(f[:, 1], f[:, 0] + 0.012)
        return 0.5 + 0.5 * np.sin(turn * 46.0)

    def shoes(self, q, n):
        c = self.person
        rgb = flat(c.shoe_colour, len(q))
        local, length = footwear.frame(self.shapes, mirrored(q))
        x, y, z = local.T
        rgb *= weave(q, c.seed + 600, 0.06)[:, None]
        sole_m = footwear.KINDS[c.shoes][1]
        sole = step(sole_m + 0.001, sole_m - 0.001, z)
        tone = {"boots": (0.16, 0.15, 0.14), "trainers": (0.80, 0.79, 0.76), "leather": (0.09, 0.08, 0.07)}[c.shoes]
        rgb = over(rgb, tone, sole)
        rgb = over(rgb, rgb[0] * 0.45, 0.8 * line(z - sole_m - 0.001, 0.0010))
        if c.shoes == "boots":
            rgb = over(rgb, rgb[0] * 0.4, line(x - 0.205, 0.0010) * (z > sole_m))
            rgb = over(rgb, (0.62, 0.52, 0.34), line(z - sole_m - 0.006, 0.0007) * (np.sin(x * 900 + y * 900) > -0.2))
        if c.shoes == "trainers":
            stripe = line((z - 0.055) + 0.9 * (x - 0.115), 0.005) * (z > sole_m + 0.004) * (np.abs(y) > 0.02)
            rgb = over(rgb, (0.88, 0.88, 0.86), stripe)
        laces, _ = self.laces(local)
        tone = (0.82, 0.80, 0.75) if c.shoes == "trainers" else (0.24, 0.19, 0.12)
        rgb = over(rgb, tone, laces)
        dust = step(0.05, 0.0, z) * (0.3 + 0.7 * fractal(q * 40.0, 3, c.seed + 620))
        return over(rgb, np.array([0.50, 0.47, 0.43]), (0.10 if c.shoes == "leather" else 0.28) * dust)

    def laces(self, local):
        """(paint, height) of the laces across the tongue."""
        x, y, z = local.T
        along = np.where(z > 0.10, 0.105 - (z - 0.10), x)  # up the shaft
        front = (x > 0.085) * (x < 0.178) * (z > 0.055)
        stripe = np.abs(((along - 0.35 * np.abs(y)) * 75.0) % 1.0 - 0.5)
        on = front * (np.abs(y + 0.002) < 0.019) * step(0.22, 0.14, stripe)
        return on, 0.0018 * on

    def relief(self, part, q):
        c = self.person
        if part == "glasses":
            return np.zeros(len(q))
        if part == "helmet":
            f, _ = head.face_frame(c, q)
            if c.head_wear == "helmet":
                return 0.00015 * fractal(f * 60.0, 3, c.seed)
            if c.head_wear == "beanie":
                return 0.0016 * self.ribs(f)
            y, x = f[:, 1], f[:, 0]
            seams = line(y, 0.0012) + line(np.abs(y) - 0.8 * np.abs(x + 0.01), 0.001)
            return -0.0008 * np.clip(seams, 0, 1) + 0.0008 * lattice(f * 60.0, c.seed)
        local, _ = footwear.frame(self.shapes, mirrored(q))
        x, y, z = local.T
        sole_m = footwear.KINDS[c.shoes][1]
        tread = 0.0012 * (np.sin(x * 420.0) > 0.3) * (z < sole_m * 0.55)
        bend = 0.0010 * ridged(local * (70.0, 14.0, 30.0), c.seed) * band(x, 0.13, 0.20, 0.02) * (z > sole_m)
        shaft = 0.0012 * ridged(local * (12.0, 12.0, 55.0), c.seed + 1) * step(0.08, 0.11, z)
        return self.laces(local)[1] + tread - bend - shaft - 0.001 * line(x - 0.205, 0.001) * (c.shoes == "boots")
