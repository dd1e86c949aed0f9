"""The installed module does without the source tree, and finds what is installed beside it."""

import os
import pathlib
import subprocess
import sys

import pytest


@pytest.fixture(scope="module")
def prefix(source, tmp_path_factory):
    program = pathlib.Path(os.environ.get("AISLE_PROGRAM", source / "build/release/harness/cli/aisle"))
    builds = {"python": source / "build/python", "data": program.parents[2],
              "program": program.parents[2]}
    folder = tmp_path_factory.mktemp("prefix")
    for component, build in builds.items():
        if not (build / "cmake_install.cmake").exists():
            pytest.skip(f"{build} is not built")
        done = subprocess.run(["cmake", "--install", build, "--prefix", folder / "first",
                               "--component", component], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    return (folder / "first").rename(folder / "moved")


def test_no_file_of_it_names_the_source_tree(prefix, source):
    files = [path for path in (prefix / "lib").rglob("*") if path.is_file()]
    assert any(path.name.startswith("_core.") for path in files)
    assert [path for path in files if str(source).encode() in path.read_bytes()] == []


def test_it_finds_its_scenes_and_renders(prefix, tmp_path):
    script = "import aisle; print(aisle.__file__); print(aisle.Simulator('smoke/bits').render(0))"
    environment = {key: value for key, value in os.environ.items() if not key.startswith("AISLE_")}
    environment |= {"PYTHONPATH": str(prefix / "lib/python3/dist-packages")}
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment,
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(str(prefix)) and "aisle.Frame 0" in done.stdout


def test_an_assets_folder_that_is_not_there_is_told(prefix, tmp_path):
    script = "import aisle; aisle.Simulator('smoke/bits')"
    environment = os.environ | {"PYTHONPATH": str(prefix / "lib/python3/dist-packages"),
                                "AISLE_ASSETS": str(tmp_path / "nowhere")}
    done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True,
                          text=True)
    assert "InputError" in done.stderr and "AISLE_ASSETS" in done.stderr
