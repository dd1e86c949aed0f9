"""Each foundation configures alone, and then holds nothing of the other houses.

Usage: alone.py SOURCE_DIR HOUSE. Compiling it alone is the same objects as compiling it in the
whole house; what can go wrong alone is the configuration, so that is what is tried.
"""

import pathlib
import subprocess
import sys
import tempfile


def main(source_dir, house):
    others = {"simulator", "slam", "harness"} - {house}
    with tempfile.TemporaryDirectory() as build:
        configure = ["cmake", "-S", source_dir, "-B", build, "-G", "Ninja", f"-DAISLE_BUILD={house}"]
        run = subprocess.run(configure, capture_output=True, text=True)
        if run.returncode:
            print(run.stdout[-2000:], run.stderr[-2000:], sep="\n")
            return 1
        graph = pathlib.Path(build, "build.ninja").read_text()
    strangers = [other for other in others if f"{source_dir}/{other}/" in graph]
    print(f"{house} configures alone" + (f", but builds files of {strangers}" if strangers else ""))
    return 1 if strangers else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
