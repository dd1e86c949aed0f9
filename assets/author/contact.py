"""Renders the contact sheets assets/contact/*.jpg from the committed files.

Run: blender -b --factory-startup -P assets/author/contact.py -- [sheet ...]
Sheets: walk, clips, vehicles, kit, street, textures (near.py makes those of the people), and by aisle's own
camera, which needs ./aisle built: near (vehicles from 1 m), beside (from 2.5 m), town (a street from 10 m).
"""

import glob
import os
import sys
import tempfile

import bpy
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, HERE)

from lib import figure, gltf, photo, picture, studio  # noqa: E402


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
            pictures.append(studio.shoot(camera, eye, tuple(c - [0, 0, 0.03 * r]), 46, (300, 242)))
    save("vehicles", pictures, 6)


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


# Vehicles in photographs: (model, middle ahead of its origin, half its length).
PHOTOGRAPHED = (
    ("car_red", 1.28, 2.0), ("car_silver", 1.37, 2.3), ("car_van", 1.52, 2.45), ("bus", 2.35, 5.3),
    ("forklift_driver", -0.5, 1.7), ("order_picker", -0.3, 1.5), ("scrubber", 0.3, 1.0), ("tow_tractor", 0.5, 1.0),
)  # fmt: skip
HALL = """hall: {{from: [-8, -9], to: [{end}, 9], height_m: 7}}
lights:
  - {{rows: 4, per_row: {lamps}, height_m: 6.6, size_m: [1.6, 0.4], brightness: 0.55}}
vehicles:
"""


def photographs(scene, views, size, focal):
    """By aisle's own camera: grey, as methods see it."""
    aisle = os.environ.get("AISLE_PROGRAM", os.path.join(ROOT, "..", "aisle"))
    with tempfile.TemporaryDirectory() as folder:
        return [studio.load(path) for path in photo.shoot(aisle, folder, scene, views, size, focal)]


def vehicle_photographs(apart, turns):
    """Pictures of every vehicle in a hall from `apart` metres beside it, at turns (degrees, 0 ahead)."""
    scene = HALL.format(end=14 * len(PHOTOGRAPHED) + 4, lamps=3 * len(PHOTOGRAPHED))
    views = []
    for i, (model, ahead, half) in enumerate(PHOTOGRAPHED):
        x = 14 * i
        scene += f"  - {{name: v{i}, model: {model}, level: none, start: [{x}, 0]}}\n"
        for turn in turns:
            a = np.radians(turn)
            wide = 1.25 if model == "bus" else 0.9 if model.startswith("car") else 0.5
            place = np.array([half * np.cos(a) + apart * np.cos(a), (wide + apart) * np.sin(a)])
            look = np.array([x + ahead + 0.55 * half * np.cos(a), 0.4 * wide * np.sin(a)])
            eye = (x + ahead + place[0], place[1], 1.35)
            views.append((eye, (look[0], look[1], 0.80 if apart < 2 else 0.9)))
    return photographs(scene, views, (448, 320), 300)


def near():
    save("near", vehicle_photographs(1.0, (40, 150)), 4)


def beside():
    save("beside", vehicle_photographs(2.5, (35, 145)), 4)


def town():
    """Houses and trees across a street, and along it."""
    scene = """hall: {from: [-15, -30], to: [95, 30], height_m: 40, floor: asphalt, walls: sky, wear: 0.4}
lights:
  - {rows: 2, per_row: 4, height_m: 39, size_m: [54, 58], brightness: 0.28}
sensor: {auto_exposure: true, auto_meter_from: 0.5, auto_target_grey: 95}
markings:
  - {kind: pavement, from: [-15, -30], to: [95, -5]}
  - {kind: pavement, from: [-15, 9], to: [95, 30]}
props:
  - {model: house_brick, at: [5, -9], heading_deg: 90}
  - {model: house_plaster, at: [19, -9], heading_deg: 90}
  - {model: house_grey, at: [33, -9], heading_deg: 90}
  - {model: house_shop, at: [5, 13], heading_deg: -90}
  - {model: house_tall, at: [19, 13], heading_deg: -90}
  - {model: tree_round, at: [48, -6], heading_deg: 0}
  - {model: tree_slim, at: [55, -6], heading_deg: 0}
  - {model: hedge, at: [49.5, -7], heading_deg: 90}
  - {model: hedge, at: [52.55, -7], heading_deg: 90}
  - {model: tree_round, at: [33, 10], heading_deg: 90}
vehicles:
  - {name: a, model: car_red, level: none, start: [28, -3.4]}
  - {name: b, model: bus, level: none, start: [34, 6], heading_deg: 180}
"""
    views = [((x, y, 1.65), (x, t, 3.2)) for x, y, t in ((5, 1, -9), (19, 1, -9), (33, 1, -9), (5, 3, 13), (19, 3, 13))]
    views += [((51.5, 4, 1.65), (51.5, -6, 3.0)), ((14, 1.5, 1.65), (40, 1, 2.4)), ((60, 2, 1.65), (30, 1, 2.6))]
    save("town", photographs(scene, views, (448, 320), 300), 4)


SHEETS = {f.__name__: f for f in (walk, clips, vehicles, kit, street, textures, near, beside, town)}


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else list(SHEETS)
    for name in wanted:
        SHEETS[name]()


if __name__ == "__main__":
    main()
