"""Runs all contestants on a problem: once for the errors, then in interleaved rounds for the times."""

import csv
import os
import random
import statistics
import subprocess
import sys
from dataclasses import dataclass, field
from decimal import Decimal, getcontext

import numpy as np

from contestants import BUILD, HERE, RIVALS
from problems import energy

sys.path.insert(0, str(HERE / "python"))
from protocol import read_initial  # noqa: E402

INITIAL, SCHEMES, RESULTS = BUILD / "initial", BUILD / "schemes", HERE / "results"
OURS = BUILD / "cargo" / "release" / "ours"
os.environ |= {"INITIAL": str(INITIAL), "SCHEMES": str(SCHEMES), "OMP_NUM_THREADS": "1"}
getcontext().prec = 45

# A run that takes longer, in seconds, is repeated in fewer rounds.
LONG = 0.1
ROUNDS_OF_LONG = 3
# A sweep ends with the first run that takes longer, in seconds.
LONGEST = 1.0


class Program:
    """A contestant's program, which stays alive, so that it starts and compiles only once."""

    def __init__(self, command):
        self.process = subprocess.Popen(
            list(map(str, command)), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=open(BUILD / "messages.txt", "a"), text=True
        )

    def run(self, system, method, parameter, samples, until):
        """The seconds, and the states as rows q, p."""
        print(system, method, parameter, samples, repr(until), file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline().split()
        if not answer:
            raise RuntimeError(f"{self.process.args} has ended at {system} {method} {parameter}")
        numbers = np.array([float(word) for word in answer])
        return numbers[0], numbers[1:].reshape(samples, -1)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


@dataclass
class Run:
    rival: object
    method: object
    parameter: str
    program: Program
    position_error: float = float("nan")
    energy_error: float = float("nan")
    times: list = field(default_factory=list)

    def time(self, problem):
        seconds, _ = self.program.run(problem.system, self.method.name, self.parameter, 1, problem.until)
        self.times.append(seconds)

    @property
    def finished(self):
        return len(self.times) >= ROUNDS_OF_LONG and self.times[-1] > LONG


def reference(problem, steps):
    text = subprocess.check_output([OURS, "reference", problem.initial, repr(problem.until), str(steps)], text=True)
    return [Decimal(word) for word in text.split()]


def distance(one, other):
    return float(sum((Decimal(a) - Decimal(b)) ** 2 for a, b in zip(one, other)).sqrt())


def references(problem):
    """The final position, and how far it is from the one with half as many steps."""
    if problem.reference_steps is None:
        return None, None
    best = reference(problem, problem.reference_steps)
    return best, distance(best, reference(problem, max(1, problem.reference_steps // 2)))


def measure_errors(run, problem, initial, exact):
    """Measures the errors of a run; the seconds that it took."""
    seconds, states = run.program.run(problem.system, run.method.name, run.parameter, problem.samples, problem.until)
    half = len(initial.q)
    if not np.isfinite(states).all():
        return seconds
    if exact is not None:
        run.position_error = distance(map(float, states[-1, :half]), exact)
    if problem.energy:
        start = energy(problem.system, initial.q, initial.p, initial)
        run.energy_error = max(abs(energy(problem.system, s[:half], s[half:], initial) - start) for s in states) / abs(start)
    return seconds


def sweeps_of(problem, programs):
    """The runs of each method, from coarse to fine."""
    for rival in RIVALS:
        if rival.takes_part(problem):
            for method in rival.methods:
                if method.takes_part(problem.system):
                    yield [Run(rival, method, parameter, programs[rival.name]) for parameter in rival.sweep(problem, method)]


def runs_with_errors(problem, programs, initial, exact):
    for sweep in sweeps_of(problem, programs):
        for run in sweep:
            seconds = measure_errors(run, problem, initial, exact)
            yield run
            if seconds > LONGEST:
                break


def measure(problem):
    """Measures a problem and writes its results."""
    here = [rival for rival in RIVALS if rival.takes_part(problem)]
    programs = {rival.name: Program(rival.command) for rival in here}
    initial = read_initial(problem.initial)
    exact, uncertainty = references(problem)
    runs = list(runs_with_errors(problem, programs, initial, exact))
    order = random.Random(1)
    for _ in range(problem.rounds):
        order.shuffle(runs)
        for run in runs:
            if not run.finished:
                run.time(problem)
    for program in programs.values():
        program.close()
    write(problem, runs, uncertainty)


COLUMNS = ["rival", "method", "parameter", "seconds", "fastest", "slowest", "repeats", "position_error", "energy_error"]


def write(problem, runs, uncertainty):
    RESULTS.mkdir(exist_ok=True)
    places = {rival.name: place for place, rival in enumerate(RIVALS)}
    runs.sort(key=lambda run: (places[run.rival.name], run.rival.methods.index(run.method), -float(run.parameter)
                               if run.method.forces is None else float(run.parameter)))
    with open(RESULTS / f"{problem.key}.csv", "w", newline="") as file:
        if uncertainty is not None:
            file.write(f"# uncertainty of the reference: {uncertainty:.1e}\n")
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(COLUMNS)
        for run in runs:
            times = [statistics.median(run.times), min(run.times), max(run.times)]
            errors = [run.position_error, run.energy_error]
            numbers = [f"{t:.4e}" for t in times] + [len(run.times)] + [f"{e:.3e}" for e in errors]
            rows.writerow([run.rival.name, run.method.name, run.parameter, *numbers])

