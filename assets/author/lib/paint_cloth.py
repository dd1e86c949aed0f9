"""Paint and relief of garments: seams, pockets, plackets, buttons, knit, reflective tape, print.

Points are those of the pattern, so that stripes and pockets follow the folds of the hung cloth.
"""

import numpy as np

from . import garments, picture
from .body import mirrored, near
from .brush import DARK, SILVER, band, dirt, flat, line, over, plate, raised, weave
from .noise import lattice, step

ZIP_M, BUTTON_M = 0.006, 0.0065


class Cloths:
    def __init__(self, person, shapes):
        self.person, self.shapes = person, shapes
        self.cut = garments.TOPS[person.top]
        self.print = self.back_print()

    def back_print(self):
        """Lettering on the back of the vest: one channel of coverage."""
        sheet = np.zeros((96, 256, 1))
        words = ("LOGISTICS", "WAREHOUSE", "SAFETY", "VISITOR", "TEAM 4", "DISPATCH")
        picture.text(sheet, words[self.person.seed % 6], 128, 44, 38, 1.0, "middle")
        picture.text(sheet, f"No. {17 + 13 * self.person.seed}", 128, 84, 32, 1.0, "middle")
        return sheet

    # Trousers.

    def trouser_lines(self, q):
        """(dark seams, raised pieces in metres, sunk seams) of the trousers."""
        c = self.person
        x, y, z = q.T
        across = np.abs(y) - np.interp(z, [0.05, 0.5, 0.92], [0.100, 0.096, 0.092])
        seams = line(x + 0.006, 0.0008) * (z < 0.90) * (np.abs(y) > 0.03)
        seams = seams + line(y, 0.001) * (z > 0.80) * (z < 1.0)
        rise = np.zeros(len(q))
        for sign in (1, -1):
            back = plate(y - sign * 0.085, z - 0.90, 0.060, 0.070)
            seams = seams + (x < -0.03) * line(back, 0.0007)
            rise = rise + (x < -0.03) * raised(back, 0.0012)
        slash = line((z - 0.93) - 1.6 * (np.abs(y) - 0.13), 0.0012) * band(z, 0.87, 0.985) * (x > 0)
        seams = seams + slash + 0.6 * line(z - 0.988, 0.0007) + 0.8 * line(z - 0.052 - 0.2 * x, 0.0006)
        if c.bottom == "work" and not c.plain:
            thigh = plate(x - 0.0, z - 0.67, 0.070, 0.085)
            out = np.abs(y) > 0.13
            seams = seams + out * (line(thigh, 0.0008) + line(z - 0.715, 0.0008) * (thigh < 0))
            rise = rise + out * (raised(thigh, 0.0035) + raised(np.maximum(thigh, 0.715 - z), 0.002))
            knee = plate(across, z - 0.48, 0.056, 0.125)
            seams = seams + (x > 0.01) * (line(knee, 0.0008) + 0.5 * line(knee + 0.006, 0.0006))
            rise = rise + (x > 0.01) * raised(knee, 0.0016)
        return np.clip(seams, 0, 1), rise

    def trousers(self, q):
        c = self.person
        x, y, z = q.T
        rgb = flat(c.trouser_colour, len(q))
        if c.bottom == "jeans":
            worn = near(z, 0.72, 0.11) * (x > 0.03) + 0.8 * near(z, 0.49, 0.06) * (x > 0.04) + 0.7 * near(z, 0.88, 0.06) * (x < -0.06)
            rgb = over(rgb, np.array(c.trouser_colour) * 0.4 + 0.48, 0.45 * np.clip(worn, 0, 1))
            twill = 0.5 + 0.5 * np.sin((z * 1.7 + y + x) * 900.0)
            rgb *= (0.97 + 0.06 * twill)[:, None]
        if c.bottom == "work" and not c.plain:
            across = np.abs(y) - np.interp(z, [0.05, 0.5, 0.92], [0.100, 0.096, 0.092])
            knee = plate(across, z - 0.48, 0.056, 0.125)
            rgb = over(rgb, np.array(c.trouser_colour) * 0.62, (x > 0.01) * step(0.002, -0.001, knee))
        seams, _ = self.trouser_lines(q)
        gold = (0.62, 0.44, 0.20) if c.bottom == "jeans" else np.array(c.trouser_colour) * 0.55
        rgb = over(rgb, gold, (0.55 if c.bottom == "jeans" else 0.7) * seams)
        if c.vest and c.bottom == "work":
            rgb = over(rgb, SILVER, band(z, 0.270, 0.318))
            rgb = over(rgb, np.array(c.trouser_colour) * 0.6, line(z - 0.270, 0.001) + line(z - 0.318, 0.001))
        belt = band(z, 1.000, 1.030)
        rgb = over(rgb, (0.10, 0.08, 0.06), belt)
        buckle = plate(y, z - 1.015, 0.020, 0.016)
        rgb = over(rgb, (0.62, 0.61, 0.58), (x > 0) * step(0.001, -0.001, np.abs(buckle + 0.003) - 0.003))
        rgb *= weave(q, c.seed + 100, 0.05)[:, None]
        if c.plain:
            return rgb
        rgb = dirt(rgb, q, 0.22 if c.bottom == "work" else 0.06, c.seed + 120)
        return rgb

    def trousers_relief(self, q):
        seams, rise = self.trouser_lines(q)
        belt = 0.002 * band(q[:, 2], 1.000, 1.030)
        return rise - 0.0012 * seams + belt + self.grain(q, 0.00022)

    def grain(self, q, amount):
        return amount * (lattice(q * 330.0, self.person.seed) + 2.0 * lattice(q * 90.0, 4))

    # Upper garment.

    def sleeve_frame(self, q):
        """(along the upper arm, along the forearm, share of arm)."""
        m, (a, e, w) = mirrored(q), self.shapes.arm_line()
        s = (m - a) @ ((e - a) / np.linalg.norm(e - a))
        r = (m - e) @ ((w - e) / np.linalg.norm(w - e))
        return s, r, self.shapes.armness(q)

    def button_heights(self):
        c = self.cut
        top = 1.46 - c.neck - (0.02 if c.collar != "lapel" else 0.01)
        gap = {"coat": 0.125, "labcoat": 0.11, "blazer": 0.11}.get(self.person.top, 0.088)
        count = {"blazer": 2, "coat": 4, "labcoat": 5}.get(self.person.top, 6)
        return [top - gap * k for k in range(count) if top - gap * k > c.hem + 0.03]

    def top_lines(self, q):
        """(dark seams, raised in metres, buttons) of the upper garment."""
        c, cut = self.person, self.cut
        x, y, z = q.T
        s, r, arm = self.sleeve_frame(q)
        body, front = 1 - arm, (x > 0.0).astype(float)
        seams = 0.6 * line(arm - 0.42, 0.015, 0.035) * (z > 1.25) * (cut.sleeve != "none")
        seams = seams + line(x + 0.010, 0.0009) * body * (z < 1.28) * (np.abs(y) > 0.08)
        seams = seams + 0.8 * line(z - cut.hem - 0.022, 0.0007) * body
        rise, buttons = np.zeros(len(q)), np.zeros(len(q))
        v_low = 1.475 - cut.neck
        if cut.front == "zip":
            seams = seams + front * body * line(np.abs(y) - 0.011, 0.0008)
            rise = rise + front * body * (0.0022 * step(ZIP_M + 0.001, ZIP_M - 0.001, np.abs(y)) + 0.0010 * (np.abs(y) < 0.011))
        if cut.front == "buttons":
            lap = np.where(y > -0.018, 1.0, 0.0)  # the left front lies over the right
            edge = front * body * (z < v_low + 0.015)
            seams = seams + edge * (0.9 * line(y + 0.018, 0.0010) + 0.35 * line(y - 0.018, 0.0006) * (cut.collar != "lapel"))
            rise = rise + edge * 0.0028 * step(-0.0195, -0.0175, y) * step(0.06, 0.0, y) * lap
            size = BUTTON_M * (1.6 if cut.collar == "lapel" else 1.0)
            for z0 in self.button_heights():
                d = np.hypot(y - 0.0, z - z0)
                buttons = np.maximum(buttons, front * body * step(size + 0.0008, size - 0.0008, d))
                rise = rise + front * body * 0.0022 * step(size + 0.001, size - 0.001, d)
        flaps = {"coat": ((0.105, 0.84, 0.072, 0.026),), "blazer": ((0.100, 0.93, 0.065, 0.022),), "labcoat": ((0.105, 0.86, 0.070, 0.085), (0.085, 1.27, 0.048, 0.055))}
        flaps["jacket"] = ((0.085, 1.27, 0.050, 0.058), (0.105, 0.98, 0.058, 0.060))
        flaps["overshirt"] = ((0.085, 1.28, 0.050, 0.055),)
        flaps["shirt"] = ((0.080, 1.28, 0.042, 0.048),) if not c.female else ()
        for y0, z0, hy, hz in flaps.get(c.top, ()):
            for sign in (1, -1):
                if c.top in ("shirt", "labcoat") and z0 > 1.2 and sign < 0:
                    continue
                d = plate(y - sign * y0, z - z0, hy, hz)
                seams = seams + 0.8 * front * body * line(d + 0.002, 0.0007)
                rise = rise + front * body * raised(d, 0.0022)
                if hz > 0.05:
                    lid = np.maximum(d, z0 + hz - 0.030 - z)
                    seams = seams + 0.7 * front * body * line(z - z0 - hz + 0.030, 0.0008) * (d < 0)
                    rise = rise + front * body * raised(lid, 0.0016)
        if cut.collar == "lapel":
            breast = plate(y - 0.095, z - 1.285, 0.042, 0.009)
            seams = seams + front * body * line(breast, 0.0007)
            rise = rise + front * body * raised(breast, 0.0014)
            dart = line(np.abs(y) - 0.085 - 0.02 * (z - 1.1), 0.0007) * band(z, 0.93, 1.2, 0.01)
            seams = seams + 0.5 * front * body * dart + 0.7 * (x < 0) * body * line(y, 0.0009) * (z < 1.44)
        if c.top in ("jacket", "overshirt", "shirt", "bomber"):
            seams = seams + 0.7 * line(z - 1.385, 0.0009) * body * (x < 0)
        if c.top == "hoodie":
            pouch = plate(y, z - 1.01, 0.115 - 0.35 * (z - 0.95).clip(0), 0.075)
            seams = seams + 0.8 * front * body * line(pouch, 0.0010)
            rise = rise + front * body * raised(pouch, 0.0035)
        cuff_end = 0.205 if cut.sleeve == "short" else 0.0
        if cut.sleeve == "short":
            seams = seams + 0.7 * arm * line(s - cuff_end, 0.0008)
        else:
            seams = seams + 0.9 * arm * line(r - 0.190, 0.0010) * (cut.collar != "lapel")
        return np.clip(seams, 0, 1), rise, np.clip(buttons, 0, 1)

    def ribs(self, q):
        """Knitted edges: share of the edge, and its ribs."""
        s, r, arm = self.sleeve_frame(q)
        around = np.arctan2(q[:, 1], q[:, 0] + 0.005) * 0.16
        m = mirrored(q)
        _, e, w = self.shapes.arm_line()
        side = m - e
        turn = np.arctan2(side[:, 0], side[:, 1] - 0.5 * r) * 0.04
        wave = np.where(arm > 0.5, np.sin(turn * 900.0), np.sin(around * 900.0))
        edge = np.maximum(arm * step(0.188, 0.192, r), (1 - arm) * step(self.cut.hem + 0.055, self.cut.hem + 0.050, q[:, 2]))
        return edge * (self.cut.cling > 0.7), wave

    def top(self, q):
        c, cut = self.person, self.cut
        x, y, z = q.T
        s, r, arm = self.sleeve_frame(q)
        body, front = 1 - arm, (x > 0.0).astype(float)
        colour = np.array(c.top_colour)
        rgb = flat(colour, len(q))
        if c.top == "overshirt":  # checks
            a, b = np.where(arm > 0.5, s * 1.0, z), np.where(arm > 0.5, x, y)
            rgb = over(rgb, colour * 0.45, 0.55 * ((a * 16.0) % 1.0 < 0.42))
            rgb = over(rgb, colour * 0.45, 0.55 * ((b * 16.0) % 1.0 < 0.42))
            rgb = over(rgb, (0.80, 0.76, 0.68), 0.5 * line((a * 16.0) % 1.0 - 0.72, 0.03, 0.03))
        if c.top == "blouse" and not c.plain:
            rgb = over(rgb, colour * 0.72, 0.5 * line((y * 62.0) % 1.0 - 0.5, 0.12, 0.08))
        if c.top == "sweater" and c.seed % 2 == 0:
            for z0 in (1.30, 1.20, 1.10, 1.00):
                rgb = over(rgb, (0.82, 0.80, 0.74), body * band(z, z0 - 0.022, z0 + 0.022, 0.003))
        if c.top == "jacket" and not c.plain:
            rgb = over(rgb, colour * 0.55, np.clip(step(1.375, 1.38, z) * (arm < 0.6) + arm * step(0.06, 0.055, s), 0, 1) * (c.seed % 2))
        edge, wave = self.ribs(q)
        rgb = over(rgb, colour * (0.80 if cut.knit else 0.62), 0.8 * edge * (0.65 + 0.35 * wave))
        seams, _, buttons = self.top_lines(q)
        rgb = over(rgb, rgb * 0.50, 0.75 * seams)
        dark = colour.mean() > 0.35
        rgb = over(rgb, (0.10, 0.09, 0.08) if dark and cut.collar == "lapel" else ((0.85, 0.84, 0.80) if not dark else colour * 0.55), buttons)
        if cut.front == "zip":
            teeth = step(0.0030, 0.0022, np.abs(y)) * front * body
            rgb = over(rgb, (0.45, 0.44, 0.42), teeth * (0.5 + 0.5 * np.sin(z * 1500.0)))
        if not c.plain:
            if c.top in ("jacket", "labcoat", "shirt"):
                badge = plate(y - 0.088, z - 1.350, 0.034, 0.011)
                rgb = over(rgb, (0.86, 0.86, 0.82), front * body * step(0.001, 0, badge))
                ink = (lattice(q * (1.0, 160.0, 90.0), 3) > 0.52) * (badge < -0.003)
                rgb = over(rgb, DARK, front * body * ink * 0.9)
            if c.vest and c.top in ("jacket", "bomber"):
                rgb = over(rgb, SILVER, arm * band(s, 0.160, 0.205))
                rgb = over(rgb, DARK, 0.6 * arm * np.clip(line(s - 0.16, 0.001) + line(s - 0.205, 0.001), 0, 1))
            if c.top == "tee":
                chest = np.hypot(y / 0.075, (z - 1.27) / 0.055) - 1
                ring = front * body * step(0.03, -0.03, np.abs(chest) - 0.14)
                rgb = over(rgb, (0.88, 0.86, 0.80), 0.85 * ring)
        rgb *= weave(q, c.seed + 200, 0.04)[:, None]
        return rgb if c.plain or cut.collar == "lapel" else dirt(rgb, q, 0.08, c.seed + 220)

    def top_relief(self, q):
        seams, rise, _ = self.top_lines(q)
        edge, wave = self.ribs(q)
        out = rise - 0.0014 * seams + 0.0010 * edge * wave + self.grain(q, 0.0002)
        if self.cut.knit:
            s, r, arm = self.sleeve_frame(q)
            around = np.where(arm > 0.5, q[:, 0], np.arctan2(q[:, 1], q[:, 0]) * 0.16)
            along = np.where(arm > 0.5, s + r, q[:, 2])
            stitch = np.sin(around * 900.0) * (0.7 + 0.3 * np.sin(along * 1100.0 + 2.0 * np.sin(around * 900.0)))
            out = out + (0.0008 if self.person.top == "sweater" else 0.0003) * stitch * (1 - edge)
        return out

    def collar(self, q):
        c = self.person
        colour = np.array(c.top_colour) * (0.86 if self.cut.knit or self.cut.collar == "stand" else 1.0)
        return flat(colour, len(q)) * weave(q, c.seed + 230, 0.04)[:, None]

    def collar_relief(self, q):
        if self.cut.collar in ("crew",) or self.person.top == "bomber":
            turn = np.arctan2(q[:, 1], q[:, 0] + 0.02)
            return 0.0009 * np.sin(turn * 75.0)
        return self.grain(q, 0.0002)

    # Vest.

    def vest_lines(self, q):
        x, y, z = q.T
        front = (x > 0.0).astype(float)
        seams, rise = line(x + 0.005, 0.0010) * (z < 1.30), np.zeros(len(q))
        seams = seams + front * (0.8 * line(y, 0.0012) + 0.5 * line(np.abs(y) - 0.014, 0.0007)) * (z < 1.36)
        rise = rise + front * 0.0020 * step(0.006, 0.005, np.abs(y))
        for sign in (1, -1):
            low = plate(y - sign * 0.092, z - 1.020, 0.056, 0.038)
            seams, rise = seams + front * line(low, 0.0007), rise + front * raised(low, 0.0022)
        return np.clip(seams, 0, 1), rise

    def tape(self, q):
        """1 on the reflective tape."""
        _, y, z = q.T
        up = step(1.125, 1.130, z)
        brace = np.abs(np.abs(y) - 0.105)
        return np.clip(band(z, 0.925, 0.975) + band(z, 1.075, 1.125) + up * step(0.0255, 0.0240, brace), 0, 1)

    def vest(self, q):
        c = self.person
        x, y, z = q.T
        front = (x > 0.0).astype(float)
        colour = np.array(c.vest_colour)
        rgb = flat(colour, len(q)) * weave(q, c.seed + 300, 0.04)[:, None]
        mesh = 0.5 + 0.5 * np.sin(y * 1200.0) * np.sin(z * 1200.0)
        rgb *= (0.97 + 0.05 * mesh)[:, None]
        tape = self.tape(q)
        glass = 1.0 + 0.05 * (lattice(q * 160.0, 6) - 0.5)
        grid = line(((z + y) * 70.0) % 1.0 - 0.5, 0.05, 0.08) + line(((z - y) * 70.0) % 1.0 - 0.5, 0.05, 0.08)
        rgb = over(rgb, SILVER, tape) * np.where(tape > 0.5, glass * (1 - 0.09 * np.clip(grid, 0, 1)), 1.0)[:, None]
        seams, _ = self.vest_lines(q)
        rgb = over(rgb, colour * 0.45, 0.8 * seams)
        card = plate(y + 0.072, z - 1.235, 0.024, 0.032)
        rgb = over(rgb, (0.92, 0.92, 0.90), front * step(0.001, 0.0, card))
        photo = plate(y + 0.072, z - 1.243, 0.010, 0.012)
        rgb = over(rgb, (0.35, 0.30, 0.30), front * step(0.001, 0.0, photo))
        rgb = over(rgb, DARK, front * line(z - 1.220, 0.002) * (np.abs(y + 0.072) < 0.015))
        ink = picture.sample(self.print, 0.5 - y / 0.30, 0.5 - (z - 1.235) / 0.11)[:, 0]
        inside = (np.abs(y) < 0.15) * (np.abs(z - 1.235) < 0.055) * (x < -0.02)
        rgb = over(rgb, DARK, ink * inside * (0.85 + 0.15 * lattice(q * 200, 5)))
        return dirt(rgb, q, 0.14, c.seed + 320)

    def vest_relief(self, q):
        seams, rise = self.vest_lines(q)
        return rise - 0.0010 * seams + 0.0009 * self.tape(q) + self.grain(q, 0.00015)
