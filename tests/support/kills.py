#!/usr/bin/env python3
"""Kills the program at random moments and holds it to losing nothing.

Usage: python3 tests/support/kills.py PROGRAM SCENE [--kills 200] [--seed 1] [--folder DIR]

A night of three systems (one of them a command), a dataset and a merge are made once in peace. Then
each is begun again and again and killed by SIGKILL after a random while: the program alone, its
whole process group, or one of the processes it started. After every kill no process of it may be
left, and no file under its own name may be half written; at the end the same command with --resume
must give the same bits. Exits with 1 where something of that does not hold. The same seed gives the
same moments, as far as a machine repeats itself.
"""

import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

FOREIGN = "  - {name: foreign, command: \"cp %s {output}\", dataset: kitti}\n"
SUITE = "suite: kills\nquestion: Does it hold?\nscenes: [%s]\nsystems:\n  - plain\n  - oracle\n%stwins: [live, empty]\nseeds: 1\n"
GRACE_S = 5  # within which what belonged to a killed program must be gone
OF_THE_MACHINE = ("ms_", "peak_rss")


def descendants(pid):
    """All processes below one, itself first; those that have left its session too."""
    found = [pid]
    for one in found:
        try:
            for task in pathlib.Path(f"/proc/{one}/task").iterdir():
                found += [int(child) for child in (task / "children").read_text().split()]
        except OSError:
            pass
    return found


def alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class Operation:
    """One command, the folder it fills, and what of that folder must be the same every time."""

    def __init__(self, name, command, out, bits, ends):
        self.name, self.command, self.out, self.bits, self.ends = name, command, out, bits, ends
        self.calm = None
        self.seconds = 0.0

    def start(self):
        return subprocess.Popen(self.command, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, start_new_session=True)

    def to_the_end(self):
        start = time.monotonic()
        done = subprocess.run(self.command, capture_output=True, text=True)
        self.seconds = time.monotonic() - start
        if done.returncode not in self.ends:
            sys.exit(f"{self.name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return self.bits(self.out)


def bits_of_report(out):
    """Every run's trajectories and scores, but for those that belong to the machine."""
    runs = {}
    for run in json.loads((out / "results.json").read_text())["runs"]:
        scores = {name: score["value"] for name, score in run["scores"].items()
                  if not name.startswith(OF_THE_MACHINE)}
        name = "/".join(str(run[key]) for key in ("scene", "twin", "system", "seed"))
        runs[name] = [run["status"], run.get("output_hash"), scores]
    return runs


def bits_of_files(out):
    return {str(path.relative_to(out)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(out.rglob("*"))
            if path.is_file() and not path.name.startswith(".")}


def half_files(out):
    """Files under their own names that are empty or break off."""
    bad = []
    for path in out.rglob("*"):
        if not path.is_file() or path.name.startswith(".") or "guest" in path.parts:
            continue
        text = path.read_bytes()
        if not text and path.name != "log.txt":
            bad.append(f"{path}: empty")
        if path.suffix == ".json":
            try:
                json.loads(text)
            except ValueError as error:
                bad.append(f"{path}: {error}")
        if path.suffix == ".png" and not text.rstrip().endswith(b"IEND\xaeB`\x82"):
            bad.append(f"{path}: breaks off")
    return bad


def kill(process, whom, moment_s, dice):
    """True where it was still at work."""
    try:
        process.wait(moment_s)
        return False
    except subprocess.TimeoutExpired:
        pass
    below = descendants(process.pid)
    try:
        if whom == "group":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            os.kill(dice.choice(below[1:] or below) if whom == "child" else process.pid,
                    signal.SIGKILL)
    except ProcessLookupError:
        pass
    if whom == "child":  # the program lives on and reports it
        process.wait()
        return True
    process.wait()
    end = time.monotonic() + GRACE_S
    while time.monotonic() < end and any(alive(pid) for pid in below):
        time.sleep(0.02)
    left = [pid for pid in below if alive(pid)]
    if left:
        raise AssertionError(f"processes left: {left}")
    return True


def short_scene(scene, folder):
    """The scene, cut to a dozen frames."""
    text = re.sub(r"(?m)^(\s*frames:) \d+", r"\1 12", scene.read_text())
    short = folder / "scenes" / "short.yaml"
    short.parent.mkdir(exist_ok=True)
    short.write_text(text.split("\n", 1)[1] if text.startswith("#") else text)
    return short


def operations(program, scene, folder):
    scene, known = short_scene(scene, folder), folder / "known.txt"
    suite = folder / "kills.yaml"
    suite.write_text(SUITE % (scene, FOREIGN % known))
    run = [program, "run", str(suite), "--jobs", "2", "--no-video"]
    first = folder / "first"
    subprocess.run(run + ["--systems", "plain", "--out", str(first)], check=True,
                   capture_output=True)
    known.write_text(next(first.rglob("plain/1/final.txt")).read_text())
    parts = [str(folder / "part1"), str(folder / "part2")]
    for number, part in enumerate(parts, 1):
        subprocess.run(run + ["--shard", f"{number}/2", "--out", part], capture_output=True)
    night, dataset, merged = folder / "night", folder / "dataset", folder / "merged"
    return [Operation("run", run + ["--resume", "--out", str(night)], night, bits_of_report, (0, 1)),
            Operation("run without cache",
                      run + ["--resume", "--no-frame-cache", "--out", str(folder / "bare")],
                      folder / "bare", bits_of_report, (0, 1)),
            Operation("render", [program, "render", str(scene), "--out", str(dataset)], dataset,
                      bits_of_files, (0,)),
            Operation("merge", [program, "merge", str(merged)] + parts, merged, bits_of_report,
                      (0, 1))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=pathlib.Path)
    options = parser.parse_args()
    folder = (options.folder or pathlib.Path(tempfile.mkdtemp(prefix="aisle_kills_"))).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["AISLE_CACHE"] = str(folder / "cache")
    dice = random.Random(options.seed)
    all_of_them = operations(options.program, options.scene.resolve(), folder)
    for operation in all_of_them:
        operation.calm = operation.to_the_end()
        shutil.rmtree(operation.out)
        print(f"{operation.name}: {operation.seconds:.1f} s in peace", flush=True)
    wrong, counts = [], {}
    for number in range(options.kills):
        operation = dice.choice(all_of_them)
        whom = dice.choice(("program", "group", "child"))
        moment_s = min(dice.expovariate(2 / operation.seconds), 2 * operation.seconds)
        try:
            hit = kill(operation.start(), whom, moment_s, dice)
        except AssertionError as error:
            wrong.append(f"kill {number}, {operation.name}, {whom} after {moment_s:.2f} s: {error}")
            hit = True
        if operation.out.exists():
            wrong += [f"kill {number}, {operation.name}: {bad}" for bad in half_files(operation.out)]
        counts[operation.name, whom, hit] = counts.get((operation.name, whom, hit), 0) + 1
        if not hit:  # it ended before: look, and begin anew
            if operation.to_the_end() != operation.calm:
                wrong.append(f"kill {number}, {operation.name}: other bits")
            shutil.rmtree(operation.out)
    for operation in all_of_them:
        operation.to_the_end()  # what a killed child left crashed is made anew
        if operation.to_the_end() != operation.calm:
            wrong.append(f"{operation.name}: other bits at the end")
    for (name, whom, hit), count in sorted(counts.items()):
        print(f"{name:20} {whom:8} {'killed' if hit else 'had ended':10} {count}")
    print("\n".join(wrong) or f"{options.kills} kills (seed {options.seed}): nothing lost")
    if not options.folder and not wrong:
        shutil.rmtree(folder)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
