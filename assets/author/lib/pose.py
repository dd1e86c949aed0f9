"""Poses of the skeleton: rotations, forward kinematics and two-bone inverse kinematics.

A pose is {"pelvis": position, "turn": {bone: 3x3}}; turn is the bone's rotation away from its rest
orientation, in the person's frame (x forward, y left, z up). Missing bones follow their parent.
"""

import numpy as np

from . import rig


def about(axis, degrees):
    """Rotation matrix about an axis (Rodrigues)."""
    a = np.asarray(axis, float)
    a = a / np.linalg.norm(a)
    t = np.radians(degrees)
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + np.sin(t) * k + (1 - np.cos(t)) * k @ k


def rx(degrees):
    return about((1, 0, 0), degrees)


def ry(degrees):
    return about((0, 1, 0), degrees)


def rz(degrees):
    return about((0, 0, 1), degrees)


def unit(v):
    return v / np.linalg.norm(v)


def joint_at(pose, joint, name, bone):
    """Where a rest joint is when carried by bone."""
    origin, turn = place(pose, joint, bone)
    return origin + turn @ (joint[name] - joint[rig.BONES[bone][1]])


def place(pose, joint, bone):
    """(position of the bone's head, its rotation)."""
    parent, head, _ = rig.BONES[bone]
    if parent is None:
        return pose["pelvis"], pose["turn"].get(bone, np.eye(3))
    at, turn = place(pose, joint, parent)
    at = at + turn @ (joint[head] - joint[rig.BONES[parent][1]])
    return at, pose["turn"].get(bone, turn)


def frame(along, across):
    """Orthonormal frame whose first axis is `along` and whose second is nearest `across`."""
    a = unit(along)
    c = unit(across - (across @ a) * a)
    return np.stack([a, c, np.cross(a, c)], 1)


def two_bones(pose, joint, upper, lower, target, toward, toward_rest):
    """Turns two bones so that the lower one's tail reaches target; returns the bend in degrees.

    The joint between them points towards `toward` (a knee forwards, an elbow back and down), as it
    does towards `toward_rest` in the rest pose. A target out of reach is met with a straight limb.
    """
    a, _ = place(pose, joint, upper)
    _, ju, jm = rig.BONES[upper]
    jt = rig.BONES[lower][2]
    u0, l0 = joint[jm] - joint[ju], joint[jt] - joint[jm]
    lu, ll = np.linalg.norm(u0), np.linalg.norm(l0)
    reach = target - a
    distance = min(np.linalg.norm(reach), 0.99999 * (lu + ll))
    r = unit(reach)
    hinge = unit(np.cross(toward, r))
    hinge_rest = unit(np.cross(toward_rest, joint[jt] - joint[ju]))
    cosine = np.clip((lu**2 + distance**2 - ll**2) / (2 * lu * distance), -1, 1)
    middle = a + lu * (cosine * r + np.sqrt(1 - cosine**2) * np.cross(r, hinge))
    end = a + distance * r
    pose["turn"][upper] = frame(middle - a, hinge) @ frame(u0, hinge_rest).T
    pose["turn"][lower] = frame(end - middle, hinge) @ frame(l0, hinge_rest).T
    bend = np.clip(unit(middle - a) @ unit(end - middle), -1, 1)
    return np.degrees(np.arccos(bend))


def local_turns(pose):
    """Rotation of every bone relative to its parent, in rest axes: what a clip stores."""
    out = {}
    for bone, (parent, _, _) in rig.BONES.items():
        own, _ = _resolved(pose, bone)
        if parent is None:
            out[bone] = own
        else:
            out[bone] = _resolved(pose, parent)[0].T @ own
    return out


def _resolved(pose, bone):
    while bone is not None and bone not in pose["turn"]:
        bone = rig.BONES[bone][0]
    return (pose["turn"][bone] if bone else np.eye(3)), bone


def unit_mean(a, b, share=0.5):
    """Rotation a share of the way from a to b."""
    d = a.T @ b
    angle = np.degrees(np.arccos(np.clip((np.trace(d) - 1) / 2, -1, 1)))
    if angle < 1e-6:
        return a
    axis = np.array([d[2, 1] - d[1, 2], d[0, 2] - d[2, 0], d[1, 0] - d[0, 1]])
    return a @ about(axis, share * angle)
