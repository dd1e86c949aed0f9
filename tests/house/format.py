"""Every C++ file of ours is as clang-format leaves it. Exit 77 (skipped) without clang-format."""

import pathlib
import shutil
import subprocess
import sys


def main(source_dir):
    formatter = shutil.which("clang-format")
    if not formatter:
        print("skipped: clang-format is not installed")
        return 77
    source = pathlib.Path(source_dir)
    files = [
        str(path)
        for folder in ("simulator", "slam", "harness", "tests")
        for path in sorted(source.glob(f"{folder}/**/*"))
        if path.suffix in (".h", ".cc")
    ]
    if not files:
        print("no C++ files found: the check looks in the wrong place")
        return 1
    run = subprocess.run([formatter, "--dry-run", "--Werror", *files], capture_output=True, text=True)
    for line in run.stderr.splitlines():
        if "error:" in line:
            print(line)
    print(f"{len(files)} files; mend with: clang-format -i FILE")
    return 1 if run.returncode else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
