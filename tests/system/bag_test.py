"""A rendered bag against the same frames as a EuRoC folder, read by programs of others.

@mcap/core and @foxglove/rosmsg2-serialization (npm) take the bag apart; where there is no npm, or
no way to its packages, those tests are skipped with a message. The SLAM must say of the bag, to the
bit, what it says of the folder.

Usage: bag_test.py PROGRAM SOURCE_FOLDER
"""

import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "tests/support"))
from dataset_reader import Dataset, read_grey_png  # noqa: E402

FRAMES = 24
EPOCH = 1_600_000_000_000_000_000
CAMERA = "camera: {size_px: [376, 240], focal_px: [217.6, 217.6], center_px: [183.35, 125.85]}\n"


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def readers():
    """The folder with the npm packages, or None and why not."""
    npm = shutil.which("npm")
    if not npm or not shutil.which("node"):
        return None, "no npm and node here"
    folder = pathlib.Path(os.environ.get("AISLE_NPM_FOLDER", Bag.root / "npm"))
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "read_bag.mjs"):
        shutil.copy(SOURCE / "tests/support/bag" / name, folder / name)
    if not (folder / "node_modules/@mcap/core").is_dir():
        done = subprocess.run([npm, "install", "--no-audit", "--no-fund"], cwd=folder,
                              capture_output=True, text=True)
        if done.returncode:
            return None, "npm install failed: " + done.stderr.strip()[-300:]
    return folder, ""


class Bag(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if hasattr(Bag, "root"):
            return
        Bag.root = pathlib.Path(tempfile.mkdtemp(prefix="aisle_bag_"))
        unittest.addModuleCleanup(shutil.rmtree, Bag.root)
        text = (SOURCE / "scenes/smoke/short.yaml").read_text()
        text = text.replace("frames: 40", f"frames: {FRAMES}\n{CAMERA}").split("\n", 1)[1]
        scene = Bag.root / "short.yaml"
        scene.write_text(text)
        for format in ("ros2", "euroc"):
            more = ["--truth", "depth,dynamic"] if format == "euroc" else []
            code, said = run("render", scene, "--out", Bag.root / format, "--format", format, *more)
            assert code == 0, said
        Bag.file = Bag.root / "ros2/drive.mcap"
        Bag.folder = Dataset(Bag.root / "euroc")


class TheProgram(Bag):
    def test_a_bag_in_and_a_folder_in_give_the_same_trajectory(self):
        tracks = {}
        for name, source in (("bag", self.file), ("folder", self.root / "euroc"),
                             ("bag_folder", self.root / "ros2")):
            out = self.root / f"{name}.txt"
            code, said = run("slam", source, "-o", out)
            self.assertEqual(code, 0, said)
            self.assertIn(f"{FRAMES} frames", said)
            tracks[name] = out.read_bytes()
        self.assertEqual(tracks["bag"], tracks["folder"])
        self.assertEqual(tracks["bag"], tracks["bag_folder"])

    def test_a_topic_of_a_bag_is_truth(self):
        track = self.root / "scored.txt"
        code, said = run("slam", self.file, "-o", track)
        self.assertEqual(code, 0, said)
        values = []
        truth = self.root / "euroc/mav0/state_groundtruth_estimate0/data.csv"
        for source in (f"{self.file}:/truth/pose", f"{self.file}:/truth/path", truth):
            code, said = run("score", "--truth", source, "--estimate", track, "--json")
            self.assertEqual(code, 0, said)
            values.append(json.loads(said)["scores"]["ate_rmse_m"]["value"])
        for value in values:
            self.assertAlmostEqual(value, values[0], delta=1e-9)
        code, said = run("score", "--truth", f"{self.file}:/truth/pos", "--estimate", track)
        self.assertEqual(code, 4)
        self.assertIn("/truth/pose", said)

    def test_the_same_command_writes_the_same_bytes(self):
        code, said = run("render", self.root / "short.yaml", "--out", self.root / "again",
                         "--format", "ros2", "--frames", ":3")
        self.assertEqual(code, 0, said)
        first = (self.root / "again/drive.mcap").read_bytes()
        run("render", self.root / "short.yaml", "--out", self.root / "again", "--format", "ros2",
            "--frames", ":3")
        self.assertEqual((self.root / "again/drive.mcap").read_bytes(), first)

    def test_the_layout_names_topics_of_the_bag(self):
        layout = json.loads((self.root / "ros2/foxglove_layout.json").read_text())
        self.assertIn("/truth/path", layout["configById"]["3D!plan"]["topics"])
        metadata = (self.root / "ros2/metadata.yaml").read_text()
        self.assertIn("version: 5", metadata)
        self.assertIn("/left/image_rect", metadata)


class ASuite(Bag):
    """One scene and its own bag, as a recording, in one suite; every run leaves a bag."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.root / "recorded.yaml").write_text("recording: ros2/drive.mcap\n"
                                                "topics: [/left/image_rect, /right/image_rect]\n")
        (cls.root / "both.yaml").write_text(
            "suite: both\nscenes: [short.yaml, recorded.yaml]\nsystems: [plain, oracle]\n"
            "twins: [live, empty]\nseeds: [1]\n")
        cls.out = cls.root / "out"
        cls.code, cls.said = run("run", cls.root / "both.yaml", "--out", cls.out, "--mcap",
                                 "--no-video")
        cls.results = json.loads((cls.out / "results.json").read_text())

    def track(self, scene, name="live.txt"):
        text = (self.out / "runs" / scene / "live/plain/1" / name).read_text()
        return [line.split() for line in text.splitlines() if not line.startswith("#")]

    def test_the_recording_is_driven_once_by_those_that_need_no_truth(self):
        self.assertIn(self.code, (0, 1), self.said)
        cells = sorted((run["scene"], run["twin"], run["system"]) for run in self.results["runs"])
        self.assertEqual(cells, [("recorded", "live", "plain"),
                                 ("short", "empty", "oracle"), ("short", "empty", "plain"),
                                 ("short", "live", "oracle"), ("short", "live", "plain")])
        recorded = [run for run in self.results["runs"] if run["scene"] == "recorded"][0]
        self.assertEqual(recorded["status"], "ok")
        self.assertIsNotNone(recorded["scores"]["ate_rmse_m"]["value"])

    def test_it_is_the_scene_to_the_bit(self):
        for name in ("live.txt", "final.txt"):
            scene, recorded = self.track("short", name), self.track("recorded", name)
            self.assertEqual([row[1:] for row in scene], [row[1:] for row in recorded])
            self.assertGreater(len(scene), FRAMES // 2)

    def test_one_bag_holds_the_frames_and_every_system(self):
        bag = self.out / "bags/short/live/1/drive.mcap"
        self.assertTrue((bag.parent / "metadata.yaml").is_file())
        self.assertIn("/oracle/path", (bag.parent / "foxglove_layout.json").read_text())
        self.assertTrue((self.out / "bags/recorded/live/1/drive.mcap").is_file())
        for system in ("plain", "oracle"):
            code, said = run("score", "--truth", f"{bag}:/truth/pose", "--estimate",
                             f"{bag}:/{system}/final_path", "--json")
            self.assertEqual(code, 0, said)
            mine = json.loads(said)["scores"]["ate_rmse_m"]["value"]
            of_run = [run for run in self.results["runs"] if run["scene"] == "short" and
                      run["twin"] == "live" and run["system"] == system][0]
            self.assertAlmostEqual(mine, of_run["scores"]["ate_rmse_m"]["value"], delta=1e-9)


class OthersReadIt(Bag):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder, why = readers()
        if folder is None:
            raise unittest.SkipTest(why)
        done = subprocess.run(["node", folder / "read_bag.mjs", cls.file], capture_output=True,
                              text=True, cwd=folder)
        assert done.returncode == 0, done.stderr
        cls.bag = json.loads(done.stdout)

    def values(self, topic):
        return [message["value"] for message in self.bag["topics"][topic]["messages"]]

    def test_it_is_a_bag_of_ros2(self):
        self.assertEqual(self.bag["profile"], "ros2")
        for name, topic in self.bag["topics"].items():
            self.assertEqual(topic["encoding"], "cdr", name)
            self.assertEqual(topic["schema"], "ros2msg", name)
            self.assertRegex(topic["type"], r"^\w+/msg/\w+$")
        self.assertIn("durability: 1", self.bag["topics"]["/tf_static"]["qos"])
        self.assertIn("durability: 2", self.bag["topics"]["/tf"]["qos"])
        total = sum(len(topic["messages"]) for topic in self.bag["topics"].values())
        self.assertEqual(total, self.bag["counted"])
        self.assertEqual(total, self.bag["streamed"])
        self.assertTrue(self.bag["done"])
        self.assertIn("scene", self.bag["metadata"]["aisle"])
        self.assertEqual(self.bag["attachments"][0]["name"], "short.yaml")

    def test_log_time_is_the_header_s(self):
        for topic in self.bag["topics"].values():
            for message in topic["messages"]:
                value = message["value"]
                if isinstance(value, dict) and value.get("stamp"):
                    self.assertEqual(message["log"], value["stamp"])

    def test_the_pictures_are_those_of_the_folder(self):
        names = sorted((self.root / "euroc/mav0/cam0/data").iterdir())
        self.assertEqual(len(names), FRAMES)
        for side, camera in (("left", "cam0"), ("right", "cam1")):
            images = self.values(f"/{side}/image_rect")
            self.assertEqual(len(images), FRAMES)
            for image, name in zip(images, names):
                self.assertEqual(image["stamp"], name.stem)
                picture = read_grey_png(self.root / "euroc/mav0" / camera / "data" / name.name)
                self.assertEqual(image["data"], hashlib.sha256(picture.tobytes()).hexdigest())
                self.assertEqual((image["width"], image["height"], image["step"]), (376, 240, 376))
                self.assertEqual(image["encoding"], "mono8")

    def test_truth_is_that_of_the_folder(self):
        for i, (pose, moving, depth) in enumerate(
                zip(self.values("/truth/pose"), self.values("/left/moving"), self.values("/left/depth"))):
            place = [pose["pose"]["position"][axis] for axis in "xyz"]
            np.testing.assert_allclose(place, self.folder.poses[i][:3, 3], atol=1e-12)
            mask = self.folder.truth("dynamic", i).astype(np.uint8)
            self.assertEqual(moving["data"], hashlib.sha256(mask.tobytes()).hexdigest())
            millimetres = self.folder.truth("depth_mm", i).astype("<u2")
            self.assertEqual(depth["data"], hashlib.sha256(millimetres.tobytes()).hexdigest())
            self.assertEqual(depth["encoding"], "16UC1")
        stamps = self.values("/truth/path")[0]["stamps"]
        self.assertEqual(len(stamps), FRAMES)

    def test_the_calibration_is_that_of_the_folder(self):
        left, right = (self.values(f"/{side}/camera_info")[0] for side in ("left", "right"))
        self.assertEqual([left["p"][0], left["p"][2], left["p"][6]],
                         [self.folder.fx, self.folder.cx, self.folder.cy])
        self.assertAlmostEqual(-right["p"][3] / right["p"][0], self.folder.baseline, delta=1e-15)
        self.assertEqual(left["d"], [0, 0, 0, 0, 0])

    def test_every_frame_has_one_parent_and_they_join(self):
        parents = {}
        for message in self.values("/tf_static") + self.values("/tf"):
            for transform in message:
                parents.setdefault(transform["child"], set()).add(transform["parent"])
        self.assertTrue(all(len(of) == 1 for of in parents.values()), parents)
        frame = "camera_right_optical_frame"
        way = [frame]
        while frame in parents:
            frame = next(iter(parents[frame]))
            way.append(frame)
        self.assertEqual(way, ["camera_right_optical_frame", "camera_left_optical_frame", "base_link",
                               "odom", "map"])

    def test_objects_are_drawn(self):
        boxes = [m for markers in self.values("/truth/boxes") for m in markers if m["type"] == 1]
        self.assertTrue(any(m["action"] == 0 and m["scale"]["z"] > 1 for m in boxes))
        self.assertTrue(any(image["points"] for image in self.values("/left/boxes")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
