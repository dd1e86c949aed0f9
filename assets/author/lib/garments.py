"""Garments: cut over the bare body, hung on it (drape.py), with collars and turned hems.

All lengths are metres of a person 1.75 m tall.
"""

from dataclasses import dataclass

import numpy as np

from . import border, drape, sdf, shell
from .body import mirrored, near
from .noise import step

CELL = 0.0125  # spacing of the hanging cloth's vertices


@dataclass
class Cut:
    """A pattern for the upper body."""

    hem: float = 0.87  # height of the lower edge
    sleeve: str = "long"  # long, short or none
    loose: float = 0.012  # room between body and cloth
    neck: float = 0.0  # how much lower the neckline lies than a crew neck
    collar: str = "stand"  # stand, fold, lapel, hood, crew or none
    cling: float = 0.0  # share of the lower edge gathered onto the body
    along: float = 0.07  # extra length of the sleeves
    round: float = 0.03  # extra width
    bend: float = 0.25
    front: str = "zip"  # zip, buttons or none
    knit: bool = False


TOPS = {
    "jacket": Cut(loose=0.016, cling=0.9, along=0.10, bend=0.30),
    "bomber": Cut(hem=0.93, loose=0.020, cling=1.0, along=0.12, round=0.05, bend=0.35),
    "hoodie": Cut(hem=0.90, loose=0.016, collar="hood", cling=0.9, along=0.12, round=0.04, bend=0.3, knit=True, front="none"),
    "shirt": Cut(hem=0.92, sleeve="short", loose=0.010, collar="fold", round=0.04, bend=0.15, front="buttons"),
    "tee": Cut(hem=0.90, sleeve="short", loose=0.010, collar="crew", round=0.03, bend=0.12, front="none"),
    "overshirt": Cut(hem=0.86, loose=0.012, collar="fold", along=0.08, round=0.04, bend=0.18, front="buttons"),
    "blouse": Cut(hem=0.90, loose=0.012, collar="fold", along=0.09, round=0.05, bend=0.10, front="buttons"),
    "sweater": Cut(hem=0.90, loose=0.014, collar="crew", cling=0.8, along=0.10, bend=0.32, knit=True, front="none"),
    "blazer": Cut(hem=0.82, loose=0.014, neck=0.15, collar="lapel", along=0.05, round=0.015, bend=0.40, front="buttons"),
    "coat": Cut(hem=0.52, loose=0.017, neck=0.12, collar="lapel", along=0.05, round=0.02, bend=0.40, front="buttons"),
    "labcoat": Cut(hem=0.56, loose=0.015, neck=0.10, collar="lapel", along=0.06, round=0.03, bend=0.25, front="buttons"),
}
# bottom: radii of the leg at hip, half thigh, knee, calf and hem; extra length
BOTTOMS = {
    "work": ((0.094, 0.089, 0.077, 0.075, 0.073), 0.06, 0.22),
    "jeans": ((0.090, 0.083, 0.067, 0.064, 0.060), 0.05, 0.22),
    "chinos": ((0.091, 0.084, 0.069, 0.066, 0.061), 0.04, 0.16),
}
VEST_OUT, UNDER_VEST = 0.030, 0.024
VEST_CLEAR = 0.008  # metres between a vest and the top below it


def limb(q, line, point=None):
    """Unit direction of the nearer of two limb segments at each point."""
    a, b, c = line
    first, second = (b - a) / np.linalg.norm(b - a), (c - b) / np.linalg.norm(c - b)
    share = step(-0.03, 0.03, (q - b) @ (first + second) / 2)[:, None]
    d = first * (1 - share) + second * share
    return d / np.linalg.norm(d, axis=1, keepdims=True)


def unmirror(direction, q):
    return direction * np.stack([np.ones(len(q)), np.where(q[:, 1] < 0, -1.0, 1.0), np.ones(len(q))], -1)


class Tailor:
    """Makes the garments of one person."""

    def __init__(self, shapes):
        self.shapes, self.person = shapes, shapes.person
        self.cut = TOPS[self.person.top]
        lo, hi = (-0.30, -0.64, -0.02), (0.30, 0.64, 1.62)
        self.body = sdf.grid(shapes.bare, lo, hi, 0.009)
        self.wide = sdf.grid(self.over_legs, lo, hi, 0.012) if self.cut.hem < 0.8 else self.body

    def over_legs(self, q):
        """The body with a skirt's width between the legs, so that a coat hangs straight."""
        return sdf.union(self.shapes.bare(q), self.shapes.trunk(q, -0.012, 0.45), 0.02)

    def armless(self, q):
        """What a vest hangs on: the body without its arms, which would tear the armholes down."""
        slope = sdf.capsule(mirrored(q), (-0.024, 0.010, 1.500), self.shapes.unit["shoulder_left"] + [-0.006, -0.030, 0.014], 0.050, 0.034)
        return sdf.union(sdf.union(self.shapes.trunk(q), slope, 0.035), self.shapes.legs(q), 0.035)

    def sleeve(self, q, loose, short):
        """Tubes round the arms that run on beyond the cuff."""
        m, (a, e, w) = mirrored(q), self.shapes.arm_line()
        g = self.person.girth**0.7
        if short:
            points = [a + [0, -0.035, -0.010], a + 0.4 * (e - a), a + 0.95 * (e - a)]
            return sdf.tube(m, points, np.array([0.054, 0.055, 0.058]) * g + loose, 0.03)
        points = [a + [0, -0.035, -0.010], a + 0.4 * (e - a), e, e + 0.4 * (w - e), e + 1.25 * (w - e)]
        return sdf.tube(m, points, np.array([0.051, 0.048, 0.042, 0.040, 0.031]) * g + loose, 0.03)

    def top_field(self, q):
        c = self.cut
        d = self.shapes.trunk(q, c.loose, c.hem - 0.06 if c.hem < 0.8 else None)
        body = self.shapes.bare(q) - c.loose
        d = np.minimum(d, np.where(q[:, 2] > 1.30, body, d)) if c.sleeve == "none" else d
        if c.hem >= 0.8:  # below the hips the tube runs straight on
            rows = self.shapes.rows()
            low = np.array([[c.hem - 0.10, *rows[1, 1:]], [0.85, *rows[1, 1:]], *rows[2:4]])
            low[:, 2:] += c.loose
            d = np.minimum(d, sdf.loft(q, low, 2.25))
        m, u = mirrored(q), self.shapes.unit
        slope = sdf.capsule(m, (-0.024, 0.010, 1.500), u["shoulder_left"] + [-0.006, -0.030, 0.014], 0.050, 0.034)
        d = sdf.union(d, slope - c.loose, 0.03)
        return sdf.union(d, self.sleeve(q, c.loose, c.sleeve == "short"), 0.030)

    def neckline(self, q):
        """Positive inside the opening for the neck, with a V in front where the cut has one."""
        n = self.cut.neck
        hole = -sdf.capsule(q, (-0.034, 0, 1.47), (0.030, 0, 1.66), 0.074, 0.080)
        if n == 0.0:
            return hole
        v = 0.9 * (0.50 * (q[:, 2] - 1.475 + n) - np.abs(q[:, 1]))
        return np.maximum(hole, np.where((q[:, 0] > 0.0) & (q[:, 2] > 1.2), np.minimum(v, 0.09), -0.05))

    def cuff(self, q):
        """Positive beyond the cuff."""
        m, (a, e, w) = mirrored(q), self.shapes.arm_line()
        if self.cut.sleeve == "short":
            end, axis = a + 0.74 * (e - a), (e - a) / np.linalg.norm(e - a)
        else:
            end, axis = e + 0.98 * (w - e), (w - e) / np.linalg.norm(w - e)
        d = (m - end) @ axis
        return np.where(np.linalg.norm(m - end, axis=1) < 0.16, d, np.minimum(d, -0.02))

    def top(self):
        """(hung vertices, triangles, vertices as cut) of the upper garment."""
        c, p, s = self.cut, self.person, self.shapes
        x = 0.66 if c.sleeve == "long" else 0.50
        lo, hi = (-0.26, -x, c.hem - 0.04), (0.28, x, 1.56)
        v, quads, _ = sdf.surface(self.top_field, lo, hi, CELL)
        t = shell.triangulate(quads)
        level = lambda q: np.maximum.reduce(
            [c.hem + 0.012 * (q[:, 0] > 9) - q[:, 2], self.neckline(q), self.cuff(q)]
        )
        v, t = self.cut_out(v, t, level)
        arm = s.armness(v)
        m = mirrored(v)
        a, e, w = s.arm_line()
        axis = arm[:, None] * unmirror(limb(m, (a, e, w)), v) + (1 - arm[:, None]) * [0.0, 0, 1.0]
        axis /= np.linalg.norm(axis, axis=1, keepdims=True)
        down = (m - e) @ ((w - e) / np.linalg.norm(w - e))
        reach = (m - a) @ ((e - a) / np.linalg.norm(e - a))
        elbow, wrist = near(reach, 0.31, 0.10), near(down, 0.21, 0.09)
        along = 0.015 + arm * step(0.03, 0.14, reach) * c.along * (0.5 + 0.9 * elbow + 1.0 * wrist)
        along += (1 - arm) * (0.02 + 0.05 * near(v[:, 2], 1.03, 0.10)) * (c.hem > 0.8)
        wide = c.round * (0.5 + arm * 0.6 + (1 - arm) * step(1.30, 1.05, v[:, 2]))
        if c.hem < 0.8:
            wide = wide + 0.06 * step(0.95, 0.6, v[:, 2]) * (1 - arm)
        if c.sleeve == "short":
            along = 0.02 + 0.02 * arm
        cuff = -self.cuff(v)
        gather = step(0.05, 0.03, cuff) * (0.0 if c.sleeve == "short" else 1.0)
        hem = step(0.055, 0.04, v[:, 2] - c.hem) * c.cling * (1 - arm)
        still = np.maximum(gather, hem)
        along, wide = along * (1 - still), wide * (1 - still)
        held = np.maximum.reduce([step(0.03, 0.012, -self.neckline(v)), 0.9 * step(0.02, 0.004, cuff) * (gather > 0), 0.97 * hem])
        if c.hem < 0.8:
            held = np.maximum(held, 0.5 * step(0.05, 0.0, np.abs(v[:, 1])) * (v[:, 0] > 0) * (arm < 0.5))
        under = p.vest * step(0.84, 0.88, v[:, 2]) * (1 - arm) * step(0.23, 0.19, np.abs(v[:, 1]))
        most = np.where(under > 0.5, UNDER_VEST - 0.008, 0.2)
        inside = 0.007 if c.sleeve == "long" else np.where(v[:, 2] < 1.06, 0.018, 0.005)
        cloth = drape.Cloth(bend=c.bend, inside_m=inside)
        hung = drape.hang(v, t, np.stack([along, wide], -1), axis, held, self.wide, most, cloth, p.seed)
        return hung, t, v

    def cut_out(self, v, t, level):
        v, t = shell.cut(v, t, level)
        v, t = shell.largest(v, t)
        return shell.even(v, t), t

    def leg_field(self, q):
        radii, _, _ = BOTTOMS[self.person.bottom]
        m, u, g = mirrored(q), self.shapes.unit, self.person.girth**0.6
        hip, knee, ankle = u["hip_left"], u["knee_left"], u["ankle_left"]
        points = [
            hip + [0.0, -0.004, -0.05],
            hip + 0.45 * (knee - hip),
            knee,
            knee + 0.4 * (ankle - knee) + [-0.010, 0, 0],
            ankle + [0.004, 0, -0.12],
        ]
        leg = sdf.tube(m, points, np.array(radii) * g, 0.04, squash=(1.06, 0.97, 1.0))
        rows = self.shapes.rows()[:5].copy()
        rows[:, 2:] += 0.008
        rows = np.concatenate([rows, [[1.20, *rows[-1, 1:]]]])
        return sdf.union(leg, sdf.loft(q, rows, 2.25), 0.04)

    def bottom(self):
        """The trousers."""
        _, extra, bend = BOTTOMS[self.person.bottom]
        v, quads, _ = sdf.surface(self.leg_field, (-0.26, -0.28, -0.03), (0.28, 0.28, 1.10), CELL)
        t = shell.triangulate(quads)
        boots = self.person.shoes == "boots"
        hem = lambda q: 0.036 + 0.20 * q[:, 0].clip(-0.1, 0.1) - q[:, 2]
        v, t = self.cut_out(v, t, lambda q: np.maximum(hem(q), q[:, 2] - 1.035))
        u, m = self.shapes.unit, mirrored(v)
        line = [u[k] for k in ("hip_left", "knee_left", "ankle_left")]
        leg = step(0.90, 0.80, v[:, 2])
        axis = leg[:, None] * unmirror(limb(m, line), v) + (1 - leg[:, None]) * [0.0, 0, -1.0]
        axis /= np.linalg.norm(axis, axis=1, keepdims=True)
        z = v[:, 2]
        along = 0.01 + extra * (0.35 * leg + 0.8 * near(z, 0.50, 0.12) + 1.3 * near(z, 0.13, 0.10))
        along += 0.03 * near(z, 0.86, 0.06)
        wide = 0.02 + 0.02 * leg
        belt = step(0.975, 0.995, z)
        along, wide = along * (1 - belt), wide * (1 - belt)
        cloth = drape.Cloth(bend=bend, inside_m=0.006)
        most = np.where(z > max(0.84, self.cut.hem - 0.03), 0.012, 0.2)
        held = np.maximum(belt, 0.75 * step(0.075, 0.055, z))
        hung = drape.hang(v, t, np.stack([along, wide], -1), axis, held, self.body, most, cloth, self.person.seed + 50)
        return hung, t, v

    def vest_field(self, q):
        rows = self.shapes.rows()
        rows = np.concatenate([[[0.70, *rows[1, 1:]]], [[0.85, *rows[1, 1:]]], rows[2:]])
        rows[:, 2:] += VEST_OUT
        d = sdf.loft(q, rows, 2.25)
        m, u = mirrored(q), self.shapes.unit
        slope = sdf.capsule(m, (-0.024, 0.010, 1.500), u["shoulder_left"] + [-0.006, -0.025, 0.018], 0.050, 0.038)
        return sdf.union(d, slope - VEST_OUT, 0.03)

    def vest(self, below):
        """A warning vest over everything; `below` is the hung top (mesh.Surface), which it clears."""
        u = self.shapes.unit
        v, quads, _ = sdf.surface(self.vest_field, (-0.26, -0.30, 0.76), (0.28, 0.30, 1.58), CELL)
        t = shell.triangulate(quads)
        arm = u["elbow_left"] - u["shoulder_left"]
        start = u["shoulder_left"] + [0, 0.050, 0.055]

        a, wide_m = u["shoulder_left"], 0.050 * self.person.girth**0.7 + self.cut.loose + 0.030

        def level(q):
            m = mirrored(q)
            hole = -sdf.capsule(m, start, start + 0.45 * arm + [0, -0.005, 0], 0.090, 0.078)
            hole = -sdf.union(-hole, sdf.capsule(m, a + 0.22 * arm, a + 0.8 * arm, wide_m, wide_m), 0.03)  # clear of the sleeve
            neck = -sdf.capsule(q, (0.15, 0, 1.24), (0.06, 0, 1.50), 0.012, 0.098)
            back = -sdf.ellipsoid(q, (-0.02, 0, 1.56), (0.10, 0.098, 0.085))
            neck = -sdf.union(-neck, -back, 0.04)  # no corner where they meet on the shoulder
            return np.maximum.reduce([0.83 - q[:, 2], hole, neck])

        v, t = self.cut_out(v, t, level)
        v = border.settle(v, t, self.vest_field, level)
        z = v[:, 2]
        along = 0.012 + 0.03 * near(z, 1.03, 0.10)
        wide = 0.015 + 0.03 * step(1.25, 0.95, z)
        held = np.maximum(0.9 * step(1.40, 1.44, z), 0.0)
        cloth = drape.Cloth(bend=0.35, inside_m=UNDER_VEST)
        axis = np.tile([0.0, 0, 1.0], (len(v), 1))
        trunk = sdf.grid(self.armless, (-0.30, -0.40, 0.60), (0.30, 0.40, 1.62), 0.009)
        hung = drape.hang(v, t, np.stack([along, wide], -1), axis, held, trunk, np.full(len(v), 0.2), cloth, self.person.seed + 80)
        hung = border.bind(hung, v, t)
        return border.over(hung, t, below, VEST_CLEAR, self.shapes.armness), t, v
