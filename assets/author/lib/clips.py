"""The clips of a person: name -> (pose at u in 0..1, number of frames, facts for the manifest)."""

import numpy as np

from . import gait, pose as ps, rig
from .figure import FPS


def gaze(p, yaw=0.0, down=0.0):
    """Turns both eyes away from straight ahead of the head, in degrees to the left and down."""
    head = p["turn"].get("head", p["turn"].get("neck", p["turn"].get("chest", np.eye(3))))
    for side, _ in rig.SIDES:
        p["turn"][f"eye_{side}"] = head @ ps.rz(yaw) @ ps.ry(down)


def walking(person, joint, style):
    """A walking clip whose duration is a whole number of frames and whose speed is kept exactly."""
    stride, duration = gait.cadence(style, person.height_m)
    frames = max(32, int(round(duration * FPS)))
    style.stride_m, style.duration_s = stride, frames / FPS
    walker = gait.Walker(person, joint, style)
    facts = {"stride_m": round(stride, 6), "speed_mps": round(stride * FPS / frames, 6)}

    def poses(u):  # the floor some ten metres ahead
        p = walker.pose(u)
        gaze(p, down=6.0)
        return p

    return poses, frames, facts


def planted(person, joint, crouch=0.004, sway=0.0, lean=1.0):
    """A standing pose with both feet flat: the base of every clip on the spot."""
    s = person.height_m / 1.75
    p = {
        "pelvis": joint["pelvis"] + np.array([0.0, sway, -crouch]) * s,
        "turn": {"pelvis": ps.rx(60.0 * sway) @ ps.ry(lean)},
    }
    p["turn"]["chest"] = ps.rx(-20.0 * sway) @ ps.ry(lean)
    return p


def plant_feet(p, person, joint, feet=0.19):
    """Solves both legs to feet standing `feet` metres apart."""
    s = person.height_m / 1.75
    for side, sign in rig.SIDES:
        ankle = joint[f"ankle_{side}"] * [1, 0, 1] + np.array([0, sign * feet / 2 * s, 0])
        knee = np.array([1.0, 0.05 * sign, 0.0])
        ps.two_bones(p, joint, f"thigh_{side}", f"shin_{side}", ankle, knee, knee)
        p["turn"][f"foot_{side}"] = p["turn"][f"toes_{side}"] = np.eye(3)


def standing(person, joint):
    """Breathing and shifting weight from leg to leg, 6 s."""

    def poses(u):
        w = 2 * np.pi * u
        breath = np.sin(2 * w)
        p = planted(person, joint, sway=0.022 * np.sin(w), lean=1.5)
        p["pelvis"] = p["pelvis"] + np.array([0.004 * np.sin(w + 1.0), 0, -0.004 * np.cos(2 * w)])
        p["turn"]["chest"] = p["turn"]["chest"] @ ps.ry(-1.1 * breath)
        p["turn"]["head"] = ps.rz(3.0 * np.sin(w + 0.5)) @ ps.ry(2.0 + np.sin(w))
        gaze(p, 5.0 * np.sin(2 * w + 1.0), 2.0)
        plant_feet(p, person, joint)
        for side, sign in rig.SIDES:
            gait.hang_arm(
                p,
                joint,
                side,
                sign,
                flex=2.0 + 1.2 * np.sin(w + sign),
                out=9.0 + 0.8 * breath,
                elbow=16.0 + 2.0 * np.sin(w + 0.4 * sign),
            )
        return p

    return poses, 6 * FPS, {}


def backwards(person, joint):
    """Walking backwards: the walk at 0.7 m/s with time reversed."""
    poses, frames, facts = walking(person, joint, gait.Gait(speed_mps=0.7, lean=1.0, arms=0.7))
    facts = {k: -v for k, v in facts.items()}
    return lambda u: poses(1.0 - u), frames, facts


def turning(person, joint, degrees):
    """Turning on the spot by two steps a cycle."""
    style = gait.Gait(
        speed_mps=0.0,
        turn_deg=degrees,
        stride_m=0.0,
        duration_s=1.3,
        step_width=0.15,
        arms=0.0,
        lean=1.5,
    )
    walker = gait.Walker(person, joint, style)
    ahead = np.sign(degrees)

    def poses(u):
        p = walker.base(u, walker.height)
        walker.legs(p, u)
        walker.trunk(p, u)
        p["turn"]["head"] = p["turn"]["chest"] @ ps.rz(18.0 * ahead)
        p["turn"]["neck"] = ps.unit_mean(p["turn"]["chest"], p["turn"]["head"])
        gaze(p, 14.0 * ahead, 4.0)
        for side, sign in rig.SIDES:
            gait.hang_arm(p, joint, side, sign, 3.0 + 4.0 * np.sin(2 * np.pi * u), 11.0, 20.0)
        return p

    return poses, int(1.3 * FPS), {"turn_deg": float(degrees)}


def carrying(person, joint, style):
    """Walking with both forearms under a box held before the belly."""
    poses, frames, facts = walking(person, joint, style)
    s = person.height_m / 1.75

    def carry(u):
        p = poses(u)
        hold_box(p, joint, s)
        return p

    facts["box"] = {
        "size_m": [0.30, 0.40, 0.28],
        "centre_m": [round(0.37 * s, 3), 0.0, round(1.09 * s, 3)],
    }
    return carry, frames, facts


def hold_box(p, joint, s):
    """Hands at the lower sides of a box that moves with the chest."""
    at, chest = ps.place(p, joint, "chest")
    for side, sign in rig.SIDES:
        wrist = at + chest @ (np.array([0.30, sign * 0.215, -0.225]) * s)
        gait.reach_arm(p, joint, side, sign, wrist, (-0.8, 0.35, -0.6), curl=50.0)


def pushing(person, joint, style):
    """Walking behind a handle bar 1.0 m high; the hands keep still in the moving frame."""
    poses, frames, facts = walking(person, joint, style)
    s = person.height_m / 1.75
    centre = np.array([0.44 * s, 0.0, 1.06])

    def push(u):
        p = poses(u)
        for side, sign in rig.SIDES:
            gait.reach_arm(
                p, joint, side, sign, centre + [0, sign * 0.17, 0], (-0.5, 0.7, -0.7), 70.0, 50.0
            )
        return p

    facts["handle_m"] = [round(0.44 * s + 0.09, 3), 0.0, 1.05]
    return push, frames, facts


def ease(u, knots, values):
    """Values held and passed smoothly between knots."""
    i = int(np.clip(np.searchsorted(knots, u, "right") - 1, 0, len(knots) - 2))
    t = (u - knots[i]) / (knots[i + 1] - knots[i])
    t = t * t * t * (t * (6 * t - 15) + 10)
    return np.asarray(values[i]) * (1 - t) + np.asarray(values[i + 1]) * t


def picking(person, joint):
    """Takes a box from a low shelf in front, lifts it, looks at it, puts it back: 6 s."""
    s = person.height_m / 1.75
    knots = [0.0, 0.22, 0.32, 0.52, 0.68, 0.85, 1.0]
    bend = [8, 52, 52, 6, 6, 50, 8]
    drop = [0.02, 0.20, 0.20, 0.02, 0.02, 0.19, 0.02]
    hand = [
        (0.16, 0.24, 0.86),
        (0.60, 0.17, 0.62),
        (0.60, 0.16, 0.62),
        (0.36, 0.16, 1.12),
        (0.38, 0.16, 1.20),
        (0.60, 0.17, 0.64),
        (0.16, 0.24, 0.86),
    ]
    look = [10, 35, 38, 22, 28, 36, 10]

    def poses(u):
        b, d = float(ease(u, knots, bend)), float(ease(u, knots, drop))
        p = {
            "pelvis": joint["pelvis"] + np.array([-0.0022 * b, 0, -d]) * s,
            "turn": {"pelvis": ps.ry(0.55 * b), "spine": ps.ry(0.8 * b), "chest": ps.ry(b)},
        }
        p["turn"]["head"] = ps.ry(float(ease(u, knots, look)))
        p["turn"]["neck"] = ps.unit_mean(p["turn"]["chest"], p["turn"]["head"])
        gaze(p, down=22.0)
        plant_feet(p, person, joint, 0.26)
        for side, sign in rig.SIDES:
            wrist = ease(u, knots, hand) * [1, sign, 1] * s
            gait.reach_arm(p, joint, side, sign, wrist, (-0.7, 0.5, -0.4), 35.0)
        return p

    return poses, 6 * FPS, {}


def waving(person, joint):
    """Only the right arm moves: two waves in 1.6 s, everything else stands still."""
    s = person.height_m / 1.75

    def poses(u):
        p = planted(person, joint, lean=1.0)
        p["turn"]["head"] = ps.ry(1.0)
        plant_feet(p, person, joint)
        gait.hang_arm(p, joint, "left", 1.0, 2.0, 9.0, 16.0)
        swing = np.sin(4 * np.pi * u)
        wrist = np.array([0.20, -0.36 - 0.13 * swing, 1.72 - 0.03 * swing**2]) * s
        gait.reach_arm(p, joint, "right", -1.0, wrist, (0.1, 0.75, -0.75), 8.0, 90.0)
        return p

    return poses, int(1.6 * FPS), {}


def looking(person, joint):
    """Looks left and right with head, trunk and a little weight shift: 6 s."""
    knots = [0.0, 0.18, 0.36, 0.56, 0.76, 1.0]
    angle = [0, 58, 52, -60, -50, 0]

    def poses(u):
        a = float(ease(u, knots, angle))
        p = planted(person, joint, sway=0.010 * np.sin(2 * np.pi * u), lean=1.5)
        p["turn"]["pelvis"] = p["turn"]["pelvis"] @ ps.rz(0.04 * a)
        p["turn"]["chest"] = p["turn"]["chest"] @ ps.rz(0.22 * a)
        p["turn"]["head"] = ps.rz(a) @ ps.ry(3.0 + 4.0 * np.sin(6 * np.pi * u))
        p["turn"]["neck"] = ps.unit_mean(p["turn"]["chest"], p["turn"]["head"])
        gaze(p, np.clip(1.5 * (float(ease((u + 0.03) % 1.0, knots, angle)) - a), -28, 28), 2.0)
        plant_feet(p, person, joint)
        for side, sign in rig.SIDES:
            gait.hang_arm(p, joint, side, sign, 3.0 + 0.05 * sign * a, 9.0, 18.0)
        return p

    return poses, 6 * FPS, {}


def standing_with_box(person, joint):
    """The stand clip with a box in the arms."""
    poses, frames, facts = standing(person, joint)
    s = person.height_m / 1.75

    def carry(u):
        p = poses(u)
        hold_box(p, joint, s)
        return p

    return carry, frames, facts


def everything(person, joint):
    """All clips of a person."""
    walk = lambda v, **more: walking(person, joint, gait.Gait(speed_mps=v, **more))
    return {
        "stand": standing(person, joint),
        "walk_creep": walk(0.2, lean=1.5),
        "walk_slow": walk(0.6, lean=2.0),
        "walk": walk(1.25),
        "walk_fast": walk(2.0, lean=5.5),
        "walk_backwards": backwards(person, joint),
        "turn_left": turning(person, joint, 90.0),
        "turn_right": turning(person, joint, -90.0),
        "wave": waving(person, joint),
        "look_around": looking(person, joint),
        "pick": picking(person, joint),
        "stand_carry": standing_with_box(person, joint),
        "walk_carry": carrying(person, joint, gait.Gait(speed_mps=1.0, lean=-3.0)),
        "walk_push": pushing(person, joint, gait.Gait(speed_mps=0.9, lean=9.0)),
    }
