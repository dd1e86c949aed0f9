"""Builds a person's parts as triangles: extraction, decimation to a budget, skin weights."""

import bpy
import numpy as np

from . import body, rig, sdf

# part: (field, box in metres of a 1.75 m person, grid step, triangles)
LAYOUT = {
    "trousers": ("trousers", (-0.24, -0.26, 0.02), (0.24, 0.26, 1.08), 0.0085, 3000),
    "top": ("upper", (-0.24, -0.60, 0.80), (0.26, 0.60, 1.58), 0.0085, 3600),
    "coat": ("upper", (-0.30, -0.60, 0.48), (0.30, 0.60, 1.58), 0.0095, 4200),
    "vest": ("vest", (-0.24, -0.26, 0.80), (0.26, 0.26, 1.56), 0.0085, 2200),
    "head": ("head", (-0.16, -0.13, 1.38), (0.17, 0.13, 1.79), 0.0036, 4200),
    "hair": ("hair", (-0.20, -0.13, 1.42), (0.14, 0.13, 1.82), 0.005, 1400),
    "helmet": ("helmet", (-0.19, -0.15, 1.58), (0.23, 0.15, 1.83), 0.005, 1700),
    "hands": ("hands", (-0.05, 0.35, 0.62), (0.24, 0.64, 1.06), 0.0030, 1300),
    "shoes": ("shoes", (-0.12, 0.03, -0.02), (0.27, 0.20, 0.21), 0.0050, 750),
    "arms": ("arms", (-0.10, -0.60, 0.85), (0.16, 0.60, 1.40), 0.0060, 1400),
}
PAIRED = ("hands", "shoes")


def parts_of(person):
    """Names of the parts the person wears."""
    out = ["trousers", "coat" if person.top == "coat" else "top", "head", "hands", "shoes"]
    if person.top == "shirt":
        out.append("arms")
    if person.vest:
        out.append("vest")
    if person.hair != "bald":
        out.append("hair")
    if person.head_wear != "none":
        out.append("helmet")
    return out


def decimate(vertices, quads, triangles):
    """Collapses edges until the budget is met; returns (vertices, triangles)."""
    mesh = bpy.data.meshes.new("part")
    mesh.from_pydata(vertices.tolist(), [], quads.tolist())
    thing = bpy.data.objects.new("part", mesh)
    bpy.context.scene.collection.objects.link(thing)
    modifier = thing.modifiers.new("d", "DECIMATE")
    modifier.ratio = min(1.0, triangles / (2.0 * len(quads)))
    modifier.use_collapse_triangulate = True
    done = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    done.calc_loop_triangles()
    v = np.empty(len(done.vertices) * 3)
    done.vertices.foreach_get("co", v)
    t = np.empty(len(done.loop_triangles) * 3, int)
    done.loop_triangles.foreach_get("vertices", t)
    bpy.data.objects.remove(thing)
    bpy.data.meshes.remove(mesh)
    return v.reshape(-1, 3), t.reshape(-1, 3)


def build(person, detail=1.0):
    """Returns (parts, shapes): part name -> vertices, triangles, skin weights, sampled field."""
    shapes, s, out = body.Shapes(person), person.height_m / 1.75, {}
    for name in parts_of(person):
        method, lo, hi, step, budget = LAYOUT[name]
        field = getattr(shapes, method)
        lo, hi = np.array(lo) * s, np.array(hi) * s
        v, quads, sampled = sdf.surface(field, lo, hi, step)
        v, t = decimate(v, quads, budget * detail)
        v = v - sdf.gradient(field, v) * np.clip(field(v), -0.003, 0.003)[:, None]
        if name in PAIRED:
            t = np.concatenate([t, t[:, ::-1] + len(v)])
            v = np.concatenate([v, v * [1, -1, 1]])
        armness = np.ones(len(v)) if name in ("arms",) else shapes.armness(v)
        skin = rig.weights(name, v, shapes.joint, s, armness)
        out[name] = {"vertices": v, "triangles": t, "weights": skin, "field": sampled}
    return out, shapes
