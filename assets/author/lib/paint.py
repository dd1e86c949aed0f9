"""Paints a person's texture: every texel knows where on the body it lies and is coloured there.

Painting in space instead of on the sheet makes seams invisible wherever the unwrapping cut.
"""

import numpy as np

from . import picture, sdf
from .body import strand_frame
from .noise import fractal, lattice, ridged, step
from .pose import unit

SILVER = np.array([0.78, 0.79, 0.80])
DARK = np.array([0.07, 0.07, 0.08])


def band(x, lo, hi, soft=0.0015):
    """1 where lo < x < hi."""
    return step(lo - soft, lo + soft, x) * step(hi + soft, hi - soft, x)


def line(x, width=0.0016, soft=0.0012):
    """1 where |x| < width."""
    return step(width + soft, width, np.abs(x))


def over(base, colour, alpha):
    return base + (np.asarray(colour) - base) * alpha[:, None]


class Painter:
    """Colours of one person at points of the rest pose."""

    def __init__(self, person, shapes, parts):
        self.person, self.shapes, self.parts = person, shapes, parts
        self.scale = person.height_m / 1.75
        self.print = self.back_print()

    def back_print(self):
        """Lettering on the back of the vest, dark on transparent: one channel of coverage."""
        sheet = np.zeros((96, 256, 1))
        words = ("LOGISTICS", "WAREHOUSE", "SAFETY", "VISITOR", "TEAM 4", "DISPATCH")
        picture.text(sheet, words[self.person.seed % 6], 128, 44, 38, 1.0, "middle")
        picture.text(sheet, f"No. {17 + 13 * self.person.seed}", 128, 84, 32, 1.0, "middle")
        return sheet

    def colour(self, part, p, n):
        """sRGB (N, 3) of points p with outward normals n on a part."""
        q = p / self.scale
        method = {
            "top": self.upper,
            "coat": self.upper,
            "arms": self.skin,
            "hands": self.hands,
            "head": self.head,
        }.get(part) or getattr(self, part)
        rgb = method(q, n) if part in ("helmet", "shoes") else method(q)
        shade = self.occlusion(p, n)
        return np.clip(rgb * shade[:, None], 0.0, 1.0)

    def occlusion(self, p, n):
        """Darkening of creases: how much solid lies just above the surface."""
        near = np.zeros(len(p))
        for h, w in ((0.006, 0.45), (0.014, 0.30), (0.035, 0.22), (0.080, 0.14)):
            d = np.full(len(p), h)
            for part in self.parts.values():
                x = p + h * n
                value = sdf.sample(part["field"], x)
                if part["paired"]:
                    value = np.minimum(value, sdf.sample(part["field"], x * [1, -1, 1]))
                d = np.minimum(d, value)
            near += w * np.clip(1.0 - d / h, 0.0, 1.6)
        return np.clip(1.0 - 0.58 * near, 0.42, 1.0)

    def weave(self, q, seed, grain=0.05):
        """Fine and coarse unevenness of cloth as a factor about 1."""
        fine = lattice(q * 420.0, seed) - 0.5
        middle = fractal(q * 60.0, 3, seed + 1) - 0.5
        worn = fractal(q * 9.0, 3, seed + 2) - 0.5
        return 1.0 + grain * fine * 1.6 + 0.16 * middle + 0.30 * worn

    def creases(self, q, freq, seed, amount):
        """Painted fold shading: light crests beside dark valleys."""
        warp = 0.5 * lattice(q * 5.0, seed)[:, None]
        r = ridged(q * freq + warp, seed + 1)
        r2 = ridged(q * freq * 1.9 + 2 * warp, seed + 2)
        return 1.0 + amount * ((r - 0.5) + 0.6 * (r2 - 0.5))

    def dirt(self, rgb, q, amount, seed):
        """Stains and dust."""
        spot = step(0.60, 0.74, fractal(q * 14.0, 4, seed))
        smear = step(0.58, 0.72, fractal(q * (22.0, 22.0, 6.0), 3, seed + 4))
        rgb = over(rgb, np.array([0.20, 0.17, 0.14]), amount * spot)
        return over(rgb, np.array([0.62, 0.58, 0.52]), 0.6 * amount * smear)

    def trousers(self, q):
        c = self.person
        rgb = np.tile(np.array(c.trouser_colour), (len(q), 1)).astype(float)
        x, y, z = q[:, 0], q[:, 1], q[:, 2]
        s = np.sign(y)
        middle = np.interp(z, [0.05, 0.5, 0.92], [0.100, 0.096, 0.092])
        across = np.abs(y) - middle
        if not c.plain:
            seat = np.interp(z, [0.05, 0.5, 0.92], [-0.02, 0.008, -0.008])
            for z0, z1, half in ((0.60, 0.76, 0.075),):
                side = (np.abs(y) > 0.13) * (np.abs(x - seat) < half + 0.01)
                box = np.maximum(np.abs(x - seat) - half, np.abs(z - (z0 + z1) / 2) - (z1 - z0) / 2)
                rgb = over(rgb, rgb[0] * 0.82, side * step(0.001, -0.001, box))
                rgb = over(rgb, rgb[0] * 0.45, side * line(box))
                rgb = over(rgb, rgb[0] * 0.45, side * line(z - z1 + 0.05) * (box < 0))
                rgb = over(rgb, DARK, side * (np.hypot(x - seat, z - z1 + 0.028) < 0.007))
            knee = (
                1.0
                if not c.vest
                else np.maximum(np.abs(across) - 0.055, np.abs(z - 0.50) - 0.105) + 0.0
            )
            front = (x > 0.01).astype(float)
            rgb = over(rgb, np.array(c.trouser_colour) * 0.55, front * step(0.002, -0.001, knee))
            rgb = over(rgb, np.array([0.75, 0.72, 0.66]), front * line(knee + 0.006, 0.0008))
            if c.vest:
                rgb = over(rgb, SILVER, band(z, 0.270, 0.320))
                rgb = over(rgb, DARK, line(z - 0.270) + line(z - 0.320) * 1.0)
            seam = line(across * 1.0 + 0.0, 0.0008) * (x < -0.0) + line(x + 0.01, 0.001) * (
                z < 0.88
            )
            rgb = over(rgb, rgb[0] * 0.6, 0.8 * np.clip(seam, 0, 1))
            for sign in (1, -1):
                back = np.maximum(np.abs(y - sign * 0.085) - 0.058, np.abs(z - 0.895) - 0.065)
                rgb = over(rgb, rgb[0] * 0.5, (x < -0.04) * line(back))
            slash = (
                line((z - 0.93) - 1.6 * (np.abs(y) - 0.13), 0.0016) * band(z, 0.86, 1.0) * (x > 0)
            )
            rgb = over(rgb, rgb[0] * 0.4, slash)
            rgb = over(rgb, np.array([0.10, 0.08, 0.06]), band(z, 1.005, 1.04))
        rgb *= self.weave(q, c.seed + 100, 0.07)[:, None]
        near = np.exp(-(((z - 0.50) / 0.14) ** 2)) + np.exp(-(((z - 0.14) / 0.12) ** 2)) + 0.35
        rgb *= self.creases(q + s[:, None] * [0, 0, 3.0], (9, 9, 26), c.seed + 110, 0.30 * near)[
            :, None
        ]
        if not c.plain:
            rgb = self.dirt(rgb, q, 0.35, c.seed + 120)
        fade = np.exp(-(((z - 0.68) / 0.13) ** 2)) * (x > 0.02)
        return rgb * (1.0 + 0.18 * fade)[:, None]

    def upper(self, q):
        c = self.person
        rgb = np.tile(np.array(c.top_colour), (len(q), 1)).astype(float)
        x, y, z = q[:, 0], q[:, 1], q[:, 2]
        u = self.shapes.unit
        m = np.stack([x, np.abs(y), z], -1)
        axis = u["elbow_left"] - u["shoulder_left"]
        length = np.linalg.norm(axis)
        s = (m - u["shoulder_left"]) @ (axis / length)
        arm = self.shapes.armness(q * self.scale)
        front = (x > 0.0).astype(float)
        if not c.plain:
            lines = front * line(y, 0.0035) * (c.top != "shirt")
            lines = lines + front * line(np.abs(y) - 0.010, 0.0010) * (c.top == "coat")
            lines = lines + line(s + 0.01, 0.0014) * (arm > 0.25) * (m[:, 1] > 0.14)
            lines = lines + line(z - 1.39, 0.0012) * (1 - arm) * (x < 0)
            lines = lines + line(x, 0.001) * (1 - arm) * (z < 1.36)
            for sign in (1, -1):
                pocket = np.maximum(np.abs(y - sign * 0.085) - 0.045, np.abs(z - 1.28) - 0.055)
                lines = lines + front * (1 - arm) * (line(pocket) + line(z - 1.315) * (pocket < 0))
                if c.top == "coat":
                    low = np.maximum(np.abs(y - sign * 0.11) - 0.065, np.abs(z - 0.86) - 0.08)
                    lines = lines + front * line(low)
            rgb = over(rgb, rgb[0] * 0.42, np.clip(lines, 0, 1))
            if c.top == "shirt":
                hem = line(s - 0.205, 0.0012) * arm + line(z - 0.955, 0.0012) * (1 - arm)
                neck = line(np.hypot(x - 0.0, y) - 0.088, 0.0015) * (z > 1.40)
                rgb = over(rgb, rgb[0] * 0.5, np.clip(hem + neck, 0, 1))
            cuff = arm * step(0.505, 0.512, s)
            rgb = over(rgb, rgb[0] * 0.6, cuff)
            badge = np.maximum(np.abs(y - 0.088) - 0.034, np.abs(z - 1.345) - 0.011)
            rgb = over(rgb, np.array([0.86, 0.86, 0.82]), front * step(0.001, 0, badge))
            ink = (lattice(q * (1.0, 160.0, 90.0), 3) > 0.52) * (badge < -0.003)
            rgb = over(rgb, DARK, front * ink * 0.9)
            if c.top in ("jacket", "coat") and c.vest:
                rgb = over(rgb, SILVER, arm * band(s, 0.150, 0.195))
                rgb = over(rgb, DARK, arm * np.clip(line(s - 0.15) + line(s - 0.195), 0, 1))
            if c.top == "coat":
                for z0 in (1.25, 1.12, 0.99, 0.86, 0.73):
                    rgb = over(rgb, DARK, front * (np.hypot(y, z - z0) < 0.009))
        rgb *= self.weave(q, c.seed + 200, 0.05)[:, None]
        along = np.where(arm[:, None] > 0.5, np.stack([x, 0.2 * y, s * 1.0], -1), q)
        fold = self.creases(
            along + np.sign(y)[:, None] * [0, 0, 5.0], (9, 9, 24), c.seed + 210, 1.0
        )
        near = 0.14 + arm * (
            0.22 * np.exp(-(((s - 0.31) / 0.10) ** 2)) + 0.16 * np.exp(-(((s - 0.52) / 0.07) ** 2))
        )
        rgb *= (1.0 + (fold - 1.0) * near * (0.5 if c.plain else 1.0))[:, None]
        return rgb if c.plain else self.dirt(rgb, q, 0.20, c.seed + 220)

    def vest(self, q):
        c = self.person
        rgb = np.tile(np.array(c.vest_colour), (len(q), 1)).astype(float)
        x, y, z = q[:, 0], q[:, 1], q[:, 2]
        front = (x > 0.0).astype(float)
        dark = np.array(c.vest_colour) * 0.50
        rgb *= self.weave(q, c.seed + 300, 0.05)[:, None]
        rgb *= self.creases(q, (8, 8, 19), c.seed + 310, 0.20)[:, None]
        for z0 in (0.925, 1.075):
            rgb = over(rgb, dark, band(z, z0 - 0.012, z0 + 0.062))
            rgb = over(rgb, SILVER, band(z, z0, z0 + 0.050))
        brace = np.abs(np.abs(y) - 0.098)
        up = step(1.12, 1.125, z)
        rgb = over(rgb, dark, up * step(0.036, 0.034, brace))
        rgb = over(rgb, SILVER, up * step(0.025, 0.0235, brace))
        silver = np.clip(
            band(z, 0.925, 0.975) + band(z, 1.075, 1.125) + up * (brace < 0.0245), 0, 1
        )
        grid = line(((q[:, 2] + q[:, 1]) * 90.0) % 1.0 - 0.5, 0.06, 0.08) + line(
            ((q[:, 2] - q[:, 1]) * 90.0) % 1.0 - 0.5, 0.06, 0.08
        )
        rgb *= (1.0 - 0.16 * silver * np.clip(grid, 0, 1))[:, None]
        lines = front * line(y, 0.004) * (z < 1.36)
        lines = lines + front * line(np.abs(y) - 0.012, 0.0008) * (z < 1.36)
        lines = lines + line(x + 0.005, 0.0012) * (z < 1.30)
        for sign in (1, -1):
            low = np.maximum(np.abs(y - sign * 0.088) - 0.055, np.abs(z - 1.022) - 0.040)
            lines = lines + front * line(low)
        chest = np.maximum(np.abs(y + 0.06) - 0.030, np.abs(z - 1.27) - 0.055)
        lines = lines + front * line(chest)
        rgb = over(rgb, dark * 0.5, np.clip(lines, 0, 1) * 0.9)
        card = np.maximum(np.abs(y + 0.060) - 0.022, np.abs(z - 1.275) - 0.030)
        rgb = over(rgb, np.array([0.92, 0.92, 0.90]), front * step(0.001, 0.0, card))
        photo = np.maximum(np.abs(y + 0.060) - 0.010, np.abs(z - 1.283) - 0.012)
        rgb = over(rgb, np.array([0.35, 0.30, 0.30]), front * step(0.001, 0.0, photo))
        rgb = over(rgb, DARK, front * line(z - 1.262, 0.002) * (np.abs(y + 0.06) < 0.015))
        ink = picture.sample(self.print, 0.5 - y / 0.30, 0.5 - (z - 1.235) / 0.11)[:, 0]
        inside = (np.abs(y) < 0.15) * (np.abs(z - 1.235) < 0.055) * (x < -0.02)
        rgb = over(rgb, DARK, ink * inside * (0.85 + 0.15 * lattice(q * 200, 5)))
        return self.dirt(rgb, q, 0.28, c.seed + 320)

    def skin(self, q):
        c = self.person
        rgb = np.tile(np.array(c.skin), (len(q), 1)).astype(float)
        tone = fractal(q * 30.0, 4, c.seed + 400) - 0.5
        fine = lattice(q * 500.0, c.seed + 401) - 0.5
        rgb *= (1.0 + 0.16 * tone + 0.05 * fine)[:, None]
        if c.top == "shirt" and c.seed % 2 == 0:
            patch = step(0.52, 0.56, fractal(q * (26.0, 26.0, 18.0), 3, c.seed + 7))
            area = band(q[:, 2], 1.02, 1.20) * (q[:, 1] > 0)
            rgb = over(rgb, np.array([0.16, 0.22, 0.28]), 0.75 * patch * area)
        return rgb

    def hands(self, q):
        rgb = self.skin(q)
        u = self.shapes.unit
        m = np.stack([q[:, 0], np.abs(q[:, 1]), q[:, 2]], -1)
        k = m - u["knuckle_left"]
        down = unit(u["fingertip_left"] - u["knuckle_left"])
        s = k @ down
        for at in (0.0, 0.040, 0.066):
            rgb = over(rgb, rgb * 0.72, 0.55 * line(s - at, 0.003, 0.003))
        return rgb * np.array([1.03, 0.96, 0.94])

    def head(self, q):
        c = self.person
        rgb = self.skin(q)
        f, _ = self.shapes.face_frame(q)
        x, y, z = f[:, 0], f[:, 1], f[:, 2]
        a = np.abs(y)
        front = (x > 0.04).astype(float)
        blush = np.exp(-(((a - 0.045) / 0.022) ** 2 + ((z + 0.030) / 0.022) ** 2)) * front
        rgb = over(rgb, np.array(c.skin) * [0.98, 0.76, 0.72], 0.55 * blush)
        nose = np.exp(-((a / 0.016) ** 2 + ((z + 0.034) / 0.016) ** 2)) * (x > 0.09)
        rgb = over(rgb, np.array(c.skin) * [0.96, 0.78, 0.74], 0.4 * nose)
        socket = np.exp(-(((a - 0.031) / 0.020) ** 2 + ((z - 0.001) / 0.013) ** 2)) * front
        rgb *= (1.0 - 0.30 * socket)[:, None]
        if c.beard or c.hair in ("short", "bald") and c.bust == 0.0:
            jaw = step(-0.030, -0.055, z - 0.45 * np.clip(0.06 - x, 0, 0.1)) * step(-0.02, 0.02, x)
            jaw *= step(-0.135, -0.120, z)
            lip = np.exp(-((a / 0.024) ** 2 + ((z + 0.052) / 0.005) ** 2)) * front
            mask = np.clip(
                jaw * (1 - np.exp(-((a / 0.020) ** 2 + ((z + 0.066) / 0.007) ** 2))) + lip, 0, 1
            )
            stubble = mask * ((0.75 if c.beard else 0.45) + 0.3 * lattice(f * 700.0, 3))
            rgb = over(rgb, np.array(c.hair_colour) * 1.1, stubble * (0.92 if c.beard else 0.25))
        lips = np.exp(-((a / 0.022) ** 4 + ((z + 0.0645) / 0.0075) ** 4)) * (x > 0.075)
        tint = np.array(c.skin) * ([0.86, 0.50, 0.50] if c.bust else [0.88, 0.66, 0.62])
        rgb = over(rgb, tint, 0.8 * lips)
        mouth = line(z + 0.0648 - 2.0 * (a - 0.01) ** 2, 0.0010, 0.0012) * (a < 0.024) * (x > 0.075)
        rgb = over(rgb, np.array([0.22, 0.09, 0.08]), 0.9 * mouth)
        nostril = np.exp(-(((a - 0.0065) / 0.0042) ** 2 + ((z + 0.0455) / 0.0030) ** 2)) * (
            x > 0.09
        )
        rgb = over(rgb, np.array([0.16, 0.07, 0.06]), 0.9 * nostril)
        e = np.stack([a - 0.032, z - 0.0005], -1)
        opening = (np.abs(e[:, 0]) / 0.0145) ** 2 + (e[:, 1] / 0.0058) ** 2
        rgb = over(rgb, np.array([0.86, 0.84, 0.82]), front * step(1.1, 0.9, opening))
        iris = np.hypot(e[:, 0], e[:, 1])
        rgb = over(
            rgb, np.array([0.25, 0.20, 0.14]), front * step(0.0060, 0.0052, iris) * (opening < 1.05)
        )
        rgb = over(rgb, np.array([0.02, 0.02, 0.02]), front * step(0.0030, 0.0024, iris))
        rim = step(0.35, 0.1, np.abs(opening - 1.12)) * (0.55 + 0.45 * (e[:, 1] > 0))
        rgb = over(rgb, np.array([0.12, 0.08, 0.07]), front * rim * (0.9 if c.bust else 0.7))
        arch = z - 0.0205 - 0.006 * np.cos((a - 0.036) * 70) + 0.0035
        brow = step(0.0048, 0.0025, np.abs(arch)) * band(a, 0.012, 0.055, 0.003) * front
        brow *= 0.55 + 0.45 * ridged(f * (40, 320, 90), 8)
        rgb = over(rgb, np.array(c.hair_colour) * 0.8, (0.7 if c.bust else 0.9) * brow)
        grown = 0.010 * (lattice(f * 160.0, 12) - 0.5)
        behind = step(0.008, -0.012, x + grown) * step(-0.066, -0.046, z + grown) * (a < 0.0775)
        if c.hair == "bald":
            fringe = behind * step(0.050, 0.020, z - 0.3 * x + grown)
            rgb = over(
                rgb, np.array(c.hair_colour), 0.75 * fringe * (0.6 + 0.4 * lattice(f * 420.0, 13))
            )
        else:
            scalp = step(
                -0.006, 0.006, z - 0.074 - 1.0 * np.clip(x - 0.085, -0.3, 0.0) + 3.0 * a * a + grown
            )
            rgb = over(rgb, np.array(c.hair_colour), np.clip(np.maximum(scalp, behind), 0, 1))
        if c.glasses:
            d = np.hypot((a - 0.034) / 1.25, z - 0.001)
            frame = line(d - 0.0195, 0.0016, 0.0012) + line(z - 0.006, 0.0014) * (a < 0.014)
            frame = frame * (x > 0.05) + line(z - 0.006, 0.0018) * (x < 0.06) * (x > -0.01) * (
                a > 0.055
            )
            rgb = over(rgb, np.array([0.05, 0.05, 0.06]), np.clip(frame, 0, 1))
        return rgb

    def hair(self, q):
        c = self.person
        f, _ = self.shapes.face_frame(q)
        flow = strand_frame(f) + 0.03 * (lattice(f * 45.0, c.seed)[:, None] - 0.5)
        strand = 0.6 * ridged(flow * (34, 34, 14), c.seed + 5) + 0.4 * ridged(flow * (80, 80, 20), 9)
        tone = fractal(f * 16.0, 3, c.seed + 7)
        rgb = np.tile(np.array(c.hair_colour), (len(q), 1)) * (0.35 + 0.85 * strand + 0.4 * tone)[:, None]
        glint = step(0.7, 0.95, strand) * np.exp(-(((f[:, 2] - 0.085) / 0.03) ** 2))
        return rgb + 0.12 * glint[:, None]

    def helmet(self, q, n):
        c = self.person
        f, _ = self.shapes.face_frame(q)
        x, y, z = f[:, 0], f[:, 1], f[:, 2]
        rgb = np.tile(np.array(c.helmet_colour), (len(q), 1)).astype(float)
        rgb *= (1.0 + 0.10 * (fractal(f * 40.0, 4, c.seed) - 0.5))[:, None]
        scratch = step(0.80, 0.90, ridged(f * (30, 110, 60), c.seed + 2)) * step(
            0.5, 0.6, fractal(f * 20, 3, 4)
        )
        rgb = over(rgb, rgb[0] * 0.62, 0.5 * scratch)
        under = (n[:, 2] < -0.35).astype(float)
        rgb = over(rgb, rgb[0] * 0.35, under)
        if c.plain:
            return rgb
        if c.head_wear == "helmet":
            logo = np.maximum(np.abs(y) - 0.024, np.abs(z - 0.092) - 0.016)
            rgb = over(rgb, np.array([0.10, 0.22, 0.45]), (x > 0) * step(0.001, 0, logo))
            letters = (
                (lattice(f * (1, 130, 1), 3) > 0.5) * (np.abs(z - 0.092) < 0.007) * (logo < -0.004)
            )
            rgb = over(rgb, np.array([0.95, 0.95, 0.95]), (x > 0) * letters)
            rgb = over(rgb, DARK, line(z - 0.056 - 0.10 * x, 0.0022))
        else:
            seams = (
                line(y, 0.0012)
                + line(np.abs(y) - 0.8 * (x + 0.01), 0.001)
                + line(np.abs(y) + 0.8 * (x + 0.01), 0.001)
            )
            rgb = over(rgb, rgb[0] * 0.5, np.clip(seams, 0, 1) * (z > 0.065))
            rgb *= self.weave(q, c.seed + 500)[:, None]
        sticker = np.hypot(x + 0.02, (z - 0.098) * 1.0)
        rgb = over(
            rgb,
            np.array([0.75, 0.15, 0.12]),
            (y > 0) * step(0.016, 0.015, sticker) * (np.abs(n[:, 1]) > 0.5),
        )
        return rgb

    def shoes(self, q, n):
        c = self.person
        rgb = np.tile(np.array(c.shoe_colour), (len(q), 1)).astype(float)
        x, z = q[:, 0], q[:, 2]
        a = np.abs(q[:, 1])
        middle = 0.100 + 0.10 * x
        rgb *= self.weave(q, c.seed + 600, 0.10)[:, None]
        rgb *= self.creases(q, (26, 12, 20), c.seed + 610, 0.25)[:, None]
        sole = step(0.027, 0.025, z)
        rgb = over(rgb, np.array([0.33, 0.31, 0.28]), sole)
        rgb = over(
            rgb,
            DARK,
            line(z - 0.027, 0.0016) + 0.8 * sole * (np.sin(x * 420.0) > 0.5) * (z < 0.014),
        )
        cap = line(x - 0.150, 0.0015) * (z > 0.027)
        rgb = over(rgb, rgb[0] * 0.4, cap)
        laces = (np.abs(((x + z * 0.8) * 62.0) % 1.0 - 0.5) < 0.16) * (np.abs(a - middle) < 0.020)
        on_top = (x > 0.02) * (x < 0.125) * (n[:, 2] > 0.2) * (z > 0.05)
        rgb = over(rgb, np.array([0.62, 0.57, 0.46]), laces * on_top * 0.9)
        dust = step(0.06, 0.0, z) * (0.3 + 0.7 * fractal(q * 40.0, 3, c.seed + 620))
        return over(rgb, np.array([0.50, 0.47, 0.43]), 0.38 * dust)
