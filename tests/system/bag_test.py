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


class Wheels(Bag):
    """What wheels measured, as a bag and as folders hold it, is what the SLAM is handed."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if hasattr(Bag, "wheels"):
            return
        Bag.wheels = Bag.root / "wheels"
        for format in ("ros2", "euroc", "kitti"):
            code, said = run("render", Bag.root / "short.yaml", "--out", Bag.wheels / format,
                             "--format", format, "--odometry")
            assert code == 0, said

    def track(self, name, *arguments):
        out = self.root / f"wheels_{name}.txt"
        code, said = run("slam", *arguments, "--system", "robust", "-o", out)
        self.assertEqual(code, 0, said)
        rows = [line.split() for line in out.read_text().splitlines() if not line.startswith("#")]
        return np.array(rows, float)[:, 1:]

    def test_the_slam_is_handed_them_from_bag_and_folders(self):
        bag = self.wheels / "ros2/drive.mcap"
        alone = self.track("none", bag)
        told = self.track("bag", bag, "--odometry", "/odom")
        euroc = self.track("euroc", self.wheels / "euroc", "--set", "odometry=true")
        kitti = self.track("kitti", self.wheels / "kitti", "--format", "kitti", "--set", "odometry=true")
        self.assertEqual(len(told), FRAMES)
        self.assertGreater(np.abs(told - alone).max(), 0)
        # A folder does not say how sure its wheels are: its tracks are a little different ones.
        for track in (euroc, kitti):
            np.testing.assert_allclose(track[:, :3], told[:, :3], atol=5e-3)

    def test_a_suite_hands_them_on(self):
        (self.wheels / "recorded.yaml").write_text("recording: ros2/drive.mcap\nodometry: /odom\n")
        (self.wheels / "suite.yaml").write_text(
            "suite: wheels\nscenes: [recorded.yaml, ../short.yaml]\n"
            "systems: [{name: told, like: robust, options: {odometry: true}}]\n"
            "twins: [live]\nseeds: [1]\n")
        code, said = run("run", self.wheels / "suite.yaml", "--out", self.wheels / "out", "--no-video")
        self.assertIn(code, (0, 1), said)
        tracks = []
        for scene in ("recorded", "short"):
            text = (self.wheels / f"out/runs/{scene}/live/told/1/live.txt").read_text()
            tracks.append(np.array([line.split()[1:] for line in text.splitlines()
                                    if not line.startswith("#")], float))
        np.testing.assert_allclose(tracks[0], tracks[1], atol=1e-6)

    def test_a_topic_that_is_not_there_is_named(self):
        code, said = run("slam", self.wheels / "ros2/drive.mcap", "--odometry", "/odm", "-o",
                         self.root / "never.txt")
        self.assertEqual(code, 4)
        self.assertIn("did you mean /odom?", said)
        (self.wheels / "mistyped.yaml").write_text("recording: ros2/drive.mcap\nodometry: /odm\n")
        code, said = run("check", self.wheels / "mistyped.yaml")
        self.assertEqual(code, 4)
        self.assertIn("did you mean /odom?", said)
        code, said = run("slam", self.file, "--odometry", "/odom", "-o", self.root / "never.txt")
        self.assertEqual(code, 4)
        self.assertIn("topics of that type: none", said)


class ReadByOthers:
    """A bag as the readers of others take it apart, in `bag`."""

    @classmethod
    def read(cls, file):
        folder, why = readers()
        if folder is None:
            raise unittest.SkipTest(why)
        done = subprocess.run(["node", folder / "read_bag.mjs", file], capture_output=True,
                              text=True, cwd=folder)
        assert done.returncode == 0, done.stderr
        cls.bag = json.loads(done.stdout)

    def values(self, topic):
        return [message["value"] for message in self.bag["topics"][topic]["messages"]]

    def way_up_from(self, frame):
        """The frames from one to the root; each has one parent."""
        parents = {}
        for message in self.values("/tf_static") + self.values("/tf"):
            for transform in message:
                parents.setdefault(transform["child"], set()).add(transform["parent"])
        self.assertTrue(all(len(of) == 1 for of in parents.values()), parents)
        way = [frame]
        while way[-1] in parents:
            way.append(next(iter(parents[way[-1]])))
        return way


def matrix(position, orientation):
    x, y, z, w = (orientation[key] for key in "xyzw")
    pose = np.eye(4)
    pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    pose[:3, 3] = [position[key] for key in "xyz"]
    return pose


class OthersReadTheWheels(ReadByOthers, Wheels):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.read(cls.wheels / "ros2/drive.mcap")

    def test_map_to_base_is_truth_and_odom_to_base_the_wheels(self):
        self.assertEqual(self.way_up_from("camera_left_optical_frame"),
                         ["camera_left_optical_frame", "base_link", "odom", "map"])
        said = self.values("/odom")
        self.assertEqual(len(said), FRAMES)
        fixed = {one["child"]: one for message in self.values("/tf_static") for one in message}
        mounted = fixed["camera_left_optical_frame"]["transform"]
        T_base_left = matrix(mounted["translation"], mounted["rotation"])
        for reading, transforms, truth in zip(said, self.values("/tf"), self.values("/truth/pose")):
            T = {one["child"]: matrix(one["transform"]["translation"], one["transform"]["rotation"])
                 for one in transforms}
            wheels = matrix(reading["pose"]["position"], reading["pose"]["orientation"])
            np.testing.assert_allclose(T["base_link"], wheels, atol=1e-12)
            np.testing.assert_allclose(T["odom"] @ T["base_link"] @ T_base_left,
                                       matrix(truth["pose"]["position"], truth["pose"]["orientation"]),
                                       atol=1e-9)
            self.assertEqual((reading["frame"], reading["child"]), ("odom", "base_link"))

    def test_twist_and_covariance_are_those_of_the_way(self):
        said = self.values("/odom")
        before = None
        for reading in said:
            pose = matrix(reading["pose"]["position"], reading["pose"]["orientation"])
            if before is not None:
                seconds = (int(reading["stamp"]) - before[1]) * 1e-9
                moved = np.linalg.inv(before[0]) @ pose
                linear = [reading["twist"]["linear"][axis] for axis in "xyz"]
                np.testing.assert_allclose(linear, moved[:3, 3] / seconds, atol=1e-6)
                spread = np.array(reading["twist_covariance"]).reshape(6, 6)
                self.assertGreater(np.linalg.eigvalsh(spread).min(), 0)
            before = pose, int(reading["stamp"])
        growth = [np.array(reading["covariance"]).reshape(6, 6)[5, 5] for reading in said]
        self.assertEqual(growth[0], 0)
        self.assertTrue(np.all(np.diff(growth) > 0), growth)


class OthersReadIt(ReadByOthers, Bag):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.read(cls.file)

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
        self.assertEqual(self.way_up_from("camera_right_optical_frame"),
                         ["camera_right_optical_frame", "camera_left_optical_frame", "base_link",
                          "odom", "map"])

    def test_objects_are_drawn(self):
        boxes = [m for markers in self.values("/truth/boxes") for m in markers if m["type"] == 1]
        self.assertTrue(any(m["action"] == 0 and m["scale"]["z"] > 1 for m in boxes))
        self.assertTrue(any(image["points"] for image in self.values("/left/boxes")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
