"""A Slurm of its own: munged, slurmctld and slurmd from Debian's packages, unpacked into a folder and
started there without systemd, on ports of their own. Nothing is installed.

    with Slurm(folder) as slurm:
        subprocess.run(["sinfo"], env=slurm.environment)

Unavailable is raised where the packages cannot be had. AISLE_SLURM_DEBS names a folder that holds
them already.
"""

import os
import pathlib
import signal
import socket
import subprocess
import time

PACKAGES = ["slurmctld", "slurmd", "slurm-client", "slurm-wlm-basic-plugins", "munge", "libmunge2"]
LIBRARIES = ["libhwloc15", "libnuma1", "libjson-c5", "libyaml-0-2", "libdbus-1-3", "libreadline8"]

CONFIGURATION = """
ClusterName=aisle
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={daemon_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
PluginDir={root}/usr/lib/x86_64-linux-gnu/slurm-wlm
PlugStackConfig={folder}/plugstack.conf
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/completed.txt
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
KillWait=5
OverTimeLimit=0
MaxArraySize={largest_array}
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=4096 State=UNKNOWN
PartitionName=night Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class Unavailable(Exception):
    pass


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def is_installed(package):
    done = subprocess.run(["dpkg-query", "-W", "-f", "${Status}", package], capture_output=True,
                          text=True)
    return done.stdout == "install ok installed"


def unpack(folder):
    """The packages' files below folder/root."""
    root = folder / "root"
    debs = pathlib.Path(os.environ.get("AISLE_SLURM_DEBS", folder / "debs"))
    debs.mkdir(parents=True, exist_ok=True)
    if not any(debs.glob("slurmctld_*.deb")):
        wanted = PACKAGES + [name for name in LIBRARIES if not is_installed(name)]
        try:
            done = subprocess.run(["apt-get", "download", *wanted], cwd=debs, capture_output=True,
                                  text=True, timeout=300)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise Unavailable(f"no Slurm packages: {error}") from error
        if done.returncode:
            raise Unavailable("no Slurm packages: " + done.stderr.strip()[-300:])
    for deb in debs.glob("*.deb"):
        subprocess.run(["dpkg", "-x", deb, root], check=True)
    return root


class Slurm:
    def __init__(self, folder, cpus=2, largest_array=1001):
        if os.geteuid() != 0:
            raise Unavailable("slurmd starts tasks for root alone here")
        self.folder = pathlib.Path(folder).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.root = unpack(self.folder)
        libraries = self.root / "usr/lib/x86_64-linux-gnu"
        self.bin = self.folder / "bin"
        self.bin.mkdir(exist_ok=True)
        self.configuration = self.folder / "slurm.conf"
        self.environment = dict(os.environ, SLURM_CONF=str(self.configuration),
                                LD_LIBRARY_PATH=f"{libraries}:{libraries}/slurm-wlm",
                                PATH=f"{self.bin}:{os.environ['PATH']}")
        # What a shell of a user finds: clients that bring their libraries along themselves, so that
        # no task inherits a library path.
        for name in ("sbatch", "squeue", "scontrol", "scancel", "sinfo"):
            (self.bin / name).write_text(
                f"#!/bin/sh\nLD_LIBRARY_PATH={libraries}:{libraries}/slurm-wlm "
                f"SLURM_CONF={self.configuration} exec {self.root}/usr/bin/{name} \"$@\"\n")
            (self.bin / name).chmod(0o755)
        self.users = dict(os.environ, SLURM_CONF=str(self.configuration),
                          PATH=self.environment["PATH"])
        self.host = socket.gethostname().split(".")[0]
        self.daemons = {}
        (self.folder / "munge.key").write_bytes(os.urandom(1024))
        (self.folder / "munge.key").chmod(0o400)
        (self.folder / "plugstack.conf").write_text("")
        for name in ("state", "spool"):
            (self.folder / name).mkdir(exist_ok=True)
        self.configuration.write_text(CONFIGURATION.format(
            host=self.host, user="root", folder=self.folder, root=self.root, cpus=cpus,
            largest_array=largest_array, controller_port=free_port(), daemon_port=free_port()))

    def __enter__(self):
        sbin = self.root / "usr/sbin"
        self.start("munged", [sbin / "munged", "--foreground", "--force",
                              f"--key-file={self.folder}/munge.key",
                              f"--socket={self.folder}/munge.socket",
                              f"--pid-file={self.folder}/munged.pid",
                              f"--log-file={self.folder}/munged.log",
                              f"--seed-file={self.folder}/munged.seed"])
        self.wait_for(lambda: (self.folder / "munge.socket").exists(), 30, "munged")
        self.start_controller()
        self.start_daemon()
        self.wait_for(lambda: "idle" in self.run("sinfo", "-h", "-o", "%t"), 60, "an idle node")
        return self

    def __exit__(self, *_):
        subprocess.run([self.bin / "scancel", "--user=root"], env=self.users, capture_output=True)
        time.sleep(1)
        for name in ("slurmd", "slurmctld", "munged"):
            self.kill(name)

    def start(self, name, command):
        with open(self.folder / f"{name}.out", "ab") as log:
            self.daemons[name] = subprocess.Popen([str(one) for one in command],
                                                  env=self.environment, stdout=log, stderr=log,
                                                  start_new_session=True)

    def start_controller(self):
        self.start("slurmctld", [self.root / "usr/sbin/slurmctld-wlm", "-D", "-f",
                                 self.configuration])
        self.wait_for(lambda: "UP" in self.run("scontrol", "ping"), 30, "slurmctld")

    def start_daemon(self):
        sbin = self.root / "usr/sbin"
        self.start("slurmd", [sbin / "slurmd-wlm", "-D", "-f", self.configuration, "-N", self.host,
                              "-d", sbin / "slurmstepd-wlm"])

    def kill(self, name):
        """kill -9 of that daemon alone; its tasks live on."""
        daemon = self.daemons.pop(name, None)
        if daemon and daemon.poll() is None:
            os.kill(daemon.pid, signal.SIGKILL)
        if daemon:
            daemon.wait()

    def run(self, *command):
        done = subprocess.run([str(one) for one in command], env=self.users, capture_output=True,
                              text=True)
        return done.stdout + done.stderr

    def wait_for(self, condition, seconds, what):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                logs = "".join((self.folder / name).read_text(errors="replace")[-1500:]
                               for name in ("slurmctld.log", "slurmd.log", "munged.log",
                                            "munged.out", "slurmctld.out", "slurmd.out")
                               if (self.folder / name).exists())
                raise TimeoutError(f"{what}: not within {seconds} s\n{logs}")
            time.sleep(0.2)
