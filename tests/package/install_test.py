"""The installed program and libraries do without the source tree.

Usage: install_test.py BUILD_DIR SOURCE_DIR. Installs into a prefix, moves it, and then: no file names
the tree; the program finds its scenes, draws one, keeps its caches where XDG says and speaks of
itself by its name; a project elsewhere finds the libraries, links them and drives.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "house"))
import arrows

BUILD, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
PACKAGE_TEST = pathlib.Path(__file__).resolve().parent


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    return done.returncode, done.stdout + done.stderr


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        root = pathlib.Path(cls.holder.name)
        code, text = run("cmake", "--install", BUILD, "--prefix", root / "first")
        assert code == 0, text
        cls.prefix = (root / "first").rename(root / "moved")
        cls.home = root / "home"
        cls.home.mkdir()
        cls.environment = {
            key: value
            for key, value in os.environ.items()
            if not key.startswith(("AISLE_", "XDG_")) and key != "HOME"
        } | {"HOME": str(cls.home)}

    def aisle(self, *words, **changed):
        return run(
            self.prefix / "bin/aisle", *words, env=self.environment | changed, cwd=self.home
        )

    def test_no_file_names_the_source_tree(self):
        named = [
            path
            for path in self.prefix.rglob("*")
            if path.is_file() and str(SOURCE).encode() in path.read_bytes()
        ]
        self.assertEqual(named, [])

    def test_of_the_foundations_only_public_headers_and_what_they_include_are_installed(self):
        headers = {path.relative_to(SOURCE).as_posix(): path.read_text()
                   for house in ("slam", "simulator") for path in SOURCE.glob(f"{house}/**/*.h")}
        expected = arrows.FACES.union(*(arrows.pulled_in(headers, face) for face in arrows.FACES))
        root = self.prefix / "include/aisle"
        found = {path.relative_to(root).as_posix()
                 for house in ("slam", "simulator") for path in root.glob(f"{house}/**/*")
                 if path.is_file()}
        self.assertEqual(found, expected)

    def test_scenes_are_found_by_name_and_drawn(self):
        for name in ("smoke/short", "quickstart", "scenes/suites/smoke.yaml"):
            code, text = self.aisle("check", name)
            self.assertEqual(code, 0, text)
        code, text = self.aisle("preview", "smoke/short", "-o", "short.png")
        self.assertEqual(code, 0, text)
        self.assertGreater((self.home / "short.png").stat().st_size, 10000)

    def test_caches_and_baselines_are_the_users(self):
        code, text = self.aisle("doctor")
        self.assertIn(f"{self.home}/.cache/aisle", text)
        elsewhere = self.home / "elsewhere"
        code, text = self.aisle("doctor", XDG_CACHE_HOME=str(elsewhere))
        self.assertIn(f"{elsewhere}/aisle", text)
        code, text = self.aisle("run", "suites/smoke", "--seeds", "9", "--gate", "--dry-run")
        self.assertEqual(code, 0, text)

    def test_pages_and_clients_of_the_stream_are_there(self):
        pages = self.prefix / "share/doc/aisle"
        for link in ("README.md", "reports/docs/README.md", "reports/docs/stream.md"):
            self.assertTrue((pages / link).is_file(), link)
        folders = [path.name for path in (pages / "reports").iterdir() if path.is_dir()]
        self.assertEqual(folders, ["docs"])
        client = pages / "examples/stream/client.py"
        _, text = run(sys.executable, client, stdin=subprocess.DEVNULL)
        self.assertIn("the harness went away", text)

    def test_it_calls_itself_by_its_name_and_knows_its_commit(self):
        _, text = self.aisle("run", "--help")
        self.assertIn("Example: aisle run", text)
        self.assertNotIn("./aisle", text)
        _, text = self.aisle("--version")
        commit = (self.prefix / "share/aisle/commit").read_text().strip()
        self.assertTrue(text.rstrip().endswith(f"({commit or 'unknown'})"), text)

    def build(self, project):
        folder = pathlib.Path(self.holder.name) / project
        code, text = run(
            "cmake", "-S", PACKAGE_TEST / project, "-B", folder, "-G", "Ninja",
            f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release",
        )  # fmt: skip
        self.assertEqual(code, 0, text)
        code, text = run("cmake", "--build", folder)
        self.assertEqual(code, 0, text)
        return folder

    def test_another_project_finds_links_and_drives(self):
        folder = self.build("consumer")
        share = self.prefix / "share/aisle"
        code, text = run(
            folder / "drive", share / "scenes/smoke/bits.yaml", share / "assets",
            env=self.environment | {"AISLE_READ_MODEL": str(self.prefix / "libexec/aisle/aisle-read-model")},
        )  # fmt: skip
        self.assertEqual((code, text), (0, "4 of 4 tracked\n"))

    def test_another_project_links_every_room_of_the_harness(self):
        assets = {"AISLE_ASSETS": str(self.prefix / "share/aisle/assets")}
        code, text = run(self.build("harness_consumer") / "rooms", env=self.environment | assets)
        self.assertEqual((code, text), (0, "packs, makes\n"))

    def test_the_package_of_the_libraries_needs_what_they_are_built_from(self):
        of_tests = {"libgmock-dev", "libgtest-dev", "librapidcheck-dev", "libvalijson-dev"}
        needed = {
            line
            for line in (SOURCE / "packages.txt").read_text().splitlines()
            if line.startswith("lib") and line.endswith("-dev")
        }
        said = re.search(
            r"set\(AISLE_DEV_PACKAGES([^)]*)\)",
            (SOURCE / "harness/package/install.cmake").read_text(),
        )
        self.assertEqual(needed - of_tests - set(said[1].split()), set())

    def test_an_old_processor_is_told_so(self):
        if run("which", "qemu-x86_64")[0]:
            self.skipTest("qemu-user is not installed")
        code, text = run("qemu-x86_64", "-cpu", "Nehalem", self.prefix / "bin/aisle", "--version")
        self.assertEqual(code, 3)
        self.assertIn("this processor lacks AVX2", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
