#!/usr/bin/env python3
"""Lets calls of the system fail, one after the other, in a short night.

Usage: python3 tests/support/faults/faults.py PROGRAM SHIM SCENE [--points 12] [--kinds write,open,...]
       python3 tests/support/faults/faults.py PROGRAM SHIM SCENE --all [--minutes N] [--jobs N]
           [--journal FILE] [--page reports/fuzz.md]

Counts the calls of each kind in a night in peace, then drives it again with a single one failing, at
so many points spread over it: a full disk, a broken one, too many files, no memory, a signal. The
program must end with 0 (it coped) or 3 and a sentence (exit code 1 where a run of its own died of
it), never by a signal, never late; and the same command with --resume must give the same bits. Two
kinds stay as they have become: files that can no longer be changed, which is a fault as the others,
and a wall clock that has jumped, of which a night may notice nothing.

With --all it is every single call instead (every_fault.py says how), for as many minutes as there
are, and goes on the next time where it stopped.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

import every_fault
from night import KINDS, Night, bits, name_of

HARMLESS = ("clock",)


def points(calls, count):
    if calls <= count:
        return range(1, calls + 1)
    return sorted({1 + round(i * (calls - 1) / (count - 1)) for i in range(count)})


def sample(options):
    """A few points of each kind; the exit code of this program."""
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
            name = f"{kind} {at} of {calls}, {name_of(kind, error)}"
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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("shim", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--points", type=int, default=12)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--all", action="store_true", help="every call of every kind")
    parser.add_argument("--minutes", type=float, help="with --all: no longer than that")
    parser.add_argument("--jobs", type=int, default=1, help="with --all: nights at once")
    parser.add_argument("--journal", type=pathlib.Path, default=pathlib.Path("build/faults.jsonl"),
                        help="with --all: the points that were tried, which are not tried again")
    parser.add_argument("--page", type=pathlib.Path,
                        help="with --all: write what is known into its block `faults`")
    options = parser.parse_args()
    return every_fault.run(options) if options.all else sample(options)


if __name__ == "__main__":
    sys.exit(main())
