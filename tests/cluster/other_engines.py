"""The same sweep with GNU parallel and with Dask, which are killed in the middle and started again."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from processes import Failed, descendants, kill, parent, reap, wait_for
from sweep import CHUNKS, say

PARALLEL = (f"seq {CHUNKS} | RAYON_NUM_THREADS=1 parallel --joblog map/jobs.log --resume-failed "
            f"shadowstep sweep map.toml --out map --chunk {{}}/{CHUNKS}")
DASK = f"python3 chunks.py map.toml map {CHUNKS}"
VENV = Path(__file__).parents[2] / "target/dask"


def parallel(page, reference, make):
    """One program is killed, then everything; the same line computes the rest."""
    sweep = make.sweep("parallel")
    sweep.run(page.command("mkdir -p map"))
    line = page.command(PARALLEL)
    process = sweep.start(line)
    wait_for("chunks are computed", lambda: len(sweep.chunks()) >= 3, 60)
    kill(wait_for("a program runs", lambda: sweep.programs(process.pid), 60)[0])
    say("a program was killed with -9")
    wait_for("chunks are computed", lambda: len(sweep.chunks()) >= 7, 60)
    kill_all(process)
    say(f"GNU parallel and its programs were killed with -9 when {len(sweep.chunks())} chunks were complete")
    sweep.run(line)
    log = [entry.split("\t") for entry in (sweep.results / "jobs.log").read_text().splitlines()[1:]]
    failed = sum(entry[6] != "0" or entry[7] != "0" for entry in log)
    say(f"the same line has computed the rest; the job log has {len(log)} entries, {failed} of them failures")
    if not failed:
        raise Failed("the job log has no failure, and a program was killed")
    sweep.run(page.command("shadowstep collect map"))
    sweep.compare(reference)


def dask(page, reference, make):
    """A program, a worker, then everything is killed; the same line computes the rest."""
    sweep = make.sweep("dask")
    (sweep.folder / "chunks.py").write_text(page.file("python"))
    sweep.environment["PATH"] = f"{VENV}/bin:{sweep.environment['PATH']}"
    line = page.command(DASK)
    process = sweep.start(line)
    wait_for("chunks are computed", lambda: len(sweep.chunks()) >= 2, 90)
    kill(wait_for("a program runs", lambda: sweep.programs(process.pid), 60)[0])
    say("a program was killed with -9")
    wait_for("chunks are computed", lambda: len(sweep.chunks()) >= 4, 60)
    program = wait_for("a program runs", lambda: sweep.programs(process.pid), 60)[0]
    worker = parent(program)
    if worker not in descendants(process.pid):
        raise Failed("the worker of a program cannot be found")
    kill(worker)
    say("a worker was killed with -9")
    wait_for("chunks are computed", lambda: len(sweep.chunks()) >= 9, 90)
    kill_all(process)
    say(f"Dask and its programs were killed with -9 when {len(sweep.chunks())} chunks were complete")
    output = sweep.run(line)
    say(f"the same line has computed the rest: {output.splitlines()[-1]}")
    sweep.run(page.command("shadowstep collect map"))
    sweep.compare(reference)


def kill_all(process):
    """kill -9 of a process and all its descendants, which must not have ended."""
    if process.poll() is not None:
        raise Failed(f"it has ended before it could be killed: {process.communicate()}")

    def all_have_ended():
        for pid in descendants():    # each time: a process may start another one after the list was made and before it is killed
            kill(pid)
        return reap() or not descendants()

    wait_for("all have ended", all_have_ended, 10)
    process.communicate()


def no_parallel(_):
    """Why GNU parallel cannot be tested; `None` if it can. Another program has the same name, that of moreutils."""
    if shutil.which("parallel") is None:
        return "GNU parallel is not installed"
    version = subprocess.run(["parallel", "--version"], capture_output=True, text=True).stdout
    return None if version.startswith("GNU parallel") else "`parallel` is not that of GNU"


def no_dask(page):
    """Why Dask cannot be tested; `None` if it can. It is installed from PyPI into `target`, once."""
    install = page.command("pip install distributed")
    environment = dict(
        os.environ, PATH=f"{VENV}/bin:{os.environ['PATH']}", PIP_RETRIES="1", PIP_DEFAULT_TIMEOUT="15", PIP_DISABLE_PIP_VERSION_CHECK="1")
    try:
        if VENV.exists() and subprocess.run([VENV / "bin/python3", "-c", "import distributed"], capture_output=True).returncode == 0:
            return None
        shutil.rmtree(VENV, ignore_errors=True)
        for command in [sys.executable, "-m", "venv", VENV], install.split():
            done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=180)
            if done.returncode != 0:
                lines = (done.stdout + done.stderr).strip().splitlines()
                return f"it cannot be installed: {lines[-1] if lines else done.returncode}"
        return None
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"it cannot be installed: {error}"
