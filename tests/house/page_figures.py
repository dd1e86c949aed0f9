"""Holds the figures of reports/*.md against the code that made them.

Usage: page_figures.py SOURCE_DIR [--mark]. A page's block names the folders on which its figures
hang, and the command that wrote it put a foot beneath with its commit:

    <!-- begin views: slam/dynamic simulator -->
    ...
    `./aisle bench ...`; commit 1234567, ...
    <!-- end views -->

Where a folder differs from what that commit held, the block must say so in a line of its own; --mark
writes that line where it is due and takes it away where it is not. Exit 1 names the blocks that say
the wrong thing, 77 (skipped) where there is no history to ask.
"""

import pathlib
import re
import subprocess
import sys

BLOCK = re.compile(r"^<!-- begin (\w+): ([^>]*?) -->\n(.*?)^<!-- end \1 -->$", re.MULTILINE | re.DOTALL)
COMMIT = re.compile(r"^`[^\n]*`; commit ([0-9a-f]{7,40})(\+?), ", re.MULTILINE)
OLD = re.compile(r"^\n?> \*\*Older than the program\*\*[^\n]*\n", re.MULTILINE)


def git(source, *words):
    return subprocess.run(["git", "-C", str(source), *words], capture_output=True, text=True)


def changed_since(source, commit, folders):
    """The folders that differ from that commit's."""
    return [
        folder
        for folder in folders
        if git(source, "diff", "--quiet", commit, "HEAD", "--", folder).returncode
    ]


def warning(commit, changed):
    return (
        f"> **Older than the program**: measured at {commit}; since then {', '.join(changed)} "
        "changed, and figures may have.\n"
    )


def due(source, folders, body):
    """The line that this block should hold: none where it is empty or as new as the code."""
    found = COMMIT.search(body)
    if not found:
        return None
    if git(source, "cat-file", "-e", f"{found.group(1)}^{{commit}}").returncode:
        print(f"commit {found.group(1)} is not in this history: nothing can be said of its figures")
        held = OLD.search(body)
        return held.group().lstrip("\n") if held else None
    changed = changed_since(source, found.group(1), folders)
    if found.group(2) and not changed:
        return warning(found.group(1) + "+", ["uncommitted work"])
    return warning(found.group(1), changed) if changed else None


def with_lines(source, text):
    """The page as it should be, and the names of the blocks that are not."""
    wrong = []

    def mended(block):
        name, folders, body = block.group(1), block.group(2).split(), block.group(3)
        line = due(source, folders, body)
        bare = OLD.sub("", body)
        right = bare if line is None else "\n" + line + bare
        if right != body:
            wrong.append(name)
        return f"<!-- begin {name}: {' '.join(folders)} -->\n{right}<!-- end {name} -->"

    return BLOCK.sub(mended, text), wrong


def missing_folders(source, text):
    return [
        (name, folder)
        for name, folders, _ in BLOCK.findall(text)
        for folder in folders.split()
        if not (source / folder).exists()
    ]


def check(source, mark):
    failed = False
    for page in sorted((source / "reports").glob("**/*.md")):
        text = page.read_text()
        for name, folder in missing_folders(source, text):
            print(f"{page.relative_to(source)}, block {name}: there is no {folder}")
            failed = True
        right, wrong = with_lines(source, text)
        if not wrong:
            continue
        if mark:
            page.write_text(right)
            print(f"{page.relative_to(source)}: {', '.join(wrong)} marked")
            continue
        failed = True
        print(
            f"{page.relative_to(source)}: {', '.join(wrong)} must say whether the code has changed "
            "since; measure again by the command beneath, or mark it: "
            "tests/house/page_figures.py . --mark"
        )
    return 1 if failed else 0


def main(source_dir, *options):
    source = pathlib.Path(source_dir).resolve()
    if git(source, "rev-parse", "--is-shallow-repository").stdout.strip() != "false":
        print("skipped: no git history, or not all of it")
        return 77
    return check(source, "--mark" in options)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
