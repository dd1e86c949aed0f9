"""Exports a short scene in every format and range, and reads it with a reader of another make.

Checked is what the files mean, not only that they are read: images, poses and truth of one name
belong to one frame of the scene, and flow, scene flow, depth, disparity, labels and boxes agree with
each other through the calibration.

Usage: dataset_test.py PROGRAM SOURCE_FOLDER
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "tests/support"))
from dataset_reader import Dataset, read_grey_png, rotation  # noqa: E402

FRAMES = 24
CAMERA = "camera: {size_px: [376, 240], focal_px: [217.6, 217.6], center_px: [183.35, 125.85]}\n"
KINDS = ["depth", "depth_right", "depth_mm", "instance", "instance_right", "class", "class_right",
         "dynamic", "dynamic_right", "actor", "boxes", "flow", "scene_flow", "disparity",
         "occluded", "moving_shadow"]


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


class Exported(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(tempfile.mkdtemp(prefix="aisle_datasets_"))
        cls.addClassCleanup(shutil.rmtree, cls.root)
        text = (SOURCE / "scenes/smoke/short.yaml").read_text()
        text = text.replace("frames: 40", f"frames: {FRAMES}\n{CAMERA}").split("\n", 1)[1]
        cls.scene = cls.root / "short.yaml"
        cls.scene.write_text(text)
        cls.whole = Dataset(cls.export("euroc", f"0:{FRAMES}"))

    @classmethod
    def export(cls, format, frames, *more):
        out = cls.root / f"{format}_{frames.replace(':', '_')}"
        code, said = run("render", cls.scene, "--out", out, "--format", format, "--frames", frames,
                         "--truth", "all", *more)
        assert code == 0, said
        return out

    def assert_truth_means_what_it_says(self, data, i):
        z, flow, way = (data.truth(kind, i) for kind in ("depth", "flow", "scene_flow"))
        v, u = np.mgrid[0 : z.shape[0], 0 : z.shape[1]]
        hit = np.isfinite(z)
        self.assertGreater(hit.mean(), 0.9)
        x = np.where(hit, z, 0)
        point = np.stack([(u - data.cx) / data.fx * x, (v - data.cy) / data.fy * x, x], axis=2)
        world = point @ data.poses[i][:3, :3].T + data.poses[i][:3, 3]

        # Where the point is at the next frame, and where its pixel goes.
        number = data.scene_frames[i] + 1
        if number < FRAMES:
            turn, place = self.whole.poses[number][:3, :3], self.whole.poses[number][:3, 3]

            def warp_error(offset):
                then = (world + offset - place) @ turn  # R^T p
                land = np.stack([data.fx * then[:, :, 0] / then[:, :, 2] + data.cx - u,
                                 data.fy * then[:, :, 1] / then[:, :, 2] + data.cy - v], axis=2)
                return np.linalg.norm(land - flow, axis=2)[hit]

            self.assertLess(np.nanmax(warp_error(way)), 1e-3)
            self.assertLess(np.isnan(warp_error(way)).mean(), 0.01)
            if np.abs(way).max() > 0.03:
                self.assertGreater(np.nanmax(warp_error(way[:, :, ::-1])), 1, "the order is seen")
        actor = data.truth("actor", i) == 255
        self.assertGreater(actor.sum(), 100)
        self.assertEqual(np.abs(way[~actor]).max(), 0)

        # Millimetres, and the disparity of the pair.
        metres = np.where(hit, z, 0).astype(np.float64)
        np.testing.assert_array_equal(data.truth("depth_mm", i), np.floor(metres * 1000 + 0.5))
        disparity = data.truth("disparity", i)
        np.testing.assert_allclose((disparity * metres)[hit], data.fx * data.baseline, rtol=1e-6)
        self.assertTrue((disparity[~hit] == 0).all())
        self.assert_pair_agrees(data, i, metres, disparity)
        self.assert_labels_agree(data, i, way)

    def assert_pair_agrees(self, data, i, metres, disparity):
        """What is not hidden from the right camera is there, as deep and of the same label."""
        seen = data.truth("occluded", i) == 0
        rows, columns = np.nonzero(seen)
        there = np.rint(columns - disparity[seen]).astype(int)
        self.assertGreaterEqual((columns - disparity[seen]).min(), -0.5)
        there = np.clip(there, 0, metres.shape[1] - 1)
        deep = data.truth("depth_right", i)[rows, there]
        self.assertGreater((np.abs(deep / metres[seen] - 1) < 0.02).mean(), 0.93)
        for kind in ("instance", "class"):
            same = data.truth(kind + "_right", i)[rows, there] == data.truth(kind, i)[seen]
            self.assertGreater(same.mean(), 0.93, kind)

    def assert_labels_agree(self, data, i, way):
        labels = {label["id"]: label for label in data.labels}
        instance, classes = data.truth("instance", i), data.truth("class", i)
        dynamic, actor = data.truth("dynamic", i), data.truth("actor", i)
        for image in (dynamic, actor, data.truth("moving_shadow", i), data.truth("occluded", i)):
            self.assertTrue(np.isin(image, (0, 255)).all())
        self.assertTrue((actor[dynamic == 255] == 255).all())
        for number in np.unique(instance):
            self.assertTrue((classes[instance == number] == labels[number]["class_id"]).all())
            is_mover = labels[number]["moving"]
            self.assertTrue((actor[instance == number] == (255 if is_mover else 0)).all())
        boxes = data.truth("boxes", i)
        self.assertEqual(boxes["frame"], i)
        self.assertEqual(boxes["scene_frame"], data.scene_frames[i])
        self.assertEqual(boxes["stamp_ns"], data.stamps_ns[i])
        self.assertEqual(len(boxes["objects"]), 1)
        for thing in boxes["objects"]:
            rows, columns = np.nonzero(instance == thing["instance"])
            self.assertEqual(thing["visible_pixels"], len(rows))
            self.assertEqual(thing["dynamic_pixels"], (dynamic[rows, columns] == 255).sum())
            self.assertEqual(thing["box_visible_px"],
                             [columns.min() - 0.5, rows.min() - 0.5, np.ptp(columns) + 1,
                              np.ptp(rows) + 1])
            # As a whole a person goes where the surface goes (limbs swing about that).
            mean = np.median(way[rows, columns], axis=0) * 20
            np.testing.assert_allclose(mean, thing["velocity_world_mps"], atol=0.35)
            if i + data.scene_frames[0] > 12:  # it has set off
                self.assertGreater(np.linalg.norm(thing["velocity_world_mps"]), 0.5)

    def assert_is_part_of_the_whole(self, data, first, last):
        """Images, poses, stamps and truth of every name are those of one frame of the scene."""
        self.assertEqual(data.scene_frames, list(range(first, last)))
        count = last - first
        for of_frames in (data.left, data.right, data.poses, data.stamps_ns):
            self.assertEqual(len(of_frames), count)
        for i, k in enumerate(data.scene_frames):
            self.assertEqual(data.scene_stamps_ns[i], 50_000_000 * k)
            self.assertEqual(data.left[i].stem, data.names[i])
            self.assertEqual(data.right[i].name, data.left[i].name)
            for camera in ("left", "right"):
                mine = getattr(data, camera)[i].read_bytes()
                self.assertEqual(mine, getattr(self.whole, camera)[k].read_bytes())
                self.assertEqual(read_grey_png(getattr(data, camera)[i]).shape, (240, 376))
            np.testing.assert_allclose(data.poses[i], self.whole.poses[k], atol=1e-9)
        for kind in KINDS:
            there = sorted(path.stem for path in (data.folder / "truth" / kind).iterdir())
            self.assertEqual(there, sorted(data.names), kind)

    def read(self, folder):
        data = Dataset(folder)
        data.labels = json.loads((folder / "truth/labels.json").read_text())
        return data

    def test_every_range_of_every_format_means_what_it_says(self):
        for format in ("euroc", "kitti", "tum"):
            for first, last in ((0, 2), (14, 17), (20, 21), (FRAMES - 1, FRAMES)):
                with self.subTest(format=format, frames=f"{first}:{last}"):
                    data = self.read(self.export(format, f"{first}:{last}"))
                    self.assert_is_part_of_the_whole(data, first, last)
                    for i in range(last - first):
                        self.assert_truth_means_what_it_says(data, i)
                    if format == "kitti":
                        self.assertEqual(data.stamps_ns[0], 0)
                    if format == "tum":
                        for i, path in enumerate(data.depth_png):
                            z = data.truth("depth", i).astype(np.float64)
                            steps = np.floor(np.where(np.isfinite(z), z, 0) * 5000 + 0.5)
                            np.testing.assert_array_equal(read_grey_png(path),
                                                          np.where(steps > 65535, 0, steps))

    def test_the_program_itself_reads_a_part(self):
        for format in ("euroc", "kitti"):
            for frames, count in (("12:20", 8), ("5:6", 1)):
                # Nobody walks: of eight frames who is near may well be taken for the world.
                out = self.export(format, frames, "--twin", "empty")
                track = self.root / f"{format}_track.txt"
                code, said = run("slam", out, "--format", format, "-o", track)
                self.assertEqual(code, 0, said)
                self.assertIn(f"{count} frames, {count} with a pose", said)
                # Against the scene's poses as the other reader has them, by the estimate's stamps.
                data, estimate = Dataset(out), np.loadtxt(track, ndmin=2)
                self.assertEqual(len(estimate), count)
                home = np.linalg.inv(data.poses[0])
                stamps = np.array(data.stamps_ns, float) * 1e-9
                np.testing.assert_allclose(estimate[:, 0], stamps, atol=1e-3)
                start = rotation(*estimate[0, 4:])
                for pose, row in zip(data.poses, estimate):
                    moved = start.T @ (row[1:4] - estimate[0, 1:4])
                    np.testing.assert_allclose(moved, (home @ pose)[:3, 3], atol=0.03)

    def test_a_right_image_that_is_missing_is_told(self):
        out, track = self.export("kitti", "3:9"), self.root / "told_track.txt"
        (out / "sequences/00/image_1/000002.png").unlink()
        code, said = run("slam", out, "--format", "kitti", "-o", track)
        self.assertEqual(code, 0, said)
        self.assertIn("skipped 1 of 6 left images", said)
        self.assertIn("5 frames", said)

    def test_stopped_it_goes_on_and_grows_at_its_end_alone(self):
        for format in ("euroc", "kitti", "tum"):
            out = self.export(format, "1:3")
            before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
            data = Dataset(out)
            data.left[1].unlink()
            code, said = self.again(format, out, "1:3")
            self.assertIn("2 frames, 1 of them rendered now", said)
            after = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
            self.assertEqual(before, after)
            for other in ("0:3", "2:4", "1:2"):
                code, said = self.again(format, out, other)
                self.assertEqual(code, 4, said)
                self.assertIn("the folder was started with frames 1:3", said)
            code, said = self.again(format, out, "1:5")
            self.assertIn("4 frames, 2 of them rendered now", said)
            self.assert_is_part_of_the_whole(self.read(out), 1, 5)

    def again(self, format, out, frames):
        return run("render", self.scene, "--out", out, "--format", format, "--frames", frames,
                   "--truth", "all")


class WheelsOfAVehicle(unittest.TestCase):
    """Where a scene says how its vehicle's wheels err, so do those that are written beside it."""

    NOTHING_ELSE = ("inequality: 0, track_error: 0, steering_error_deg: 0, noise_m: 0, "
                    "slip_per_mps2: 0, counts_per_rev: 10000000")

    def written(self, seed):
        root = pathlib.Path(tempfile.mkdtemp(prefix="aisle_wheels_"))
        self.addCleanup(shutil.rmtree, root)
        scene = root / "straight.yaml"
        scene.write_text(
            "about: A vehicle rolls straight ahead.\nframes: 8\nrate_hz: 4\ncamera: {size_px: [96, 64], focal_px: [60, 60]}\n"
            "rig: {camera_height_m: 0.85, start: [0, 0], steps: [{go: [[6, 0]], speed_mps: 1.2}]}\n"
            "drive: {kind: tricycle, odometry: {radius_error: 0.2, " + self.NOTHING_ELSE + "}}\n"
            "hall: {from: [-6, -6], to: [12, 6], height_m: 6}\n"
            "lights: [{rows: 1, per_row: 2, height_m: 5.4, size_m: [1.5, 0.3]}]\n")
        code, said = run("render", scene, "--out", root / "out", "--format", "tum", "--odometry",
                         "--seed", seed)
        self.assertEqual(code, 0, said)
        return [np.loadtxt(root / "out" / name) for name in ("odometry.txt", "groundtruth.txt")]

    def test_err_as_its_scene_says(self):
        shares = []
        for seed in (1, 2, 3):
            wheels, truth = self.written(seed)
            ways = [np.linalg.norm(track[1:, 1:4] - track[0, 1:4], axis=1)
                    for track in (wheels, truth)]
            share = ways[0] / ways[1]
            self.assertAlmostEqual(share[3], share[-1], delta=0.005)  # the same all the way
            # Both wheels' radius is off by one share: nothing turns it.
            np.testing.assert_allclose(wheels[:, 4:], wheels[:1, 4:].repeat(len(wheels), 0),
                                       atol=2e-4)
            shares.append(share[-1] - 1)
        self.assertGreater(np.abs(shares).max(), 0.03, shares)  # ten times what others have


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
