"""Walking in place: feet that stay where they stand, legs solved to them, published proportions.

Sources of the numbers (facts only):
- stride and cadence from speed: constant walk ratio of 6.5 mm per step/min (Sekiya and Nagasaki
  1998), scaled with stature;
- foot angle, stance share, pelvis excursion and the knee curve compared against: Winter,
  The Biomechanics and Motor Control of Human Gait; Perry, Gait Analysis;
- pelvis list and rotation, arm swing: Murray, Drought and Kory 1964; Murray, Sepic and Barnard 1967;
- walking backwards as time-reversed walking: Thorstensson 1986.

Time is in cycles: the left heel strikes at 0, the right one at 0.5. While a foot is on the floor a
point of its sole (heel edge, ball, then toe) is fixed to the floor and everything else follows from
that, so a body moved along at stride / duration has feet that do not slide.
"""

from dataclasses import dataclass

import numpy as np

from . import pose as ps
from . import rig

# Knee flexion of natural walking in degrees, every 4 % of the cycle from heel strike (Winter).
WINTER_KNEE = [
    4,
    9,
    15.5,
    20,
    21.5,
    20,
    17.5,
    14.5,
    11.5,
    9,
    7.5,
    7.5,
    10,
    15.5,
    25,
    38,
    50,
    60,
    64.5,
    63,
    56,
    44.5,
    30.5,
    16,
    4.5,
    4,
]


# Fitted to Winter's knee curve at 1.3 m/s: where in the stance the ankle passes below the hips, the
# bob of the hips in metres and its lag in cycles, and the foot's velocity at heel strike in strides
# per cycle (forward, left, up).
MIDDLE = 0.38
BOB = 0.016
BOB_LAG = 0.02
LANDING = np.array([0.10, 0.0, -0.22])


@dataclass
class Gait:
    """One walking style. Lengths in metres of a person of 1.75 m, angles in degrees."""

    speed_mps: float = 1.3
    turn_deg: float = 0.0  # yaw of the body per cycle
    step_width: float = 0.10  # between ankles
    lean: float = 3.0  # trunk forward
    arms: float = 1.0  # arm swing, 1 = Murray's mean at this speed
    crouch: float = 0.0  # metres the hips are lower
    stride_m: float = None  # from the walk ratio when None
    duration_s: float = None


def cadence(gait, height):
    """(stride in metres, duration of a cycle in seconds) from the walk ratio."""
    if gait.stride_m is not None:
        return gait.stride_m, gait.duration_s
    ratio = 0.0065 * height / 1.70
    steps_per_min = np.sqrt(60.0 * abs(gait.speed_mps) / ratio)
    duration = 120.0 / steps_per_min
    return abs(gait.speed_mps) * duration, duration


def hermite(knots, values, slopes, x):
    """Piecewise cubic through values with given slopes."""
    i = np.clip(np.searchsorted(knots, x, "right") - 1, 0, len(knots) - 2)
    h = knots[i + 1] - knots[i]
    t = (x - knots[i]) / h
    a, b, da, db = values[i], values[i + 1], slopes[i] * h, slopes[i + 1] * h
    return (
        a * (1 + 2 * t) * (1 - t) ** 2
        + da * t * (1 - t) ** 2
        + b * t * t * (3 - 2 * t)
        - db * t * t * (1 - t)
    )


def monotone(knots, values, x):
    """Cubic without overshoot through periodic knots (Fritsch and Carlson)."""
    knots, values = np.asarray(knots, float), np.asarray(values, float)
    slope = np.diff(values) / np.diff(knots)
    before, after = np.roll(slope, 1), slope
    tangent = np.where(before * after > 0, 2 * before * after / (before + after + 1e-12), 0.0)
    tangent = np.append(tangent, tangent[0])
    return hermite(knots, values, tangent, x)


class Feet:
    """Where one foot is at any time of the cycle, in the person's frame."""

    def __init__(self, gait, joint, height, side):
        self.scale = height / 1.75
        self.stride, _ = cadence(gait, height)
        v = gait.speed_mps
        self.gait, self.side, self.known = gait, side, {}
        self.sign = 1.0 if side == "left" else -1.0
        self.offset = 0.0 if side == "left" else 0.5
        self.duty = float(np.interp(v, [0.1, 0.6, 1.3, 2.0], [0.70, 0.665, 0.62, 0.585]))
        self.middle = MIDDLE * self.duty  # the ankle passes below the hips
        self.strength = float(
            np.interp(
                self.stride / self.scale, [0.0, 0.3, 1.0, 1.45, 1.8], [0.10, 0.32, 0.80, 1.0, 1.12]
            )
        )
        self.ankle = joint[f"ankle_{side}"]
        self.ball = joint[f"ball_{side}"]
        self.ahead = ps.unit((joint[f"toe_{side}"] - self.ball) * [1, 1, 0])
        self.across = np.cross([0, 0, 1.0], self.ahead)
        s = self.scale
        under = self.ankle * [1, 1, 0]
        self.heel = under + self.ahead * (-0.050 * s)
        self.tip = self.ball * [1, 1, 0] + self.ahead * 0.088 * s
        self.nose = self.ball * [1, 1, 0] + self.ahead * 0.118 * s + [0, 0, 0.010 * s]
        self.home = np.array([self.ankle[0], self.sign * gait.step_width / 2 * s, 0.0]) - under
        self.landing = LANDING * self.stride
        self.clearance = 0.0
        for _ in range(0 if gait.turn_deg else 8):
            swing = np.linspace(self.duty + 0.01, 0.93, 40)
            short = max(self.wanted(t) * s - self.lowest(t) for t in swing)
            if short <= 0:
                break
            self.clearance += 1.5 * short + 0.001

    def pitch(self, tau):
        """Foot angle, positive heel up, at tau in [0, 1) since heel strike."""
        if tau not in self.known:
            self.known[tau] = self.angle(tau)
        return self.known[tau]

    def angle(self, tau):
        """pitch(), computed."""
        d, k = self.duty, self.strength
        h = 1 - d
        knots = [
            0,
            0.115 * d,
            0.61 * d,
            0.82 * d,
            0.97 * d,
            d + 0.09 * h,
            d + 0.37 * h,
            d + 0.66 * h,
            1 - 0.13 * h,
            1,
        ]
        angle = [-20, 0, 0, 15, 50, 62, 38, 0, -19, -20]
        return monotone(knots, np.array(angle) * k, np.asarray(tau))

    def toe_bend(self, tau):
        """Toes against the foot, positive bent up."""
        return 36 * np.tanh(np.clip(self.pitch(tau), 0, None) / 36)

    def body(self, u):
        """The person's ground frame at time u: (position, yaw in degrees)."""
        turn = self.gait.turn_deg * u
        return np.array([self.stride * u, 0.0, 0.0]), turn

    def stance(self, tau, u0):
        """(ankle, yaw) in the world while standing; the stride began at u0."""
        at, yaw = self.body(u0 + self.middle)
        base, r = at, ps.rz(yaw)
        phi, bend = float(self.pitch(tau)), float(self.toe_bend(tau))
        roll = ps.about(self.across, phi)
        if phi <= 0:
            local = self.heel + roll @ (self.ankle - self.heel)
        else:
            toe_roll = ps.about(self.across, phi - bend)
            ball = self.tip + toe_roll @ (self.ball - self.tip)
            local = ball + roll @ (self.ankle - self.ball)
        return base + r @ (local + self.home), yaw

    def world(self, u):
        """(ankle, yaw, pitch, toe bend) of the foot in the world at time u."""
        k = np.floor(u - self.offset)
        tau, u0 = u - self.offset - k, k + self.offset
        phi, bend = float(self.pitch(tau)), float(self.toe_bend(tau))
        if tau <= self.duty:
            at, yaw = self.stance(tau, u0)
            return at, yaw, phi, bend
        d, e = self.duty, 1e-4
        a0, yaw0 = self.stance(d, u0)
        a1, yaw1 = self.stance(0.0, u0 + 1)
        va = (a0 - self.stance(d - e, u0)[0]) / e
        vb = (self.stance(e, u0 + 1)[0] - a1) / e + self.landing
        t = (tau - d) / (1 - d)
        if self.gait.turn_deg:
            x = np.clip((t - 0.14) / 0.72, 0, 1)
            ease = x * x * (3 - 2 * x)
            lift = np.array([0, 0, 0.07 * self.scale * 4 * t * (1 - t)])
            return a0 + (a1 - a0) * ease + lift, yaw0 + (yaw1 - yaw0) * ease, phi, bend
        h = 1 - d
        at = (
            a0 * (1 + 2 * t) * (1 - t) ** 2
            + va * h * t * (1 - t) ** 2
            + a1 * t * t * (3 - 2 * t)
            - vb * h * t * t * (1 - t)
        )
        at = at + np.array([0, 0, self.clearance * 12.2 * t * (1 - t) ** 4])
        ease = t * t * (3 - 2 * t)
        return at, yaw0 + (yaw1 - yaw0) * ease, phi, bend

    def local(self, u):
        """(ankle, foot rotation, toe rotation) in the person's frame at time u."""
        at, yaw, phi, bend = self.world(u)
        origin, turn = self.body(u)
        back = ps.rz(-turn)
        foot = ps.rz(yaw - turn) @ ps.about(self.across, phi)
        toes = ps.rz(yaw - turn) @ ps.about(self.across, phi - bend)
        return back @ (at - origin), foot, toes

    def wanted(self, tau):
        """Height the sole should have while it swings."""
        return min(0.014, 0.20 * (tau - self.duty), 0.45 * (1 - tau))

    def lowest(self, tau):
        """Lowest sole point at tau."""
        at, foot, toes = self.local(tau + self.offset)
        ball = at + foot @ (self.ball - self.ankle)
        points = [
            at + foot @ (self.heel - self.ankle),
            ball + toes @ (self.tip - self.ball),
            ball + toes @ (self.nose - self.ball),
            at + foot @ (self.ball * [1, 1, 0] - self.ankle),
        ]
        return min(p[2] for p in points)


def hips(gait, stride, u):
    """Pelvis sway (y), bob (z) and rotation at time u, per metre of stride where it grows with it."""
    k = stride / 1.42
    w = 2 * np.pi
    sway = 0.020 * np.sin(w * (u - 0.05))
    bob = BOB * min(k, 1.25) ** 1.5 * -np.cos(2 * w * (u - BOB_LAG))
    yaw = -4.5 * min(k, 1.3) * np.cos(w * u)
    roll = 3.5 * min(k, 1.2) * np.cos(w * (u - 0.14))
    tilt = gait.lean * 0.4 + 1.0 * k * np.sin(2 * w * (u - 0.1))
    return sway, bob, ps.rz(yaw) @ ps.rx(roll) @ ps.ry(tilt)


class Walker:
    """Poses of a person walking with one gait."""

    def __init__(self, person, joint, gait):
        self.person, self.joint, self.gait = person, joint, gait
        self.scale = person.height_m / 1.75
        self.stride, self.duration = cadence(gait, person.height_m)
        self.feet = {s: Feet(gait, joint, person.height_m, s) for s, _ in rig.SIDES}
        self.height = self.settle()

    def settle(self):
        """Highest hips at which both legs reach the floor with knees a little bent."""
        leg = np.linalg.norm(self.joint["knee_left"] - self.joint["hip_left"]) + np.linalg.norm(
            self.joint["ankle_left"] - self.joint["knee_left"]
        )
        low, high = 0.75 * self.scale, 1.0 * self.scale
        times = np.linspace(0, 1, 40, endpoint=False)
        ankles = {s: [self.feet[s].local(u)[0] for u in times] for s, _ in rig.SIDES}
        for _ in range(14):
            z = 0.5 * (low + high)
            far = 0.0
            for i, u in enumerate(times):
                p = self.base(u, z)
                for side, _ in rig.SIDES:
                    hip = ps.joint_at(p, self.joint, f"hip_{side}", "pelvis")
                    far = max(far, np.linalg.norm(ankles[side][i] - hip))
            low, high = (z, high) if far < 0.9982 * leg else (low, z)
        return low - self.gait.crouch * self.scale

    def base(self, u, height):
        sway, bob, turn = hips(self.gait, self.stride / self.scale, u)
        at = np.array([self.joint["pelvis"][0], sway * self.scale, height + bob * self.scale])
        return {"pelvis": at, "turn": {"pelvis": turn}}

    def legs(self, p, u):
        """Sets both legs to their feet; returns knee flexion by side."""
        bend = {}
        for side, sign in rig.SIDES:
            ankle, foot, toes = self.feet[side].local(u)
            rest = np.array([1.0, 0.05 * sign, 0.0])
            flat = (foot @ self.feet[side].across)[[1, 0, 2]] * [1, -1, 0]
            knee = p["turn"]["pelvis"] @ rest + flat
            bend[side] = ps.two_bones(
                p, self.joint, f"thigh_{side}", f"shin_{side}", ankle, knee, rest
            )
            p["turn"][f"foot_{side}"] = foot
            p["turn"][f"toes_{side}"] = toes
        return bend

    def trunk(self, p, u):
        """Trunk against the pelvis, head steady."""
        k, w = self.stride / self.scale / 1.42, 2 * np.pi
        yaw, lean = 4.0 * min(k, 1.3) * np.cos(w * u), self.gait.lean
        roll = -1.0 * k * np.cos(w * (u - 0.14))
        pelvis = p["turn"]["pelvis"]
        chest = ps.rz(yaw) @ ps.rx(roll) @ ps.ry(lean)
        p["turn"]["spine"] = ps.unit_mean(pelvis, chest)
        p["turn"]["chest"] = chest
        p["turn"]["head"] = ps.rz(0.15 * yaw) @ ps.ry(1.0 + 0.8 * k * np.cos(2 * w * (u - 0.3)))
        p["turn"]["neck"] = ps.unit_mean(chest, p["turn"]["head"])

    def swing_arms(self, p, u):
        """Arms against the legs: shoulder -20..15 degrees, elbow 12..38 at natural speed."""
        k = min(self.stride / self.scale / 1.42, 1.35) * self.gait.arms
        for side, sign in rig.SIDES:
            beat = np.cos(2 * np.pi * (u - (0.0 if side == "left" else 0.5) - 0.02))
            late = np.cos(2 * np.pi * (u - (0.0 if side == "left" else 0.5) - 0.06))
            hang_arm(
                p,
                self.joint,
                side,
                sign,
                flex=-1.0 - 19.0 * k * beat,
                out=9.0,
                elbow=14.0 + 7.0 * k - 10.0 * k * late,
            )

    def pose(self, u):
        p = self.base(u, self.height)
        self.legs(p, u)
        self.trunk(p, u)
        self.swing_arms(p, u)
        return p


def hang_arm(p, joint, side, sign, flex, out, elbow, twist=0.0):
    """Arm by angles: forward, off the body, bent at the elbow (degrees)."""
    _, chest = ps.place(p, joint, "chest")
    p["turn"][f"clavicle_{side}"] = chest
    rest = np.degrees(rig.ARM_ANGLE)
    upper = (
        chest
        @ ps.ry(-flex)
        @ ps.rx(-sign * (rest - out))
        @ ps.about(joint[f"elbow_{side}"] - joint[f"shoulder_{side}"], sign * twist)
    )
    p["turn"][f"upper_arm_{side}"] = upper
    direction = ps.unit(joint[f"elbow_{side}"] - joint[f"shoulder_{side}"])
    p["turn"][f"forearm_{side}"] = upper @ ps.about(np.cross(direction, [1, 0, 0]), elbow - 8.0)
    p["turn"][f"fingers_{side}"] = p["turn"][f"forearm_{side}"] @ ps.rx(-sign * 18.0)


def reach_arm(p, joint, side, sign, wrist, elbow=(-0.55, 0.45, -0.8), curl=35.0, palm=0.0):
    """Arm by inverse kinematics to a wrist position; elbow is where the elbow points (left arm)."""
    _, chest = ps.place(p, joint, "chest")
    p["turn"][f"clavicle_{side}"] = chest
    toward = np.array(elbow, float) * [1, sign, 1]
    ps.two_bones(
        p,
        joint,
        f"upper_arm_{side}",
        f"forearm_{side}",
        np.asarray(wrist, float),
        toward,
        np.array([-1.0, 0, 0]),
    )
    along = ps.unit(joint[f"knuckle_{side}"] - joint[f"wrist_{side}"])
    hand = p["turn"][f"forearm_{side}"] @ ps.about(along, sign * palm)
    p["turn"][f"hand_{side}"] = hand
    p["turn"][f"fingers_{side}"] = hand @ ps.rx(-sign * curl)
