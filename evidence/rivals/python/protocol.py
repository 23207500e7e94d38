"""Requests and answers as rust/src/protocol.rs describes them, for contestants in Python."""

import os
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Request:
    problem: str
    method: str
    parameter: str
    samples: int
    until: float

    @property
    def steps(self):
        return int(self.parameter)

    @property
    def tolerance(self):
        return float(self.parameter)


@dataclass
class Initial:
    parameters: np.ndarray
    mass: np.ndarray
    q: np.ndarray
    p: np.ndarray


def read_initial(problem):
    """What `ours initial` has printed."""
    lines = (Path(os.environ["INITIAL"]) / f"{problem}.txt").read_text().splitlines()
    return Initial(*(np.array([float(word) for word in line.split()[1:]]) for line in lines))


def serve(answer):
    """Answers each request by answer(request, initial), which gives the seconds and the list of states (q, p)."""
    for line in sys.stdin:
        problem, method, parameter, samples, until = line.split()
        request = Request(problem, method, parameter, int(samples), float(until))
        seconds, states = answer(request, read_initial(problem))
        numbers = " ".join(repr(float(x)) for q, p in states for x in (*q, *p))
        print(f"{seconds!r} {numbers}", flush=True)
