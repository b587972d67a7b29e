# SPDX-License-Identifier: Apache-2.0
"""A Slurm of this process alone: munged, slurmctld and some slurmd, all on this machine, with their state in a temporary
directory and free ports. It neither needs nor touches daemons of the system. Needs root, as slurmd does.

Every process carries the variable FILAMENT_PRIVATE_SLURM, jobs included; close() kills all that have it, and daemons also
die with the process that started them."""
import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

MARK = "FILAMENT_PRIVATE_SLURM"
PROGRAMS = ("munged", "munge", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo")
PR_SET_PDEATHSIG = 1


def why_not():
    """What is missing to start one, or nothing."""
    missing = [name for name in PROGRAMS if find(name) is None]
    if missing:
        return f"{', '.join(missing)} missing; install slurmctld, slurmd, slurm-client and munge"
    if os.geteuid() != 0:
        return "slurmd needs root"
    if not os.path.ismount("/sys/fs/cgroup"):
        return "slurmd needs control groups; mount a file system of them at /sys/fs/cgroup"
    return None


def find(name):
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def environment_of(pid):
    try:
        text = pathlib.Path(f"/proc/{pid}/environ").read_bytes()
    except OSError:  # it ended
        return {}
    pairs = (entry.partition(b"=") for entry in text.split(b"\0"))
    return {name.decode(errors="replace"): value.decode(errors="replace") for name, _, value in pairs}


def files_of(pid):
    """Names of its open files. slurmstepd writes its title over its environment; its log tells whose it is."""
    try:
        return [os.readlink(link) for link in pathlib.Path(f"/proc/{pid}/fd").iterdir()]
    except OSError:  # it ended
        return []


def die_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


class PrivateSlurm:
    def __init__(self, nodes):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="slurm-"))
        self.nodes = [f"n{i + 1}" for i in range(nodes)]
        self.daemons = {}
        self.environment = {**os.environ, MARK: str(self.folder), "SLURM_CONF": str(self.folder / "slurm.conf")}
        for name in list(self.environment):  # of a job that runs this test
            if name.startswith(("SLURM_", "SBATCH_")) and name != "SLURM_CONF":
                del self.environment[name]
        try:
            self.start()
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self):
        self.start_munge()
        self.write_configuration()
        self.spawn("slurmctld", "-D", "-f", str(self.folder / "slurm.conf"))
        for node in self.nodes:
            self.spawn("slurmd", "-D", "-N", node, "-f", str(self.folder / "slurm.conf"), name=node)
        self.wait_for(lambda: self.run("sinfo", "-h", "-N", "-t", "idle", "-o", "%N", check=False).split() == self.nodes,
                      "the nodes")

    def start_munge(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.folder.chmod(0o755)  # munged refuses a socket that nobody else could reach
        self.spawn("munged", "--foreground", "--force", *(f"--{name}={self.folder}/munge.{suffix}" for name, suffix in (
            ("socket", "sock"), ("key-file", "key"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))))
        socket_option = f"--socket={self.folder}/munge.sock"
        self.wait_for(lambda: subprocess.run([find("munge"), socket_option, "-n"], capture_output=True).returncode == 0,
                      "munged")

    def write_configuration(self):
        host = socket.gethostname().split(".")[0]
        controller, *ports = free_ports(1 + len(self.nodes))
        for name in ("state", *(f"spool-{node}" for node in self.nodes)):
            (self.folder / name).mkdir()
        lines = [f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 State=UNKNOWN"
                 for node, port in zip(self.nodes, ports)]
        (self.folder / "slurm.conf").write_text(f"""ClusterName=private
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge.sock,cred_expire=5
SlurmUser=root
SlurmdUser=root
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool-%n
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd-%n.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0,bf_interval=1
ReturnToService=2
SlurmdTimeout=5
MessageTimeout=5
KillWait=2
MailProg=/bin/true
PropagateResourceLimits=NONE
{os.linesep.join(lines)}
PartitionName=main Nodes=ALL Default=YES MaxTime=30 State=UP
""")

    def spawn(self, program, *words, name=None):
        log = open(self.folder / f"{name or program}.out", "wb")
        self.daemons[name or program] = subprocess.Popen([find(program), *words], env=self.environment, stdout=log,
                                                         stdin=subprocess.DEVNULL, stderr=log, preexec_fn=die_with_parent)

    def run(self, *words, check=True, cwd=None):
        """The standard output of a command of this Slurm."""
        done = subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=120, cwd=cwd)
        if check and done.returncode != 0:
            raise RuntimeError(f"{' '.join(words)}: {done.stdout}{done.stderr}")
        return done.stdout

    def wait_for(self, condition, what, seconds=120):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise RuntimeError(f"waited {seconds} s for {what}\n{self.logs()}")
            time.sleep(0.1)

    def processes(self):
        """Process id and node (None: of no node) of all that belong to this Slurm, except this process."""
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit() or int(entry.name) == os.getpid():
                continue
            environment = environment_of(entry.name)
            logs = {f"{self.folder}/slurmd-{node}.log": node for node in self.nodes}
            if environment.get(MARK) == str(self.folder):
                yield int(entry.name), environment.get("SLURMD_NODENAME")
            else:
                for node in {logs[name] for name in files_of(entry.name) if name in logs}:
                    yield int(entry.name), node

    def kill_node(self, node):
        """As if its power failed: slurmd, its steps and their tasks end at once, without a word."""
        self.daemons[node].kill()
        self.daemons[node].wait()
        for _ in range(2):  # again for what was started while the first were killed
            for pid, of_node in self.processes():
                if of_node == node:
                    kill(pid)

    def logs(self, lines=15):
        """The end of every log, for a test that fails."""
        text = []
        for path in sorted([*self.folder.glob("*.log"), *self.folder.glob("*.out")]):
            text += [f"== {path.name}", *path.read_text(errors="replace").splitlines()[-lines:]]
        return "\n".join(text)

    def close(self):
        for daemon in reversed(self.daemons.values()):
            daemon.kill()
        for _ in range(3):
            for pid, _ in self.processes():
                kill(pid)
        for daemon in self.daemons.values():
            daemon.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
