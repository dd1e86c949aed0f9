"""A vehicle is stepped from frame to frame, by a system of aisle's or by one's own."""

import numpy as np
import pytest

import aisle

ELSEWHERE = np.array([[0.6, -0.8, 0, 3], [0.8, 0.6, 0, -2], [0, 0, 1, 0.5], [0, 0, 0, 1]])


def drive_by_truth(drive_file, **arguments):
    """Somebody's own system, which knows the truth in a world of its own."""
    drive = aisle.Drive(drive_file, system=None, **arguments)
    frame, indices = drive.reset(), []
    while frame is not None:
        indices.append(frame.index)
        frame = drive.step(ELSEWHERE @ frame.pose)
    return drive, indices


def test_who_knows_the_truth_arrives(drive_file):
    drive, indices = drive_by_truth(drive_file)
    assert drive.end == "arrived" and indices == list(range(len(indices)))
    assert abs(drive.vehicle.truth[0] - 2) < 0.03
    scores = drive.scores()
    assert float(scores["goal_reached"]) == 1
    # Its twin is told the truth as well: the same drive.
    own, twin = scores["docking_error_m"], scores["docking_error_truth_steered_m"]
    assert float(own) == pytest.approx(float(twin), abs=1e-6) and own.unit == "m"
    assert max(abs(sample.cross_track_m) for sample in drive.samples) < 0.02


def test_latency_takes_frames(drive_file):
    drive, indices = drive_by_truth(drive_file, options={"drive.latency_ms": 120})
    assert drive.end == "arrived"
    assert np.diff(indices).min() >= 2


def test_the_same_answers_give_the_same_drive(drive_file):
    samples = [drive_by_truth(drive_file)[0].samples for _ in range(2)]
    for one, other in zip(*samples):
        np.testing.assert_array_equal(one.truth, other.truth)
        np.testing.assert_array_equal(one.belief, other.belief)


def test_a_system_of_aisles_steers_as_in_the_program(program, drive_file, tmp_path):
    import json

    drive = aisle.Drive(drive_file, "plain")
    frame = drive.reset()
    while frame is not None:
        frame = drive.step()
    assert drive.end == "arrived" and drive.estimate.state == "tracking"
    program("run", drive_file, "--systems", "plain", "--out", tmp_path / "out", "--frames-in-report",
            "none")
    told = json.loads((tmp_path / "out/results.json").read_text())["runs"][0]["scores"]
    for name, score in drive.scores().items():
        assert score.value == told[name].get("value"), name


def test_who_is_lost_stands(drive_file):
    drive = aisle.Drive(drive_file, system=None)
    drive.reset()
    for _ in range(5):
        drive.step(None)
    assert drive.vehicle.mode == "waiting" and drive.vehicle.speed_mps == 0


def test_reset_begins_anew(drive_file):
    drive = aisle.Drive(drive_file, system=None)
    first = drive.reset()
    drive.step(first.pose)
    again = drive.reset()
    np.testing.assert_array_equal(again.left, first.left)
    assert drive.end is None and drive.vehicle.stamp_ns == 0


def test_others_may_look_while_it_drives(drive_file):
    import threading

    drive = aisle.Drive(drive_file, system=None)
    frame = drive.reset()
    over, counts = threading.Event(), []

    def look():
        while not over.is_set():
            samples, vehicle = drive.samples, drive.vehicle
            counts.append(len(samples))
            assert drive.end is None and drive.estimate is None
            assert not samples or vehicle.stamp_ns >= samples[-1].stamp_ns

    looking = threading.Thread(target=look)
    looking.start()
    for _ in range(20):
        frame = drive.step(frame.pose)
    over.set()
    looking.join()
    assert counts == sorted(counts)


def test_mistakes_are_told(drive_file):
    for options in ({"feature.features": 800}, {"odometry": True}):
        with pytest.raises(aisle.InputError, match=next(iter(options))):
            aisle.Drive(drive_file, system=None, options=options)
    with pytest.raises(aisle.InputError, match="drive"):
        aisle.Drive("smoke/short")
    drive = aisle.Drive(drive_file, system=None)
    with pytest.raises(RuntimeError, match="reset"):
        drive.step()
    with pytest.raises(RuntimeError, match="reset"):
        drive.vehicle
    drive.reset()
    with pytest.raises(ValueError, match="rigid"):
        drive.step(np.zeros((4, 4)))
    own = aisle.Drive(drive_file, "plain")
    own.reset()
    with pytest.raises(ValueError, match="steered by plain"):
        own.step(np.eye(4))
    with pytest.raises(aisle.InputError, match="latency_ms"):
        aisle.Drive(drive_file, options={"drive.latency_ms": -1})
