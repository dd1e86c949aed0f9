#!/usr/bin/env python3
"""Sends mutants of glb, glTF, OBJ and COLLADA files through the door, a reader's process for each.

Usage: python3 tests/support/door/mutants.py DOOR_MUTANTS [--count 10000] [--minutes N] [--jobs N]
           [--formats glb,obj] [--journal FILE] [--page reports/fuzz.md]

DOOR_MUTANTS is the program of mutants.cc. Holds the door to this: the program that asks never
crashes, hears one clear error or gets a sound model, and no reader outlives its answer, its memory
or its time. Readers that died of a file are no failure of the door, and are counted apart: each is
to be mended in the reader. Goes by batches; with a journal, those in it that held are not
run again. Exits with 1 where something does not hold or a reader died.
"""

import argparse
import concurrent.futures
import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import page_block  # noqa: E402

FORMATS = ("glb", "gltf", "obj", "dae")
BATCH = 250
MEMORY_MIB, TIME_S = 1024, 20  # of a reader, as mutants.cc sets them
GRACE_S = 10  # until a killed reader is gone, on a busy machine
COUNTS = ("taken", "refused", "no_memory", "large", "late", "died")
FOLDERS = "simulator/mesh tests/support/door tests/simulator/mesh/mutants.h"


def run_batch(program, kind, first, count):
    """What became of these mutants, as the journal keeps it."""
    with tempfile.TemporaryDirectory(prefix="aisle_mutants_") as folder:
        subprocess.run([sys.executable, HERE.parent / "gltf_models.py", folder], check=True)
        done = subprocess.run([program, kind, str(first), str(count), folder], capture_output=True,
                              text=True, errors="replace")
        line = {"format": kind, "first": first, "count": count}
        if done.returncode != 0:
            return dict(line, wrong=[f"the program itself ended with {done.returncode}: "
                                     f"{done.stderr[-300:]}"])
        line.update(json.loads(done.stdout))
        if line["peak_mib"] > MEMORY_MIB:
            line["wrong"].append(f"a reader took {line['peak_mib']} MiB")
        if line["slowest_s"] > TIME_S + GRACE_S:
            line["wrong"].append(f"a reader took {line['slowest_s']} s")
        return line


def key(line):
    return line["format"], line["first"], line["count"]


def read_journal(file):
    lines = map(json.loads, file.read_text().splitlines()) if file and file.exists() else ()
    return {key(line): line for line in lines}


def drive(options, batches, commit):
    """Runs batches until the time is over; their lines."""
    driven = {}
    end = time.monotonic() + 60 * options.minutes if options.minutes else float("inf")

    def one(batch):
        if time.monotonic() > end:
            return None
        return run_batch(options.program, *batch)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for line in filter(None, pool.map(one, batches)):
            driven[key(line)] = dict(line, commit=commit)
            if options.journal:
                with open(options.journal, "a") as journal:
                    journal.write(json.dumps(driven[key(line)]) + "\n")
            print({name: value for name, value in line.items() if name != "wrong"},
                  *line["wrong"][:5], flush=True)
    return driven


def table(known):
    rows = ["| format | mutants | " + " | ".join(COUNTS).replace("_", " ") +
            " | slowest, s | largest, MiB | wrong |", "|---|" + "---:|" * (len(COUNTS) + 4)]
    for kind in FORMATS:
        lines = [line for line in known.values() if line["format"] == kind]
        if not lines:
            continue
        cells = [sum(line["count"] for line in lines)]
        cells += [sum(line.get(name, 0) for line in lines) for name in COUNTS]
        cells += [f"{max(line.get('slowest_s', 0) for line in lines):.1f}",
                  max(line.get("peak_mib", 0) for line in lines),
                  sum(len(line["wrong"]) for line in lines)]
        rows.append(f"| {kind} | " + " | ".join(map(str, cells)) + " |")
    wrong = [f"- {line['format']}, {one}" for line in known.values() for one in line["wrong"]]
    return "\n".join(rows + ([""] + wrong if wrong else []))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=10000, help="mutants of each format")
    parser.add_argument("--minutes", type=float, help="no longer than that")
    parser.add_argument("--jobs", type=int, default=1, help="batches at once")
    parser.add_argument("--formats", default=",".join(FORMATS))
    parser.add_argument("--journal", type=pathlib.Path, help="of the batches that were run")
    parser.add_argument("--page", type=pathlib.Path, help="write the figures into its block `door`")
    options = parser.parse_args()
    options.program = options.program.resolve()
    known = read_journal(options.journal)
    batches = [(kind, first, min(BATCH, options.count - first))
               for first in range(0, options.count, BATCH) for kind in options.formats.split(",")]
    commit = subprocess.run(["git", "describe", "--always", "--dirty=+", "--exclude", "*"],
                            cwd=HERE, capture_output=True, text=True).stdout.strip()
    todo = [batch for batch in batches if batch not in known or known[batch]["wrong"]]
    known.update(drive(options, todo, commit))
    print(table(known))
    if options.page:
        foot = (f"`tests/support/door/mutants.py DOOR_MUTANTS --count {options.count}`; commit "
                f"{next(line['commit'] for line in known.values())}, {os.cpu_count()} cores, "
                f"{datetime.date.today()}.")
        page_block.put(options.page, "door", FOLDERS, table(known), foot)
    failed = any(line["wrong"] or line.get("died", 0) for line in known.values())
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
