"""A night through a Slurm of its own (tests/support/slurm.py) against the same night on this machine.

The controller, the node's daemon, tasks and the merge are killed, the node is drained, the queue ends
tasks as it does at their limit: nothing may be lost and the verdict must be right. Where Slurm's packages cannot be
had, those tests are skipped with a message; what needs no queue is tested all the same.

Usage: cluster_test.py PROGRAM SOURCE_FOLDER
"""

import fcntl
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(SOURCE / "tests/support"))
from slurm import Slurm, Unavailable  # noqa: E402

OF_THE_MACHINE = ("ms_", "peak_rss")
CAMERA = "camera: {size_px: [376, 240], focal_px: [217.6, 217.6], center_px: [183.35, 125.85]}\n"
SUITE = """suite: many
question: Is a cluster's night this machine's night?
scenes: [tiny.yaml]
systems: [plain, oracle]
twins: [live, empty]
seeds: %d
"""
# Fails at first; the second time it ends well where none of the truth on its node can be read.
SPY = """case $1 in */again/*) ;; *) exit 7 ;; esac
truth=$(find "${1%%/task-*}" -name truth.txt)
[ -n "$truth" ] || exit 8
for file in $truth; do cat "$file" >/dev/null 2>&1 && exit 9; done
for x in 0 1 2 3; do echo "1 0 0 0  0 1 0 0  0 0 1 0.$x"; done >"$1"
"""
# As Kubernetes has it: a Job that is there is not made again, and waiting for what never comes ends
# with the time alone.
KUBECTL = """case $1 in
delete) shift; for job; do rm -f "$STATE/$job"; done ;;
apply) for job in $(sed -n 's/^  name: "\\(.*\\)"$/\\1/p' "$3"); do
    [ -e "$STATE/$job" ] || { echo "$ENDS" >"$STATE/$job"; echo made >>"$STATE/log"; }
  done ;;
wait) [ "$2" = "--for=condition=$(cat "$STATE/${4#job/}")" ] ;;
patch) [ -e "$STATE/$3" ] && echo released >>"$STATE/log" ;;
esac
"""
root = pathlib.Path(tempfile.mkdtemp(prefix="aisle_cluster_"))
unittest.addModuleCleanup(shutil.rmtree, root, ignore_errors=True)


def write_suite(seeds, frames=4):
    text = (SOURCE / "scenes/smoke/short.yaml").read_text()
    text = text.replace("frames: 40", f"frames: {frames}")
    (root / "tiny.yaml").write_text(text + CAMERA)
    (root / f"suite_{seeds}.yaml").write_text(SUITE % seeds)
    return root / f"suite_{seeds}.yaml"


def aisle(*arguments, environment=None):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=root,
                          env=environment)
    return done.returncode, done.stdout + done.stderr


def bits(out):
    """All of a night that must not depend on who drove it."""
    results = json.loads((out / "results.json").read_text())
    runs = {}
    for run in results["runs"]:
        scores = {name: value for name, value in run["scores"].items()
                  if not name.startswith(OF_THE_MACHINE)}
        runs[run["id"]] = (
            run["status"], run["inputs_hash"], run["output_hash"], run["content_hash"],
            json.dumps(scores, sort_keys=True))
    trajectories = {path.relative_to(out).as_posix(): path.read_bytes()
                    for name in ("live.txt", "final.txt", "truth.txt")
                    for path in sorted((out / "runs").rglob(name))}
    return runs, trajectories


def read_jobs(test, yaml):
    """The documents as a YAML reader and the published schema of others have them."""
    npm = shutil.which("npm")
    if not npm or not shutil.which("node"):
        test.skipTest("no npm and node here")
    folder = root / "npm"
    folder.mkdir(exist_ok=True)
    for name in ("package.json", "check_jobs.mjs"):
        shutil.copy(SOURCE / "tests/support/cluster" / name, folder / name)
    if not (folder / "node_modules/yaml").is_dir():
        done = subprocess.run([npm, "install", "--no-audit", "--no-fund"], cwd=folder,
                              capture_output=True, text=True)
        if done.returncode:
            test.skipTest("npm install failed: " + done.stderr.strip()[-300:])
    done = subprocess.run(["node", "check_jobs.mjs"], cwd=folder, input=yaml, capture_output=True,
                          text=True)
    test.assertEqual(done.returncode, 0, yaml + done.stderr)
    return json.loads(done.stdout)


class WithoutAQueue(unittest.TestCase):
    """Tasks by their number alone, as Kubernetes calls them."""

    @classmethod
    def setUpClass(cls):
        cls.suite = write_suite(1)
        cls.local = root / "local_1"
        code, text = aisle("run", cls.suite, "--out", cls.local, "--no-video")
        assert code == 0, text
        cls.environment = dict(os.environ, TMPDIR=str(root / "scratch"))
        (root / "scratch").mkdir(exist_ok=True)

    def task(self, out, index):
        return subprocess.Popen([PROGRAM, "run-task", out], cwd=root,
                                env=dict(self.environment, JOB_COMPLETION_INDEX=str(index)),
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def plan(self, name, *more):
        out = root / name
        done = subprocess.run([PROGRAM, "run", self.suite, "--out", out, "--no-video", "--on", "k8s",
                               "--late", "0", *more], cwd=root, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.recipe = done.stdout
        return out

    def test_tasks_of_any_order_doubled_and_killed_make_the_same_night(self):
        out = self.plan("k8s")
        killed = self.task(out, 1)
        time.sleep(1)
        killed.kill()
        killed.communicate()
        tasks = [self.task(out, index) for index in (1, 0, 1)]  # one of them twice at once
        for task in tasks:
            self.assertEqual(task.wait(), 0, task.stderr.read())
            task.stderr.close()
        code, text = aisle("merge", out)
        self.assertEqual(code, 0, text)
        self.assertEqual(bits(out), bits(self.local))
        self.assertEqual([path.name for path in (root / "scratch").glob("aisle-*/task-*")], [])
        self.assertEqual(aisle("status", out)[0], 0)

    def test_a_second_attempt_and_a_neighbour_on_the_node_see_no_truth(self):
        if "external commands are not confined" in aisle("doctor")[1]:
            self.skipTest("no Landlock here")
        neighbour = root / f"scratch/aisle-{os.getuid()}/task-neighbour"
        (neighbour / "runs").mkdir(parents=True)
        (neighbour / "runs/truth.txt").write_text("of another seed")
        lock = (neighbour / ".lock").open("w")  # somebody's who is at work
        fcntl.flock(lock, fcntl.LOCK_EX)
        self.addCleanup(lock.close)
        (root / "spy.sh").write_text(SPY)
        suite = root / "spied.yaml"
        suite.write_text("suite: spied\nquestion: Does it see truth?\nscenes: [tiny.yaml]\n"
                         "systems:\n  - plain\n  - {name: spy, command: \"sh spy.sh {output}\", "
                         "dataset: kitti, trajectory: kitti}\n"
                         "twins: [live]\nseeds: 1\n")
        out = root / "spied"
        code, text = aisle("run", suite, "--out", out, "--no-video", "--on", "k8s", "--late", 0)
        self.assertEqual(code, 0, text)
        task = self.task(out, 0)
        said = task.communicate()[1]
        self.assertEqual(task.returncode, 0, said)
        self.assertIn("running again to tell flaky from broken", said)
        result = json.loads((out / "runs/tiny/live/spy/1/result.json").read_text())
        self.assertTrue(result["flaky"], result)

    def test_what_is_missing_fails_the_verdict_and_no_more(self):
        out = self.plan("half")
        task = self.task(out, 0)
        self.assertEqual(task.wait(), 0, task.stderr.read())
        task.stderr.close()
        code, text = aisle("merge", out)
        self.assertEqual(code, 1, text)
        self.assertIn("no result", (out / "junit.xml").read_text())
        self.assertEqual(len(bits(out)[0]), 2)
        self.assertEqual(aisle("status", out)[0], 1)

    def test_a_node_with_another_scene_does_not_answer(self):
        out = self.plan("other")
        scene = root / "tiny.yaml"
        text = scene.read_text()
        scene.write_text(text.replace("speed_mps: 1.1", "speed_mps: 1.2"))
        try:
            task = self.task(out, 0)
            said = task.communicate()[1]
        finally:
            scene.write_text(text)
        self.assertEqual(task.returncode, 4)
        self.assertIn("another program, scene", said)

    def test_a_wrong_number_is_named(self):
        out = self.plan("number")
        for index in ("2", "-1", "x", ""):
            task = self.task(out, index)
            said = task.communicate()[1]
            self.assertEqual(task.returncode, 4, index)
            self.assertIn("below 2", said)

    def test_the_yaml_is_what_batch_v1_has(self):
        yaml = subprocess.run([PROGRAM, "run", self.suite, "--seeds", "9", "--out", root / "dry",
                               "--on", "k8s", "--dry-run", "--nodes-at-most", "3"], cwd=root,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              check=True).stdout
        self.assertFalse((root / "dry").exists())
        tasks, merge = read_jobs(self, yaml)
        self.assertEqual({key: tasks["spec"][key] for key in tasks["spec"] if key != "template"},
                         {"completionMode": "Indexed", "completions": 18, "parallelism": 3,
                          "backoffLimit": 24})
        self.assertEqual({key: merge["spec"][key] for key in merge["spec"] if key != "template"},
                         {"suspend": True, "backoffLimit": 0})
        for job, command in ((tasks, "run-task"), (merge, "merge")):
            pod = job["spec"]["template"]["spec"]
            self.assertEqual(set(pod), {"restartPolicy", "containers", "volumes"})
            container = pod["containers"][0]
            self.assertEqual(set(container), {"name", "image", "command", "args", "workingDir",
                                              "env", "resources", "volumeMounts"})
            self.assertEqual(container["args"], [command, str(root / "dry")])
            mounted = {mount["name"]: mount["mountPath"] for mount in container["volumeMounts"]}
            self.assertEqual(mounted, {"report": str(root / "dry"), "scratch": "/scratch"})
            self.assertEqual([volume["name"] for volume in pod["volumes"]], list(mounted))

    def test_a_dry_run_prints_the_scripts_and_leaves_nothing(self):
        code, text = aisle("run", self.suite, "--out", root / "dry", "--on", "slurm", "--dry-run",
                           "--partition", "night", "--nodes-at-most", 2)
        self.assertEqual(code, 0, text)
        self.assertIn("#SBATCH --array=0-1%2", text)
        self.assertIn("#SBATCH --partition=\"night\"", text)
        self.assertFalse((root / "dry").exists())

    def test_an_old_verdict_does_not_speak_for_a_night_that_never_began(self):
        out = self.plan("never")
        code, text = aisle("run", self.suite, "--out", out, "--no-video")
        self.assertEqual(code, 0, text)
        code, text = aisle("status", out)  # a night of this machine
        self.assertEqual((code, "has no run of a cluster" in text), (4, True), text)
        self.plan("never", "--resume")
        self.assertEqual(aisle("status", out)[0], 2)
        self.assertEqual(aisle("merge", out)[0], 0)
        (out / "cluster/submission.json").write_text('{"id": "a", "arrays": ["1"], "merge": "2"}')
        (out / "cluster/verdict.json").write_text('{"submission": "a", "exit_code": 0}')
        queue = dict(os.environ, PATH=f"{self.commands(sbatch='exit 1')}:{os.environ['PATH']}")
        self.assertEqual(aisle("status", out, environment=queue)[0], 0)
        code, text = aisle("run", self.suite, "--out", out, "--on", "slurm", environment=queue)
        self.assertEqual(code, 3, text)
        self.assertEqual(aisle("status", out, environment=queue)[0], 2)
        self.assertFalse((out / "results.json").exists())

    def test_a_night_with_nothing_missing_has_its_verdict_told(self):
        out = root / "nothing"
        code, text = aisle("run", self.suite, "--out", out, "--no-video")
        self.assertEqual(code, 0, text)
        baseline = json.loads((out / "results.json").read_text())
        for run in baseline["runs"]:
            run["scores"]["docking_error_m"] = {"value": 0.01, "unit": "m", "n": 1}
        (root / "more.json").write_text(json.dumps(baseline))  # a score that the night has not
        queue = dict(os.environ, PATH=f"{self.commands(sbatch='exit 1')}:{os.environ['PATH']}")
        code, text = aisle("run", self.suite, "--out", out, "--on", "slurm", "--resume", "--gate",
                           "--baseline", root / "more.json", "--late", 0, environment=queue)
        self.assertEqual(code, 1, text)
        self.assertEqual(aisle("status", out, environment=queue)[0], 1)

    def test_a_merge_by_hand_is_no_verdict_while_jobs_may_come(self):
        out = self.plan("by_hand")
        (out / "cluster/submission.json").write_text('{"id": "a", "arrays": ["1"], "merge": "2"}')
        for squeue, status in (('echo "1|PENDING"', 2), ("exit 1", 2), ("exit 0", 1)):
            queue = dict(os.environ, PATH=f"{self.commands(squeue=squeue)}:{os.environ['PATH']}")
            self.assertEqual(aisle("merge", out, environment=queue)[0], 1)
            self.assertEqual(aisle("status", out, environment=queue)[0], status, squeue)

    def test_the_clusters_own_merge_waits_for_the_folder_where_a_person_is_told(self):
        out = self.plan("held")
        with (out / ".lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            code, text = aisle("merge", out)
            self.assertEqual((code, "in use by" in text), (4, True), text)
            merge = subprocess.Popen([PROGRAM, "merge", out, "--submission", "a"], cwd=root,
                                     stdout=subprocess.DEVNULL)
            time.sleep(2)
            self.assertIsNone(merge.poll())
        self.assertEqual(merge.wait(60), 1)  # of a night of which no run is there

    def test_the_recipe_runs_every_night_and_ends_with_a_night_that_fails(self):
        kubectl = self.commands(kubectl=KUBECTL, sleep="exit 0")
        state = root / "jobs"
        state.mkdir()
        nights = dict(os.environ, PATH=f"{kubectl}:{os.environ['PATH']}", STATE=str(state))
        for night, ends in enumerate(("complete", "failed", "complete"), 1):
            self.plan("recipe")
            done = subprocess.run(["sh", "-ec", self.recipe], env=dict(nights, ENDS=ends), timeout=60,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, self.recipe + done.stderr)
            log = (state / "log").read_text().splitlines()
            self.assertEqual(log.count("made"), 2 * night, self.recipe)
            self.assertEqual(log.count("released"), night)

    def test_a_folder_whose_jobs_wait_is_not_taken(self):
        out = self.plan("waits")
        (out / "cluster/submission.json").write_text('{"id": "a", "arrays": ["1"], "merge": "2"}')
        full = self.commands(squeue='echo "1|PENDING"')
        queue = dict(os.environ, PATH=f"{full}:{os.environ['PATH']}")
        code, text = aisle("run", self.suite, "--out", out, "--no-video", environment=queue)
        self.assertEqual(code, 4, text)
        self.assertIn("its jobs are still in the queue", text)
        queue["PATH"] = f"{self.commands()}:{os.environ['PATH']}"
        code, text = aisle("run", self.suite, "--out", out, "--no-video", environment=queue)
        self.assertEqual(code, 0, text)
        self.assertFalse((out / "cluster/submission.json").exists())

    def commands(self, **scripts):
        """A folder with a batch system's commands that do just this; others answer nothing."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=root))
        for name in ("sbatch", "squeue", "scontrol", *scripts):
            (folder / name).write_text(f"#!/bin/sh\n{scripts.get(name, 'exit 0')}\n")
            (folder / name).chmod(0o755)
        return folder

    def test_what_a_cluster_cannot_do_is_refused(self):
        for more in (["--mcap"], ["--shard", "1/2"]):
            code, text = aisle("run", self.suite, "--out", root / "no", "--on", "slurm", *more)
            self.assertEqual(code, 4, text)
            self.assertFalse((root / "no").exists())
        self.assertEqual(aisle("status", root)[0], 4)
        self.assertEqual(aisle("merge", root)[0], 4)


class OnSlurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            cls.slurm = Slurm(root / "slurm", largest_array=8).__enter__()
        except Unavailable as error:
            raise unittest.SkipTest(str(error)) from error
        cls.addClassCleanup(cls.slurm.__exit__)
        (root / "scratch").mkdir(exist_ok=True)
        cls.environment = dict(cls.slurm.users, TMPDIR=str(root / "scratch"))

    def start(self, suite, out, *more, threads=1):
        return subprocess.Popen(
            [PROGRAM, "run", suite, "--out", out, "--no-video", "--on", "slurm", "--wait", "--late",
             "4", "--threads", str(threads), *map(str, more)],
            cwd=root, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True)

    def end(self, process, out, code, seconds=400):
        try:
            said = process.communicate(timeout=seconds)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            said = process.communicate()[0]
            self.fail(f"no end\n{said}\n{self.slurm.run('squeue')}\n{self.logs(out)}")
        self.assertEqual(process.returncode, code, said + self.logs(out))
        return said

    def logs(self, out):
        return "".join(f"\n{path.name}: {path.read_text(errors='replace')[-400:]}"
                       for path in sorted((out / "cluster/log").glob("*")))

    def local(self, suite, seeds):
        out = root / f"local_{seeds}"
        if not (out / "results.json").exists():
            code, text = aisle("run", suite, "--out", out, "--no-video")
            self.assertEqual(code, 0, text)
        return out

    def results(self, out):
        return len(list((out / "runs").glob("*/*/*/*/result.json")))

    def wait_for_results(self, out, count):
        self.slurm.wait_for(lambda: self.results(out) >= count, 200, f"{count} results")

    def test_a_night_of_forty_runs_is_this_machines(self):
        suite = write_suite(10)
        out = root / "forty"
        began = time.monotonic()
        self.end(self.start(suite, out, "--nodes-at-most", 2), out, 0)
        print(f"\n40 runs in 20 tasks: {time.monotonic() - began:.0f} s", file=sys.stderr)
        self.assertEqual(len(bits(out)[0]), 40)
        self.assertEqual(bits(out), bits(self.local(suite, 10)))
        self.assertGreater(len(json.loads((out / "cluster/submission.json").read_text())["arrays"]), 2)
        self.assertEqual(aisle("status", out, environment=self.environment)[0], 0)
        # Nothing is missing: nothing is submitted, the verdict is made again from the files.
        self.end(self.start(suite, out, "--resume"), out, 0, 60)

    def test_daemons_and_tasks_are_killed(self):
        suite = write_suite(3)
        out = root / "killed"
        process = self.start(suite, out)
        self.wait_for_results(out, 1)
        self.slurm.kill("slurmctld")
        self.slurm.kill("slurmd")
        time.sleep(3)
        self.slurm.start_controller()
        self.slurm.start_daemon()
        self.wait_for_results(out, 3)
        for line in self.slurm.run("pgrep", "-f", f"run-task {out}").split()[:1]:
            os.kill(int(line), signal.SIGKILL)
        said = process.communicate(timeout=400)[0]
        self.assertIn(process.returncode, (0, 1), said + self.logs(out))
        complete = self.results(out) == 12
        self.assertEqual(process.returncode, 0 if complete else 1, said)
        self.end(self.start(suite, out, "--resume"), out, 0)
        self.assertEqual(bits(out), bits(self.local(suite, 3)))

    def test_a_drained_node_and_a_killed_merge(self):
        suite = write_suite(1)
        out = root / "drained"
        self.slurm.run("scontrol", "update", f"nodename={self.slurm.host}", "state=drain",
                       "reason=test")
        process = self.start(suite, out)
        self.slurm.wait_for((out / "cluster/submission.json").exists, 60, "a submission")
        time.sleep(4)
        self.assertIsNone(process.poll())
        merge = json.loads((out / "cluster/submission.json").read_text())["merge"]
        self.slurm.run("scancel", merge)
        self.slurm.run("scontrol", "update", f"nodename={self.slurm.host}", "state=resume")
        said = self.end(process, out, 0)
        self.assertIn("merging here", said)
        self.assertEqual(bits(out), bits(self.local(suite, 1)))

    def test_tasks_that_the_queue_ends_fail_the_verdict_and_resume_mends_it(self):
        suite = write_suite(1, frames=4)
        out = root / "limit"
        process = self.start(suite, out)
        self.slurm.wait_for(lambda: "RUNNING" in self.slurm.run("squeue", "-h", "-o", "%T"), 60,
                            "a running task")
        arrays = json.loads((out / "cluster/submission.json").read_text())["arrays"]
        self.slurm.run("scancel", *arrays)
        self.end(process, out, 1)
        self.assertLess(self.results(out), 4)
        self.end(self.start(suite, out, "--resume"), out, 0)
        self.assertEqual(bits(out), bits(self.local(suite, 1)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
