"""A rig of a user's own: two pairs and colour from one scene, and the way out of a bag.

Usage: rig_test.py PROGRAM SOURCE_DIR
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "tests/support"))

from dataset_reader import Dataset, read_colour_png, read_grey_png  # noqa: E402
from made_models import Glb, box  # noqa: E402

SCENE = """about: Two pairs, and colour.
frames: 4
camera: {size_px: [160, 120], focal_px: [90, 90], center_px: [80, 60], colour: %s}
sensor: {noise: false, fixed_pattern: false, preset: ideal}
rig:
%s
  camera_height_m: 1
  pairs:
  - {name: rear, camera_yaw_deg: 180, camera_forward_m: -0.3, camera_height_m: 1.1,
     camera: {size_px: [128, 96], focal_px: [80, 80], center_px: [64, 48]}}
hall: {from: [-6, -4], to: [8, 4], height_m: 4, walls: plain}
lights: [{height_m: 3.8}]
props:
- {mesh: red.glb, at: [4, 0]}
- {mesh: blue.glb, at: [-4, 0]}
"""
STEPS = "  start: [0, 0]\n  steps: [{go: [[2, 0.4]], speed_mps: 0.9}]"


def aisle(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout if code == 0 else done.stderr


class Rig(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="aisle_rig_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        for name, rgb in (("red", (0.7, 0.1, 0.1)), ("blue", (0.1, 0.1, 0.7))):
            glb = Glb()
            glb.node("Box", mesh=glb.mesh(box((-0.5, -0.8, 0), (0.5, 0.8, 1.6)),
                                          glb.material(rgb)))
            (cls.folder / f"{name}.glb").write_bytes(glb.bytes())
        cls.scene = cls.write("scene.yaml", "true", STEPS)
        for pair in ("", "rear"):
            aisle("render", cls.scene, "--out", cls.folder / f"euroc_{pair}", "--truth", "depth",
                  *(["--pair", pair] if pair else []))
        aisle("render", cls.scene, "--out", cls.folder / "bag", "--format", "ros2")

    @classmethod
    def write(cls, name, colour, steps):
        (cls.folder / name).write_text(SCENE % (colour, steps))
        return cls.folder / name

    def test_both_pairs_are_datasets_of_one_drive(self):
        front, rear = Dataset(self.folder / "euroc_"), Dataset(self.folder / "euroc_rear")
        self.assertEqual(front.stamps_ns, rear.stamps_ns)
        self.assertEqual((rear.fx, rear.cx), (80, 64))
        self.assertEqual(rear.about["pair"], "rear")
        between = [np.linalg.inv(a) @ b for a, b in zip(front.poses, rear.poses)]
        # By hand: half a turn about the vertical; 0.6 m back and 0.1 m up in the front's axes.
        expected = np.array([[-1, 0, 0, 0], [0, 1, 0, -0.1], [0, 0, -1, -0.6], [0, 0, 0, 1]])
        for one in between:
            np.testing.assert_allclose(one, expected, atol=1e-9)
        mount = np.reshape(list(map(float, rear.about["T_vehicle_left_camera"].split())), (4, 4))
        np.testing.assert_allclose(mount[:3, 3], [-0.3, 0, 1.1], atol=1e-12)
        self.assertAlmostEqual(float(rear.truth("depth", 0)[60, 64]), 4 - 0.5 - 0.3, delta=1e-4)

    def test_colour_is_what_the_materials_say_and_grey_stays_grey(self):
        mav = self.folder / "euroc_/mav0"
        name = Dataset(self.folder / "euroc_").names[0] + ".png"
        for camera in ("cam0_rgb", "cam1_rgb"):
            red = read_colour_png(mav / camera / "data" / name).astype(float)
            self.assertEqual(red.shape, (120, 160, 3))
            box_r, box_g, box_b = red[60:75, 76:84].reshape(-1, 3).mean(axis=0)
            self.assertGreater(box_r, 1.8 * box_g)
            self.assertLess(abs(box_g - box_b), 6)
            wall = red[10:25, 20:40].reshape(-1, 3)  # grey; what the box throws on it apart
            self.assertLess(np.ptp(wall.mean(axis=0)), 5)
        rear = self.folder / "euroc_rear/mav0/cam0_rgb/data" / name
        self.assertFalse(rear.exists())  # that pair's camera has none

    def test_grey_pictures_do_not_know_of_colour(self):
        scene = self.write("grey.yaml", "false", STEPS)
        aisle("render", scene, "--out", self.folder / "grey")
        coloured = Dataset(self.folder / "euroc_")
        for one, other in zip(Dataset(self.folder / "grey").left, coloured.left):
            np.testing.assert_array_equal(read_grey_png(one), read_grey_png(other))
        self.assertFalse((self.folder / "grey/mav0/cam0_rgb").exists())

    def test_the_other_formats_have_colour_too(self):
        first = read_colour_png(next((self.folder / "euroc_/mav0/cam0_rgb/data").glob("*.png")))
        for form, path in (("kitti", "sequences/00/image_2"), ("tum", "rgb_colour")):
            out = self.folder / form
            aisle("render", self.scene, "--out", out, "--format", form, "--frames", "0:1")
            picture = read_colour_png(next((out / path).glob("*.png")))
            self.assertEqual(picture.shape, first.shape)
        metadata = (self.folder / "bag/metadata.yaml").read_text()
        self.assertIn("/left/image_rect_color", metadata)
        self.assertIn("/right/image_rect_color", metadata)

    def test_the_way_of_a_bag_is_driven_again(self):
        again = "  trajectory: bag/drive.mcap:/truth/pose\n  trajectory_of: camera"
        scene = self.write("again.yaml", "false", again)
        aisle("check", scene)
        for pair in ("", "rear"):
            out = self.folder / f"again_{pair}"
            aisle("render", scene, "--out", out, *(["--pair", pair] if pair else []))
            for one, other in zip(Dataset(out).poses, Dataset(self.folder / f"euroc_{pair}").poses):
                np.testing.assert_allclose(one, other, atol=1e-9)
        wrong = self.write("wrong.yaml", "false", again.replace("/truth/pose", "/nothing"))
        self.assertIn("/truth/pose", aisle("check", wrong, code=4))

    def test_a_bag_and_a_tum_file_of_one_way_are_one_way(self):
        truth = Dataset(self.folder / "euroc_")
        rows = []
        data = (self.folder / "euroc_/mav0/state_groundtruth_estimate0/data.csv").read_text()
        for row in data.splitlines()[1:]:
            n = row.split(",")
            seconds = f"{int(n[0]) // 10**9}.{int(n[0]) % 10**9:09d}"
            rows.append(" ".join([seconds, *n[1:4], *n[5:8], n[4]]))
        (self.folder / "way.txt").write_text("\n".join(rows) + "\n")
        steps = "  trajectory: %s\n  trajectory_of: camera"
        tum = self.write("tum.yaml", "false", steps % "way.txt")
        aisle("render", tum, "--out", self.folder / "tum_way")
        for one, other in zip(Dataset(self.folder / "tum_way").poses, truth.poses):
            np.testing.assert_allclose(one, other, atol=1e-9)

    def test_a_start_is_asked_of_those_who_drive_a_route(self):
        scene = self.write("nostart.yaml", "false", "  steps: []")
        self.assertIn("start", aisle("check", scene, code=4))
        schema = json.loads((SOURCE / "scenes/scene.schema.json").read_text())
        rig = schema["anyOf"][1]["properties"]["rig"]
        self.assertNotIn("start", rig.get("required", []))
        self.assertIn({"required": ["trajectory"]}, rig["anyOf"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
