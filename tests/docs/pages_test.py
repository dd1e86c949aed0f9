"""The pages keep what they promise: every link leads somewhere, every command line names commands and
options that there are, every block of YAML is read by the reader.

Usage: pages_test.py PROGRAM SOURCE_DIR.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "reports").glob("**/*.md"))]
NIGHTLY = SOURCE / "reports/docs/nightly.md"
HELP = {}


def help_of(*words):
    if words not in HELP:
        run = subprocess.run([PROGRAM, *words, "--help"], capture_output=True, text=True)
        HELP[words] = run.stdout if run.returncode == 0 else ""
    return HELP[words]


def subcommands(*words):
    part = re.search(r"^Subcommands:\n(.*?)\n(?:\n|\Z)", help_of(*words) + "\n", re.M | re.S)
    return re.findall(r"^  ([a-z][a-z-]*)", part.group(1), re.M) if part else []


def blocks(text):
    """(language, body) of each fenced block, and of those that are indented by four."""
    for language, body in re.findall(r"^```(\w*)[^\n]*\n(.*?)^```$", text, re.M | re.S):
        yield language, body
    bare = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    for body in re.findall(r"(?:^    .*\n)+", bare, re.M):
        yield "", re.sub(r"^    ", "", body, flags=re.M)


def command_lines(text):
    """What a reader would type: lines of blocks and code spans that begin with the launcher."""
    spans = [span.replace("\n", " ") for span in re.findall(r"`(\./aisle [^`]+)`", text)]
    lines = [
        line
        for language, body in blocks(text)
        if language in ("", "sh", "bash")
        for line in body.replace("\\\n", " ").splitlines()
    ]
    for line in lines + spans:
        for part in re.split(r"&&|\|\||;", line):
            if part.strip().startswith("./aisle "):
                yield part.strip()


def anchors(text):
    titles = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


class Pages(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        for page in PAGES:
            text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S)
            for target in re.findall(r"\]\(([^)\s]+)\)", text):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, anchor = target.partition("#")
                place = (page.parent / name) if name else page
                self.assertTrue(place.exists(), f"{page.relative_to(SOURCE)}: {target}")
                if anchor:
                    self.assertIn(anchor, anchors(place.read_text()), f"{page.relative_to(SOURCE)}: {target}")

    def test_every_command_and_option_is_there(self):
        seen = 0
        for page in PAGES:
            for line in command_lines(page.read_text()):
                words = shlex.split(line.split(" #")[0].split(" >")[0].replace("…", ""), posix=True)[1:]
                path = ()
                while len(path) < len(words) and words[len(path)] in subcommands(*path):
                    path += (words[len(path)],)
                where = f"{page.relative_to(SOURCE)}: {line}"
                launcher = words[0] in ("test", "fuzz", "package", "python")  # the launcher's own
                self.assertTrue(path or launcher or words[0].startswith("-"), where)
                options = [word.split("=")[0] for word in words if re.match(r"--?[a-zA-Z]", word)]
                for option in [] if launcher else options:
                    known = rf"(^|[\s,]){re.escape(option)}([\s,:]|$)"
                    self.assertRegex(help_of(*path), re.compile(known, re.M), f"{where}: {option}")
                seen += 1
        self.assertGreater(seen, 50)

    def test_every_block_of_yaml_is_read(self):
        seen = 0
        for page in PAGES:
            for language, body in blocks(page.read_text()):
                if language != "yaml" or not re.search(r"^(suite|frames|extend):", body, re.M):
                    continue
                with tempfile.TemporaryDirectory() as folder:
                    file = pathlib.Path(folder) / "block.yaml"
                    (file.parent / "scenes").symlink_to(SOURCE / "scenes")
                    file.write_text(body)
                    run = subprocess.run([PROGRAM, "check", file], capture_output=True, text=True)
                    self.assertEqual(run.returncode, 0, f"{page.relative_to(SOURCE)}:\n{body}\n{run.stderr}")
                seen += 1
        self.assertGreater(seen, 1)

    def test_no_page_waits_for_a_number(self):
        for page in PAGES:
            text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S)
            text = re.sub(r"`[^`]*`", "", text)
            self.assertEqual(re.findall(r"\b[A-Z]{4,}_[A-Z]+\b", text), [], page.relative_to(SOURCE))

    def test_suites_have_as_many_runs_as_the_table_says(self):
        rows = re.findall(r"^\| `(\w+)((?: --seeds \d+)?)` \| (\d+)\b", NIGHTLY.read_text(), re.M)
        self.assertGreater(len(rows), 5)
        for suite, seeds, runs in rows:
            file = SOURCE / f"scenes/suites/{suite}.yaml"
            words = [PROGRAM, "run", file, *seeds.split(), "--dry-run"]
            said = subprocess.run(words, capture_output=True, text=True).stderr
            self.assertIn(f"aisle: {runs} runs", said.replace(",", ""), suite)

    def test_prose_is_wrapped(self):
        others = {"commands.md", "options.md", "scene.md", "suite.md", "scores.md", "scores.head.md", "fuzz.md"}
        for page in [page for page in PAGES if page.name not in others and "gallery" not in page.parts]:
            text = re.sub(r"^```.*?^```$|^<!-- begin.*?^<!-- end", "", page.read_text(), flags=re.M | re.S)
            prose = [line for line in text.splitlines() if not re.match(r"[|!#]|    ", line)]
            long = [line for line in prose if len(line) > 120 and " " in line[:120].strip()]
            self.assertEqual(long, [], page.relative_to(SOURCE))

    def test_the_cron_line_writes_of_every_failure(self):
        line = re.search(r"^0 2 \* \* \*  (.*)$", NIGHTLY.read_text(), re.M).group(1)
        for code, summary in ((0, False), (1, True), (3, False), (4, False)):
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                night = 'while [ "$1" != --out ]; do shift; done; mkdir -p "$2"; echo worse >"$2/summary.txt"'
                for tool, text in (
                    ("aisle", f"echo says why\n{night if summary else ':'}\nexit {code}"),
                    ("git", ":"),
                    ("mail", f'echo "$2" >>{folder}/sent; cat >>{folder}/sent'),
                ):
                    (folder / tool).write_text(f"#!/bin/sh\n{text}\n")
                    (folder / tool).chmod(0o755)
                command = line.replace("/srv/aisle", name).replace("\\%", "%")  # as cron has it
                path = {"PATH": f"{name}:{os.environ['PATH']}"}
                subprocess.run(["/bin/sh", "-c", command], env=os.environ | path, check=False)
                sent = (folder / "sent").read_text() if (folder / "sent").exists() else ""
                told = f"aisle: exit {code}\n" + ("worse\n" if summary else "") + "says why\n"
                self.assertEqual(sent, told if code else "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
