"""A Slurm cluster on this machine: munged, slurmctld and several slurmd with a private configuration in a private folder.

It needs Debian's packages slurmctld, slurmd, slurm-client and munge, and no rights: all services run as the present user, who can be
root. Nothing of the system's own Slurm is read or written, and several clusters can be up at a time.
"""

import getpass
import os
import re
import shutil
import socket
import subprocess
from pathlib import Path

from processes import Failed, descendants, environment, kill, parent, start, wait_for

PROGRAMS = "munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"

# What differs from an ordinary cluster:
# - proctrack/linuxproc, task/none, no accounting of jobs, and cgroup.conf: no cgroups, which need root.
# - ReturnToService=2: a node that was down is used again as soon as its slurmd registers.
# - config_overrides: a node has as many CPUs as configured, whatever the machine has.
# - SlurmdTimeout, MessageTimeout: a node that is lost is down after some 10 s.
# - cred_expire: a task that is requeued starts again after 5 s, not 120 s.
# - KillWait: a cancelled task that ignores SIGTERM is killed after 2 s.
# - MinJobAge: squeue and scontrol know tasks that have ended for 10 minutes, as there is no database.
# - batch_sched_delay, sched_min_interval, bf_interval: tasks start at once.
CONFIGURATION = """\
ClusterName=private
SlurmctldHost={host}({address})
SlurmctldPort={port}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/log/jobs.log
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdParameters=config_overrides
SlurmdTimeout=5
MessageTimeout=4
KillWait=2
MinJobAge=600
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=1
"""

NODE = "NodeName={name} NodeHostname={host} NodeAddr={address} Port={port} CPUs={cpus} RealMemory=1000\n"
PARTITION = "PartitionName=main Nodes=ALL Default=YES MaxTime=60 DefaultTime=10 State=UP\n"


def missing_programs():
    """The programs of the packages that are not there; those of administrators are in /usr/sbin, which is not on every user's PATH."""
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    return [name for name in PROGRAMS if shutil.which(name) is None]


def free_ports(count):
    """Ports of TCP on which nothing listens now."""
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class Cluster:
    """A running cluster; `with Cluster(…)` brings it up. `network` gives the nodes' addresses and namespaces, if they have some."""

    def __init__(self, folder, nodes=("n1", "n2"), cpus=2, network=None):
        self.folder, self.nodes, self.cpus, self.network = Path(folder), nodes, cpus, network
        self.environment = dict(os.environ, SLURM_CONF=f"{folder}/slurm.conf")
        self.services = {}

    def __enter__(self):
        self.make_folders()
        self.write_configuration()
        self.start_munged()
        self.services["slurmctld"] = start(["slurmctld", "-D"], self.folder / "log/slurmctld.out", env=self.environment)
        wait_for("slurmctld answers", lambda: "is UP" in self.ask("scontrol", "ping"), 20)
        for node in self.nodes:
            self.start_slurmd(node)
        self.wait_until_up()
        return self

    def __exit__(self, *_):
        for service in reversed(self.services.values()):
            service.terminate()
        for service in self.services.values():
            try:
                service.wait(5)
            except subprocess.TimeoutExpired:
                service.kill()
                service.wait()

    def make_folders(self):
        """munged accepts only folders that no other user can write, and a socket in one that others can enter."""
        for name, mode in ("munge", 0o755), ("munge/private", 0o700), ("log", 0o700), ("state", 0o700), ("spool", 0o755):
            (self.folder / name).mkdir()
            (self.folder / name).chmod(mode)
        for node in self.nodes:
            (self.folder / "spool" / node).mkdir()

    def write_configuration(self):
        host, port, *ports = socket.gethostname().split(".")[0], *free_ports(1 + len(self.nodes))
        local = "127.0.0.1"
        text = CONFIGURATION.format(
            host=host, address=self.network.outside if self.network else local, port=port, folder=self.folder, user=getpass.getuser())
        for node, its_port in zip(self.nodes, ports):
            address = self.network.address(node) if self.network else local
            text += NODE.format(name=node, host=host, address=address, port=its_port, cpus=self.cpus)
        (self.folder / "slurm.conf").write_text(text + PARTITION)
        # slurmd makes itself a cgroup unless this hinders it; 22.05, which cannot be without them, makes none of version 1 before a plugin asks
        version = re.search(r"(\d+)\.(\d+)", subprocess.run(["slurmd", "-V"], capture_output=True, text=True).stdout)
        plugin = "disabled" if version and tuple(map(int, version.groups())) >= (23, 2) else "cgroup/v1"
        (self.folder / "cgroup.conf").write_text(f"CgroupPlugin={plugin}\n")

    def start_munged(self):
        private, munge_socket = self.folder / "munge/private", self.folder / "munge/socket"
        key = private / "key"
        key.touch(0o600)
        key.write_bytes(os.urandom(1024))
        self.services["munged"] = start(
            ["munged", "--foreground", f"--socket={munge_socket}", f"--key-file={key}", f"--pid-file={private}/pid",
             f"--seed-file={private}/seed", "--num-threads=10", "--origin=127.0.0.1"], self.folder / "log/munged.out")
        wait_for("munged listens", munge_socket.exists, 20)

    def start_slurmd(self, node):
        inside = self.network.inside(node) if self.network else []
        self.services[node] = start(
            [*inside, "slurmd", "-D", "-N", node], self.folder / f"log/slurmd-{node}.out", env=self.environment)

    def wait_until_up(self):
        """Waits until every node can take tasks; one that is completing still ends some."""
        up = {"idle", "mixed", "allocated", "completing"}
        try:
            wait_for("all nodes are up", lambda: set(self.states().values()) <= up, 90)
        except Failed as failure:
            raise Failed(f"{failure}: {self.states()}") from None

    def states(self):
        """The states of the nodes; a star, which marks one that does not answer, is kept."""
        return dict(line.split() for line in self.ask("sinfo", "--noheader", "--Node", "--format=%N %T").splitlines())

    def ask(self, *command):
        """The output of a command of Slurm, whatever its exit status."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def demand(self, *command):
        """The output of a command of Slurm that must succeed."""
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        if done.returncode != 0:
            raise Failed(f"{' '.join(command)}: {done.stderr.strip() or done.returncode}")
        return done.stdout

    def tasks(self, state):
        """The tasks of arrays in a state, each as (its job, its array's job and number, its node)."""
        lines = self.ask("squeue", "--noheader", "--array", f"--states={state}", "--format=%A %F %K %N").splitlines()
        return [(job, array, number, *node) for job, array, number, *node in map(str.split, lines) if number != "N/A"]

    def programs(self, node=None):
        """The processes of tasks that run now, on one node or on all: each as (process, number of its task)."""
        found = []
        for pid in descendants():
            values = environment(pid)
            of_this = values.get("SLURM_CONF") == self.environment["SLURM_CONF"] and "SLURM_ARRAY_TASK_ID" in values
            if of_this and node in (None, values.get("SLURMD_NODENAME")):
                found.append((pid, values["SLURM_ARRAY_TASK_ID"]))
        return found

    def kill_slurmd(self, node):
        """kill -9 of a node's slurmd; its tasks go on."""
        service = self.services.pop(node)
        service.kill()
        service.wait()

    def crash(self, node):
        """The end of a node with all that runs on it."""
        tasks = [pid for pid, _ in self.programs(node)]
        self.kill_slurmd(node)
        for pid in [*map(parent, tasks), *tasks]:  # the slurmstepd first, which would report how its task ended
            if pid and pid != os.getpid():
                kill(pid)
        wait_for("the node's tasks have ended", lambda: not self.programs(node), 10)

    def logs(self):
        """The last lines that each service has printed."""
        text = ""
        for log in sorted((self.folder / "log").glob("*.out")):
            lines = log.read_text(errors="replace").splitlines()[-12:]
            text += f"--- {log.name}\n" + "".join(f"{line}\n" for line in lines)
        return text
