"""What the results depend on: processor, compilers, versions, load. Written beside the results."""

import importlib.metadata
import json
import os
import platform
import subprocess
from datetime import date

from contestants import HERE
from measure import LONG, ROUNDS, ROUNDS_OF_LONG

PACKAGES = ["rebound", "heyoka", "scipy", "numpy", "pyhamsys"]


def first_line(*command):
    return subprocess.check_output(command, text=True).splitlines()[0]


def processor():
    with open("/proc/cpuinfo") as file:
        return next(line.split(":")[1].strip() for line in file if line.startswith("model name"))


def describe(load_before):
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in PACKAGES)
    load = f"{load_before:.1f} when it began and {os.getloadavg()[0]:.1f} when it ended, itself included"
    text = (
        f"Measured on {date.today()}: {processor()}, {os.cpu_count()} cores, {first_line('rustc', '--version')}, "
        f"{first_line('gcc', '--version')}, Python {platform.python_version()}, {versions}. The load of the machine was {load}."
    )
    rounds = f"{ROUNDS} rounds ({ROUNDS_OF_LONG} for runs above {LONG} s)"
    return {"text": text, "rounds": rounds, "samples": "100 (argon: 10)"}


def write(load_before):
    (HERE / "results" / "machine.json").write_text(json.dumps(describe(load_before), indent=1, ensure_ascii=False) + "\n")
