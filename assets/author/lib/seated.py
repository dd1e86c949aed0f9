"""A driver on a seat with both hands on the wheel."""

import numpy as np

from . import figure, gait, pose as ps, rig


def add(m, node, person, seat, wheel, floor):
    """Puts person on the seat (middle of its base) of machine m; feet on a floor at that height."""
    m.adopt(figure.still(person, lambda joint: shape(joint, seat, wheel, floor), m.folder), node)


def shape(joint, seat, wheel, floor):
    """The pose: pelvis on the cushion, trunk leaning a little, limbs solved to pedals and wheel."""
    at = np.array(seat) + [-0.075, 0.0, 0.285]
    p = {"pelvis": at, "turn": {"pelvis": ps.ry(-16), "spine": ps.ry(-2), "chest": ps.ry(8)}}
    p["turn"]["head"] = ps.rz(6) @ ps.ry(5)
    p["turn"]["neck"] = ps.ry(6)
    for side, sign in rig.SIDES:
        foot = ps.rz(6 * sign) @ ps.ry(-14 if side == "right" else -6)
        ankle = np.array([seat[0] + 0.56, sign * 0.13, floor + 0.098])
        toward = np.array([0.5, 0.16 * sign, 1.0])
        ps.two_bones(
            p,
            joint,
            f"thigh_{side}",
            f"shin_{side}",
            ankle,
            toward,
            np.array([1.0, 0.05 * sign, 0]),
        )
        p["turn"][f"foot_{side}"] = p["turn"][f"toes_{side}"] = foot
        wrist = np.array(wheel) + [-0.085, sign * 0.165, 0.025]
        gait.reach_arm(p, joint, side, sign, wrist, (-0.3, 0.6, -0.8), curl=75.0, palm=35.0)
    return p
