"""What a run costs from Python: 10⁶ steps of Störmer–Verlet on Kepler's problem, beside a loop in Rust.

    cargo build --release --example steps-of-kepler -p shadowstep
    python overhead.py target/release/examples/steps-of-kepler

All take turns; times are medians, ratios are medians of those to Rust in the same round.
"""

import math
import statistics
import subprocess
import sys
import time

import numba
import numpy as np

import shadowstep

STEPS, ROUNDS = 1_000_000, 15


@numba.cfunc("float64(CPointer(float64), CPointer(float64))")
def kepler_in_numba(q, gradient):
    r2 = q[0] * q[0] + q[1] * q[1]
    r = math.sqrt(r2)
    inverse = 1.0 / (r2 * r)
    gradient[0] = q[0] * inverse
    gradient[1] = q[1] * inverse
    return -r2 * inverse


def kepler_in_python(q):
    r = math.hypot(q[0], q[1])
    return -1 / r, q / r**3


STATE = {"q": [0.4, 0.0], "p": [0.0, 2.0]}


def timed(problem, steps=STEPS):
    def run():
        begin = time.perf_counter()
        found = shadowstep.integrate(problem, "stormer-verlet", "1/100", steps=steps, every=steps)
        return (time.perf_counter() - begin) * (STEPS / steps), found.q[-1, 0]

    return run


def main(program):
    rust = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def in_rust():
        print("go", file=rust.stdin, flush=True)
        return tuple(float(word) for word in rust.stdout.readline().split())

    contestants = {
        "Rust": in_rust,
        "integrate, a shipped problem": timed(shadowstep.Problem("kepler")),
        "integrate, a formula": timed(shadowstep.Problem("-1/sqrt(x^2 + y^2)", coordinates=["x", "y"], **STATE)),
        "integrate, a C function of numba": timed(shadowstep.Problem(kepler_in_numba.address, **STATE)),
        "integrate, a Python function": timed(shadowstep.Problem(kepler_in_python, **STATE), STEPS // 100),
    }
    rounds = [{name: run() for name, run in contestants.items()} for _ in range(ROUNDS)]
    assert len({found["Rust"][1] for found in rounds} | {found["integrate, a shipped problem"][1] for found in rounds}) == 1
    print("| | ns a step | beside Rust |\n| --- | --- | --- |")
    for name in contestants:
        seconds = statistics.median(found[name][0] for found in rounds)
        ratio = statistics.median(found[name][0] / found["Rust"][0] for found in rounds)
        print(f"| {name} | {seconds / STEPS * 1e9:.1f} | {ratio:.2f} |")


if __name__ == "__main__":
    main(sys.argv[1])
