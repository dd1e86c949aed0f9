"""Scores are what NumPy says they are, and what the program says."""

import json

import numpy as np
import pytest

import aisle


def wobbly(n=200, seed=3):
    """A curved track, and the same displaced, turned and with noise."""
    random = np.random.default_rng(seed)
    stamps = np.arange(n) * 50_000_000
    angle = np.linspace(0, 3, n)
    poses = np.tile(np.eye(4), (n, 1, 1))
    poses[:, 0, 0] = poses[:, 1, 1] = np.cos(angle)
    poses[:, 0, 1], poses[:, 1, 0] = -np.sin(angle), np.sin(angle)
    poses[:, :3, 3] = np.stack([4 * np.sin(angle), 4 - 4 * np.cos(angle), 0.1 * angle], axis=1)
    turn = np.eye(4)
    turn[:2, :2] = [[0.6, -0.8], [0.8, 0.6]]
    turn[:3, 3] = 5, -3, 1
    estimate = turn @ poses
    estimate[:, :3, 3] += random.normal(0, 0.02, (n, 3))
    return stamps, poses, estimate


def ate_by_hand(truth, estimate):
    """Umeyama's rigid alignment by NumPy's SVD."""
    a, b = estimate[:, :3, 3], truth[:, :3, 3]
    u, _, vt = np.linalg.svd((b - b.mean(0)).T @ (a - a.mean(0)))
    turn = u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
    errors = (a - a.mean(0)) @ turn.T + b.mean(0) - b
    return np.sqrt((errors**2).sum(1).mean())


def test_ate_is_numpys():
    stamps, truth, estimate = wobbly()
    scores = aisle.score(aisle.Trajectory(stamps, truth), aisle.Trajectory(stamps, estimate))
    ate = scores["ate_rmse_m"]
    assert ate.value == pytest.approx(ate_by_hand(truth, estimate), rel=1e-9)
    assert (ate.unit, ate.alignment, ate.n) == ("m", "se3", 200)
    assert float(scores["coverage"]) == 1


def test_truth_itself_has_no_error():
    stamps, truth, _ = wobbly()
    track = aisle.Trajectory(stamps, truth)
    assert float(aisle.score(track, track)["ate_rmse_m"]) < 1e-12
    assert float(aisle.score(track, track, align="none")["rpe_trans_rmse_m"]) < 1e-12


def test_a_score_that_cannot_be_had_says_why():
    stamps, truth, _ = wobbly()
    track = aisle.Trajectory(stamps, truth)
    drift = aisle.score(track, track)["t_rel_percent"]  # the way is far shorter than 100 m
    assert drift.value is None and drift.absent
    with pytest.raises(ValueError, match="no value"):
        float(drift)


def test_the_program_says_the_same(program, tmp_path):
    stamps, truth, estimate = wobbly()
    tracks = {"truth": aisle.Trajectory(stamps, truth),
              "estimate": aisle.Trajectory(stamps[:150], estimate[:150])}
    for name, track in tracks.items():
        track.write(tmp_path / name)
    told = json.loads(program("score", "--truth", tmp_path / "truth", "--estimate",
                              tmp_path / "estimate", "--json"))["scores"]
    read = [aisle.Trajectory.read(tmp_path / name) for name in ("truth", "estimate")]
    ours = aisle.score(*read)
    assert set(told) == set(ours) and set(ours) <= set(aisle.score_names())
    for name, score in ours.items():
        assert score.value == told[name].get("value"), name
        assert score.unit == told[name]["unit"], name
    assert float(ours["coverage"]) == 0.75


@pytest.mark.parametrize("ours, programs", [
    ({"align": "sim3", "align_first": 20}, ["--align", "sim3", "--align-first", "20"]),
    ({"max_difference_s": 0.012}, ["--max-difference", "0.012"]),
    ({"delta": 2, "unit": "metres", "all_pairs": True}, ["--delta", "2", "--unit", "metres", "--all-pairs"]),
    ({"unit": "metres", "along_estimate": True}, ["--unit", "metres", "--along-estimate"]),
])
def test_every_option_of_the_program_is_one_here(program, tmp_path, ours, programs):
    stamps, truth, estimate = wobbly()
    tracks = {"truth": aisle.Trajectory(stamps, truth),
              "estimate": aisle.Trajectory(stamps + 10_000_000 * (np.arange(200) % 3), estimate)}
    for name, track in tracks.items():
        track.write(tmp_path / name)
    told = json.loads(program("score", "--truth", tmp_path / "truth", "--estimate",
                              tmp_path / "estimate", "--json", *programs))["scores"]
    read = [aisle.Trajectory.read(tmp_path / name) for name in ("truth", "estimate")]
    chosen, usual = aisle.score(*read, **ours), aisle.score(*read)
    assert {name: score.value for name, score in chosen.items()} == {
        name: told[name].get("value") for name in chosen}
    assert any(chosen[name].value != usual[name].value for name in usual), "it has an effect"


def test_options_without_effect_are_refused():
    stamps, truth, _ = wobbly()
    track = aisle.Trajectory(stamps, truth)
    for wrong in ({"along_estimate": True}, {"align": "none", "align_first": 3},
                  {"max_difference_s": float("nan")}, {"max_difference_s": -1}):
        with pytest.raises(ValueError):
            aisle.score(track, track, **wrong)


def test_kitti_takes_its_times(tmp_path):
    _, truth, _ = wobbly(5)
    aisle.Trajectory(np.arange(5), truth).write(tmp_path / "00.txt", "kitti")
    (tmp_path / "times.txt").write_text("0\n0.05\n0.1\n0.5\n2\n")
    timed = aisle.Trajectory.read(tmp_path / "00.txt", times=tmp_path / "times.txt")
    np.testing.assert_array_equal(timed.stamps_ns, [0, 50_000_000, 100_000_000, 500_000_000, 2_000_000_000])
    rows = aisle.Trajectory.read(tmp_path / "00.txt")
    np.testing.assert_array_equal(rows.stamps_ns, 100_000_000 * np.arange(5))
    timed.write(tmp_path / "tum.txt")
    with pytest.raises(aisle.InputError, match="KITTI"):
        aisle.Trajectory.read(tmp_path / "tum.txt", times=tmp_path / "times.txt")


def test_two_frames_of_reference_are_warned_of():
    stamps, truth, _ = wobbly()
    body = truth.copy()
    body[:, :3, :3] = body[:, :3, :3] @ np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    with pytest.warns(UserWarning):
        aisle.score(aisle.Trajectory(stamps, truth), aisle.Trajectory(stamps, body))


def test_trajectories_round_trip_to_the_bit(tmp_path):
    stamps, truth, _ = wobbly()
    track = aisle.Trajectory(stamps, truth)
    np.testing.assert_array_equal(track.poses, truth)
    np.testing.assert_array_equal(track.stamps_ns, stamps)
    track.write(tmp_path / "track.txt")
    again = aisle.Trajectory.read(tmp_path / "track.txt", "tum")
    np.testing.assert_array_equal(again.stamps_ns, stamps)
    np.testing.assert_allclose(again.poses, truth, atol=1e-12)


def test_masks_are_counted_as_numpy_counts_them():
    random = np.random.default_rng(1)
    truth = [random.random((60, 80)) < 0.3 for _ in range(5)]
    masks = [mask ^ (random.random((60, 80)) < 0.1) for mask in truth]
    scores = aisle.score_masks(truth, masks)
    both = sum((a & b).sum() for a, b in zip(truth, masks))
    assert float(scores["mask_precision"]) == pytest.approx(both / sum(b.sum() for b in masks))
    assert float(scores["mask_recall"]) == pytest.approx(both / sum(a.sum() for a in truth))
    assert float(scores["mask_iou"]) == pytest.approx(
        both / sum((a | b).sum() for a, b in zip(truth, masks)))
    with pytest.raises(ValueError, match="size"):
        aisle.score_masks(truth[:1], [masks[0][:10]])


def test_outlines_meet_within_what_is_said():
    truth = np.zeros((300, 400), bool)
    truth[100:200, 100:200] = True
    said = np.roll(truth, 5, axis=1)  # its left and right outline are five pixels off

    def f(**options):
        return float(aisle.score_masks([truth], [said], **options)["mask_boundary_f"])

    assert f() == f(boundary_px=3) < f(boundary_px=5) == 1
    assert f(boundary_share=3 / 500) == f()  # the diagonal is 500 pixels long
    assert f(boundary_davis=True) < 1  # 0.008 of it are four
    for wrong in ({"boundary_px": 3, "boundary_davis": True}, {"boundary_px": -1}, {"boundary_share": 2}):
        with pytest.raises(ValueError):
            aisle.score_masks([truth], [said], **wrong)


def test_mistakes_are_told(tmp_path):
    stamps, truth, _ = wobbly()
    with pytest.raises(ValueError, match="falls at index 1"):
        aisle.Trajectory([10, 0], truth[:2])
    with pytest.raises(ValueError, match="rigid"):
        aisle.Trajectory([0], 2 * truth[:1])
    # Seconds, as a list or an array, and what int64 does not hold: none is cut to whole nanoseconds.
    for wrong in ([0.1, 0.6], np.array([0.0, 1.0]), [0, 2**63], ["0", "1"]):
        with pytest.raises(TypeError, match="whole"):
            aisle.Trajectory(wrong, truth[:2])
    assert len(aisle.Trajectory(np.array([0, 5], np.int32), truth[:2])) == 2
    assert len(aisle.Trajectory([], truth[:0])) == 0
    track = aisle.Trajectory(stamps, truth)
    with pytest.raises(ValueError, match="sim3"):
        aisle.score(track, track, align="best")
    (tmp_path / "bad.txt").write_text("0 1 2 3 0 0 0 nan\n")
    with pytest.raises(aisle.InputError, match="bad.txt:1"):
        aisle.Trajectory.read(tmp_path / "bad.txt", "tum")
