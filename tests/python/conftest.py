"""What the tests of the Python module share.

Run by ctest (run.py) where the module is built, or by hand: ./aisle python -m pytest tests/python.
"""

import os
import pathlib
import subprocess
import sys

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/support"))

import aisle  # noqa: E402

# Two metres down an aisle, past somebody who crosses; small pictures.
SHORT_DRIVE = """
about: A short drive.
frames: 80
rate_hz: 20
camera: {size_px: [320, 200], focal_px: [185, 185], center_px: [160, 105]}
rig:
  start: [0, 0]
  steps: [{go: [[2, 0]], speed_mps: 0.9}]
drive: {footprint_m: [[-0.3, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.3, 0.3]]}
hall: {from: [-4, -5], to: [12, 5], height_m: 5}
racks:
  - {from: [-2, 2.2], bays: 4}
  - {from: [-2, -2.2], bays: 4, goods: cartons}
stacks: [{at: [8, 0], goods: drums}]
lights: [{rows: 2, per_row: 4, height_m: 4.5}]
people:
  - name: walker
    start: [4, 1.2]
    steps: [{go: [[4, -1.2]], speed_mps: 1}]
"""


@pytest.fixture(scope="session")
def source():
    return SOURCE


@pytest.fixture(scope="session")
def program():
    """The program of the same tree, as an oracle for the module."""
    path = pathlib.Path(os.environ.get("AISLE_PROGRAM", SOURCE / "build/release/harness/cli/aisle"))
    if not path.exists():
        pytest.skip(f"{path} is not built")

    def run(*words):
        done = subprocess.run([path, *map(str, words)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


@pytest.fixture(scope="session")
def scene():
    return aisle.Simulator("smoke/short")


@pytest.fixture(scope="session")
def frames(scene):
    """The first twenty of that scene."""
    return [scene.render(k) for k in range(20)]


@pytest.fixture(scope="session")
def drive_file(tmp_path_factory):
    file = tmp_path_factory.mktemp("drive") / "short.yaml"
    file.write_text(SHORT_DRIVE)
    return file
