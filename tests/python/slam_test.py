"""The SLAM tracks arrays, tells them what is wrong with them, and is the program's SLAM."""

import numpy as np
import pytest

import aisle


def drive(frames, slam, mask=None):
    return [slam.track(frame.left, frame.right, frame.stamp_ns, mask and mask(frame))
            for frame in frames]


def test_it_tracks(scene, frames):
    slam = aisle.Slam(scene.calibration)
    estimates = drive(frames, slam)
    last = estimates[-1]
    assert last.state == "tracking" and last.pose.shape == (4, 4)
    assert last.mask.shape == frames[0].left.shape and last.mask.dtype == np.uint8
    assert last.keypoints.shape == (len(last.inliers), 2) and last.inliers.any()
    assert last.counts["features"] > 100 and last.stage_ms
    live, final = slam.live, slam.finish()
    assert len(live) == len(final) == len(frames)
    truth = aisle.Trajectory(scene.trajectory.stamps_ns[:20], scene.trajectory.poses[:20])
    assert float(aisle.score(truth, final)["ate_rmse_m"]) < 0.01


def test_it_is_the_programs(program, scene, tmp_path):
    program("render", "smoke/short", "--out", tmp_path / "set")
    program("slam", tmp_path / "set", "--system", "robust", "-o", tmp_path / "program.txt")
    slam = aisle.Slam(scene.calibration)
    drive(scene, slam)
    ours, theirs = slam.finish(), aisle.Trajectory.read(tmp_path / "program.txt")
    np.testing.assert_array_equal(np.diff(ours.stamps_ns), np.diff(theirs.stamps_ns))
    # Quaternions of a text file are made of rotations and back.
    np.testing.assert_allclose(ours.poses, theirs.poses, atol=1e-12)


def test_the_same_frames_give_the_same_bits_however_they_lie_in_memory(scene, frames):
    one, other = aisle.Slam(scene.calibration), aisle.Slam(scene.calibration, threads=1)
    for frame in frames[:8]:
        wide = np.zeros((*frame.left.shape, 2), np.uint8)
        wide[..., 1] = frame.left
        given, right = wide[..., 1], frame.right.copy()
        a = one.track(frame.left, frame.right, frame.stamp_ns)
        b = other.track(given, right, frame.stamp_ns)
        right[:] = 0  # the caller's again
        np.testing.assert_array_equal(a.pose, b.pose)


def test_masks_of_numbers_and_of_truth_values_are_one(scene, frames):
    slams = [aisle.Slam(scene.calibration, system="oracle") for _ in range(2)]
    a = drive(frames[:6], slams[0], lambda frame: frame.moving)
    b = drive(frames[:6], slams[1], lambda frame: frame.moving > 0)
    np.testing.assert_array_equal(a[-1].pose, b[-1].pose)
    for x, y in a[-1].keypoints:
        assert frames[5].moving[round(float(y)), round(float(x))] == 0


def test_a_black_frame_is_no_error(scene):
    rig = scene.calibration
    black = np.zeros((rig.height, rig.width), np.uint8)
    estimate = aisle.Slam(rig).track(black, black, 0)
    assert estimate.state != "tracking" and estimate.pose is None


def test_a_map_is_kept_and_gone_on_in(scene, frames, tmp_path):
    slam = aisle.Slam(scene.calibration)
    drive(frames, slam)
    slam.finish()
    slam.save_map(tmp_path / "site.map")
    later = aisle.Slam(scene.calibration, load_map=tmp_path / "site.map", localise_only=True)
    assert any(estimate.pose is not None for estimate in drive(frames[10:16], later))


def test_a_map_that_is_none_is_wrong_input(scene, tmp_path):
    (tmp_path / "bad.map").write_bytes(b"no map at all")
    for name in ("bad.map", "none.map"):
        with pytest.raises(aisle.InputError, match=name):
            aisle.Slam(scene.calibration, load_map=tmp_path / name)


def test_a_frame_that_is_refused_changes_nothing(scene, frames):
    one, other = aisle.Slam(scene.calibration), aisle.Slam(scene.calibration)
    for frame in frames[:6]:
        a = one.track(frame.left, frame.right, frame.stamp_ns)
        with pytest.raises(ValueError, match="rise"):
            one.track(frame.left, frame.right, frame.stamp_ns)
        b = other.track(frame.left, frame.right, frame.stamp_ns)
        np.testing.assert_array_equal(a.pose, b.pose)
    assert len(one.live) == 6


def test_what_is_live_is_a_copy(scene, frames):
    slam = aisle.Slam(scene.calibration)
    drive(frames[:5], slam)
    live = slam.live
    before = len(live)
    drive(frames[5:7], slam)
    assert len(live) == before and len(slam.live) == before + 2


def test_mistakes_are_told(scene, frames):
    frame = frames[0]
    with pytest.raises(aisle.InputError, match="feature.features"):
        aisle.Slam(scene.calibration, {"feature.feature": 800})
    with pytest.raises(aisle.InputError, match="robust"):
        aisle.Slam(scene.calibration, system="robusst")
    for path, value in {"drive.scanner": False, "odometry": True}.items():
        with pytest.raises(aisle.InputError, match=path):
            aisle.Slam(scene.calibration, {path: value})
    slam = aisle.Slam(scene.calibration, {"feature.features": 800})
    with pytest.raises(ValueError, match="calibration"):
        slam.track(frame.left[:100], frame.right[:100], 0)
    with pytest.raises(TypeError):
        slam.track(frame.left.astype(float), frame.right, 0)
    slam.track(frame.left, frame.right, 10)
    with pytest.raises(ValueError, match="rise"):
        slam.track(frame.left, frame.right, 10)
    slam.finish()
    with pytest.raises(RuntimeError, match="finish"):
        slam.track(frame.left, frame.right, 20)
    with pytest.raises(ValueError, match="positive"):
        aisle.Calibration(0, 480, 400, 400, 300, 200, 0.1)


def test_systems_and_options_can_be_read():
    assert {"robust", "plain", "oracle"} <= set(aisle.systems())
    value, unit, sentence = aisle.options("robust")["feature.features"]
    assert int(value) > 0 and unit == "" and sentence
