"""Paints a person's texture: every texel knows where on the pattern it lies and is coloured there.

Painting in space instead of on the sheet makes seams invisible wherever the unwrapping cut. `relief`
is the height of what is sewn on or drawn, in metres: its slopes go into the normal map.
"""

import numpy as np

from . import paint_cloth, paint_gear, paint_skin

# part: (material, roughness)
FINISH = {
    "trousers": ("cloth", 0.92),
    "top": ("cloth", 0.92),
    "collar": ("cloth", 0.92),
    "vest": ("cloth", 0.92),
    "head": ("skin", 0.52),
    "arms": ("skin", 0.52),
    "hands": ("skin", 0.52),
    "cap": ("hair", 0.60),
    "locks": ("hair", 0.60),
    "eyes": ("eye", 0.10),
    "helmet": ("hard", 0.38),
    "shoes": ("leather", 0.62),
    "glasses": ("frame", 0.30),
}


def finish(person, part):
    """(material, roughness) of a part: cloth hats are cloth."""
    if part == "helmet" and person.head_wear != "helmet":
        return FINISH["top"]
    if part == "shoes" and person.shoes == "leather":
        return ("polish", 0.40)
    return FINISH[part]


class Painter:
    """Colours and relief of one person at points of the pattern."""

    def __init__(self, person, shapes):
        self.person = person
        self.cloth = paint_cloth.Cloths(person, shapes)
        self.skin = paint_skin.Skin(person, shapes)
        self.gear = paint_gear.Gear(person, shapes)

    def colour(self, part, q, n, depth):
        """sRGB (N, 3) at pattern points q with normals n, `depth` metres down in folds."""
        if part in ("trousers", "top", "vest", "collar"):
            rgb = getattr(self.cloth, part)(q)
            shade = 1.0 - np.clip(28.0 * depth, -0.06, 0.22)
            return np.clip(rgb * shade[:, None], 0, 1)
        if part in ("helmet", "shoes", "glasses"):
            return np.clip(getattr(self.gear, part)(q, n), 0, 1)
        return np.clip(getattr(self.skin, part)(q), 0, 1)

    def relief(self, part, q):
        if part in ("trousers", "top", "vest", "collar"):
            return getattr(self.cloth, part + "_relief")(q)
        if part in ("helmet", "shoes", "glasses"):
            return self.gear.relief(part, q)
        return self.skin.relief(part, q)
