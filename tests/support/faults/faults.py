#!/usr/bin/env python3
"""Lets calls of the system fail, one after the other, in a short night.

Usage: python3 tests/support/faults/faults.py PROGRAM SHIM SCENE [--points 12] [--kinds write,open,...]

Counts the calls of each kind in a night in peace, then drives it again with a single one failing, at
so many points spread over it: a full disk, a broken one, too many files, no memory, a signal. The
program must end with 0 (it coped) or 3 and a sentence (exit code 1 where a run of its own died of
it), never by a signal, never late; and the same command with --resume must give the same bits. Two kinds stay as they have
become: files that can no longer be changed, which is a fault as the others, and a wall clock that has
jumped, of which a night may notice nothing.
"""

import argparse
import errno
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

KINDS = {"write": (errno.ENOSPC, errno.EIO, errno.EINTR), "fsync": (errno.EIO, errno.ENOSPC),
         "rename": (errno.ENOSPC, errno.EIO), "open": (errno.EMFILE, errno.EIO),
         "mmap": (errno.ENOMEM,), "fork": (errno.EAGAIN, errno.ENOMEM),
         "readonly": (errno.EROFS, errno.EACCES),
         "clock": (400 * 86400, -400 * 86400, 7200, -7200)}
HARMLESS = ("clock",)
SUITE = "suite: faults\nquestion: Does it hold?\nscenes: [%s]\nsystems: [plain]\nseeds: 1\n"
TIMEOUT_S = 600
OF_THE_MACHINE = ("ms_", "peak_rss")


def bits(out):
    runs = json.loads((out / "results.json").read_text())["runs"]
    return [[run["status"], run.get("output_hash"),
             {name: score["value"] for name, score in run["scores"].items()
              if not name.startswith(OF_THE_MACHINE)}] for run in runs]


class Night:
    def __init__(self, program, shim, scene, folder):
        # A dozen frames of it.
        text = re.sub(r"(?m)^(\s*frames:) \d+", r"\1 12", scene.read_text())
        scene = folder / "short.yaml"
        scene.write_text(text.split("\n", 1)[1] if text.startswith("#") else text)
        self.folder, self.shim, self.out = folder, shim, folder / "out"
        suite = folder / "faults.yaml"
        suite.write_text(SUITE % scene)
        self.counter = folder / "count"
        self.command = [program, "run", str(suite), "--no-video", "--resume", "--out",
                        str(self.out)]

    def run(self, fault=None):
        """Exit code, what was said, and how many calls of the kind there were."""
        environment = dict(os.environ, AISLE_CACHE=str(self.folder / "cache"))
        self.counter.write_bytes(struct.pack("Q", 0))
        if fault:
            environment.update(LD_PRELOAD=str(self.shim), AISLE_FAULT=fault,
                               AISLE_FAULT_BELOW=str(self.folder),
                               AISLE_FAULT_COUNT=str(self.counter))
        done = subprocess.run(self.command, env=environment, capture_output=True, text=True,
                              timeout=TIMEOUT_S)
        return (done.returncode, done.stdout + done.stderr,
                struct.unpack("Q", self.counter.read_bytes())[0])

    def clear(self):
        shutil.rmtree(self.out, ignore_errors=True)
        for path in self.folder.glob("history.sqlite*"):
            path.unlink()
        shutil.rmtree(self.folder / "cache/frames", ignore_errors=True)


def points(calls, count):
    if calls <= count:
        return range(1, calls + 1)
    return sorted({1 + round(i * (calls - 1) / (count - 1)) for i in range(count)})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("shim", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--points", type=int, default=12)
    parser.add_argument("--kinds", default=",".join(KINDS))
    options = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="aisle_faults_")).resolve()
    night = Night(options.program, options.shim.resolve(), options.scene.resolve(), folder)
    code, said, _ = night.run()
    if code != 0:
        sys.exit(f"the night in peace ends with {code}\n{said}")
    calm = bits(night.out)
    wrong, tried, coped = [], 0, 0
    for kind in options.kinds.split(","):
        night.clear()
        _, _, calls = night.run(f"{kind}:0:0")
        if calls == 0:
            wrong.append(f"{kind}: no call was counted: the shim does not reach the program")
        print(f"{kind}: {calls} calls", flush=True)
        for number, at in enumerate(points(calls, options.points)):
            error = KINDS[kind][number % len(KINDS[kind])]
            what = f"{error} s" if kind == "clock" else errno.errorcode[error]
            name = f"{kind} {at} of {calls}, {what}"
            night.clear()
            tried += 1
            try:
                code, said, _ = night.run(f"{kind}:{at}:{error}")
            except subprocess.TimeoutExpired:
                wrong.append(f"{name}: no end")
                continue
            coped += code == 0
            if kind in HARMLESS and (code != 0 or bits(night.out) != calm):
                wrong.append(f"{name}: exit code {code}, or other bits\n{said[-400:]}")
            if code not in (0, 1, 3) or (code != 0 and "aisle: " not in said and "crashed" not in said):
                wrong.append(f"{name}: exit code {code}\n{said[-400:]}")
            code, said, _ = night.run()
            if code != 0 or bits(night.out) != calm:
                wrong.append(f"{name}: --resume ends with {code}, other bits\n{said[-400:]}")
    print("\n".join(wrong) or f"{tried} faults: {coped} coped with, the others said; nothing lost")
    if not wrong:
        shutil.rmtree(folder)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
