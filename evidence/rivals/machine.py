"""What the results depend on: processor, compilers, versions, load. Written beside the results."""

import importlib.metadata
import json
import os
import platform
import subprocess
from datetime import date

from contestants import BUILD, HERE
from measure import LONG, LONGEST, ROUNDS_OF_LONG
from problems import Problem

PACKAGES = ["rebound", "heyoka", "scipy", "numpy", "pyhamsys"]


def first_line(*command):
    return subprocess.check_output(command, text=True).splitlines()[0]


def processor():
    with open("/proc/cpuinfo") as file:
        return next(line.split(":")[1].strip() for line in file if line.startswith("model name"))


def debian(package):
    return first_line("dpkg-query", "--show", "--showformat=${Version}\n", package)


def compile_times():
    """The longest time for which heyoka has compiled, from its messages."""
    lines = (BUILD / "messages.txt").read_text().splitlines()
    times = [float(line.split()[-2]) for line in lines if line.startswith("compiled ")]
    return f"{max(times):.1f} s"


def describe(load_before):
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in PACKAGES)
    load = f"{load_before:.1f} when it began and {os.getloadavg()[0]:.1f} when it ended, its own 1 included"
    text = (
        f"Measured on {date.today()}: {processor()}, {os.cpu_count()} cores, {first_line('rustc', '--version')}, "
        f"{first_line('gcc', '--version')}, Boost {debian('libboost-dev')}, MPFR {debian('libmpfr-dev')}, Python {platform.python_version()}, {versions}. The load of the machine was {load}."
    )
    rounds = f"{Problem.rounds} rounds ({ROUNDS_OF_LONG} for runs above {LONG} s)"
    return {"machine": text, "rounds": rounds, "longest": LONGEST, "jit": compile_times()}


def write(load_before):
    (HERE / "results" / "machine.json").write_text(json.dumps(describe(load_before), indent=1, ensure_ascii=False) + "\n")
