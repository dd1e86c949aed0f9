"""A person's description, and the bare body as signed distance fields.

All fields take and give metres of a person 1.75 m tall; figure.py scales them to the stature.
"""

from dataclasses import dataclass, field

import numpy as np

from . import rig, sdf
from .noise import step


@dataclass
class Face:
    """Deviations from an average face, as factors or metres."""

    length: float = 1.0  # of the lower face
    jaw: float = 1.0  # breadth at the jaw's angle
    chin: float = 0.0  # metres the chin stands out
    cheeks: float = 1.0  # breadth of the cheekbones
    full: float = 0.0  # metres of flesh over cheeks and jaw
    nose_length: float = 1.0
    nose_width: float = 1.0
    nose_bridge: float = 0.0  # metres the bridge stands out
    brow: float = 1.0  # strength of the brow ridge
    lips: float = 1.0  # fullness
    mouth: float = 1.0  # width
    eyes: float = 1.0  # opening
    apart: float = 1.0  # distance between the eyes
    ears: float = 1.0
    skull: float = 1.0  # depth of the skull from front to back


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
    muscle: float = 1.0  # relief of bare limbs
    age: float = 0.3  # 0: twenty years, 1: seventy
    face: Face = field(default_factory=Face)
    top: str = "jacket"  # a garment of garments.TOPS
    bottom: str = "work"  # work, jeans or chinos
    vest: bool = True
    head_wear: str = "helmet"  # helmet, cap, beanie or none
    hair: str = "short"  # a cut of hair.CUTS, or bald
    beard: str = ""  # "", stubble, full or moustache
    glasses: bool = False
    shoes: str = "boots"  # boots, trainers or leather
    skin: tuple = (0.80, 0.61, 0.51)
    eye_colour: tuple = (0.30, 0.20, 0.12)
    hair_colour: tuple = (0.20, 0.13, 0.08)
    top_colour: tuple = (0.13, 0.17, 0.27)
    trouser_colour: tuple = (0.30, 0.31, 0.33)
    vest_colour: tuple = (0.80, 0.86, 0.16)
    helmet_colour: tuple = (0.93, 0.90, 0.82)
    shoe_colour: tuple = (0.16, 0.12, 0.09)
    plain: bool = False  # no stripes, pockets or print: hard for feature detectors

    def __post_init__(self):
        if self.beard is True or self.beard is False:
            self.beard = "full" if self.beard else ""

    @property
    def female(self):
        return self.bust > 0


def mirrored(q):
    """Folds the right half of space onto the left."""
    return np.stack([q[:, 0], np.abs(q[:, 1]), q[:, 2]], -1)


def near(x, at, width):
    """A smooth bump of height 1 at `at`."""
    return np.exp(-(((x - at) / width) ** 2))


class Shapes:
    """The bare body of one person; every method maps points to distance."""

    def __init__(self, person):
        self.person = person
        self.scale = person.height_m / 1.75
        self.joint = rig.joints(person)
        self.unit = {k: v / self.scale for k, v in self.joint.items()}

    def rows(self):
        """(z, x of centre, half width, depth forward, depth back) from crotch to neck."""
        c, g = self.person, self.person.girth
        w, b, u = c.shoulders, c.belly, c.bust
        waist = 0.93 if c.female else 1.0
        rows = np.array(
            [
                (0.79, -0.010, 0.140 * c.hips, 0.078, 0.090),
                (0.87, -0.010, 0.168 * c.hips, 0.096, 0.120),
                (0.95, -0.008, 0.168 * c.hips, 0.102 + 0.5 * b, 0.112),
                (1.03, -0.004, 0.152 * (c.hips + g * waist) / 2, 0.102 + b, 0.092),
                (1.11, -0.004, 0.142 * g * waist, 0.102 + b, 0.083),
                (1.20, -0.006, 0.149 * g, 0.108 + 0.7 * b, 0.090),
                (1.28, -0.010, 0.162 * (g + w) / 2, 0.114 + 0.2 * b + u, 0.102),
                (1.35, -0.014, 0.170 * w, 0.106 + 0.5 * u, 0.106),
                (1.41, -0.018, 0.160 * w, 0.088, 0.100),
                (1.455, -0.020, 0.120 * w, 0.070, 0.082),
                (1.490, -0.020, 0.072, 0.060, 0.064),
                (1.53, -0.018, 0.056, 0.054, 0.055),
            ]
        )
        rows[:, 2:] *= np.where(rows[:, :1] < 1.4, g**0.5, 1.0)
        return rows

    def trunk(self, q, grow=0.0, low=None):
        """The torso; with `low` it goes on below the hips as a skirt down to that height."""
        rows = self.rows()
        if low is not None:
            hip = rows[2, 2:] * [1.0, 1.0, 1.0] + [0.006, 0.012, 0.012]
            flare = lambda z: (z, -0.008, hip[0] + 0.10 * (0.9 - z), hip[1] + 0.12 * (0.9 - z), hip[2] + 0.10 * (0.9 - z))
            rows = np.concatenate([[flare(low), flare(0.70), flare(0.86)], rows[2:]])
        rows[:, 2:] += grow
        return sdf.loft(q, rows, 2.25)

    def arm_line(self):
        """Shoulder, elbow and wrist of the left arm."""
        return [self.unit[k] for k in ("shoulder_left", "elbow_left", "wrist_left")]

    def arms(self, q):
        """Both arms with deltoid, biceps, triceps and the forearm's bellies."""
        m, (a, e, w) = mirrored(q), self.arm_line()
        g, r = self.person.girth**0.7, self.person.muscle
        at = lambda s, x=0.0, y=0.0: a + s * (e - a) + [x, y, 0]
        low = lambda s, x=0.0, y=0.0: e + s * (w - e) + [x, y, 0]
        d = sdf.tube(
            m,
            [at(-0.05, 0, -0.012), at(0.3), at(0.62), at(1.0), low(0.45), low(1.0)],
            np.array([0.049, 0.0445, 0.0425, 0.0375, 0.0345, 0.0255]) * g,
            0.03,
        )
        swell = 0.010 * r
        d = sdf.union(d, sdf.capsule(m, at(0.02, 0, 0.012), at(0.32, 0, 0.010), 0.040 * g, 0.026 * g + swell), 0.03)
        d = sdf.union(d, sdf.capsule(m, at(0.38, 0.014), at(0.78, 0.012), 0.026 * g + swell, 0.026 * g), 0.03)
        d = sdf.union(d, sdf.capsule(m, at(0.35, -0.016), at(0.70, -0.010), 0.025 * g + swell, 0.022 * g), 0.03)
        d = sdf.union(d, sdf.capsule(m, low(0.06, 0.006, 0.012), low(0.36, 0.002, 0.006), 0.026 * g + swell, 0.022 * g), 0.025)
        d = sdf.union(d, sdf.capsule(m, low(0.04, -0.006, -0.012), low(0.34, -0.002, -0.006), 0.024 * g + swell, 0.020 * g), 0.025)
        return sdf.union(d, sdf.ellipsoid(m, e + [-0.022, 0, -0.004], (0.016, 0.018, 0.020)), 0.018)

    def legs(self, q):
        m, u, g = mirrored(q), self.unit, self.person.girth**0.6
        hip, knee, ankle = u["hip_left"], u["knee_left"], u["ankle_left"]
        points = [
            hip + [0.0, -0.004, -0.04],
            hip + 0.45 * (knee - hip),
            knee + [0.006, 0, 0.02],
            knee + 0.30 * (ankle - knee) + [-0.016, 0, 0],
            ankle + [-0.004, 0, 0.05],
            ankle,
        ]
        radii = np.array([0.086, 0.074, 0.056, 0.056, 0.040, 0.039]) * g
        return sdf.tube(m, points, radii, 0.04, squash=(1.06, 0.97, 1.0))

    def bare(self, q):
        """Trunk, neck, arms and legs together: what cloth lies on."""
        m, u = mirrored(q), self.unit
        trapezius = sdf.capsule(
            m, (-0.024, 0.010, 1.500), u["shoulder_left"] + [-0.006, -0.030, 0.014], 0.050, 0.034
        )
        d = sdf.union(self.trunk(q), trapezius, 0.035)
        d = sdf.union(d, self.arms(q), 0.035)
        d = sdf.union(d, self.legs(q), 0.035)
        return d

    def armness(self, q):
        """1 on the arm, 0 on the trunk: which of the two surfaces is nearer."""
        return step(-0.02, 0.03, self.trunk(q) - self.arms(q))

    def hands(self, q):
        q = mirrored(q)
        u, g = self.unit, (0.90 if self.person.female else 0.97) * (0.9 + 0.1 * self.person.girth)
        w, k = u["wrist_left"], u["knuckle_left"]
        down = (k - w) / np.linalg.norm(k - w)
        ahead = np.array([1.0, 0, 0]) - down[0] * down
        ahead /= np.linalg.norm(ahead)
        palm = np.cross(down, ahead)  # medial: towards the body for the left hand
        palm *= -np.sign(palm[1])
        at = lambda s, f, n: w + s * down + f * ahead + n * palm
        d = sdf.capsule(q, w - 0.06 * down, at(0.01, 0, 0), 0.0255 * g, 0.0250 * g)
        for f0, f1 in ((-0.024, -0.030), (-0.009, -0.011), (0.008, 0.009), (0.022, 0.028)):
            d = sdf.union(
                d, sdf.capsule(q, at(0.020, 0.6 * f0, 0), at(0.086, f1, -0.002), 0.0140 * g, 0.0110 * g), 0.010
            )
        d = sdf.union(d, sdf.ellipsoid(q, at(0.045, 0.018, 0.011), (0.022, 0.016, 0.028)), 0.012)
        d = sdf.union(d, sdf.ellipsoid(q, at(0.055, -0.022, 0.010), (0.014, 0.013, 0.030)), 0.012)
        for f, length, curl in (
            (-0.031, 0.060, 1.35),
            (-0.011, 0.077, 1.15),
            (0.009, 0.084, 1.0),
            (0.029, 0.076, 0.85),
        ):
            base, angle, points = at(0.086, f, -0.002), 0.16, []
            for share in (0.0, 0.45, 0.30, 0.25):
                base = base + share * length * (np.cos(angle) * down + np.sin(angle) * palm)
                points.append(base)
                angle += 0.42 * curl if share else 0.0
            finger = sdf.tube(q, points, np.array([0.0104, 0.0088, 0.0082, 0.0068]) * g, 0.0015)
            for p, r in ((points[0], 0.0112), (points[1], 0.0094), (points[2], 0.0085)):
                finger = sdf.union(finger, sdf.ellipsoid(q, p - 0.0008 * palm, np.full(3, r * g)), 0.003)
            d = sdf.union(d, finger, 0.0035)
        thumb = [at(0.022, 0.026, 0.010), at(0.052, 0.044, 0.016), at(0.078, 0.050, 0.022), at(0.100, 0.049, 0.028)]
        return sdf.union(d, sdf.tube(q, thumb, np.array([0.015, 0.0120, 0.0104, 0.0082]) * g, 0.004), 0.010)
