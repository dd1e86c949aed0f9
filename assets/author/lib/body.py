"""A clothed person as signed distance fields, one per part: cloth, skin, hair, helmet, shoes.

All numbers are metres of a person 1.75 m tall; the fields scale them to the person's stature.
"""

from dataclasses import dataclass

import numpy as np

from . import rig, sdf
from .noise import lattice, ridged, step


@dataclass
class Person:
    """What distinguishes one person from another; colours are sRGB 0..1 triples."""

    name: str = "worker"
    seed: int = 1
    height_m: float = 1.75
    shoulders: float = 1.0  # breadth of shoulders, 1 = average man
    girth: float = 1.0  # thickness of trunk and limbs
    belly: float = 0.0  # metres the waist stands out in front
    hips: float = 1.0  # breadth of hips
    bust: float = 0.0  # metres the chest stands out in front
    top: str = "jacket"  # jacket, shirt (short sleeves), coat (to the knee) or hoodie
    vest: bool = True
    head_wear: str = "helmet"  # helmet, cap or none
    hair: str = "short"  # short, bob, bun, bald
    beard: bool = False
    glasses: bool = False
    skin: tuple = (0.80, 0.61, 0.51)
    hair_colour: tuple = (0.20, 0.13, 0.08)
    top_colour: tuple = (0.13, 0.17, 0.27)
    trouser_colour: tuple = (0.30, 0.31, 0.33)
    vest_colour: tuple = (0.80, 0.86, 0.16)
    helmet_colour: tuple = (0.93, 0.90, 0.82)
    shoe_colour: tuple = (0.16, 0.12, 0.09)
    plain: bool = False  # no stripes, pockets or print: hard for feature detectors


def mirrored(q):
    """Folds the right half of space onto the left."""
    return np.stack([q[:, 0], np.abs(q[:, 1]), q[:, 2]], -1)


def cloth(q, freq, amount, seed):
    """Fold depth of cloth: crests run across the direction of the highest frequency."""
    warp = 0.35 * lattice(q * 6.0, seed + 9)[:, None]
    crest = ridged(q * freq + warp, seed) ** 1.5
    return amount * (crest - 0.45) + 0.25 * amount * (
        ridged(q * np.array(freq) * 2.3, seed + 3) - 0.5
    )


def strand_frame(f):
    """Coordinates of hair: direction round the crown (two numbers) and height, so that noise that is
    fine in the first two and coarse in the third runs from the crown down."""
    angle = np.arctan2(f[:, 1], f[:, 0] + 0.035)
    return np.stack([np.cos(angle), np.sin(angle), f[:, 2]], -1)


class Shapes:
    """The fields of one person; every method maps points in metres to distance in metres."""

    def __init__(self, person):
        self.person = person
        self.scale = person.height_m / 1.75
        self.joint = rig.joints(person)
        self.unit = {k: v / self.scale for k, v in self.joint.items()}

    def trunk(self, q, grow=0.0, low=0.80):
        """The torso from the crotch (or low) to the base of the neck."""
        c, g = self.person, self.person.girth
        w, b, u = c.shoulders, c.belly, c.bust
        rows = [
            (0.80, -0.010, 0.150 * c.hips, 0.090, 0.100),
            (0.87, -0.010, 0.172 * c.hips, 0.103, 0.122),
            (0.95, -0.008, 0.172 * c.hips, 0.108 + 0.5 * b, 0.118),
            (1.03, -0.004, 0.156 * (c.hips + g) / 2, 0.108 + b, 0.098),
            (1.11, -0.004, 0.146 * g, 0.108 + b, 0.090),
            (1.20, -0.006, 0.154 * g, 0.114 + 0.7 * b, 0.096),
            (1.29, -0.010, 0.168 * (g + w) / 2, 0.120 + 0.2 * b + u, 0.106),
            (1.36, -0.014, 0.176 * w, 0.112 + 0.6 * u, 0.108),
            (1.42, -0.018, 0.168 * w, 0.092, 0.100),
            (1.465, -0.020, 0.128 * w, 0.074, 0.084),
            (1.500, -0.020, 0.076, 0.062, 0.066),
            (1.53, -0.018, 0.060, 0.056, 0.058),
        ]
        if low < 0.80:
            rows = [
                (z, x, w + 0.014 * (z < 1.0), f + 0.014 * (z < 1.0), k + 0.014 * (z < 1.0))
                for z, x, w, f, k in rows
            ]
            rows = [
                (low, -0.006, 0.205 * c.hips, 0.150, 0.165),
                (0.70, -0.008, 0.188 * c.hips, 0.128, 0.142),
            ] + rows[1:]
        rows = np.array(rows)
        rows[:, 2:] = rows[:, 2:] * np.where(rows[:, :1] < 1.4, g**0.5, 1.0) + grow
        return sdf.loft(q, rows, 2.35)

    def sleeve(self, m, radii, short=False):
        u = self.unit
        a, e, w = u["shoulder_left"], u["elbow_left"], u["wrist_left"]
        if short:
            end = a + 0.72 * (e - a)
            return sdf.tube(m, [a + [0, -0.035, -0.008], a + 0.3 * (e - a), end], radii, 0.03)
        cuff = e + 0.97 * (w - e)
        points = [a + [0, -0.035, -0.008], a + 0.35 * (e - a), e, e + 0.35 * (w - e), cuff]
        return sdf.tube(m, points, radii, 0.03)

    def armness(self, p):
        """1 on the arm, 0 on the trunk: which of the two surfaces is nearer."""
        q = p / self.scale
        m = mirrored(q)
        return step(-0.015, 0.025, self.trunk(q) - self.sleeve(m, self.arm_radii(0.0)))

    def arm_radii(self, loose):
        g = self.person.girth**0.7
        return [
            0.052 * g + loose,
            0.051 * g + loose,
            0.043 * g + loose,
            0.045 * g + loose,
            0.031 * g + loose,
        ]

    def trousers(self, p):
        q = p / self.scale
        m, u, g = mirrored(q), self.unit, self.person.girth**0.7
        hip, knee, ankle = u["hip_left"], u["knee_left"], u["ankle_left"]
        points = [
            hip + [0.0, -0.006, -0.05],
            hip + 0.45 * (knee - hip),
            knee,
            knee + 0.35 * (ankle - knee) + [-0.012, 0, 0],
            ankle + [-0.012, 0, 0.02],
            ankle + [-0.008, 0, -0.02],
        ]
        radii = [0.088 * g, 0.080 * g, 0.066 * g, 0.068 * g, 0.060, 0.062]
        leg = sdf.tube(m, points, radii, 0.04, squash=(1.06, 0.97, 1.0))
        leg = np.maximum(leg, 0.052 - q[:, 2])
        seat = sdf.common(self.trunk(q, -0.004), q[:, 2] - 1.045, 0.01)
        d = sdf.union(seat, leg, 0.045)
        side = np.sign(q[:, 1])[:, None] * [0.0, 0.0, 3.3]
        near = lambda z, r: np.exp(-(((q[:, 2] - z) / r) ** 2))
        amount = (
            0.003 + 0.007 * near(0.50, 0.11) + 0.010 * near(0.13, 0.10) + 0.007 * near(0.84, 0.09)
        )
        folds = cloth(
            q + side + 0.4 * q[:, :1] * [0, 0, 1], (7.0, 7.0, 17.0), 1.0, self.person.seed
        )
        return (d - amount * folds) * self.scale

    def upper(self, p):
        """Jacket, hoodie, shirt or coat with its sleeves."""
        q = p / self.scale
        m, u, kind = mirrored(q), self.unit, self.person.top
        loose = {"jacket": 0.014, "hoodie": 0.016, "shirt": 0.004, "coat": 0.014}[kind]
        low = {"jacket": 0.87, "hoodie": 0.90, "shirt": 0.93, "coat": 0.52}[kind]
        d = self.trunk(q, loose, low=0.50 if kind == "coat" else 0.80)
        d = sdf.common(d, low - q[:, 2], 0.012)
        short = kind == "shirt"
        radii = [0.056, 0.060, 0.064] if short else self.arm_radii(loose * 0.6)
        d = sdf.union(d, self.sleeve(m, radii, short), 0.035)
        d = sdf.cut(d, sdf.ellipsoid(q, (0.05, 0, 1.55), (0.085, 0.058, 0.075)), 0.01)
        if kind != "shirt":
            ring = sdf.ellipsoid(q, (-0.012, 0, 1.505), (0.084, 0.076, 0.055))
            hole = sdf.ellipsoid(q, (0.0, 0, 1.545), (0.080, 0.062, 0.075))
            d = sdf.union(d, sdf.cut(ring, hole, 0.008), 0.012)
        if kind == "hoodie":
            d = sdf.union(d, sdf.ellipsoid(q, (-0.105, 0, 1.455), (0.05, 0.10, 0.075)), 0.02)
        axis = u["elbow_left"] - u["shoulder_left"]
        axis = axis / np.linalg.norm(axis)
        s = (m - u["shoulder_left"]) @ axis
        arm = self.armness(p)
        along = (
            q[:, 1:2] * [0.0, 1.2, 0.0] + s[:, None] * [0, 0, 1.0] + q[:, :1] * [1.0, 0, 0.3]
        ) + np.sign(q[:, 1])[:, None] * [0, 0, 4.7]
        sleeve = cloth(along, (8.0, 6.0, 20.0), 1.0, self.person.seed + 20)
        near = lambda x, at, r: np.exp(-(((x - at) / r) ** 2))
        sleeve_amount = 0.002 + 0.008 * near(s, 0.30, 0.09) + 0.006 * near(s, 0.5, 0.08)
        body = cloth(q + 0.5 * m[:, 1:2] * [0, 0, 1], (6.0, 6.0, 13.0), 1.0, self.person.seed + 40)
        body_amount = 0.004 + 0.006 * near(q[:, 2], 1.02, 0.12)
        if kind == "coat":
            hang = cloth(q, (11.0, 11.0, 1.6), 1.0, self.person.seed + 60)
            body = np.where(q[:, 2] < 1.0, hang, body)
            body_amount = body_amount + 0.010 * step(1.0, 0.6, q[:, 2])
        return (d - arm * sleeve_amount * sleeve - (1 - arm) * body_amount * body) * self.scale

    def vest(self, p):
        q = p / self.scale
        m, u = mirrored(q), self.unit
        loose = {"jacket": 0.026, "hoodie": 0.029, "shirt": 0.016, "coat": 0.028}[self.person.top]
        d = self.trunk(q, loose)
        d = sdf.common(d, 0.84 - q[:, 2], 0.012)
        d = sdf.common(d, q[:, 2] - 1.515, 0.01)
        arm = u["elbow_left"] - u["shoulder_left"]
        hole = sdf.capsule(
            m,
            u["shoulder_left"] + [0, 0.045, 0.05],
            u["shoulder_left"] + 0.4 * arm + [0, 0.03, 0],
            0.086,
            0.080,
        )
        d = sdf.cut(d, hole, 0.012)
        neck = sdf.capsule(q, (0.10, 0, 1.33), (0.06, 0, 1.60), 0.012, 0.105)
        d = sdf.cut(d, neck, 0.008)
        d = sdf.cut(d, sdf.ellipsoid(q, (-0.01, 0, 1.55), (0.09, 0.085, 0.09)), 0.008)
        folds = cloth(q + 0.7 * m[:, 1:2] * [0, 0, 1], (6.0, 6.0, 11.0), 1.0, self.person.seed + 80)
        amount = 0.005 + 0.005 * np.exp(-(((q[:, 2] - 1.06) / 0.1) ** 2))
        return (d - amount * folds) * self.scale

    def arms(self, p):
        """Bare arms under short sleeves."""
        q = p / self.scale
        m, u, g = mirrored(q), self.unit, self.person.girth**0.7
        a, e, w = u["shoulder_left"], u["elbow_left"], u["wrist_left"]
        d = sdf.tube(
            m,
            [a + 0.3 * (e - a), a + 0.6 * (e - a), e, e + 0.28 * (w - e), w],
            [0.050 * g, 0.049 * g, 0.038 * g, 0.044 * g, 0.026 * g],
            0.025,
        )
        return d * self.scale

    def hands(self, p):
        q = mirrored(p / self.scale)
        u, g = self.unit, 0.92 + 0.08 * self.person.girth
        w, k = u["wrist_left"], u["knuckle_left"]
        down = (k - w) / np.linalg.norm(k - w)
        ahead = np.array([1.0, 0, 0]) - down[0] * down
        ahead /= np.linalg.norm(ahead)
        palm = np.cross(down, ahead)  # medial: towards the body for the left hand
        palm *= -np.sign(palm[1])
        at = lambda s, f, n: w + s * down + f * ahead + n * palm
        d = sdf.capsule(q, w - 0.05 * down, at(0.01, 0, 0), 0.027 * g, 0.026 * g, None)
        for f0, f1 in ((-0.026, -0.030), (-0.010, -0.011), (0.008, 0.009), (0.024, 0.028)):
            d = sdf.union(
                d,
                sdf.capsule(q, at(0.022, 0.6 * f0, 0), at(0.088, f1, 0), 0.0150 * g, 0.0115 * g),
                0.014,
            )
        d = sdf.union(d, sdf.ellipsoid(q, at(0.045, 0.018, 0.010), (0.022, 0.016, 0.028)), 0.012)
        for f, length, curl in (
            (-0.031, 0.060, 1.25),
            (-0.011, 0.078, 1.1),
            (0.009, 0.084, 1.0),
            (0.029, 0.076, 0.9),
        ):
            base, angle, points = at(0.086, f, 0.0), 0.18, []
            for share in (0.0, 0.45, 0.30, 0.25):
                base = base + share * length * (np.cos(angle) * down + np.sin(angle) * palm)
                points.append(base)
                angle += 0.42 * curl if share else 0.0
            d = sdf.union(
                d,
                sdf.tube(q, points, [0.0110 * g, 0.0098 * g, 0.0090 * g, 0.0075 * g], 0.003),
                0.006,
            )
        thumb = [
            at(0.022, 0.026, 0.010),
            at(0.052, 0.046, 0.016),
            at(0.078, 0.052, 0.022),
            at(0.102, 0.050, 0.028),
        ]
        d = sdf.union(
            d, sdf.tube(q, thumb, [0.016 * g, 0.0130 * g, 0.0108 * g, 0.0085 * g], 0.005), 0.012
        )
        return d * self.scale

    def shoes(self, p):
        q = mirrored(p / self.scale)
        u = self.unit
        heel, toe = u["ankle_left"] + [-0.055, 0, 0], u["toe_left"]
        ahead = (toe - heel) * [1, 1, 0]
        length = np.linalg.norm(ahead) + 0.056
        ahead /= np.linalg.norm(ahead)
        out = np.array([-ahead[1], ahead[0], 0.0])
        local = np.stack([(q - heel) @ ahead + 0.018, (q - heel) @ out, q[:, 2]], -1)
        x = local[:, 0]
        t = np.clip(x / length, 0.0, 1.0)
        half = np.interp(
            t,
            [0, 0.08, 0.25, 0.5, 0.72, 0.88, 0.96, 1.0],
            [0.020, 0.032, 0.035, 0.037, 0.047, 0.041, 0.026, 0.008],
        )
        bend = np.interp(t, [0, 0.4, 0.7, 1.0], [0, -0.004, -0.002, 0.006])
        top = np.interp(
            t,
            [0, 0.12, 0.3, 0.42, 0.55, 0.75, 0.92, 1.0],
            [0.095, 0.118, 0.120, 0.106, 0.078, 0.060, 0.050, 0.030],
        )
        spring = 0.010 * step(0.74, 1.0, t) ** 1.5
        side = np.abs(local[:, 1] - bend) - half * (1.0 - 0.30 * step(0.02, 0.12, local[:, 2]))
        ends = np.maximum(-x, x - length)
        sole_side = np.maximum(np.abs(local[:, 1] - bend) - half - 0.003, ends - 0.002)
        upper = sdf.common(sdf.common(side, ends, 0.03), local[:, 2] - top, 0.035)
        sole = sdf.common(sole_side, local[:, 2] - 0.026, 0.006)
        d = sdf.union(upper, sole, 0.004)
        shaft = sdf.capsule(
            q,
            u["ankle_left"] + [-0.012, 0, 0.015],
            u["ankle_left"] + [-0.016, 0, 0.075],
            0.044,
            0.047,
        )
        d = sdf.union(d, shaft, 0.02)
        under = spring + 0.006 * step(0.03, 0.0, x) ** 2 - local[:, 2]
        return sdf.common(d, under, 0.007) * self.scale

    def face_frame(self, q):
        """Points relative to the head's middle (eye height), in metres of an average head."""
        k = (1.75 / self.person.height_m) ** 0.4
        return (q - [0.0, 0.0, 1.755]) / k + [0.0, 0.0, 0.118], k

    def head(self, p):
        f, k = self.face_frame(p / self.scale)
        m, g = mirrored(f), self.person.girth**0.4
        d = sdf.ellipsoid(f, (-0.010, 0, 0.022), (0.099, 0.076 * g, 0.094))
        d = sdf.union(d, sdf.ellipsoid(f, (0.038, 0, -0.030), (0.055, 0.060 * g, 0.078)), 0.03)
        jaw = sdf.capsule(m, (-0.002, 0.050 * g, -0.058), (0.066, 0.014, -0.098), 0.022, 0.018)
        d = sdf.union(d, jaw, 0.03)
        d = sdf.union(d, sdf.ellipsoid(f, (0.078, 0, -0.098), (0.020, 0.022, 0.016)), 0.02)
        d = sdf.union(d, sdf.ellipsoid(m, (0.066, 0.040 * g, -0.030), (0.022, 0.022, 0.020)), 0.025)
        d = sdf.union(
            d, sdf.capsule(m, (0.088, 0.008, 0.020), (0.074, 0.046, 0.018), 0.009, 0.008), 0.018
        )
        d = sdf.cut(d, sdf.ellipsoid(m, (0.098, 0.033, 0.000), (0.020, 0.021, 0.013)), 0.012)
        d = sdf.union(d, sdf.ellipsoid(m, (0.073, 0.032, 0.000), (0.0135, 0.0145, 0.0125)), 0.003)
        lid = sdf.ellipsoid(m, (0.0735, 0.032, 0.004), (0.0150, 0.0160, 0.0115))
        lid = np.maximum(lid, 0.0045 - m[:, 2])
        d = sdf.union(d, lid, 0.003)
        d = sdf.union(
            d, sdf.capsule(f, (0.090, 0, 0.008), (0.114, 0, -0.032), 0.0085, 0.0115), 0.012
        )
        d = sdf.union(d, sdf.ellipsoid(m, (0.102, 0.011, -0.036), (0.012, 0.009, 0.008)), 0.006)
        d = sdf.cut(d, sdf.ellipsoid(m, (0.108, 0.0065, -0.0455), (0.006, 0.0035, 0.004)), 0.003)
        d = sdf.union(d, sdf.ellipsoid(f, (0.088, 0, -0.060), (0.016, 0.026, 0.018)), 0.014)
        d = sdf.union(
            d,
            sdf.capsule(m, (0.1035, 0.002, -0.0585), (0.094, 0.021, -0.0625), 0.0048, 0.0032),
            0.004,
        )
        d = sdf.union(
            d,
            sdf.capsule(m, (0.1015, 0.0, -0.0705), (0.092, 0.018, -0.0675), 0.0056, 0.0036),
            0.004,
        )
        d = sdf.cut(
            d, sdf.capsule(m, (0.108, 0.0, -0.0645), (0.094, 0.023, -0.0650), 0.0022, 0.0018), 0.002
        )
        ear = sdf.ellipsoid(m, (-0.010, 0.079 * g, -0.008), (0.018, 0.009, 0.032))
        bowl = sdf.ellipsoid(m, (-0.005, 0.088 * g, -0.004), (0.010, 0.006, 0.020))
        d = sdf.union(d, sdf.cut(ear, bowl, 0.004), 0.006)
        neck = sdf.capsule(f, (-0.030, 0, -0.215), (-0.012, 0, -0.045), 0.060 * g, 0.056 * g)
        d = sdf.union(d, neck, 0.022)
        return d * self.scale * k

    def hair(self, p):
        f, k = self.face_frame(p / self.scale)
        m, kind = mirrored(f), self.person.hair
        flow = strand_frame(f)
        strands = 0.0045 * (ridged(flow * (13.0, 13.0, 9.0), self.person.seed + 5) - 0.5)
        strands += 0.004 * (lattice(f * 22.0, self.person.seed + 6) - 0.5)
        under_helmet = self.person.head_wear != "none"
        rise = 0.0 if under_helmet else 0.006
        d = sdf.ellipsoid(f, (-0.016, 0, 0.028 + rise), (0.105, 0.086, 0.100 + rise)) - strands
        parting = sdf.capsule(f, (0.09, 0.030, 0.110), (-0.03, 0.026, 0.142), 0.006, 0.004)
        d = d if under_helmet else sdf.cut(d, parting, 0.006)
        ragged = 0.014 * (lattice(f * (70.0, 70.0, 20.0), self.person.seed + 8) - 0.5)
        line = 0.078 + 1.0 * (f[:, 0] - 0.085).clip(-0.3, 0) - 3.0 * m[:, 1] ** 2 * (f[:, 0] > 0.03)
        low = {"short": -0.060, "bun": -0.050, "bob": -0.125}[kind]
        d = sdf.common(d, np.maximum(line, low) + ragged - f[:, 2], 0.006)
        if kind == "bob":
            curtain = sdf.ellipsoid(f, (-0.036, 0, -0.030), (0.084, 0.095, 0.125)) - 1.6 * strands
            curtain = sdf.common(
                curtain, f[:, 0] - 0.008 - 0.5 * (f[:, 2]).clip(-0.05, 0.1) - ragged, 0.010
            )
            curtain = sdf.common(curtain, -0.125 + 2.0 * ragged - f[:, 2], 0.006)
            d = sdf.union(d, curtain, 0.012)
        if kind == "bun":
            d = sdf.union(
                d, sdf.ellipsoid(f, (-0.120, 0, 0.030), (0.038, 0.042, 0.040)) - strands, 0.008
            )
        ear = sdf.ellipsoid(m, (0.0, 0.088, -0.012), (0.026, 0.020, 0.040))
        if kind != "bob":
            d = sdf.cut(d, ear, 0.006)
        return d * self.scale * k

    def helmet(self, p):
        f, k = self.face_frame(p / self.scale)
        m = mirrored(f)
        cap = self.person.head_wear == "cap"
        size = (0.112, 0.092, 0.088) if cap else (0.130, 0.108, 0.098)
        d = sdf.ellipsoid(f, (-0.010, 0, 0.045), size)
        if not cap:
            ridge = sdf.capsule(f, (-0.110, 0, 0.075), (0.085, 0, 0.080), 0.020, 0.020)
            ridge = sdf.common(
                ridge, sdf.ellipsoid(f, (-0.010, 0, 0.047), (0.137, 0.113, 0.104)), 0.004
            )
            d = sdf.union(d, ridge, 0.006)
            for y in (0.035,):
                groove = sdf.capsule(m, (-0.10, y, 0.135), (0.07, y, 0.135), 0.010, 0.010)
                d = sdf.cut(d, groove, 0.004)
        tilt = 0.052 + 0.10 * f[:, 0]
        d = sdf.common(d, tilt - 0.004 - f[:, 2], 0.004)
        reach = 0.070 if cap else 0.038
        brim = sdf.ellipsoid(
            f * [1, 1, 0],
            (0.012 + 0.5 * reach, 0, 0),
            (0.128 + 0.5 * reach, 0.088 if cap else 0.112, 1.0),
        )
        droop = tilt - 0.25 * (f[:, 0] - 0.10).clip(0) - 2.0 * m[:, 1] ** 2 * (f[:, 0] > 0.05)
        flat = np.abs(f[:, 2] - droop) - 0.004
        if cap:
            brim = sdf.common(brim, 0.060 - f[:, 0], 0.01)
        d = sdf.union(d, sdf.common(brim, flat, 0.004), 0.006)
        return d * self.scale * k
