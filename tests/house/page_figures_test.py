"""page_figures.py says when a page's figures are older than the code, in a repository made here."""

import pathlib
import subprocess
import tempfile
import unittest

import page_figures


class PageFigures(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)
        self.git("init", "-q", "-b", "main")
        self.write("slam/a.cc", "1")
        self.write("simulator/b.cc", "1")
        self.measured = self.commit()

    def git(self, *words):
        who = ["-c", "user.name=A", "-c", "user.email=a@b.c"]
        run = subprocess.run(["git", *who, *words], cwd=self.root, capture_output=True, text=True, check=True)
        return run.stdout.strip()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-qm", "x")
        return self.git("rev-parse", "--short=9", "HEAD")

    def page(self, commit=None, folders="slam"):
        foot = f"`./aisle bench`; commit {commit or self.measured}, CPU, 2 threads, 2026-01-01.\n"
        self.write(
            "reports/p.md",
            f"Before.\n<!-- begin views: {folders} -->\n\n| a |\n\n{foot}\n<!-- end views -->\nAfter.\n",
        )
        return (self.root / "reports/p.md").read_text()

    def check(self, mark=False):
        return page_figures.main(self.root, *(["--mark"] if mark else []))

    def text(self):
        return (self.root / "reports/p.md").read_text()

    def test_figures_of_the_present_code_pass(self):
        self.page()
        self.write("simulator/b.cc", "2")  # not what they hang on
        self.commit()
        self.assertEqual(self.check(), 0)

    def test_a_changed_folder_must_be_said_and_is_marked(self):
        before = self.page()
        self.write("slam/a.cc", "2")
        self.commit()
        self.assertEqual(self.check(), 1)
        self.assertEqual(self.check(mark=True), 0)
        self.assertIn(f"measured at {self.measured}; since then slam changed", self.text())
        self.assertEqual(self.check(), 0)
        marked = self.text()
        self.check(mark=True)
        self.assertEqual(self.text(), marked)
        self.write("slam/a.cc", "1")  # as it was: nothing to warn of
        self.commit()
        self.assertEqual(self.check(), 1)
        self.check(mark=True)
        self.assertEqual(self.text(), before)

    def test_uncommitted_code_is_said_and_of_unknown_code_nothing(self):
        self.page(commit=self.measured + "+")
        self.assertEqual(self.check(), 1)
        self.check(mark=True)
        self.assertIn("uncommitted work", self.text())
        before = self.page(commit="123456789")
        self.assertEqual(self.check(), 0)
        self.check(mark=True)
        self.assertEqual(self.text(), before)

    def test_an_empty_block_says_nothing_and_a_wrong_folder_is_named(self):
        self.write("reports/p.md", "<!-- begin views: slam -->\n<!-- end views -->\n")
        self.assertEqual(self.check(), 0)
        self.write("reports/p.md", "<!-- begin views: slum -->\n<!-- end views -->\n")
        self.assertEqual(self.check(), 1)

    def test_without_history_it_is_skipped(self):
        with tempfile.TemporaryDirectory() as elsewhere:
            self.assertEqual(page_figures.main(elsewhere), 77)


if __name__ == "__main__":
    unittest.main()
