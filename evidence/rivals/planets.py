"""Wisdom–Holman maps of the Sun and the outer planets beside REBOUND's: CPU time a step, errors of H and of the position at the end.

    build/venv/bin/python planets.py DAYS STEP…      # as 3652500 400 200 100 50

The reference is `ours reference` at 40 digits; states are compared twenty times for the error of H.
"""

import subprocess
import sys

import numpy as np

from contestants import BUILD, HERE, PYTHON

OURS = BUILD / "cargo" / "release" / "ours"
SYSTEM, SAMPLES, ROUNDS = "outer-solar-system", 20, 3
METHODS = {
    "ours": [f"wisdom-holman/{name}" for name in ("drift-kick-drift", "saba2", "saba4", "abah864", "abah1064", "aba1064")],
    "REBOUND": ["whfast", "whfast-11", "whfast-17", "saba-4", "saba-10_6_4", "saba-H_8_6_4", "saba-H_10_6_4"],
}


def numbers(text):
    return np.array([float(word) for word in text.split()])


def ours(*words):
    return subprocess.run([OURS, *words], check=True, capture_output=True, text=True).stdout


class Contestant:
    def __init__(self, command, **options):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, **options)

    def answer(self, method, steps, until):
        print(SYSTEM, method, steps, SAMPLES, until, file=self.process.stdin, flush=True)
        seconds, *states = numbers(self.process.stdout.readline())
        return seconds, np.array(states).reshape(SAMPLES, 2, -1)


def energy(parameters, mass, q, p):
    x, m = q.reshape(-1, 3), mass[::3]
    pairs = ((i, j) for i in range(len(m)) for j in range(i))
    return np.sum(p * p / (2 * mass)) - parameters[0] * sum(m[i] * m[j] / np.linalg.norm(x[i] - x[j]) for i, j in pairs)


def main(until, *step_sizes):
    folder = BUILD / "initial"
    folder.mkdir(parents=True, exist_ok=True)
    text = ours("initial", SYSTEM)
    (folder / f"{SYSTEM}.txt").write_text(text)
    parameters, mass, q, p = (numbers(line)[1:] for line in text.splitlines())
    before = energy(parameters, mass, q, p)
    # 40 days a step of order 10
    reference = numbers(ours("reference", SYSTEM, until, str(round(float(until) / 40))))
    contestants = {
        "ours": Contestant([OURS]),
        "REBOUND": Contestant([PYTHON, HERE / "python" / "rebound_rival.py"], env={"INITIAL": str(folder)}),
    }
    print("| h, days | | method | ns a step | error of H | error of the position |\n| --- | --- | --- | --- | --- | --- |")
    for step in map(float, step_sizes):
        steps = SAMPLES * round(float(until) / step / SAMPLES)
        for name, methods in METHODS.items():
            for method in methods:
                answers = [contestants[name].answer(method, steps, until) for _ in range(ROUNDS)]
                seconds, states = min(answer[0] for answer in answers), answers[0][1]
                of_energy = max(abs(energy(parameters, mass, *state) / before - 1) for state in states)
                of_position = np.linalg.norm((states[-1][0] - reference).reshape(-1, 3), axis=1).max()
                print(f"| {step:g} | {name} | {method} | {seconds / steps * 1e9:.0f} | {of_energy:.1e} | {of_position:.1e} |")


main(*sys.argv[1:])
