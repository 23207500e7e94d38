"""Builds all contestants into rivals/build. The virtual environment is made by run.sh."""

import os
import subprocess

from contestants import BUILD, HERE, RIVALS
from problems import PROBLEMS


def run(*command, **environment):
    subprocess.run(list(map(str, command)), check=True, env=os.environ | environment)


def output(path, *command):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(subprocess.check_output(list(map(str, command)), text=True))


def build():
    BUILD.mkdir(exist_ok=True)
    run("cargo", "build", "--release", "--locked", "--manifest-path", HERE / "rust" / "Cargo.toml",
        CARGO_TARGET_DIR=str(BUILD / "cargo"), RUSTFLAGS="-C target-cpu=native")
    run("gcc", "-O3", "-march=native", "-Wall", "-Wextra", "-o", BUILD / "by_hand", HERE / "c" / "by_hand.c", "-lm")
    ours = BUILD / "cargo" / "release" / "ours"
    for system in {problem.system for problem in PROBLEMS}:
        output(BUILD / "initial" / f"{system}.txt", ours, "initial", system)
    for method in RIVALS[0].methods:
        output(BUILD / "schemes" / f"{method.name}.txt", ours, "weights", method.name)
