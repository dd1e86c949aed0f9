"""Frames are arrays of the renderer's own memory, say what geometry says, and are the program's."""

import gc
import pickle
import threading

import numpy as np
import pytest
from dataset_reader import Dataset, read_grey_png, read_pfm

import aisle


def test_arrays_have_the_shapes_and_types_that_are_promised(scene, frames):
    rig, frame = scene.calibration, frames[0]
    size = (rig.height, rig.width)
    for name in ("left", "right", "moving", "moving_right", "actors", "actors_right"):
        array = getattr(frame, name)
        assert (array.shape, array.dtype) == (size, np.uint8), name
    for name in ("depth", "depth_right"):
        assert (getattr(frame, name).shape, getattr(frame, name).dtype) == (size, np.float32)
    for name in ("labels", "labels_right"):
        assert (getattr(frame, name).shape, getattr(frame, name).dtype) == (size, np.uint16)
    assert (frame.flow.shape, frame.flow.dtype) == ((*size, 2), np.float32)
    assert frame.motion.scene_flow.shape == (*size, 3)
    assert (frame.pose.shape, frame.pose.dtype) == ((4, 4), np.float64)
    assert frame.boxes.shape == (len(frame.objects), 4)
    assert len(scene) == 40 and scene.rate_hz == 20 and frames[3].stamp_ns == 150_000_000


def test_no_pixel_is_copied(frames):
    frame = frames[0]
    for name in ("left", "right", "depth", "labels", "moving"):
        assert np.shares_memory(getattr(frame, name), getattr(frame, name)), name
        assert not getattr(frame, name).flags.owndata


def test_pixels_outlive_their_frame(scene):
    frame = scene.render(0)
    part = frame.left[10:20, 10:20]
    total = int(part.sum())
    del frame
    gc.collect()
    filler = [np.full((480, 752), 7, np.uint8) for _ in range(50)]  # what was freed is used again
    assert part.sum() == total and len(filler) == 50


def test_the_same_arguments_give_the_same_bytes(scene, frames):
    again = aisle.Simulator("smoke/short", threads=1).render(5)
    for name in ("left", "right", "depth", "labels", "moving"):
        np.testing.assert_array_equal(getattr(again, name), getattr(frames[5], name), name)
    planned = scene.render(5, pose=frames[5].pose)
    np.testing.assert_array_equal(planned.left, frames[5].left)
    assert (aisle.Simulator("smoke/short", seed=2).render(5).left != again.left).any()


def test_they_are_the_bytes_of_the_program(program, frames, tmp_path):
    program("render", "smoke/short", "--out", tmp_path / "set", "--frames", "3:5", "--truth", "all")
    data = Dataset(tmp_path / "set")
    for i, k in enumerate(data.scene_frames):
        frame = frames[k]
        assert data.scene_stamps_ns[i] == frame.stamp_ns
        np.testing.assert_array_equal(read_grey_png(data.left[i]), frame.left)
        np.testing.assert_array_equal(read_grey_png(data.right[i]), frame.right)
        np.testing.assert_allclose(data.poses[i], frame.pose, atol=1e-9)
        truth = tmp_path / "set/truth"
        files = {path.parent.relative_to(truth).as_posix(): path
                 for path in truth.rglob(data.names[i] + ".*")}
        depths = [read_pfm(path) for path in files.values() if path.suffix == ".pfm"]
        assert any(np.array_equal(depth, frame.depth) for depth in depths)
        masks = [read_grey_png(path) for path in files.values() if path.suffix == ".png"]
        assert any(np.array_equal(mask, frame.moving) for mask in masks)
        assert any(np.array_equal(mask, frame.labels) for mask in masks)


def test_truth_keeps_the_laws_of_geometry(scene, frames):
    rig, frame = scene.calibration, frames[8]
    hit = np.isfinite(frame.depth) & (frame.motion.disparity > 0)
    np.testing.assert_allclose(frame.motion.disparity[hit],
                               rig.fx * rig.baseline_m / frame.depth[hit], rtol=1e-4)
    assert frame.objects, "nobody walks in this frame"
    for thing, box in zip(frame.objects, frame.boxes):
        rows, columns = np.nonzero(frame.labels == thing.label)
        assert len(rows) == thing.visible_pixels
        assert scene.things[thing.label].can_move
        # Edges of pixels: centres are whole numbers.
        x, y, width, height = box
        assert abs(x - columns.min()) <= 1 and abs(x + width - columns.max()) <= 1.5
        assert abs(y - rows.min()) <= 1 and abs(y + height - rows.max()) <= 1.5


def test_flow_takes_a_static_point_to_where_its_pose_says(scene, frames):
    rig, one, next_one = scene.calibration, frames[2], frames[3]
    rows, columns = np.nonzero(np.isfinite(one.depth) & (one.actors == 0))
    rows, columns = rows[::997], columns[::997]
    z = one.depth[rows, columns].astype(float)
    points = np.stack([(columns - rig.cx) / rig.fx * z, (rows - rig.cy) / rig.fy * z, z, z * 0 + 1])
    seen = np.linalg.inv(next_one.pose) @ one.pose @ points
    expected = np.stack([rig.fx * seen[0] / seen[2] + rig.cx - columns,
                         rig.fy * seen[1] / seen[2] + rig.cy - rows], axis=1)
    np.testing.assert_allclose(one.flow[rows, columns], expected, atol=2e-3)
    np.testing.assert_array_equal(one.flow, one.motion_to(next_one).flow)


def test_any_pose_and_any_time(scene, frames):
    raised = frames[5].pose.copy()
    raised[2, 3] += 0.3
    frame = scene.render(5, pose=raised)
    np.testing.assert_array_equal(frame.pose, raised)
    assert (frame.left != frames[5].left).mean() > 0.1
    with pytest.raises(ValueError, match="motion_to"):
        frame.flow
    back = frame.motion_to(frames[5]).flow
    assert np.isfinite(back).any()
    between = scene.render(5, stamp_ns=275_000_000)
    assert between.stamp_ns == 275_000_000
    low, high = frames[5].pose[0, 3], frames[6].pose[0, 3]
    assert low < between.pose[0, 3] < high


def test_a_scene_is_a_sequence(scene):
    assert [frame.index for frame, _ in zip(scene, range(3))] == [0, 1, 2]
    assert scene.render(-1).index == 39
    with pytest.raises(IndexError, match="0 to 39"):
        scene[40]


def test_mistakes_are_told(scene, tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("about: Bad.\nframes: none\nrate_hz: 20\n")
    with pytest.raises(aisle.InputError, match=r"bad.yaml:2"):
        aisle.Simulator(bad)
    with pytest.raises(ValueError, match="twin"):
        aisle.Simulator("smoke/short", twin="dead")
    with pytest.raises(ValueError, match="rigid"):
        scene.render(0, pose=2 * np.eye(4))
    with pytest.raises(ValueError, match="4 x 4"):
        scene.render(0, pose=np.eye(3))
    with pytest.raises(AttributeError):
        scene.render(0).left = None


def test_other_threads_run_while_a_frame_is_rendered(scene):
    steps, done = [0], threading.Event()

    def count():
        while not done.is_set():
            steps[0] += 1
            done.wait(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    before = steps[0]
    scene.render(7)
    during = steps[0] - before
    done.set()
    counter.join()
    assert during > 3


def test_threads_may_share_a_scene(scene, frames):
    made = {}
    threads = [threading.Thread(target=lambda k=k: made.__setitem__(k, scene.render(k)))
               for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k, frame in made.items():
        np.testing.assert_array_equal(frame.left, frames[k].left)


def test_a_scene_can_be_sent_to_another_process(scene, frames):
    other = pickle.loads(pickle.dumps(scene))
    assert other.content_hash == scene.content_hash
    np.testing.assert_array_equal(other.render(1).left, frames[1].left)
