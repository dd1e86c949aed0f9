"""The launcher of a tree, with programs of our own in place of those that it calls.

Usage: launcher_test.py SOURCE_FOLDER
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])
NEEDED = ("bash", "dirname", "readlink", "mkdir", "flock", "grep", "awk", "tail", "head", "env",
          "id", "tr", "cat")


class Launcher(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="aisle_launcher_"))
        self.addCleanup(shutil.rmtree, folder)
        self.root = folder / "tree"
        (self.root / ".ci").mkdir(parents=True)
        for name in ("aisle", "packages.txt", ".ci/test_data"):
            shutil.copy(SOURCE / name, self.root / name)
        (self.root / "bin").mkdir()
        for name in NEEDED:
            (self.root / "bin" / name).symlink_to(shutil.which(name))
        self.program("bin/ninja", "echo ninja: no work to do.")
        self.program("bin/cmake", "exit 1")
        self.machine("x86_64", "fpu sse2 avx avx2 bmi2")

    def program(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def machine(self, name, flags):
        """What uname and the kernel's file on processors say."""
        self.program("bin/uname", f"echo {name}")
        (self.root / "cpuinfo").write_text(f"flags\t\t: {flags}\n")
        (self.root / "bin/grep").unlink()
        self.program("bin/grep", f"""for word; do
  shift
  [ "$word" = /proc/cpuinfo ] && word={self.root}/cpuinfo
  set -- "$@" "$word"
done
exec {shutil.which("grep")} "$@\"""")

    def build(self):
        (self.root / "build/release").mkdir(parents=True)
        (self.root / "build/release/build.ninja").touch()
        self.program("build/release/harness/cli/aisle", 'echo "program $*"')

    def run_it(self, *words, **more):
        environment = {"PATH": str(self.root / "bin"), "AISLE_NO_INSTALL": "1"} | more
        done = subprocess.run([self.root / "aisle", *words], capture_output=True, text=True,
                              env=environment)
        return done.returncode, done.stdout, done.stderr

    def test_what_is_built_runs_where_there_is_no_dpkg(self):
        self.build()
        self.assertEqual(self.run_it("check", "a b"), (0, "program check a b\n", ""))

    def test_a_tree_that_nobody_configured_says_what_to_do(self):
        code, said, why = self.run_it("check")
        self.assertEqual((code, said), (3, ""))
        self.assertIn("packages.txt", why)
        self.assertIn("cmake --preset release", why)

    def test_packages_that_dpkg_lacks_are_named(self):
        self.build()
        self.program("bin/dpkg-query", "exit 1")
        code, _, why = self.run_it("check")
        self.assertEqual(code, 3)
        self.assertIn("apt-get install build-essential ", why)

    def test_another_processor_is_named_before_anything_is_installed(self):
        self.build()
        for name, flags, named in (("aarch64", "fp asimd", "aarch64"),
                                   ("x86_64", "fpu sse2 avx not_avx2", "lacks AVX2")):
            self.machine(name, flags)
            for command in ("check", "test", "python", "package", "fuzz"):
                code, said, why = self.run_it(command)
                self.assertEqual((code, said), (3, ""), command)
                self.assertIn("x86-64 processor with AVX2 is needed", why)
                self.assertIn(named, why)
                self.assertEqual(why.count("\n"), 1, why)

    def test_cmake_refuses_another_processor(self):
        done = subprocess.run(
            ["cmake", "-S", SOURCE, "-B", self.root / "cross", "-DCMAKE_SYSTEM_NAME=Linux",
             "-DCMAKE_SYSTEM_PROCESSOR=aarch64"], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("needs an x86-64 processor with AVX2", " ".join(done.stderr.split()))
        self.assertIn("not aarch64", " ".join(done.stderr.split()))

    def test_data_beside_the_tree_serves_the_tests(self):
        self.build()
        self.program("bin/ctest", 'echo "$AISLE_TEST_DATA"')
        self.program("bin/nproc", "echo 1")
        self.assertEqual(self.run_it("test")[1], "\n")
        data = self.root.parent / "shared/data"
        data.mkdir(parents=True)
        self.assertEqual(self.run_it("test")[1], f"{data}\n")
        self.assertEqual(self.run_it("test", AISLE_TEST_DATA="mine")[1], "mine\n")

    def test_its_own_commands_are_explained_where_nothing_is_there(self):
        for command in ("test", "package", "fuzz", "python"):
            for word in ("--help", "-h"):
                code, said, why = self.run_it(command, word)
                self.assertEqual((code, why), (0, ""), command)
                self.assertIn(f"Usage: ./aisle {command} ", said)
                self.assertIn(f"Example: ./aisle {command}", said)

    def test_they_are_listed_beneath_those_of_the_program(self):
        self.build()
        code, said, _ = self.run_it("--help")
        self.assertEqual(code, 0)
        self.assertTrue(said.startswith("program --help\n"), said)
        for command in ("test", "package", "fuzz", "python"):
            self.assertIn(f"\n  {command} ", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
