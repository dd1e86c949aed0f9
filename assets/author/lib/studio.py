"""Renders assets for contact sheets: Cycles on the CPU, few samples, grey warehouse light."""

import bpy
import numpy as np
from mathutils import Vector


def stage(samples=16):
    """Floor, sky, lamps and camera in the current scene."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.seed = 1
    scene.view_settings.view_transform = "Standard"
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.42, 0.43, 0.46, 1)
    scene.world = world
    for place, size, power in (((2.5, 2.0, 4.5), 2.0, 260), ((-2.5, -1.0, 4.5), 2.5, 150)):
        data = bpy.data.lights.new("lamp", "AREA")
        data.energy, data.size = power, size
        lamp = bpy.data.objects.new("lamp", data)
        lamp.location = place
        aim(lamp, (0, 0, 0.8))
        scene.collection.objects.link(lamp)
    floor()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def floor():
    """A pale floor with a tape line every metre, to judge where feet stand."""
    data = bpy.data.meshes.new("floor")
    data.from_pydata([(-15, -15, 0), (15, -15, 0), (15, 15, 0), (-15, 15, 0)], [], [(0, 1, 2, 3)])
    thing = bpy.data.objects.new("floor", data)
    m = bpy.data.materials.new("floor")
    m.use_nodes = True
    nodes = m.node_tree.nodes
    checker = nodes.new("ShaderNodeTexChecker")
    checker.inputs["Scale"].default_value = 2.0
    checker.inputs["Color1"].default_value = (0.33, 0.33, 0.33, 1)
    checker.inputs["Color2"].default_value = (0.28, 0.28, 0.28, 1)
    coordinates = nodes.new("ShaderNodeTexCoord")
    m.node_tree.links.new(coordinates.outputs["Object"], checker.inputs["Vector"])
    m.node_tree.links.new(checker.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    data.materials.append(m)
    bpy.context.scene.collection.objects.link(thing)


def aim(thing, target):
    thing.rotation_euler = (Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()


def shoot(camera, place, target, lens, size):
    """One picture (h, w, 3) in sRGB from place towards target."""
    scene = bpy.context.scene
    camera.location = place
    aim(camera, target)
    camera.data.lens = lens
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    path = bpy.app.tempdir + "shot.png"
    scene.render.filepath = path
    scene.render.image_settings.file_format = "PNG"
    bpy.ops.render.render(write_still=True)
    return load(path)


def load(path):
    """A picture file (h, w, 3) in sRGB."""
    image = bpy.data.images.load(path)
    w, h = image.size
    flat = np.empty(w * h * 4, np.float32)
    image.pixels.foreach_get(flat)
    bpy.data.images.remove(image)
    return flat.reshape(h, w, 4)[::-1, :, :3].copy()


# The importer of Blender 3.4 still uses an alias that newer numpy dropped.
if not hasattr(np, "bool"):
    np.bool = bool


def bring(path):
    """Imports a .glb; returns its new objects."""
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=path)
    for action in bpy.data.actions:
        action.use_fake_user = True
    return [o for o in bpy.data.objects if o not in before]


def play(things, clip, seconds):
    """Poses imported things at a time of a clip."""
    fps = bpy.context.scene.render.fps
    for thing in things:
        if thing.type != "ARMATURE":
            continue
        for track in thing.animation_data.nla_tracks:
            track.mute = True
        name = next(
            a for a in bpy.data.actions if a.name.split("_skeleton")[0] == clip or a.name == clip
        )
        thing.animation_data.action = name
    frame = seconds * fps
    bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))


def montage(pictures, columns, gap=3):
    """Pictures of one size in a grid."""
    h, w, _ = pictures[0].shape
    rows = -(-len(pictures) // columns)
    out = np.ones((rows * (h + gap) - gap, columns * (w + gap) - gap, 3), np.float32)
    for i, p in enumerate(pictures):
        r, c = divmod(i, columns)
        out[r * (h + gap) : r * (h + gap) + h, c * (w + gap) : c * (w + gap) + w] = p
    return out
