"""Renders the contact sheets assets/contact/*.jpg from the committed files.

Run: blender -b --factory-startup -P assets/author/contact.py -- [sheet ...]
Sheets: people, backs, faces, walk, clips, vehicles, kit, street, textures.
"""

import glob
import os
import sys

import bpy
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, HERE)

from lib import figure, gltf, picture, studio  # noqa: E402


def fresh(samples=10):
    figure.reset()
    return studio.stage(samples)


def files(folder, ext="glb"):
    return sorted(glob.glob(os.path.join(ROOT, folder, "*." + ext)))


def save(name, pictures, columns):
    """Grey would be what the camera sees; colour shows the paint better."""
    os.makedirs(os.path.join(ROOT, "contact"), exist_ok=True)
    sheet = studio.montage(pictures, columns)
    picture.jpeg_image(sheet, name, os.path.join(ROOT, "contact"), 85)


def people():
    pictures = []
    for path in files("people"):
        camera = fresh()
        things = studio.bring(path)
        studio.play(things, "stand", 0.0)
        pictures.append(studio.shoot(camera, (4.4, 1.6, 1.35), (0, 0, 0.97), 72, (200, 380)))
    save("people", pictures, 10)


def backs():
    pictures = []
    for path in files("people"):
        camera = fresh()
        things = studio.bring(path)
        studio.play(things, "walk", 0.12)
        pictures.append(studio.shoot(camera, (-4.2, 2.0, 1.35), (0, 0, 0.97), 72, (200, 380)))
    save("people_walking", pictures, 10)


def faces():
    pictures = []
    for path in files("people"):
        camera = fresh(16)
        things = studio.bring(path)
        studio.play(things, "stand", 0.0)
        tall = next(t for t in things if t.type == "ARMATURE")["aisle"]["height_m"]
        pictures.append(
            studio.shoot(camera, (1.3, 0.5, tall - 0.02), (0.02, 0, tall - 0.17), 88, (220, 240))
        )
    save("faces", pictures, 5)


def walk():
    path = files("people")[-2]
    pictures = []
    for clip in ("walk_slow", "walk", "walk_fast"):
        camera = fresh()
        things = studio.bring(path)
        duration = gltf.Glb(path).duration(clip)
        for k in range(8):
            studio.play(things, clip, duration * k / 8)
            pictures.append(studio.shoot(camera, (0.5, 4.3, 1.1), (0, 0, 0.92), 64, (180, 300)))
    save("walk", pictures, 8)


def clips():
    path = files("people")[-2]
    pictures = []
    camera = fresh()
    things = studio.bring(path)
    for clip, count in (
        ("turn_left", 4),
        ("wave", 2),
        ("look_around", 2),
        ("pick", 4),
        ("walk_carry", 2),
        ("walk_push", 2),
    ):
        duration = gltf.Glb(path).duration(clip)
        for k in range(count):
            studio.play(things, clip, duration * (k + 0.3) / count)
            pictures.append(studio.shoot(camera, (2.3, 3.5, 1.4), (0, 0, 0.95), 58, (190, 300)))
    save("clips", pictures, 8)


def vehicles():
    pictures = []
    for path in files("vehicles"):
        camera = fresh(12)
        things, glb = studio.bring(path), gltf.Glb(path)
        ridden = glb.facts().get("ridden", {}).get("clip")
        if ridden:
            studio.play(things, ridden, 0.0)
        low, high = glb.bounds(ridden)
        c, r = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
        for place in ((1.9, 1.3, 0.6), (-1.9, 1.5, 0.75)):
            eye = c + np.array(place) * r * 1.02
            pictures.append(studio.shoot(camera, eye, tuple(c - [0, 0, 0.03 * r]), 46, (360, 290)))
    save("vehicles", pictures, 4)


def kit(folder="kit"):
    pictures = []
    for path in files(folder):
        camera = fresh(12)
        studio.bring(path)
        low, high = gltf.Glb(path).bounds()
        c, r = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
        eye = c + np.array([1.9, 1.3, 0.9]) * r * 1.1
        pictures.append(studio.shoot(camera, eye, tuple(c), 42, (260, 240)))
    save(folder, pictures, 5)


def street():
    kit("street")


def textures():
    pictures = []
    for path in files("textures", "png"):
        image = bpy.data.images.load(path)
        w, h = image.size
        flat = np.empty(w * h * 4, np.float32)
        image.pixels.foreach_get(flat)
        a = flat.reshape(h, w, 4)[::-1, :, :3]
        k = max(1, max(w, h) // 256)
        a = a[: h // k * k, : w // k * k].reshape(h // k, k, w // k, k, 3).mean((1, 3))
        cell = np.full((256, 256, 3), 0.93, np.float32)
        cell[: a.shape[0], : a.shape[1]] = a[:256, :256]
        pictures.append(cell)
        bpy.data.images.remove(image)
    save("textures", pictures, 6)


SHEETS = {f.__name__: f for f in (people, backs, faces, walk, clips, vehicles, kit, street, textures)}


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else list(SHEETS)
    for name in wanted:
        SHEETS[name]()


if __name__ == "__main__":
    main()
