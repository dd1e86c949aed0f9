"""Scenes that differ in actors and words alone have one `empty` twin: its frames are rendered once,
and what a run says does not depend on which scene rendered them.

Usage: shared_frames_test.py PROGRAM SOURCE_FOLDER
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
CAMERA = "camera: {size_px: [376, 240], focal_px: [217.6, 217.6], center_px: [183.35, 125.85]}\n"
OF_THE_MACHINE = ("ms_", "peak_rss")
root = pathlib.Path(tempfile.mkdtemp(prefix="aisle_shared_"))
unittest.addModuleCleanup(shutil.rmtree, root, ignore_errors=True)


def run(cache, scene):
    """What the run of a scene's empty twin said, with frames shared through that cache."""
    out = root / f"{cache}_{scene}"
    done = subprocess.run([PROGRAM, "run", root / f"{scene}.yaml", "--systems", "plain", "--twins",
                           "empty", "--seeds", "1", "--no-video", "--out", out],
                          capture_output=True, text=True, cwd=root,
                          env=dict(os.environ, AISLE_CACHE=str(root / cache)))
    assert done.returncode == 0, done.stdout + done.stderr
    record = json.loads(next(out.glob("runs/*/*/*/*/result.json")).read_text())
    scores = {name: value for name, value in record["scores"].items()
              if not name.startswith(OF_THE_MACHINE)}
    return record["content_hash"], record["output_hash"], json.dumps(scores, sort_keys=True)


def rendered(cache):
    return len(list((root / cache / "frames").iterdir()))


class SharedFrames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        text = (SOURCE / "scenes/smoke/short.yaml").read_text().replace("frames: 40", "frames: 4")
        (root / "one.yaml").write_text(text + CAMERA)
        other = text.replace("speed_mps: 1.1", "speed_mps: 0.8").replace("start: [2.6", "start: [2.5")
        other = "# The same hall.\n" + other.replace("while a person crosses", "alone")
        (root / "other.yaml").write_text(other + CAMERA)
        (root / "fast.yaml").write_text(text.replace("speed_mps: 0.7", "speed_mps: 0.8") + CAMERA)

    def test_whoever_rendered_them(self):
        one_first = [run("a", "one"), run("a", "other")]
        self.assertEqual(rendered("a"), 1)
        other_first = [run("b", "other"), run("b", "one")]
        self.assertEqual(rendered("b"), 1)
        self.assertEqual(one_first[0], other_first[1])
        self.assertEqual(one_first[1], other_first[0])
        self.assertEqual(one_first[0], one_first[1])

    def test_what_can_be_seen_is_not_shared(self):
        run("c", "one"), run("c", "fast")
        self.assertEqual(rendered("c"), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
