"""Every shell block of the users' pages says how long it takes, and is typed as it is written.

Usage: shell_test.py PROGRAM SOURCE_DIR [--minutes] [--hours] [--page NAME].

The word behind `sh` that opens a block, which readers do not see, tells: nothing, seconds; `minutes`;
`hours`; `elsewhere`, which needs what this machine may not have (root, another repository, a farm).
The blocks of a page are run one after the other in a folder of its own, which looks like a checkout:
`aisle` there is the program itself, without the launcher's build. A block of YAML behind "Save as
`FILE`" is saved there. What a reader brings lies there too: a SLAM `my_slam`, trajectories, masks.
Without options, blocks of seconds are run, up to the first longer one that they need.
"""

import argparse
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import time
import zlib

SPANS = {"": 0, "minutes": 1, "hours": 2, "elsewhere": 3}
FENCE = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.M | re.S)
GENERATED = {"commands.md", "options.md", "scene.md", "suite.md", "scores.md", "scores.head.md"}


def pages(source):
    own = sorted((source / "reports/docs").glob("*.md"))
    return [source / "README.md", *[page for page in own if page.name not in GENERATED]]


def steps(page):
    """(kind, argument, text): files to be saved and blocks to be run, in the page's order."""
    text = page.read_text()
    for match in FENCE.finditer(text):
        words, body = match.group(1).split(), match.group(2)
        line = text.count("\n", 0, match.start()) + 1
        if words[:1] == ["sh"]:
            yield "run", " ".join(words[1:]), body, line
        saved = re.findall(r"Save as\s+`([^`]+)`", text[max(0, match.start() - 200) : match.start()])
        if saved and words[:1] != ["sh"]:
            yield "save", saved[-1], body, line


def bare_commands(page):
    """Lines of commands in blocks that do not say that they are a shell's."""
    for match in FENCE.finditer(page.read_text()):
        if not match.group(1) and re.search(r"^(\./aisle|sudo|aisle) ", match.group(2), re.M):
            yield match.group(2)


def grey_png(rows):
    """Bytes of rows of grey, by the format's own words."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    lines = b"".join(b"\0" + bytes(row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines))
            + chunk(b"IEND", b""))


def bring(folder):
    """What a reader has: two trajectories, and masks."""
    for name, off in (("gt.txt", 0), ("slam.txt", 0.01)):
        rows = [f"{k / 20:.9f} {k * 0.05:.6f} {off * (k % 3):.6f} 0 0 0 0 1" for k in range(200)]
        (folder / name).write_text("\n".join(rows) + "\n")
    for name, width in (("truth/dynamic", 40), ("my_masks", 36)):
        (folder / name).mkdir(parents=True)
        rows = [[255 * (20 <= row < 80 and 30 <= column < 30 + width) for column in range(120)]
                for row in range(90)]
        (folder / name / "000000.png").write_bytes(grey_png(rows))


def make_checkout(folder, program, source):
    for name in ("scenes", "assets", "reports"):
        (folder / name).symlink_to(source / name)
    launcher = folder / "aisle"
    launcher.write_text(f'#!/bin/sh\nexec "{program}" "$@"\n')
    launcher.chmod(0o755)
    bring(folder)
    tools = folder / ".tools"
    tools.mkdir()
    (tools / "my_slam").write_text(
        f'#!/bin/sh\n[ "$1" = --version ] && exec echo my_slam 1\nexec "{program}" slam "$1" -o "$3"\n')
    (tools / "my_slam").chmod(0o755)
    return os.environ | {"PATH": f"{tools}:{os.environ['PATH']}"}


def run_page(page, program, source, longest):
    """Failures, each in words."""
    blocks = [step for step in steps(page)]
    if not any(kind == "run" and SPANS[span] <= longest for kind, span, _, _ in blocks):
        return []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        environment = make_checkout(folder, program, source)
        for kind, argument, text, line in blocks:
            where = f"{page.relative_to(source)}:{line}"
            if kind == "save":
                (folder / argument).write_text(text)
                continue
            if SPANS[argument] > longest:
                continue
            began = time.monotonic()
            done = subprocess.run(["bash", "-eu", "-o", "pipefail", "-c", text], cwd=folder,
                                  env=environment, capture_output=True, text=True)
            print(f"{where}: {time.monotonic() - began:.1f} s, exit {done.returncode}", flush=True)
            if done.returncode:
                return [f"{where}: exit {done.returncode}\n{text}{done.stdout}{done.stderr}"]
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("source", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--minutes", action="store_true", help="blocks of minutes too")
    parser.add_argument("--hours", action="store_true", help="and those of hours")
    parser.add_argument("--page", help="this page alone, by its file's name")
    arguments = parser.parse_args()
    longest = 2 if arguments.hours else 1 if arguments.minutes else 0
    failures, seen = [], 0
    for page in pages(arguments.source):
        failures += [f"{page.name}: a block of commands does not begin with ```sh:\n{text}"
                     for text in bare_commands(page)]
        spans = [span for kind, span, _, _ in steps(page) if kind == "run"]
        failures += [f"{page.name}: ```sh {span}: expected one of {list(SPANS)}"
                     for span in spans if span not in SPANS]
        seen += len(spans)
        if not failures and arguments.page in (None, page.name):
            failures += run_page(page, arguments.program, arguments.source, longest)
    print(f"{seen} blocks, {len(failures)} failures", *failures, sep="\n")
    return 1 if failures or not seen else 0


if __name__ == "__main__":
    sys.exit(main())
