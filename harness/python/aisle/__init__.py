"""aisle: stereo pictures of a moving warehouse with exact truth, a stereo SLAM, and the scores.

Poses are 4 x 4 matrices T_world_rig in metres: rig coordinates (x right, y down, z forward; the left
camera) to the world (right-handed, z up). Times are whole nanoseconds. Images are NumPy arrays.

    import aisle
    scene = aisle.Simulator("paper/scene2")
    slam = aisle.Slam(scene.calibration)
    for frame in scene:
        slam.track(frame.left, frame.right, frame.stamp_ns)
    print(aisle.score(scene.trajectory, slam.finish())["ate_rmse_m"])
"""

import pathlib as _pathlib
import re as _re

# The compiled part runs on processors with AVX2 alone; without a word it would end in a signal.
_flags = _re.search(r"^flags\s*:(.*)$", _pathlib.Path("/proc/cpuinfo").read_text(), _re.M)
if _flags and not {"avx2", "fma", "bmi2"} <= set(_flags.group(1).split()):
    raise ImportError("aisle: this processor lacks AVX2, FMA or BMI2 (x86-64-v3)")

from aisle._core import (  # noqa: E402
    Calibration,
    Drive,
    Estimate,
    Frame,
    InputError,
    MachineError,
    Motion,
    Object,
    Score,
    Simulator,
    Slam,
    Thing,
    Trajectory,
    Vehicle,
    options,
    score,
    score_masks,
    score_names,
    systems,
)

__all__ = [
    "Calibration",
    "Drive",
    "Estimate",
    "Frame",
    "InputError",
    "MachineError",
    "Motion",
    "Object",
    "Score",
    "Simulator",
    "Slam",
    "Thing",
    "Trajectory",
    "Vehicle",
    "options",
    "score",
    "score_masks",
    "score_names",
    "systems",
]
