#!/usr/bin/env python3
"""Fuzzes the readers of bytes: builds the preset `fuzz` and lets every target run for a while.

Usage: ./aisle fuzz [--minutes N | --seconds N] [--jobs N] [--page reports/fuzz.md] [TARGET...]

Each target (tests/fuzz/TARGET.cc) begins with its corpus under tests/fuzz/corpus and with what
earlier runs found of interest (build/fuzz/corpus). An input that breaks a reader lies in
build/fuzz/found afterwards; `build/fuzz/tests/fuzz/fuzz_TARGET FILE` shows it again. Exits with 1
where something was found, with 77 without clang.

The page is written after every target, and keeps the rows of targets that this call does not run:
an hour of each may be spread over several nights.
"""

import argparse
import concurrent.futures
import datetime
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build/fuzz"
SINGLE_INPUT_S, MEMORY_MIB = 25, 3000
SKIPPED = 77
OTHERS = "\n## "  # where other programs' parts of the page begin
PAGE_HEAD = """# What fuzzing the readers found

**{inputs:,} inputs to {targets} readers of bytes: {findings}.** A target hands any bytes at all to one reader
(`tests/fuzz`); a finding is whatever leaves it but the errors that its header names. libFuzzer of clang with ASan and
UBSan; written by `./aisle fuzz --page reports/fuzz.md`.

"""


def targets():
    return sorted(file.stem for file in (ROOT / "tests/fuzz").glob("*.cc") if file.stem != "replay")


def build(chosen):
    log = BUILD.with_suffix(".log")
    log.parent.mkdir(exist_ok=True)
    with open(log, "w") as out:
        steps = [["cmake", "--preset", "fuzz"],
                 ["cmake", "--build", "--preset", "fuzz", "--target", *(f"fuzz_{t}" for t in chosen)]]
        for step in steps:
            if subprocess.run(step, cwd=ROOT, stdout=out, stderr=out).returncode:
                sys.exit(f"{' '.join(step)} failed; the whole log is {log}")


def figure(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


class Outcome:
    """What one run of a target said of itself."""

    def __init__(self, target, seconds, done):
        text = done.stderr
        self.target, self.seconds, self.failed = target, seconds, done.returncode != 0
        self.inputs = figure(r"stat::number_of_executed_units:\s*(\d+)", text)
        self.edges = figure(r"cov: (\d+)", text)
        self.kept = figure(r"corp: (\d+)", text)
        finding = re.search(r"^(?:==\d+==\s*)?(?:ERROR|SUMMARY|terminate|does not hold)[^\n]*", text,
                            re.MULTILINE)
        self.finding = finding.group(0) if finding else text[-300:].strip()


def fuzz(target, seconds):
    known, found = BUILD / "corpus" / target, BUILD / "found"
    known.mkdir(parents=True, exist_ok=True)
    found.mkdir(exist_ok=True)
    command = [BUILD / "tests/fuzz" / f"fuzz_{target}", f"-max_total_time={seconds}",
               f"-timeout={SINGLE_INPUT_S}", f"-rss_limit_mb={MEMORY_MIB}", "-print_final_stats=1",
               "-seed=1", f"-artifact_prefix={found}/{target}-", known,
               ROOT / "tests/fuzz/corpus" / target]
    options = dict(os.environ, ASAN_OPTIONS="allocator_may_return_null=0:max_allocation_size_mb=2048",
                   LSAN_OPTIONS=f"suppressions={ROOT}/tests/support/lsan.supp")
    done = subprocess.run(command, env=options, capture_output=True, text=True, errors="replace",
                          cwd=BUILD)
    return Outcome(target, seconds, done)


def output(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout


def row(outcome):
    """The page's line of one target, with the day and the commit that it ran at."""
    commit = output("git", "describe", "--always").strip()
    if output("git", "status", "--porcelain", "--", ".", ":!reports"):  # where the page lies
        commit += "-dirty"
    found = f"**{outcome.finding.replace('|', '/')}**" if outcome.failed else "0"
    return (f"| {outcome.target} | {outcome.seconds} | {outcome.inputs} | {outcome.edges} | "
            f"{outcome.kept} | {found} | {commit}, {datetime.date.today()} |")


def parts_of(page):
    """What this program writes of a page, and the blocks of others behind it."""
    text = page.read_text() if page.exists() else ""
    own, mark, others = text.partition(OTHERS)
    return own, mark + others


def rows_of(page):
    """The lines of a page's targets, by target; of a page that is absent, none."""
    text, _ = parts_of(page)
    known = {line.split("|")[1].strip(): line for line in text.splitlines() if line.startswith("| ")}
    return {target: line for target, line in known.items() if target in targets()}


def page(rows):
    cells = [line.split("|") for line in rows.values()]
    clang = output("clang++", "--version").splitlines()[0]
    findings = sum(cell[6].strip() != "0" for cell in cells)
    head = PAGE_HEAD.format(inputs=sum(int(cell[3]) for cell in cells), targets=len(rows),
                            findings=f"{findings} findings" if findings else "no finding")
    lines = [head + f"{clang}, {os.cpu_count()} cores.\n",
             "| target | s | inputs | edges reached | inputs kept | found | commit, day |",
             "|---|---|---|---|---|---|---|"]
    lines += [rows[target] for target in sorted(rows)]
    return "\n".join(lines) + "\n"


def write_aside(file, text):
    aside = file.with_name(file.name + ".part")
    aside.write_text(text)
    aside.replace(file)


def main():
    parser = argparse.ArgumentParser(prog="aisle fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("targets", nargs="*", metavar="TARGET", help="default: all")
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--minutes", type=float, help="of each target, 1 if nothing is said")
    length.add_argument("--seconds", type=int, help="of each target")
    parser.add_argument("--jobs", type=int, default=1, help="targets at a time, 1 if not said")
    parser.add_argument("--page", type=pathlib.Path, help="write the figures there")
    options = parser.parse_args()
    unknown = set(options.targets) - set(targets())
    if unknown:
        sys.exit(f"aisle fuzz: no target {', '.join(sorted(unknown))}; there are "
                 f"{', '.join(targets())}")
    if not shutil.which("clang++"):
        print("aisle fuzz: clang is absent: apt-get install clang libclang-rt-14-dev",
              file=sys.stderr)
        return SKIPPED
    build(options.targets or targets())
    seconds = options.seconds or max(1, round(60 * (options.minutes or 1)))
    rows = rows_of(options.page) if options.page else {}
    failed = False
    with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, options.jobs)) as pool:
        running = [pool.submit(fuzz, target, seconds) for target in options.targets or targets()]
        for future in concurrent.futures.as_completed(running):
            last = future.result()
            failed = failed or last.failed
            print(f"{last.target}: {last.inputs} inputs in {seconds} s, {last.edges} edges"
                  + (f": {last.finding}" if last.failed else ""), flush=True)
            rows[last.target] = row(last)
            if options.page:
                write_aside(options.page, page(rows) + parts_of(options.page)[1])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
