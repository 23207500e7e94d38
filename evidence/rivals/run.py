"""Builds, measures, and writes docs/speed-against-error.md. Names of problems as arguments measure only these."""

import os
import subprocess
import sys

import build
import machine
import measure
from contestants import HERE
from problems import PROBLEMS

if __name__ == "__main__":
    build.build()
    load = os.getloadavg()[0]
    for problem in PROBLEMS:
        if len(sys.argv) < 2 or problem.key in sys.argv[1:]:
            print(f"measuring {problem.key}", flush=True)
            measure.measure(problem)
            machine.write(load)
    subprocess.run([sys.executable, HERE / "page.py"], check=True)
