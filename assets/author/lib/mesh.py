"""Builds a person's parts as triangles: fields and hung cloth, decimated to budgets, with skin weights.

A part is {"v", "t": the mesh in units of a 1.75 m person; "material": where each vertex lay on the
pattern, for paint and weights; "fine": (v, t, material) of the dense surface whose normals are baked,
or None; "weights"}.
"""

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from . import body, border, collar, footwear, garments, gear, hair, head, rig, sdf, shell
from .noise import step

# part: (box, grid step, triangles)
SOLIDS = {
    "head": ((-0.16, -0.13, 1.38), (0.17, 0.13, 1.79), 0.0028, 6000),
    "cap": ((-0.17, -0.13, 1.42), (0.14, 0.13, 1.82), 0.0045, 900),
    "helmet": ((-0.19, -0.15, 1.58), (0.25, 0.15, 1.85), 0.0034, 2200),
    "hands": ((-0.05, 0.35, 0.62), (0.24, 0.64, 1.06), 0.0026, 1500),
    "shoes": ((-0.12, 0.03, -0.02), (0.27, 0.20, 0.26), 0.0042, 1200),
    "arms": ((-0.10, 0.20, 0.85), (0.16, 0.62, 1.42), 0.0060, 800),
}
CLOTH = {"top": 4200, "trousers": 3100, "vest": 2000}
# A vest's edge lies on cloth that bends sharply: a deep hem would come out through its own front.
HEMS = {"vest": {"thick_m": 0.005, "deep_m": 0.005}}
TUCKED = (0.010, 0.03)  # metres below the jacket, and from its hem on
PAIRED = ("hands", "shoes", "arms")


def parts_of(person):
    """Names of the parts the person wears."""
    out = ["trousers", "top", "head", "eyes", "hands", "shoes"]
    if garments.TOPS[person.top].collar != "none":
        out.append("collar")
    if garments.TOPS[person.top].sleeve == "short":
        out.append("arms")
    if person.vest:
        out.append("vest")
    if person.hair != "bald":
        out += ["cap", "locks"]
    if person.head_wear != "none":
        out.append("helmet")
    if person.glasses:
        out.append("glasses")
    return out


def decimate(v, t, triangles):
    """Collapses edges until the budget is met."""
    mesh = bpy.data.meshes.new("part")
    mesh.from_pydata(v.tolist(), [], t.tolist())
    thing = bpy.data.objects.new("part", mesh)
    bpy.context.scene.collection.objects.link(thing)
    modifier = thing.modifiers.new("d", "DECIMATE")
    modifier.ratio = min(1.0, triangles / len(t))
    modifier.use_collapse_triangulate = True
    done = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    done.calc_loop_triangles()
    out = np.empty(len(done.vertices) * 3)
    done.vertices.foreach_get("co", out)
    tri = np.empty(len(done.loop_triangles) * 3, int)
    done.loop_triangles.foreach_get("vertices", tri)
    bpy.data.objects.remove(thing)
    bpy.data.meshes.remove(mesh)
    return out.reshape(-1, 3), tri.reshape(-1, 3)


class Surface:
    """A dense surface to look up: the nearest place's normal, pattern coordinates and depth."""

    def __init__(self, v, t, material):
        self.t, self.material = t, material
        self.v, self.normal = v, shell.normals(v, t)
        self.depth = ((relaxed(v, t, 18) - v) * self.normal).sum(1)
        self.tree = BVHTree.FromPolygons(v.tolist(), t.tolist())

    def at(self, p):
        """(normals, pattern coordinates, metres below the smoothed surface) nearest to p."""
        found = [self.tree.find_nearest(x) for x in p.tolist()]
        place = np.array([f[0] for f in found])
        tri = self.t[[f[2] for f in found]]
        share = barycentric(place, *(self.v[tri[:, i]] for i in range(3)))
        mix = lambda a: sum(share[:, i : i + 1] * a[tri[:, i]] for i in range(3))
        n = mix(self.normal)
        return n / (np.linalg.norm(n, axis=1, keepdims=True) + 1e-9), mix(self.material), mix(self.depth[:, None])[:, 0]


def relaxed(v, t, passes=6):
    """The surface with its folds ironed out."""
    e = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    e = np.unique(np.concatenate([e, e[:, ::-1]]), axis=0)
    count = np.bincount(e[:, 0], minlength=len(v))[:, None] + 1e-9
    for _ in range(passes):
        total = np.stack([np.bincount(e[:, 0], v[e[:, 1], k], minlength=len(v)) for k in range(3)], -1)
        v = 0.4 * v + 0.6 * total / count
    return v


def barycentric(p, a, b, c):
    """Shares of a, b and c at p (all (N, 3))."""
    u, v, w = b - a, c - a, p - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    det = uu * vv - uv * uv + 1e-20
    s, r = (vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det
    out = np.clip(np.stack([1 - s - r, s, r], -1), 0, 1)
    return out / out.sum(1, keepdims=True)


def cloth(made, budget, **hems):
    """A hung garment, decimated, with turned hems (shell.hem)."""
    hung, t, pattern = made
    fine = Surface(hung, t, pattern)
    v, low = decimate(hung, t, budget)
    v, low, parents = shell.hem(v, low, **hems)
    _, material, _ = fine.at(v[: parents.max() + 1])
    material = material[parents] + v - v[parents]
    return {"v": v, "t": low, "material": material, "fine": fine}


def solid(name, shapes, field, detail):
    lo, hi, step, budget = SOLIDS[name]
    v, quads, sampled = sdf.surface(field, np.array(lo), np.array(hi), step)
    v, t = decimate(v, shell.triangulate(quads), budget * detail)
    v = v - sdf.gradient(field, v) * np.clip(field(v), -0.02, 0.02)[:, None]
    if name in PAIRED:
        t = np.concatenate([t, t[:, ::-1] + len(v)])
        v = np.concatenate([v, v * [1, -1, 1]])
    return {"v": v, "t": t, "material": v, "fine": None, "field": field}


def tuck_in(person, out):
    """Trousers go under the jacket: hung apart, they came through it at the small of the back."""
    if "top" not in out or "trousers" not in out:
        return
    legs, top = out["trousers"], out["top"]
    covered = legs["v"][:, 2] > max(garments.TOPS[person.top].hem + TUCKED[1], 0.82)
    legs["v"] = border.under(legs["v"], legs["t"], (top["v"], top["t"]), TUCKED[0], covered)


def build(person, detail=1.0):
    """Returns (parts, shapes)."""
    shapes, out = body.Shapes(person), {}
    tailor = garments.Tailor(shapes)
    fields = {
        "head": lambda q: head.head(person, q),
        "cap": lambda q: hair.cap(person, q),
        "helmet": lambda q: gear.head_wear(person, q),
        "hands": shapes.hands,
        "shoes": lambda q: footwear.shoes(shapes, q),
        "arms": shapes.arms,
    }
    for name in parts_of(person):
        if name in SOLIDS:
            out[name] = solid(name, shapes, fields[name], detail)
        elif name == "eyes":
            v, t, _ = head.eyes(person)
            out[name] = {"v": v, "t": t, "material": v, "fine": None}
        elif name == "locks":
            v, t, material = hair.locks(person)
            out[name] = {"v": v, "t": t, "material": material, "fine": None}
        elif name == "glasses":
            v, t = gear.glasses(person)
            out[name] = {"v": v, "t": t, "material": v, "fine": None}
        elif name == "collar":
            v, t = collar.make(tailor, out["top"]["fine"])
            out[name] = {"v": v, "t": t, "material": v, "fine": None}
        else:
            made = {"top": tailor.top, "trousers": tailor.bottom, "vest": lambda: tailor.vest(out["top"]["fine"])}[name]()
            out[name] = cloth(made, CLOTH[name] * detail, **HEMS.get(name, {}))
    tuck_in(person, out)
    for name, part in out.items():
        where = part["v"] if name == "locks" else part["material"]
        if name == "vest":  # shoulders move as what is worn below, so that it does not come through
            share = step(1.10, 1.20, where[:, 2])[:, None]
            where = where + share * (out["top"]["fine"].at(part["v"])[1] - where)
        armness = np.ones(len(where)) if name == "arms" else shapes.armness(where)
        kind = "coat" if name == "top" and garments.TOPS[person.top].hem < 0.7 else name
        part["weights"] = rig.weights(kind, where * shapes.scale, shapes.joint, shapes.scale, armness)
    return out, shapes
