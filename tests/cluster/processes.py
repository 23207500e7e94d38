"""Processes that are started here, directly or not: all of them are found by their parents, and ended at the end."""

import ctypes
import os
import signal
import subprocess
import time
from pathlib import Path

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
libc = ctypes.CDLL(None, use_errno=True)


class Failed(Exception):
    """What was expected did not happen."""


def adopt_orphans():
    """Processes whose parent ends become children of this one, so that none is lost (a slurmstepd outlives its slurmd)."""
    if libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl(PR_SET_CHILD_SUBREAPER)")


def start(command, output, **options):
    """Starts a service in a session of its own, which Ctrl-C does not reach; it ends when this process does, however that comes."""
    with open(output, "ab") as stream:
        return subprocess.Popen(
            [str(word) for word in command], stdin=subprocess.DEVNULL, stdout=stream, stderr=stream, start_new_session=True,
            preexec_fn=lambda: libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0), **options)


def descendants(root=None):
    """The numbers of all running processes that descend from `root`, this process if it is omitted."""
    children = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, parent = stat.read_text().rpartition(")")[2].split()[:2]
        except OSError:
            continue
        if state != "Z":
            children.setdefault(int(parent), []).append(int(stat.parent.name))
    found, due = [], [root or os.getpid()]
    while due:
        of_this = children.get(due.pop(), [])
        found += of_this
        due += of_this
    return found


def environment(pid):
    """The environment with which a process was started; empty if that cannot be read."""
    try:
        entries = Path(f"/proc/{pid}/environ").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return {}
    return dict(entry.split("=", 1) for entry in entries if "=" in entry)


def words(pid):
    """The command line of a process; empty if it has ended."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace").rstrip("\0").split("\0")
    except OSError:
        return []


def parent(pid):
    """The number of a process's parent; `None` if it has ended."""
    try:
        return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    except OSError:
        return None


def kill(pid, number=signal.SIGKILL):
    """Sends a signal to a process that may have ended."""
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def end_all(seconds=5):
    """Ends every descendant of this process: with SIGTERM, and after some seconds with SIGKILL."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number in signal.SIGTERM, signal.SIGKILL:
        end = time.monotonic() + seconds
        while (left := descendants()) and time.monotonic() < end:
            for pid in left:
                kill(pid, number)
            time.sleep(0.1)
            reap()
        if not left:
            return


def reap():
    """Takes the exit statuses of children that have ended."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass


def wait_for(what, condition, seconds):
    """Waits until `condition()` is true and returns its value."""
    end = time.monotonic() + seconds
    while not (value := condition()):
        if time.monotonic() > end:
            raise Failed(f"{what}: not within {seconds} s")
        time.sleep(0.05)
    return value
