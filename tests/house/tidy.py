#!/usr/bin/env python3
"""Runs clang-tidy over the tree, or over the folders given: tests/house/tidy.py [FOLDER...]

Needs Debian's clang-tidy and a configured release build. GCC's precompiled header means nothing to
clang: the database it is given includes the plain header instead.
"""

import json
import os
import pathlib
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
TIDY = ROOT / "build" / "tidy"
FOREIGN_FLAGS = {"-Winvalid-pch", "-fpch-preprocess"}


def readable_by_clang(entry):
    """The entry of a compile database with the plain header in place of the precompiled one."""
    words = shlex.split(entry["command"])
    while words[0].endswith("cmake") or words[0] in ("-E", "env") or "=" in words[0] or words[
            0].endswith("ccache"):
        words.pop(0)
    words = [word for word in words if word not in FOREIGN_FLAGS]
    if "-include" in words:
        at = words.index("-include") + 1
        header = TIDY / "headers.hxx"
        header.write_text(pathlib.Path(words[at]).read_text())
        words[at] = str(header)
    return {"directory": entry["directory"], "file": entry["file"], "arguments": words}


def own_sources(entries, folders):
    """The files of the database below one of the folders."""
    wanted = [(ROOT / folder).resolve() for folder in folders]
    for entry in entries:
        path = pathlib.Path(entry["file"]).resolve()
        if any(path.is_relative_to(folder) for folder in wanted):
            yield str(path)


def check(path):
    run = subprocess.run(["clang-tidy", "-p", str(TIDY), "--quiet", path],
                         capture_output=True, text=True, check=False)
    found = [line for line in run.stdout.splitlines() if line.strip()]
    print("\n".join([f"{path}: {'ok' if run.returncode == 0 else 'NOT OK'}"] + found), flush=True)
    return run.returncode == 0


def main():
    database = BUILD / "compile_commands.json"
    if not database.exists():
        sys.exit(f"{database}: not there; configure first: cmake --preset release")
    TIDY.mkdir(parents=True, exist_ok=True)
    entries = json.loads(database.read_text())
    (TIDY / "compile_commands.json").write_text(
        json.dumps([readable_by_clang(e) for e in entries]))
    files = sorted(set(own_sources(entries, sys.argv[1:] or ["simulator", "slam", "harness"])))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(check, files))
    print(f"{results.count(True)} of {len(files)} files clean")
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
