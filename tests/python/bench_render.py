"""What a frame costs in Python over what it costs in the program: both render the same frames by turns.

Usage: ./aisle python tests/python/bench_render.py PROGRAM [--rounds N] [--frames N]. Wall time; on a busy
machine take more rounds, and the quieter the better.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile
import time

import aisle

parser = argparse.ArgumentParser()
parser.add_argument("program")
parser.add_argument("--scene", default="paper/scene3")
parser.add_argument("--rounds", type=int, default=5)
parser.add_argument("--frames", type=int, default=20)
arguments = parser.parse_args()

scene = aisle.Simulator(arguments.scene)


def by_python():
    """Median milliseconds, as `bench render` has them: frames spread over the scene."""
    times = []
    for i in range(arguments.frames):
        began = time.perf_counter()
        frame = scene.render(i * len(scene) // arguments.frames)
        pixels = (frame.left, frame.right, frame.depth, frame.labels, frame.moving)
        times.append(1e3 * (time.perf_counter() - began))
        del pixels
    return statistics.median(times)


def by_program():
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "bench.json"
        subprocess.run([arguments.program, "bench", "render", arguments.scene, "--frames",
                        str(arguments.frames), "--json", str(file)], check=True, capture_output=True)
        return json.loads(file.read_text())["pair_ms"]


ratios = []
for turn in range(arguments.rounds):
    python, program = by_python(), by_program()
    ratios.append(python / program)
    print(f"{python:8.1f} ms in Python, {program:8.1f} ms in the program: {ratios[-1]:.3f}", flush=True)
print(f"median ratio {statistics.median(ratios):.3f}")
