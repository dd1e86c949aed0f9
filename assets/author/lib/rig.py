"""The skeleton: joints in the rest pose, bones, skin weights.

The rest pose stands at the origin, looks along +X, arms hang 30 degrees off the body. Segment
lengths are fractions of stature after Drillis and Contini (1966), as tabulated by Winter,
Biomechanics and Motor Control of Human Movement.
"""

import numpy as np

from .noise import step

SIDES = (("left", 1.0), ("right", -1.0))
ARM_ANGLE = np.radians(30.0)
ON_HEAD = ("cap", "locks", "helmet", "glasses", "eyes")  # parts that move with the head alone

# bone: (parent, head joint, tail joint); the deform tree of every person.
BONES = {
    "pelvis": (None, "pelvis", "spine"),
    "spine": ("pelvis", "spine", "chest"),
    "chest": ("spine", "chest", "neck"),
    "neck": ("chest", "neck", "head"),
    "head": ("neck", "head", "crown"),
}
for _side, _ in SIDES:
    BONES.update(
        {
            f"clavicle_{_side}": ("chest", f"clavicle_{_side}", f"shoulder_{_side}"),
            f"upper_arm_{_side}": (f"clavicle_{_side}", f"shoulder_{_side}", f"elbow_{_side}"),
            f"forearm_{_side}": (f"upper_arm_{_side}", f"elbow_{_side}", f"wrist_{_side}"),
            f"hand_{_side}": (f"forearm_{_side}", f"wrist_{_side}", f"knuckle_{_side}"),
            f"fingers_{_side}": (f"hand_{_side}", f"knuckle_{_side}", f"fingertip_{_side}"),
            f"thigh_{_side}": ("pelvis", f"hip_{_side}", f"knee_{_side}"),
            f"shin_{_side}": (f"thigh_{_side}", f"knee_{_side}", f"ankle_{_side}"),
            f"foot_{_side}": (f"shin_{_side}", f"ankle_{_side}", f"ball_{_side}"),
            f"toes_{_side}": (f"foot_{_side}", f"ball_{_side}", f"toe_{_side}"),
        }
    )
for _side, _ in SIDES:  # behind all others, whose order stays
    BONES[f"eye_{_side}"] = ("head", f"eye_{_side}", f"gaze_{_side}")


def joints(person):
    """Joint name -> rest position in metres."""
    s = person.height_m / 1.75
    w = person.shoulders
    out = {
        "pelvis": (0, 0, 0.945),
        "spine": (-0.005, 0, 1.06),
        "chest": (-0.01, 0, 1.23),
        "neck": (-0.018, 0, 1.485),
        "head": (0.0, 0, 1.575),
        "crown": (0.0, 0, 1.75),
    }
    arm = np.array([0.0, np.sin(ARM_ANGLE), -np.cos(ARM_ANGLE)])
    fore = arm + np.array([0.13, 0.0, 0.0])
    fore /= np.linalg.norm(fore)
    shoulder = np.array([-0.012, 0.183 * w, 1.425])
    elbow = shoulder + 0.312 * arm
    wrist = elbow + 0.250 * fore
    knuckle = wrist + 0.088 * fore
    fingertip = knuckle + 0.095 * fore
    chain = {
        "clavicle": np.array([0.0, 0.03, 1.44]),
        "shoulder": shoulder,
        "elbow": elbow,
        "wrist": wrist,
        "knuckle": knuckle,
        "fingertip": fingertip,
        "hip": np.array([0.0, 0.088, 0.925]),
        "knee": np.array([0.012, 0.096, 0.500]),
        "ankle": np.array([-0.012, 0.100, 0.082]),
        "ball": np.array([0.120, 0.111, 0.020]),
        "toe": np.array([0.184, 0.116, 0.012]),
    }
    for side, sign in SIDES:
        for name, at in chain.items():
            out[f"{name}_{side}"] = at * (1.0, sign, 1.0)
    k = (1.75 / person.height_m) ** 0.4  # the head's scale, as in head.face_frame
    for side, sign in SIDES:
        eye = np.array([0.0735, 0.0315 * sign * person.face.apart, -0.118]) * k + [0, 0, 1.755]
        out[f"eye_{side}"], out[f"gaze_{side}"] = eye, eye + [0.03, 0, 0]
    return {name: np.asarray(at, float) * s for name, at in out.items()}


def weights(part, p, joint, scale, armness):
    """Skin weights (N, bones) of a part's points; armness is 1 on sleeves and 0 on the trunk.

    Neighbouring bones share a band around their joint, so knees and elbows bend softly.
    """
    names = list(BONES)
    w = np.zeros((len(p), len(names)))
    q = p / scale

    def give(name, value):
        w[:, names.index(name)] += value

    def along(start, end):
        axis = joint[end] - joint[start]
        return (p - joint[start]) @ (axis / np.linalg.norm(axis)) / scale

    def leg(share, side, shoe):
        knee = along(f"knee_{side}", f"ankle_{side}")
        shin = step(-0.055, 0.055, knee)
        give(f"thigh_{side}", share * (1 - shin))
        if not shoe:
            give(f"shin_{side}", share * shin)
            return
        sole = step(0.125, 0.075, q[:, 2])
        toes = step(-0.018, 0.018, q[:, 0] - joint[f"ball_{side}"][0] / scale)
        give(f"shin_{side}", share * shin * (1 - sole))
        give(f"foot_{side}", share * shin * sole * (1 - toes))
        give(f"toes_{side}", share * shin * sole * toes)

    def arm(share, side):
        elbow = step(-0.045, 0.045, along(f"elbow_{side}", f"wrist_{side}"))
        wrist = step(-0.018, 0.022, along(f"wrist_{side}", f"knuckle_{side}"))
        finger = step(-0.012, 0.014, along(f"knuckle_{side}", f"fingertip_{side}"))
        if part == "hands":
            thumb = step(
                0.030,
                0.045,
                q[:, 0]
                - along(f"wrist_{side}", f"knuckle_{side}") * 0.22
                - joint[f"wrist_{side}"][0] / scale,
            )
            finger = finger * (1 - thumb)
        else:
            wrist = finger = 0.0
        give(f"upper_arm_{side}", share * (1 - elbow))
        give(f"forearm_{side}", share * elbow * (1 - wrist))
        give(f"hand_{side}", share * elbow * wrist * (1 - finger))
        give(f"fingers_{side}", share * elbow * wrist * finger)

    rest = np.ones(len(p))
    for side, sign in SIDES:
        mine = step(-0.025, 0.025, sign * q[:, 1])
        if part in ("shoes", "hands"):
            only = (sign * p[:, 1] > 0).astype(float)
            (leg(only, side, True) if part == "shoes" else arm(only, side))
            rest = rest - only
            continue
        drop = joint[f"hip_{side}"][2] / scale - q[:, 2] + 0.35 * (np.abs(q[:, 1]) - 0.10)
        thigh = mine * step(-0.07, 0.09, drop) * (1 - armness)
        if part == "coat":
            thigh = thigh * 0.75
        if part not in ("head", *ON_HEAD):
            leg(thigh, side, False)
            reach = along(f"shoulder_{side}", f"elbow_{side}")
            upper = (sign * p[:, 1] > 0) * armness * step(-0.045, 0.075, reach)
            arm(upper, side)
            girdle = (
                (sign * p[:, 1] > 0)
                * step(0.05, 0.15, np.abs(q[:, 1]))
                * step(1.30, 1.40, q[:, 2])
                * 0.85
            )
            girdle = np.maximum(girdle, (sign * p[:, 1] > 0) * armness)
            give(f"clavicle_{side}", (rest - thigh - upper).clip(0) * girdle)
            rest = rest - thigh - upper - (rest - thigh - upper).clip(0) * girdle
    if part == "eyes":
        for side, sign in SIDES:
            give(f"eye_{side}", (sign * p[:, 1] > 0).astype(float))
    elif part in ON_HEAD:
        give("head", rest)
    else:
        rest = rest.clip(0)
        spine = step(1.00, 1.12, q[:, 2])
        chest = step(1.15, 1.31, q[:, 2])
        neck = step(1.465, 1.515, q[:, 2] + 0.25 * q[:, 0].clip(-0.1, 0.1))
        head = step(1.545, 1.600, q[:, 2] + 0.55 * q[:, 0].clip(-0.1, 0.1))
        give("pelvis", rest * (1 - spine))
        give("spine", rest * spine * (1 - chest))
        give("chest", rest * spine * chest * (1 - neck))
        give("neck", rest * chest * neck * (1 - head))
        give("head", rest * neck * head)
    return limit(w)


def limit(w, most=4):
    """Keeps the largest `most` weights of each point and makes them sum to 1."""
    order = np.argsort(-w, axis=1)
    out = np.zeros_like(w)
    rows = np.arange(len(w))[:, None]
    out[rows, order[:, :most]] = w[rows, order[:, :most]]
    return out / out.sum(1, keepdims=True)
