"""Measures a person's proportions on the exported mesh, in the rest pose.

Published figures (Drillis and Contini 1966): the head is 0.130 of stature from chin to crown, the
shoulders are 0.259 of it wide; the rule of thumb of drawing is 1/7.5 and 1/4.
"""

import numpy as np

HEAD = (1 / 8.4, 1 / 6.6)  # of stature: small people have the larger heads
SHOULDERS = (0.205, 0.300)  # in the clothes they wear


def skin_of(glb):
    """Vertices of skin in the rest pose."""
    mesh = next(m for m in glb.json["meshes"])
    out = []
    for primitive in mesh["primitives"]:
        if glb.json["materials"][primitive["material"]]["name"].endswith("_skin"):
            p = glb.read(primitive["attributes"]["POSITION"]).astype(float)
            out.append(np.stack([p[:, 0], -p[:, 2], p[:, 1]], -1))
    return np.concatenate(out)


def measure(glb):
    """{"head", "shoulders"}: chin to crown and the shoulders' breadth, as shares of stature.

    The chin is the lowest skin of the face's front; a shoulder ends where the outline, seen from
    the front, falls at 45 degrees.
    """
    height = glb.facts()["height_m"]
    skin = skin_of(glb)
    face = skin[skin[:, 2] > 0.8 * height]
    front = face[(np.abs(face[:, 1]) < 0.03) & (face[:, 0] > face[:, 0].max() - 0.062)]
    head = face[:, 2].max() - front[:, 2].min()
    v = glb.vertices()
    side = np.arange(0.08, 0.36, 0.006) * height / 1.75
    top = [v[np.abs(np.abs(v[:, 1]) - y) < 0.006][:, 2].max() for y in side]
    top = np.convolve(np.pad(top, 2, mode="edge"), np.ones(5) / 5, "valid")
    fall = (top[5:] - top[:-5]) / (side[5:] - side[:-5])  # over 3 cm: a vest's edge is no shoulder
    middle = (side[5:] + side[:-5]) / 2
    end = middle[(fall < -1.0) & (middle > 0.165 * height / 1.75)][0]
    return {"head": float(head / height), "shoulders": float(2 * end / height)}


def wrong(found):
    """Names of the proportions outside the published range."""
    limits = {"head": HEAD, "shoulders": SHOULDERS}
    return [k for k, (low, high) in limits.items() if not low <= found[k] <= high]
