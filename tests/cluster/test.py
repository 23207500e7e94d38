#!/usr/bin/env python3
"""Sweeps on Slurm, with GNU parallel and with Dask, each with failures in the middle, beside the run on one machine.

`make test-cluster` calls this. What is not installed is skipped, with the reason. All that is started is ended, and all that is written
is removed, but for Dask, which is kept in `target`. `test.py slurm dask` makes only these tests; SHADOWSTEP=PROGRAM tests another program than
target/debug/shadowstep.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import other_engines
import slurm
import slurm_tests
from page import PAGE, Page
from processes import Failed, adopt_orphans, end_all
from sweep import PROGRAM, Sweep, say

PACKAGES = "slurmctld slurmd slurm-client munge parallel iproute2 python3-venv"


class Make:
    """Makes folders and sweeps for tests."""

    def __init__(self, folder, text):
        self.root, self.text = Path(folder), text

    def folder(self, name):
        path = self.root / name
        path.mkdir(mode=0o755)
        return path

    def sweep(self, name, environment=None):
        return Sweep(self.root / name, self.text, environment)


def one_machine(page, make):
    """The results that all others are compared with: with one thread, and with three."""
    reference = make.sweep("one-thread", dict(os.environ, RAYON_NUM_THREADS="1"))
    reference.run(page.command("shadowstep sweep map.toml --out map"))
    other = make.sweep("three-threads", dict(os.environ, RAYON_NUM_THREADS="3"))
    other.run(page.command("shadowstep sweep map.toml --out map"))
    other.compare(reference)
    rows = [line for line in reference.table().decode().splitlines() if not line.startswith("#")]
    say(f"{len(rows) - 1} runs with one thread and with three")
    return reference


def no_networks():
    """Why nodes cannot have networks of their own; `None` if they can."""
    if os.geteuid() != 0:
        return "network namespaces need root"
    for command in (["ip", "link", "show", "lo"], ["unshare", "--net", "ip", "link", "show", "lo"]):
        try:
            done = subprocess.run(command, capture_output=True, text=True)
        except FileNotFoundError:
            return f"{command[0]} is not installed"
        if done.returncode != 0:
            return f"`{' '.join(command)}`: {done.stderr.strip()}"
    name = f"v{os.getpid()}"
    if subprocess.run(["ip", "link", "add", name, "type", "veth"], capture_output=True).returncode != 0:
        return "the kernel gives no veth"
    subprocess.run(["ip", "link", "del", name], capture_output=True)
    return None


def no_slurm(_):
    missing = slurm.missing_programs()
    return f"{', '.join(missing)} not installed" if missing else None


TESTS = {
    "slurm": ("Slurm", no_slurm, slurm_tests.slurm),
    "networks": ("Slurm, two nodes in two networks", lambda page: no_slurm(page) or no_networks(), slurm_tests.two_networks),
    "parallel": ("GNU parallel", other_engines.no_parallel, other_engines.parallel),
    "dask": ("Dask", other_engines.no_dask, other_engines.dask),
}


def main(chosen):
    if unknown := set(chosen) - set(TESTS):
        raise Failed(f"no tests {', '.join(unknown)}: there are {', '.join(TESTS)}")
    page = Page()
    skipped = []
    with tempfile.TemporaryDirectory(prefix="shadowstep-cluster-") as folder:
        os.chmod(folder, 0o755)
        make = Make(folder, page.file("toml"))
        print(f"== One machine, {PROGRAM}")
        reference = one_machine(page, make)
        for name, reason, test in [TESTS[key] for key in chosen or TESTS]:
            begin = time.monotonic()
            if why := reason(page):
                skipped.append(name)
                print(f"== {name}: skipped, {why}", flush=True)
                continue
            print(f"== {name}", flush=True)
            test(page, reference, make)
            say(f"{time.monotonic() - begin:.0f} s")
    if skipped:
        print(f"\nPassed; skipped: {', '.join(skipped)}. On Debian: apt-get install {PACKAGES}")
    elif chosen:
        print("\nPassed.")
    elif unused := page.unused():
        raise Failed(f"{PAGE} has commands that are not tested: {unused}")
    else:
        print(f"\nPassed: every command of {PAGE.name} was run.")


if __name__ == "__main__":
    adopt_orphans()
    for number in signal.SIGTERM, signal.SIGHUP:
        signal.signal(number, lambda *_: sys.exit("ended by a signal"))
    try:
        main(sys.argv[1:])
    except Failed as failure:
        sys.exit(f"FAILED: {failure}")
    except KeyboardInterrupt:
        sys.exit("interrupted")
    finally:
        end_all()
