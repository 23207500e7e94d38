"""A sweep as a job array of Slurm, whose tasks and nodes fail: results must have the bytes of the run on one machine."""

import os
import re
import signal
import time

from network import Network
from processes import Failed, kill, wait_for
from slurm import Cluster
from sweep import CHUNKS, list_of, say

SCRIPT = f"shadowstep sweep map.toml --out map --job-script {CHUNKS} > map.sbatch"
SUBMIT = 'sbatch --dependency=afterany:$(sbatch --parsable --time=10 --mem=500M map.sbatch) --wrap "shadowstep collect map"'
MISSING = "sbatch --time=10 --mem=500M --array=$(shadowstep collect map) map.sbatch"
COLLECT = "shadowstep collect map"
LONGEST = 150


class Faults:
    """Faults of the tasks of a cluster; each takes another task."""

    def __init__(self, cluster):
        self.cluster, self.taken = cluster, set()

    def running(self, node=None):
        """A running task: its process and its number."""
        def found():
            programs = self.cluster.programs(node)
            return next(((pid, number) for pid, number in programs if number not in self.taken), None)
        pid, number = wait_for("a task runs", found, 60)
        self.taken.add(number)
        return pid, int(number)

    def kill_program(self):
        pid, number = self.running()
        kill(pid)
        say(f"task {number}: its program was killed with -9")
        return number

    def command(self, *command):
        """A command on a running task; one that ends at this moment is passed over."""
        for _ in range(5):
            _, number = self.running()
            for _, array, task, *_ in self.cluster.tasks("running"):
                if task == str(number):
                    self.cluster.demand(*command, f"{array}_{task}")
                    say(f"task {number}: {' '.join(command)} {array}_{task}")
                    return number
        raise Failed(f"{' '.join(command)}: no task runs long enough")


def slurm(page, reference, make):
    """Programs, tasks, a slurmd and a node fail; what is missing is submitted again."""
    with Cluster(make.folder("cluster")) as cluster, reporting(cluster):
        say(f"up: munged, slurmctld and the nodes {', '.join(cluster.nodes)} with {cluster.cpus} CPUs each")
        sweep = make.sweep("slurm 100%", cluster.environment)
        sweep.run(page.command(SCRIPT))
        say(sweep.run(page.command(SUBMIT)).strip())
        lost = failures(cluster)
        say_lines(sweep.run(page.command("squeue --me")))
        wait_for("all tasks and the collecting job end", lambda: has_ended(cluster), LONGEST)
        check_missing(page, sweep, lost)
        say(sweep.run(page.command(MISSING)).strip())
        wait_for("all tasks end", lambda: has_ended(cluster), LONGEST)
        sweep.run(COLLECT)
        sweep.compare(reference)
        check_again(page, sweep, reference, cluster)
        say(f"states of tasks that have ended: {ends(cluster)}")


def failures(cluster):
    """Makes tasks and nodes fail; returns the tasks that are not started again."""
    faults = Faults(cluster)
    wait_for("tasks run on both nodes", lambda: all(cluster.programs(node) for node in cluster.nodes), 60)
    on_second = len(cluster.programs("n2"))
    cluster.crash("n2")
    say(f"n2: slurmd and {on_second} tasks were killed with -9")
    lost = {faults.kill_program()}
    requeued = faults.command("scontrol", "requeue")
    lost.add(faults.command("scancel"))
    # a slurmd that is killed while it ends a task leaves its node occupied for a minute
    wait_for("n1 has ended these tasks", lambda: not cluster.tasks("completing"), 30)
    before = {pid for pid, _ in wait_for("a task runs on n1", lambda: cluster.programs("n1"), 30)}
    cluster.kill_slurmd("n1")
    time.sleep(0.5)
    after = {pid for pid, _ in cluster.programs("n1")}
    cluster.start_slurmd("n1")
    say(f"n1: slurmd was killed with -9 and started again; {len(before & after)} of its {len(before)} tasks went on without it")
    wait_for("n2 is down", lambda: cluster.states()["n2"].startswith("down"), 90)
    cluster.start_slurmd("n2")
    cluster.wait_until_up()
    say("n2: slurmctld has found it down and started its tasks again; it is up again")
    restarts = re.findall(rf"ArrayTaskId={requeued} .*?Restarts=(\d+)", cluster.ask("scontrol", "--oneliner", "show", "job"))
    if restarts != ["1"]:
        raise Failed(f"task {requeued} was requeued, and has been started again {restarts} times")
    return lost


def check_missing(page, sweep, lost):
    """The collecting job must have listed what is missing, as `collect` does."""
    missing = sweep.missing()
    if not missing or not missing <= lost:
        raise Failed(f"the chunks {list_of(missing)} are missing, and the tasks {list_of(lost)} were ended")
    log = "".join(path.read_text() for path in sweep.folder.glob("slurm-*.out"))
    if list_of(missing) not in log.splitlines():
        raise Failed(f"the log of the collecting job does not list {list_of(missing)}:\n{log}")
    listed = sweep.run(page.command(COLLECT), status=1).strip()
    if listed != list_of(missing):
        raise Failed(f"`{COLLECT}` lists {listed}, not {list_of(missing)}")


def check_again(page, sweep, reference, cluster):
    """An array that is submitted once more computes nothing but chunks that are missing."""
    before = files(sweep, sweep.chunks())
    sweep.run("sbatch map.sbatch")
    sweep.run("sbatch --array=3,7-9 map.sbatch")
    wait_for("all tasks end", lambda: has_ended(cluster), LONGEST)
    if before != files(sweep, sweep.chunks()):
        raise Failed("tasks of complete chunks have changed files")
    say("the array was submitted once more, and tasks 3,7-9 of it: no file has changed")
    for number in 3, 7, 8, 9:
        sweep.chunk(number).unlink()
    sweep.run(page.command('sbatch --array=3,7-9 --wrap "shadowstep sweep map.toml --out map"'))
    wait_for("all tasks end", lambda: has_ended(cluster), LONGEST)
    sweep.compare(reference)
    say("chunks 3,7-9 were removed, and computed again by a custom job script")


def two_networks(page, reference, make):
    """Each node has a network of its own. One is cut off, and its tasks are computed twice: by it and by the other."""
    folder = make.folder("networks")
    with Network(("n1", "n2"), folder) as network, Cluster(folder, network=network) as cluster, reporting(cluster):
        say(f"up: slurmctld at {network.outside}, n1 at {network.address('n1')}, n2 at {network.address('n2')}")
        sweep = make.sweep("slurm-networks", cluster.environment)
        sweep.run(page.command(SCRIPT))
        sweep.run(page.command(SUBMIT))
        stale = wait_for("n2 is computing chunks", lambda: computing(cluster, sweep, "n2"), 60)
        for pid, _ in stale:
            kill(pid, signal.SIGSTOP)
        network.cut("n2")
        say(f"n2: its network was cut while it computed {list_of(int(number) for _, number in stale)}")
        wait_for("n2 is down", lambda: cluster.states()["n2"].startswith("down"), 90)
        both = {int(number) for _, number in stale}
        wait_for("n1 has computed these chunks, too", lambda: both <= sweep.chunks(), LONGEST)
        written = files(sweep, both)
        for pid, _ in stale:
            kill(pid, signal.SIGCONT)
        wait_for("n2 has ended its tasks", lambda: not any(os.path.exists(f"/proc/{pid}/cwd") for pid, _ in stale), 60)
        if len(written & files(sweep, both)):
            raise Failed(f"n2 has not written the chunks {list_of(both)} again")
        say(f"chunks {list_of(both)}: slurmctld has started this again on n1, and n2 has written the same chunks after that")
        network.mend("n2")
        cluster.wait_until_up()
        wait_for("all tasks and the collecting job end", lambda: has_ended(cluster), LONGEST)
        sweep.compare(reference)
        say(f"states of tasks that have ended: {ends(cluster)}")


def computing(cluster, sweep, node):
    """The tasks of a node that have begun their chunks, which are not complete; one that has not begun would find a complete chunk later."""
    begun = [(pid, number) for pid, number in cluster.programs(node) if sweep.has_begun(int(number))]
    return [(pid, number) for pid, number in begun if int(number) in sweep.missing()]


def files(sweep, chunks):
    """The files of some chunks, each by the number of its inode and its time."""
    stats = [sweep.chunk(number).stat() for number in chunks]
    return {(stat.st_ino, stat.st_mtime_ns) for stat in stats}


def has_ended(cluster):
    """Whether no job is pending or running."""
    return not cluster.demand("squeue", "--noheader")


def ends(cluster):
    """How jobs have ended, by their states."""
    states = re.findall(r"JobState=(\w+)", (cluster.folder / "log/jobs.log").read_text())
    return ", ".join(f"{states.count(state)} {state}" for state in sorted(set(states)))


def say_lines(text):
    for line in text.splitlines():
        say(f"  {line}")


class reporting:
    """Shows the cluster's logs if what is done with it fails."""

    def __init__(self, cluster):
        self.cluster = cluster

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is not None and issubclass(kind, Exception):
            print(self.cluster.logs())
