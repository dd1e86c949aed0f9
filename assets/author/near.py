"""Contact sheets of the people 1 m and 2.5 m before the camera, rendered by aisle itself.

Run: blender -b --factory-startup -P assets/author/near.py -- [path of the aisle program [sheet ...]]
Writes assets/contact/people_1m.jpg, people_2_5m.jpg and people_2_5m_backs.jpg. Blender only reads
and writes the pictures.
"""

import glob
import os
import subprocess
import sys
import tempfile

import bpy
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, HERE)

from lib import picture, studio  # noqa: E402

SCENE = """about: People abreast before the camera.
frames: 3
rate_hz: 20
sensor: {{exposure_ms: 4}}
rig:
  camera_height_m: {eye}
  camera_forward_m: 0
  camera_pitch_deg: {pitch}
  start: [0, 0]
  steps: [{{wait_s: 9}}]
hall: {{from: [-4, -4], to: [9, 4], height_m: 4.5, walls: panels, floor: concrete, wear: 0.4}}
lights:
  - {{rows: 2, per_row: 4, height_m: 4.2}}
people:
{people}"""
PERSON = """  - name: {model}
    model: {model}
    start: [{far}, {aside:.2f}]
    heading_deg: {heading}
    steps: [{{wait_s: 9}}]
"""
# name: (distance, people in a picture, metres between them, eye, pitch, heading, crop (x, y, w, h))
SHEETS = {
    "people_1m": (1.0, 2, 0.68, 1.55, -4, 190, (76, 20, 600, 460)),
    "people_2_5m": (2.5, 4, 0.80, 0.95, 0, 165, (86, 60, 580, 400)),
    "people_2_5m_backs": (2.5, 4, 0.80, 0.95, 0, 20, (86, 60, 580, 400)),
}


def shoot(program, folder, models, view):
    """One picture (h, w, 3) of people abreast."""
    far, _, apart, eye, pitch, heading, _ = view
    middle = (len(models) - 1) / 2
    people = "".join(
        PERSON.format(model=m, far=far, aside=apart * (middle - i), heading=heading)
        for i, m in enumerate(models)
    )
    scene, out = os.path.join(folder, "scene.yaml"), os.path.join(folder, models[0])
    with open(scene, "w", encoding="utf-8") as f:
        f.write(SCENE.format(eye=eye, pitch=pitch, people=people))
    wanted = ["--out", out, "--frames", "1:2"]
    subprocess.run([program, "render", scene, *wanted], check=True, stdout=subprocess.DEVNULL)
    image = bpy.data.images.load(glob.glob(out + "/mav0/cam0/data/*.png")[0])
    w, h = image.size
    flat = np.empty(w * h * 4, np.float32)
    image.pixels.foreach_get(flat)
    bpy.data.images.remove(image)
    return flat.reshape(h, w, 4)[::-1, :, :3].copy()


def main():
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    program = given[0] if given else os.path.join(ROOT, "..", "build/release/harness/cli/aisle")
    os.environ["AISLE_ASSETS"] = ROOT
    models = sorted(f[:-4] for f in os.listdir(os.path.join(ROOT, "people")) if f.endswith(".glb"))
    for name in given[1:] or SHEETS:
        view = SHEETS[name]
        pictures, (x, y, w, h) = [], view[-1]
        with tempfile.TemporaryDirectory() as folder:
            for i in range(0, len(models), view[1]):
                shot = shoot(program, folder, models[i : i + view[1]], view)
                pictures.append(shot[y : y + h, x : x + w])
        sheet = studio.montage(pictures, 2)
        picture.jpeg_image(sheet, name, os.path.join(ROOT, "contact"), 82)


if __name__ == "__main__":
    main()
