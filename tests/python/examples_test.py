"""The scripts that users begin with run, and do what they say."""

import os
import pathlib
import subprocess
import sys

import numpy as np

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "harness/python/examples"


def run(name, *words, folder):
    path = os.pathsep.join(p for p in sys.path if (pathlib.Path(p) / "aisle").is_dir())
    done = subprocess.run([sys.executable, EXAMPLES / name, *words], cwd=folder, text=True,
                          capture_output=True, env=os.environ | {"PYTHONPATH": path})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_dataset_for_a_network(tmp_path):
    run("dataset_for_a_network.py", "--scene", "smoke/short", "--every", "20", "--seeds", "2",
        "--out", "set", folder=tmp_path)
    shards = sorted((tmp_path / "set").glob("*.npz"))
    assert len(shards) == 2
    with np.load(shards[0]) as shard:
        count = len(shard["image"])
        assert count == len(shard["moving"]) == len(shard["flow"]) == len(shard["depth"]) > 1
        assert shard["image"].dtype == np.uint8 and set(np.unique(shard["moving"])) <= {0, 1}


def test_own_slam(tmp_path):
    said = run("own_slam.py", "--frames", "16", folder=tmp_path)
    errors = [float(line.split()[-2]) for line in said.splitlines() if line.startswith("ATE")]
    assert len(errors) == 2 and all(0 < error < 0.2 for error in errors), said


def test_own_metric(tmp_path):
    said = run("own_metric.py", folder=tmp_path)
    rows = [line.split() for line in said.splitlines() if line.startswith(("paper", "robust"))]
    assert len(rows) == 2, said
    assert all(0 <= float(row[1]) <= 1 for row in rows)
