"""Programs, packages and libraries that the tests need."""

import functools
import os
import shutil
import subprocess
import sys
from pathlib import Path

BUILT = Path(__file__).parents[2] / "target/emit"


class Failed(Exception):
    """A test has failed."""


class Missing(Exception):
    """Something is not installed."""


def run(command, folder):
    done = subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")


def found(program):
    if not shutil.which(program):
        raise Missing(f"{program} is not installed")
    return program


@functools.cache
def python_packages(module):
    """A Python that has the packages of requirements.txt, in a virtual environment."""
    python = BUILT / "python/bin/python3"
    has = [python, "-c", f"import {module}"]
    if python.exists() and subprocess.run(has, capture_output=True).returncode == 0:
        return python
    environment = dict(os.environ, PIP_RETRIES="1", PIP_DEFAULT_TIMEOUT="15", PIP_DISABLE_PIP_VERSION_CHECK="1")
    install = [python, "-m", "pip", "install", "--quiet", "-r", Path(__file__).with_name("requirements.txt")]
    for command in [sys.executable, "-m", "venv", BUILT / "python"], install:
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            lines = (done.stdout + done.stderr).strip().splitlines()
            raise Missing(f"the packages cannot be installed: {lines[-1] if lines else done.returncode}")
    return python


def pkg_config(name, what):
    found("pkg-config")
    done = subprocess.run(["pkg-config", "--cflags", "--libs", name], capture_output=True, text=True)
    if done.returncode != 0:
        raise Missing(f"{what} is not installed")
    return done.stdout.split()
