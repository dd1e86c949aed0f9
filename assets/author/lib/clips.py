"""The clips of a person: name -> (pose at u in 0..1, number of frames, facts for the manifest)."""

import numpy as np

from . import gait, pose as ps
from . import rig
from .figure import FPS


def walking(person, joint, style):
    """A walking clip whose duration is a whole number of frames and whose speed is kept exactly."""
    stride, duration = gait.cadence(style, person.height_m)
    frames = max(32, int(round(duration * FPS)))
    style.stride_m, style.duration_s = stride, frames / FPS
    walker = gait.Walker(person, joint, style)
    facts = {"stride_m": round(stride, 6), "speed_mps": round(stride * FPS / frames, 6)}
    return walker.pose, frames, facts


def planted(person, joint, u, crouch=0.012, sway=0.0, lean=1.0, feet=0.16):
    """A standing pose with both feet flat: the base of every clip on the spot."""
    s = person.height_m / 1.75
    p = {"pelvis": joint["pelvis"] + np.array([0.0, sway, -crouch]) * s,
         "turn": {"pelvis": ps.rx(60.0 * sway) @ ps.ry(lean)}}
    p["turn"]["chest"] = ps.rx(-20.0 * sway) @ ps.ry(lean)
    return p


def plant_feet(p, person, joint, feet=0.17):
    """Solves both legs to feet standing `feet` metres apart."""
    s = person.height_m / 1.75
    for side, sign in rig.SIDES:
        ankle = joint[f"ankle_{side}"] * [1, 0, 1] + np.array([0, sign * feet / 2 * s, 0])
        rest = np.array([-0.05 * sign, 1.0, 0.0])
        ps.two_bones(p, joint, f"thigh_{side}", f"shin_{side}", ankle, rest, rest)
        p["turn"][f"foot_{side}"] = p["turn"][f"toes_{side}"] = np.eye(3)


def standing(person, joint):
    """Breathing and shifting weight from leg to leg, 6 s."""

    def poses(u):
        w = 2 * np.pi * u
        breath = np.sin(2 * w)
        p = planted(person, joint, u, sway=0.022 * np.sin(w), lean=1.5)
        p["pelvis"] = p["pelvis"] + np.array([0.004 * np.sin(w + 1.0), 0, -0.004 * np.cos(2 * w)])
        p["turn"]["chest"] = p["turn"]["chest"] @ ps.ry(-1.1 * breath)
        p["turn"]["head"] = ps.rz(3.0 * np.sin(w + 0.5)) @ ps.ry(2.0 + np.sin(w))
        plant_feet(p, person, joint)
        for side, sign in rig.SIDES:
            gait.hang_arm(p, joint, side, sign, flex=2.0 + 1.2 * np.sin(w + sign),
                          out=9.0 + 0.8 * breath, elbow=16.0 + 2.0 * np.sin(w + 0.4 * sign))
        return p

    return poses, 6 * FPS, {}


def basic(person, joint):
    """Clips of the first figure."""
    return {"walk": walking(person, joint, gait.Gait(speed_mps=1.25)),
            "stand": standing(person, joint)}
