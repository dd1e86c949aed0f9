"""An operator who stands at controls, both hands on them."""

import numpy as np

from . import figure, gait, pose as ps, rig


def add(m, node, person, feet, hands):
    """Puts person on a platform of machine m: feet (between the heels) and hands (middle of the grips)."""
    m.adopt(figure.still(person, lambda joint: shape(joint, feet, hands), m.folder), node)


def shape(joint, feet, hands):
    feet, hands = np.array(feet), np.array(hands)
    p = {"pelvis": feet + [0.02, 0.0, joint["pelvis"][2] - 0.015], "turn": {"pelvis": ps.ry(3), "spine": ps.ry(5), "chest": ps.ry(9)}}
    p["turn"]["neck"], p["turn"]["head"] = ps.ry(4), ps.rz(-8) @ ps.ry(6)
    for side, sign in rig.SIDES:
        ankle = feet + [0.02, sign * 0.12, 0.098]
        ps.two_bones(p, joint, f"thigh_{side}", f"shin_{side}", ankle, np.array([1.0, 0.05 * sign, 0.1]), np.array([1.0, 0.05 * sign, 0]))
        p["turn"][f"foot_{side}"] = p["turn"][f"toes_{side}"] = ps.rz(8 * sign)
        wrist = hands + [-0.09, sign * 0.17, 0.03]
        gait.reach_arm(p, joint, side, sign, wrist, (-0.3, 0.6, -0.8), curl=70.0, palm=25.0)
    return p
