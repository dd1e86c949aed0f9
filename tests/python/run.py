"""Runs the tests of the Python module by the Python that it was built for.

Usage: run.py BUILD_DIR PROGRAM [pytest's options]. Ends with 77 (skipped) where ./aisle python has not
been called, or pytest is missing.
"""

import os
import pathlib
import subprocess
import sys

PYTHON = "/usr/bin/python3"
folder = pathlib.Path(sys.argv[1]) / "python"
if not list(folder.glob("aisle/_core.*.so")):
    print(f"{folder}/aisle: no module there; ./aisle python builds it")
    sys.exit(77)
if subprocess.run([PYTHON, "-c", "import pytest, numpy"], capture_output=True).returncode:
    print("python3-pytest or python3-numpy is not installed")
    sys.exit(77)
tests = pathlib.Path(__file__).resolve().parent
environment = os.environ | {"PYTHONPATH": str(folder), "AISLE_PROGRAM": sys.argv[2]}
sys.exit(subprocess.run([PYTHON, "-m", "pytest", "-q", "-p", "no:cacheprovider", tests, *sys.argv[3:]],
                        env=environment).returncode)
