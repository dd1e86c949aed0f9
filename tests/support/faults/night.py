"""A short night that calls of the system fail in: what faults.py and every_fault.py drive."""

import errno
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess

KINDS = {"write": (errno.ENOSPC, errno.EIO, errno.EINTR), "fsync": (errno.EIO, errno.ENOSPC),
         "rename": (errno.ENOSPC, errno.EIO), "open": (errno.EMFILE, errno.EIO),
         "mmap": (errno.ENOMEM,), "fork": (errno.EAGAIN, errno.ENOMEM),
         "readonly": (errno.EROFS, errno.EACCES),
         "clock": (400 * 86400, -400 * 86400, 7200, -7200)}
SUITE = "suite: faults\nquestion: Does it hold?\nscenes: [%s]\nsystems: [plain]\nseeds: 1\n"
TIMEOUT_S = 600
OF_THE_MACHINE = ("ms_", "peak_rss")


def bits(out):
    """What a night must give each time: status, trajectories and all scores but the machine's."""
    runs = json.loads((out / "results.json").read_text())["runs"]
    return [[run["status"], run.get("output_hash"),
             {name: score["value"] for name, score in run["scores"].items()
              if not name.startswith(OF_THE_MACHINE)}] for run in runs]


class Night:
    """A suite of one scene, cut to some frames, and one system, with its own cache and folder."""

    def __init__(self, program, shim, scene, folder, frames=12, more="", options=()):
        text = re.sub(r"(?m)^(\s*frames:) \d+", rf"\1 {frames}", scene.read_text()) + more
        scene = folder / "short.yaml"
        scene.write_text(text.split("\n", 1)[1] if text.startswith("#") else text)
        self.folder, self.shim, self.out = folder, shim, folder / "out"
        self.cache = folder / "cache"
        suite = folder / "faults.yaml"
        suite.write_text(SUITE % scene)
        self.counter = folder / "count"
        self.hit = folder / "count.hit"
        self.command = [program, "run", str(suite), "--no-video", "--resume", "--out",
                        str(self.out), *options]

    def run(self, fault=None, below=None, timeout_s=TIMEOUT_S):
        """Exit code, what was said on stderr and stdout, and how many calls of the kind there
        were below a folder, the night's own if none is named."""
        environment = dict(os.environ, AISLE_CACHE=str(self.cache))
        self.counter.write_bytes(struct.pack("Q", 0))
        self.hit.unlink(missing_ok=True)
        if fault:
            environment.update(LD_PRELOAD=str(self.shim), AISLE_FAULT=fault,
                               AISLE_FAULT_BELOW=str(below or self.folder),
                               AISLE_FAULT_COUNT=str(self.counter))
        done = subprocess.run(self.command, env=environment, capture_output=True, text=True,
                              timeout=timeout_s)
        return (done.returncode, done.stdout + done.stderr,
                struct.unpack("Q", self.counter.read_bytes())[0])

    def failing_call(self):
        """Which call the last fault hit, as "process: file"; empty where none was reached."""
        return self.hit.read_text().strip() if self.hit.exists() else ""

    def clear(self):
        """Nothing was ever driven; the light, which takes longest, is kept."""
        self.clear_report()
        shutil.rmtree(self.cache / "frames", ignore_errors=True)

    def clear_report(self):
        shutil.rmtree(self.out, ignore_errors=True)
        for path in self.folder.glob("history.sqlite*"):
            path.unlink()


def name_of(kind, error):
    return f"{error} s" if kind == "clock" else errno.errorcode[error]
