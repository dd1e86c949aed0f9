"""Assembles a person in Blender: unwrap, painted texture, armature, clips, and the .glb file."""

import os
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

from . import mesh, paint, picture, pose, rig

FPS = 40
DENSITY = {"head": 2.0, "hair": 1.1, "hands": 1.25, "helmet": 1.0, "vest": 1.1}


def reset():
    """An empty scene at the clips' frame rate."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = FPS


def join(parts, name):
    """One mesh object from all parts; returns (object, part index of every triangle)."""
    vertices, triangles, owner, skin, start = [], [], [], [], 0
    for i, part in enumerate(parts.values()):
        vertices.append(part["vertices"])
        triangles.append(part["triangles"] + start)
        owner.append(np.full(len(part["triangles"]), i))
        skin.append(part["weights"])
        start += len(part["vertices"])
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


def unwrap(thing, owner, names):
    """Smart projection, part by part scaled to its importance, packed into one sheet."""
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    thing.data.uv_layers.new(name="uv")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(
        angle_limit=np.radians(72),
        island_margin=0.0,
        area_weight=0.6,
        correct_aspect=False,
        scale_to_bounds=False,
    )
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = read_uv(thing)
    scale = np.array([DENSITY.get(n, 1.0) for n in names])[owner]
    uv = uv * scale[:, None, None]
    thing.data.uv_layers[0].data.foreach_set("uv", uv.ravel())
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    bpy.ops.uv.pack_islands(rotate=True, margin=0.003)
    bpy.ops.object.mode_set(mode="OBJECT")
    return read_uv(thing)


def read_uv(thing):
    """UVs (T, 3, 2) of a triangle mesh."""
    flat = np.empty(len(thing.data.loops) * 2)
    thing.data.uv_layers[0].data.foreach_get("uv", flat)
    return flat.reshape(-1, 3, 2)


def bake(thing, uv, owner, names, painter, size):
    """Paints the sheet: (size, size, 3)."""
    count = len(thing.data.vertices)
    co, no = np.empty(count * 3), np.empty(count * 3)
    thing.data.vertices.foreach_get("co", co)
    thing.data.vertices.foreach_get("normal", no)
    co, no = co.reshape(-1, 3), no.reshape(-1, 3)
    index = np.array([p.vertices[:] for p in thing.data.polygons])
    which = np.full((size, size), -1)
    where, normal = np.zeros((size, size, 3)), np.zeros((size, size, 3))
    for t, (tri, corners) in enumerate(zip(uv, index)):
        a = tri * [size, size] * [1, -1] + [0, size]
        lo = np.clip(np.floor(a.min(0) - 1.5).astype(int), 0, size - 1)
        hi = np.clip(np.ceil(a.max(0) + 1.5).astype(int), 0, size)
        gx, gy = np.meshgrid(np.arange(lo[0], hi[0]) + 0.5, np.arange(lo[1], hi[1]) + 0.5)
        d = np.array(
            [[a[1, 0] - a[0, 0], a[2, 0] - a[0, 0]], [a[1, 1] - a[0, 1], a[2, 1] - a[0, 1]]]
        )
        det = d[0, 0] * d[1, 1] - d[0, 1] * d[1, 0]
        if abs(det) < 1e-9:
            continue
        x, y = gx - a[0, 0], gy - a[0, 1]
        v, w = (d[1, 1] * x - d[0, 1] * y) / det, (d[0, 0] * y - d[1, 0] * x) / det
        edge = np.sqrt(abs(det)) + 1e-6
        inside = (v > -1.0 / edge) & (w > -1.0 / edge) & (v + w < 1 + 1.0 / edge)
        centre = (v >= 0) & (w >= 0) & (v + w <= 1)
        iy, ix = gy.astype(int), gx.astype(int)
        write = inside & ((which[iy, ix] < 0) | centre)
        iy, ix, v, w = iy[write], ix[write], v[write][:, None], w[write][:, None]
        p, n = co[corners], no[corners]
        where[iy, ix] = p[0] + v * (p[1] - p[0]) + w * (p[2] - p[0])
        normal[iy, ix] = n[0] + v * (n[1] - n[0]) + w * (n[2] - n[0])
        which[iy, ix] = owner[t]
    sheet = np.zeros((size, size, 3))
    for i, name in enumerate(names):
        mine = which == i
        n = normal[mine]
        n /= np.linalg.norm(n, axis=1, keepdims=True) + 1e-9
        sheet[mine] = painter.colour(name, where[mine], n)
    return spread(sheet, which >= 0, 10)


def spread(sheet, known, times):
    """Grows painted areas outwards so that filtering never meets bare sheet."""
    known = known.copy()
    for _ in range(times):
        total, count = np.zeros_like(sheet), np.zeros(known.shape)
        for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            k = np.roll(known, (dy, dx), (0, 1))
            total += np.roll(sheet, (dy, dx), (0, 1)) * k[..., None]
            count += k
        new = ~known & (count > 0)
        sheet[new] = total[new] / count[new][:, None]
        known |= new
    sheet[~known] = sheet[known].mean(0)
    return sheet


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


def material(image, name, roughness=0.85):
    """A matt material with one base-colour picture."""
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes = m.node_tree.nodes
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Specular"].default_value = 0.3
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    m.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
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


def still(person, shape, folder, size=512, detail=0.45):
    """The person as a rigid object held in one pose; shape(joint) makes the pose."""
    parts, shapes = mesh.build(person, detail)
    for name, part in parts.items():
        part["paired"] = name in mesh.PAIRED
    thing, owner = join(parts, person.name)
    thing.vertex_groups.clear()
    names = list(parts)
    uv = unwrap(thing, owner, names)
    sheet = bake(thing, uv, owner, names, paint.Painter(person, shapes, parts), size)
    thing.data.materials.append(
        material(picture.jpeg_image(sheet, person.name, folder), person.name)
    )
    held = shape(shapes.joint)
    skin = np.concatenate([p["weights"] for p in parts.values()])
    rest = np.concatenate([p["vertices"] for p in parts.values()])
    moved = np.zeros_like(rest)
    for b, (bone, (_, head, _)) in enumerate(rig.BONES.items()):
        at, turn = pose.place(held, shapes.joint, bone)
        moved += skin[:, b : b + 1] * ((rest - shapes.joint[head]) @ turn.T + at)
    thing.data.vertices.foreach_set("co", moved.ravel())
    thing.data.update()
    return thing


def on_bones(person, folder, size, detail=1.0):
    """The person's mesh on its skeleton in the rest pose: (mesh, armature, its shapes)."""
    parts, shapes = mesh.build(person, detail)
    for name, part in parts.items():
        part["paired"] = name in mesh.PAIRED
    thing, owner = join(parts, person.name)
    names = list(parts)
    uv = unwrap(thing, owner, names)
    painter = paint.Painter(person, shapes, parts)
    sheet = bake(thing, uv, owner, names, painter, size)
    image = picture.jpeg_image(sheet, person.name, folder)
    thing.data.materials.append(material(image, person.name))
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
        thing, bones, shapes = on_bones(person, folder, size)
        details = {"height_m": person.height_m, "clips": {}}
        for name, (poses, frames, extras) in clips(person, shapes.joint).items():
            clip(bones, shapes.joint, name, poses, frames)
            details["clips"][name] = dict(duration_s=frames / FPS, **extras)
        bones["aisle"] = details
        bones.animation_data.action = None
        export(path)
    return thing, bones
