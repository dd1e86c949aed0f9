"""Assembles a person in Blender: unwrap, painted sheets, armature, clips, and the .glb file."""

import os
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

from . import hair, mesh, paint, person_file, picture, pose, rig, sheets, shell

FPS = 40
DENSITY = {"head": 2.1, "cap": 0.9, "locks": 0.55, "hands": 1.2, "helmet": 1.0, "vest": 1.1, "eyes": 3.2, "collar": 1.0, "glasses": 0.4}

# Smart projection looks along the largest triangle first. A vest's may lie obliquely, and would skew
# the sheets of all; made small while it is unwrapped, it never is the largest.
SHRUNK = {"vest": 0.4}


def reset():
    """An empty scene at the clips' frame rate."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = FPS


def join(parts, name, scale):
    """One mesh object from all parts; returns (object, part index of every triangle)."""
    vertices, triangles, owner, skin, start = [], [], [], [], 0
    for i, part in enumerate(parts.values()):
        vertices.append(part["v"] * scale)
        triangles.append(part["t"] + start)
        owner.append(np.full(len(part["t"]), i))
        skin.append(part["weights"])
        start += len(part["v"])
    vertices, triangles = np.concatenate(vertices), np.concatenate(triangles)
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices.tolist(), [], triangles.tolist())
    data.polygons.foreach_set("use_smooth", np.ones(len(triangles), bool))
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    skin = np.concatenate(skin)
    for b, bone in enumerate(rig.BONES):
        group = thing.vertex_groups.new(name=bone)
        for v in np.nonzero(skin[:, b] > 1e-4)[0]:
            group.add([int(v)], float(skin[v, b]), "REPLACE")
    return thing, np.concatenate(owner)


def flattened(parts, scale):
    """Where vertices lie for unwrapping: cloth as its pattern, without folds."""
    at = lambda n: scale * SHRUNK.get(n, 1.0)
    return np.concatenate([(p["v"] if n == "locks" else p["material"]) * at(n) for n, p in parts.items()])


def unwrap(thing, owner, parts, scale):
    """Smart projection, part by part scaled to its importance, packed into one sheet.

    Of the locks only the first few are unwrapped; the others are painted like them.
    """
    own = np.ones(len(owner), bool)
    if "locks" in parts:
        place = list(parts).index("locks")
        each = 4 * hair.SEGMENTS
        mine = np.nonzero(owner == place)[0]
        own[mine[hair.KINDS * each :]] = False
    shown = np.empty(len(thing.data.vertices) * 3)
    thing.data.vertices.foreach_get("co", shown)
    thing.data.vertices.foreach_set("co", flattened(parts, scale).ravel())
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    thing.data.uv_layers.new(name="uv")
    choose(thing, own)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.uv.smart_project(
        angle_limit=np.radians(72),
        island_margin=0.0,
        area_weight=0.6,
        correct_aspect=False,
        scale_to_bounds=False,
    )
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = sheets.read_uv(thing)
    density = np.array([DENSITY.get(n, 1.0) / SHRUNK.get(n, 1.0) for n in parts])[owner]
    uv = uv * density[:, None, None]
    thing.data.uv_layers[0].data.foreach_set("uv", uv.ravel())
    choose(thing, own)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.uv.select_all(action="SELECT")
    bpy.ops.uv.pack_islands(rotate=True, margin=0.002)
    bpy.ops.object.mode_set(mode="OBJECT")
    thing.data.vertices.foreach_set("co", shown)
    uv = sheets.read_uv(thing)
    if "locks" in parts:
        uv[mine] = np.resize(uv[mine[: hair.KINDS * each]], uv[mine].shape)
        thing.data.uv_layers[0].data.foreach_set("uv", uv.ravel())
    thing.data.update()
    return uv, own


def choose(thing, faces):
    """Selects faces (a mask) and what belongs to them."""
    data = thing.data
    chosen = np.zeros(len(data.vertices), bool)
    chosen[np.array([p.vertices[:] for p in data.polygons])[faces].ravel()] = True
    data.vertices.foreach_set("select", chosen)
    data.edges.foreach_set("select", np.zeros(len(data.edges), bool))
    data.polygons.foreach_set("select", faces)
    data.update()


def armature(joint, name):
    """The skeleton as a Blender armature object."""
    data = bpy.data.armatures.new(name)
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    for bone, (parent, head, tail) in rig.BONES.items():
        b = data.edit_bones.new(bone)
        b.head, b.tail = joint[head], joint[tail]
        b.roll = 0.0
        if parent:
            b.parent = data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    return thing


def clip(thing, joint, name, poses, frames):
    """Bakes poses(u), u = 0..1 in equal steps, as an action of `frames` + 1 linear keys."""
    action = bpy.data.actions.new(name)
    rest = {b: np.array(thing.data.bones[b].matrix_local.to_3x3()) for b in rig.BONES}
    times = np.arange(frames + 1)
    turns = {b: [] for b in rig.BONES}
    places = []
    for i in times:
        p = poses(i / frames)
        if not all(np.isfinite(t).all() for t in p["turn"].values()):
            raise ValueError(f"clip {name}: frame {i} is not finite")
        places.append(rest["pelvis"].T @ (p["pelvis"] - joint["pelvis"]))
        for bone, turn in pose.local_turns(p).items():
            turns[bone].append(Matrix(rest[bone].T @ turn @ rest[bone]).to_quaternion())
    for bone, quaternions in turns.items():
        keep = [quaternions[0]]
        for q in quaternions[1:]:
            keep.append(q if q.dot(keep[-1]) >= 0 else Quaternion((-q.w, -q.x, -q.y, -q.z)))
        path = f'pose.bones["{bone}"].rotation_quaternion'
        for axis in range(4):
            curve(action, path, axis, times, [q[axis] for q in keep])
    for axis in range(3):
        curve(action, 'pose.bones["pelvis"].location', axis, times, [p[axis] for p in places])
    if thing.animation_data is None:
        thing.animation_data_create()
    track = thing.animation_data.nla_tracks.new()
    track.name = name
    strip = track.strips.new(name, 0, action)
    strip.name = name
    track.mute = True
    return action


def curve(action, path, axis, times, values):
    """One linear animation curve."""
    c = action.fcurves.new(path, index=axis)
    c.keyframe_points.add(len(times))
    c.keyframe_points.foreach_set("co", np.stack([times, values], -1).ravel())
    c.keyframe_points.foreach_set("interpolation", [1] * len(times))
    c.update()


def material(image, name, roughness=0.85, bumps=None):
    """A material with one base-colour picture and perhaps a normal map."""
    m = bpy.data.materials.new(name)
    m["roughness"] = roughness
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Specular"].default_value = 0.3
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    if bumps is not None:
        slopes = nodes.new("ShaderNodeTexImage")
        slopes.image = bumps
        turn = nodes.new("ShaderNodeNormalMap")
        links.new(slopes.outputs["Color"], turn.inputs["Color"])
        links.new(turn.outputs["Normal"], shader.inputs["Normal"])
    return m


def export(path):
    """Writes the whole scene as binary glTF with y up."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    part = path[:-4] + ".part.glb"
    bpy.ops.export_scene.gltf(
        filepath=part,
        export_format="GLB",
        export_yup=True,
        export_extras=True,
        export_animations=True,
        export_nla_strips=True,
        export_force_sampling=True,
        export_optimize_animation_size=True,
        export_def_bones=False,
        export_skins=True,
        export_image_format="AUTO",
        export_materials="EXPORT",
        export_copyright="BSD-3-Clause, aisle",
    )
    os.replace(part, path)


def dressed(person, folder, size, detail, bumps=True):
    """The painted mesh of the person: (object, parts, shapes)."""
    parts, shapes = mesh.build(person, detail)
    thing, owner = join(parts, person.name, shapes.scale)
    uv, own = unwrap(thing, owner, parts, shapes.scale)
    painter = paint.Painter(person, shapes)
    colour, slopes = sheets.bake(thing, uv, np.where(own, owner, -1), parts, painter, size, shapes.scale)
    image = picture.jpeg_image(colour, person.name, folder)
    normal = None
    if bumps:
        normal = picture.jpeg_image(slopes, person.name + "_normal", folder, 92)
        normal.colorspace_settings.name = "Non-Color"
    made = {}
    for i, name in enumerate(parts):
        key = paint.finish(person, name)
        if key not in made:
            made[key] = len(thing.data.materials)
            thing.data.materials.append(material(image, f"{person.name}_{key[0]}", key[1], normal))
    index = np.array([made[paint.finish(person, n)] for n in parts])[owner]
    thing.data.polygons.foreach_set("material_index", index.astype(np.int32))
    thing.data.update()
    return thing, parts, shapes


def still(person, shape, folder, size=512, detail=0.45):
    """The person as a rigid object held in one pose; shape(joint) makes the pose."""
    thing, parts, shapes = dressed(person, folder, size, detail)
    thing.vertex_groups.clear()
    held = shape(shapes.joint)
    skin = np.concatenate([p["weights"] for p in parts.values()])
    rest = np.concatenate([p["v"] * shapes.scale for p in parts.values()])
    moved = np.zeros_like(rest)
    for b, (bone, (_, head, _)) in enumerate(rig.BONES.items()):
        at, turn = pose.place(held, shapes.joint, bone)
        moved += skin[:, b : b + 1] * ((rest - shapes.joint[head]) @ turn.T + at)
    thing.data.vertices.foreach_set("co", moved.ravel())
    thing.data.update()
    return thing


def on_bones(person, folder, size, detail=1.0):
    """The person's mesh on its skeleton in the rest pose: (mesh, armature, its shapes)."""
    thing, _, shapes = dressed(person, folder, size, detail)
    bones = armature(shapes.joint, "skeleton")
    thing.parent = bones
    modifier = thing.modifiers.new("skeleton", "ARMATURE")
    modifier.object = bones
    modifier.show_viewport = False  # sampling clips need not deform the mesh
    return thing, bones, shapes


def build(person, clips, path, size=1024):
    """Makes the person with clips {name: (pose function, duration in seconds, extras)}."""
    reset()
    with tempfile.TemporaryDirectory() as folder:
        thing, parts, shapes = dressed(person, folder, size, 1.0)
        pictures = []
        for suffix in ("", "_normal"):
            with open(os.path.join(folder, person.name + suffix + ".jpg"), "rb") as f:
                pictures.append(f.read())
    details, keys = {"height_m": person.height_m, "clips": {}}, {}
    for name, (poses, frames, extras) in clips(person, shapes.joint).items():
        keys[name] = person_file.sampled(poses, frames)
        details["clips"][name] = dict(duration_s=frames / FPS, **extras)
    person_file.write(path, person.name, arrays(thing, parts, shapes), pictures, keys, FPS, details)


def arrays(thing, parts, shapes):
    """What person_file writes of the mesh."""
    v = np.concatenate([p["v"] for p in parts.values()]) * shapes.scale
    t = np.array([p.vertices[:] for p in thing.data.polygons])
    uv = sheets.read_uv(thing).reshape(-1, 2)
    unique, corner = np.unique(np.rint(uv * 65536), axis=0, return_inverse=True)
    material = np.empty(len(t), np.int32)
    thing.data.polygons.foreach_get("material_index", material)
    return {
        "v": v,
        "n": shell.normals(v, t),
        "uv": unique / 65536,
        "weights": np.concatenate([p["weights"] for p in parts.values()]),
        "t": t,
        "corners": corner.reshape(-1, 3),
        "material": material,
        "finishes": [(m.name.split("_")[-1], round(m["roughness"], 3)) for m in thing.data.materials],
        "joint": shapes.joint,
    }
