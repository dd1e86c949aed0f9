"""Every single write, fsync, rename, open, mmap and fork of a short night, each failing once.

Two nights, each as small as it can be (three frames of a fifth of a picture, one system): `warm`
finds light and frames where the one before left them, `cold` makes them, and of its files only the
cache's are the points, since all others are the warm night's too. After each fault the program must
have ended with 0, with 3 and a sentence, or with 1 where the process of its run died; and the next
night must give the same bits: with --resume, or where nothing had failed anew in the same cache, so
that a damaged entry of it is found out. No file that was being written may be left.

The journal, a line a point, is what goes on the next time: points that held are not tried again,
those that failed are. Points come in an order of chance, the same every time: however few there was
time for, they are spread over all.
"""

import concurrent.futures
import datetime
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from night import KINDS, Night, bits, name_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import page_block  # noqa: E402

SINGLE_KINDS = ("write", "fsync", "rename", "open", "mmap", "fork")
NIGHTS = ("warm", "cold")
SMALL = "camera: {size_px: [320, 240], focal_px: [200, 200], center_px: [160, 120]}\n"
FRAMES, THREADS, LONGEST_S, SEED = 3, 1, 300, 1
FOLDERS = "harness simulator slam tests/support/faults"
ASIDE = (".tmp-", ".part")


class Worker:
    """A folder with its own night and a cache that was made in peace."""

    def __init__(self, options):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="aisle_faults_")).resolve()
        self.night = Night(options.program, options.shim.resolve(), options.scene.resolve(),
                           self.folder, FRAMES, SMALL, ("--threads", str(THREADS)))
        self.kept = self.folder / "kept"
        code, said, _ = self.night.run()
        if code not in (0, 1):
            sys.exit(f"the night in peace ends with {code}\n{said}")
        self.code, self.calm = code, bits(self.night.out)
        shutil.copytree(self.night.cache, self.kept)

    def prepare(self, night):
        self.night.clear_report()
        shutil.rmtree(self.night.cache, ignore_errors=True)
        if night == "warm":
            shutil.copytree(self.kept, self.night.cache)

    def below(self, night):
        return self.folder if night == "warm" else self.night.cache

    def count(self, night, kind):
        self.prepare(night)
        return self.night.run(f"{kind}:0:0", self.below(night))[2]

    def attempt(self, point):
        """The point's line for the journal."""
        night, kind, at, error = point["night"], point["kind"], point["at"], point["error"]
        self.prepare(night)
        try:
            code, said, _ = self.night.run(f"{kind}:{at}:{error}", self.below(night), LONGEST_S)
            hit = self.night.failing_call()
            wrong = self.judge(code, said)
        except subprocess.TimeoutExpired:
            code, said, hit, wrong = None, "", self.night.failing_call(), "no end"
        return dict(point, code=code, hit=hit.replace(str(self.folder), "~"), wrong=wrong,
                    said=said.replace(str(self.folder), "~")[-600:])

    def judge(self, code, said):
        """What is wrong with a faulted night and what follows it; empty: nothing."""
        if code not in (0, 1, 3):
            return f"exit code {code}"
        if code == 3 and not any("aisle: " in line for line in said.splitlines()):
            return "exit code 3 without a sentence"
        if code == self.code and bits(self.night.out) != self.calm:
            return f"exit code {code} with other bits"
        if code == 1 and self.code == 0 and "crashed" not in said:
            return "exit code 1, and no process of a run died"
        if code == self.code:
            self.night.clear_report()
        code, said, _ = self.night.run(timeout_s=LONGEST_S)
        if code != self.code or bits(self.night.out) != self.calm:
            return f"the next night ends with {code}, or has other bits: {said[-300:]}"
        left = [path.name for path in self.folder.rglob("*")
                if any(mark in path.name for mark in ASIDE)]
        return f"left half written: {left}" if left else ""


def all_points(calls):
    """Every call once, its errors in turn, in an order of chance."""
    points = [{"night": night, "kind": kind, "at": at, "of": count,
               "error": KINDS[kind][at % len(KINDS[kind])]}
              for (night, kind), count in sorted(calls.items()) for at in range(1, count + 1)]
    random.Random(SEED).shuffle(points)
    return points


def key(line):
    return line["night"], line["kind"], line["at"]


def read_journal(file):
    """The last line of each point."""
    if not file.exists():
        return {}
    lines = map(json.loads, file.read_text().splitlines())
    return {key(line): line for line in lines if "at" in line}


def known_calls(file):
    """How many calls there were when this journal was begun; empty where nobody has counted."""
    lines = map(json.loads, file.read_text().splitlines()) if file.exists() else ()
    found = [line for line in lines if line.get("calls")]
    return {(night, kind): count for night, kind, count in found[-1]["calls"]} if found else {}


def count_calls(worker, file, commit):
    calls = {(night, kind): worker.count(night, kind) for night in NIGHTS for kind in SINGLE_KINDS}
    with open(file, "a") as journal:
        journal.write(json.dumps({"calls": [[*which, count] for which, count in calls.items()],
                                  "commit": commit}) + "\n")
    return calls


def title(line):
    return (f"{line['night']} {line['kind']} {line['at']} of {line['of']}, "
            f"{name_of(line['kind'], line['error'])} ({line['hit'] or 'not reached'})")


def drive(workers, points, journal, minutes, commit):
    """Tries points until there are none or the time is over; their lines."""
    end = time.monotonic() + 60 * minutes if minutes else float("inf")
    lock, lines, waiting = threading.Lock(), [], iter(points)

    def work(worker):
        while time.monotonic() < end:
            with lock:
                point = next(waiting, None)
            if point is None:
                return
            line = dict(worker.attempt(point), commit=commit)
            with lock, open(journal, "a") as file:
                file.write(json.dumps(line) + "\n")
                lines.append(line)
                if line["wrong"]:
                    print(f"{title(line)}: {line['wrong']}\n{line['said']}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(len(workers)) as pool:
        list(pool.map(work, workers))
    return lines


def table(calls, known):
    rows = ["| night | call | points | tried | completed (0) | run failed (1) | error reported (3) | wrong |",
            "|---|---|---:|---:|---:|---:|---:|---:|"]
    total = [0] * 6
    for (night, kind), count in sorted(calls.items(), reverse=True):
        lines = [line for line in known.values() if (line["night"], line["kind"]) == (night, kind)]
        held = [line for line in lines if not line["wrong"]]
        cells = [count, len(lines)] + [sum(line["code"] == code for line in held)
                                       for code in (0, 1, 3)] + [len(lines) - len(held)]
        total = [a + b for a, b in zip(total, cells)]
        rows.append(f"| {night} | {kind} | " + " | ".join(map(str, cells)) + " |")
    rows.append("| all | | " + " | ".join(map(str, total)) + " |")
    wrong = [f"- {title(line)}: {line['wrong'].splitlines()[0]}"
             for line in known.values() if line["wrong"]]
    return "\n".join(rows + ([""] + wrong if wrong else []))


def oldest_commit(known):
    """That of the first line: what has changed since may have changed any of the figures."""
    return next((line["commit"] for line in known.values()), "")


def version(program):
    said = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    return said.strip().rpartition("(")[2].rstrip(")")


def run(options):
    """What `faults.py --all` does; its exit code."""
    known = read_journal(options.journal)
    options.journal.parent.mkdir(parents=True, exist_ok=True)
    workers = [Worker(options) for _ in range(options.jobs)]
    commit = version(options.program)
    calls = known_calls(options.journal) or count_calls(workers[0], options.journal, commit)
    points = [point for point in all_points(calls)
              if key(point) not in known or known[key(point)]["wrong"]]
    print(f"{sum(calls.values())} points, {len(points)} of them to be tried", flush=True)
    drive(workers, points, options.journal, options.minutes, commit)
    known = read_journal(options.journal)
    print(table(calls, known))
    if options.page:
        foot = (f"`tests/support/faults/faults.py PROGRAM SHIM scenes/smoke/short.yaml --all`; commit "
                f"{oldest_commit(known)}, {os.cpu_count()} cores, {datetime.date.today()}.")
        page_block.put(options.page, "faults", FOLDERS, table(calls, known), foot)
    for worker in workers:
        shutil.rmtree(worker.folder)
    return 1 if any(line["wrong"] for line in known.values()) else 0
