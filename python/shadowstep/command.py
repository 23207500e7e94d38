"""Everything that the command line has."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import Union

import numpy as np

from ._shadowstep import InputError, RunError
from .arguments import naming, path_of
from .scene import columns_of


def command(*words: Union[str, os.PathLike[str]]) -> str:
    """Runs a command of the program ``shadowstep``, and gives what it prints; its progress and notes are shown on stderr.

    Raises
    ------
    InputError
        Wrong arguments, or faults of a file: exit code 2.
    RunError
        A run that failed or was interrupted: exit code 3.

    Examples
    --------
    >>> from shadowstep import command
    >>> "Kepler" in command("problems")
    True
    >>> command("schemes", "show", "stormer-verlet").splitlines()[0]
    'stormer-verlet: Störmer–Verlet (leapfrog, Strang; kick first: velocity Verlet)'
    """
    # the package itself is found wherever this process has found it
    program = "import sys; sys.path[:0] = sys.argv.pop(1).split(chr(10)); from shadowstep.__main__ import main; main()"
    paths = "\n".join(path for path in sys.path if path)
    arguments = [sys.executable, "-c", program, paths, *(path_of(word, "words") for word in words)]
    done = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, encoding="utf-8")
    if done.returncode in (2, 3):
        error = (InputError if done.returncode == 2 else RunError)(done.stderr.strip())
        error.hint = None
        raise error
    sys.stderr.write(done.stderr)
    return done.stdout


def sweep(path: Union[str, os.PathLike[str]], out: Union[str, os.PathLike[str]], *, allow_outside: bool = False) -> dict[str, np.ndarray]:
    """Makes the runs of a sweep on all cores, into the folder ``out``, and gives the columns of its results.

    What the folder has is not computed again; after an interruption the same call continues. The files that the sweep names lie in its own folder
    or below, unless ``allow_outside`` is true.
    """
    folder = path_of(out, "out")
    allowed = ["--allow-outside"] if allow_outside else []
    with naming("path", "FILE"):
        command("sweep", path_of(path, "path"), "--out", folder, *allowed)
    with open(os.path.join(folder, "results.csv"), encoding="utf-8") as results:
        return columns_of(results.read())
