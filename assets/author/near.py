"""Contact sheets of the people 1 m and 2.5 m before the camera, rendered by aisle itself.

Run: blender -b --factory-startup -P assets/author/near.py -- [path of the aisle program]
Writes assets/contact/people_1m.jpg (who looks at the camera, who looks aside) and people_2_5m.jpg
(standing, from behind while walking away). Blender only reads and writes the pictures.
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

from lib import gltf, picture, studio  # noqa: E402

SCENE = """about: One person before the camera.
frames: {frames}
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
  - name: who
    model: {model}
    start: [{far}, 0]
    heading_deg: {heading}
    steps:
      - {step}
"""


def shoot(program, folder, model, height, view):
    """One picture (h, w, 3) of a person."""
    far, heading, frame, step = view
    near = far < 2
    text = SCENE.format(
        frames=frame + 2,
        eye=round(height - 0.15 if near else 0.95, 3),
        pitch=-6 if near else 0,
        model=model,
        far=far,
        heading=heading,
        step=step,
    )
    scene = os.path.join(folder, f"{model}.yaml")
    with open(scene, "w", encoding="utf-8") as f:
        f.write(text)
    out = os.path.join(folder, f"{model}_{far}_{heading}")
    wanted = ["--out", out, "--frames", f"{frame}:{frame + 1}"]
    subprocess.run([program, "render", scene, *wanted], check=True, stdout=subprocess.DEVNULL)
    image = bpy.data.images.load(glob.glob(out + "/mav0/cam0/data/*.png")[0])
    w, h = image.size
    flat = np.empty(w * h * 4, np.float32)
    image.pixels.foreach_get(flat)
    bpy.data.images.remove(image)
    return flat.reshape(h, w, 4)[::-1, :, :3].copy()


STAND = "{wait_s: 9}"
SHEETS = {  # name: (views (distance, heading, frame, step), crop (x, y, w, h))
    "people_1m": (((1.0, 195, 1, STAND), (1.0, 125, 1, STAND)), (226, 60, 300, 420)),
    "people_2_5m": (
        ((2.5, 165, 1, STAND), (2.3, 15, 12, "{go: [[8, 1.5]], speed_mps: 1.2}")),
        (276, 75, 200, 380),
    ),
}


def main():
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    program = given[0] if given else os.path.join(ROOT, "..", "build/release/harness/cli/aisle")
    os.environ["AISLE_ASSETS"] = ROOT
    for name, (views, (x, y, w, h)) in SHEETS.items():
        pictures = []
        with tempfile.TemporaryDirectory() as folder:
            for path in sorted(glob.glob(os.path.join(ROOT, "people", "*.glb"))):
                model = os.path.basename(path)[:-4]
                height = gltf.Glb(path).facts()["height_m"]
                for view in views:
                    shot = shoot(program, folder, model, height, view)
                    pictures.append(shot[y : y + h, x : x + w])
        sheet = studio.montage(pictures, 8)
        picture.jpeg_image(sheet, name, os.path.join(ROOT, "contact"), 82)


if __name__ == "__main__":
    main()
