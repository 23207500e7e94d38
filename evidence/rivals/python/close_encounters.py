"""REBOUND's IAS15 and heyoka on close encounters: the error of the end state against CPU time.

Prints a line `PROBLEM METHOD TOLERANCE SECONDS ERROR` for each run. The argument is a file with the lines that
`close_encounters reference` prints; a second one selects a problem.
"""

import sys
import time

import numpy as np
import rebound

try:
    import heyoka as hy
except ImportError:
    hy = None

ROUNDS = 5
PROBLEMS = {"kepler-0.99": (65.0, 0.99), "kepler-0.999": (65.0, 0.999), "pythagorean": (70.0, None)}


def bodies(e):
    """Masses, positions and velocities."""
    if e is None:
        q = np.array([[1.0, 3.0], [-2.0, -1.0], [1.0, -1.0]])
        return np.array([3.0, 4.0, 5.0]), q, np.zeros((3, 2))
    q = np.array([[0.0, 0.0], [1 - e, 0.0]])
    return np.array([1.0, 0.0]), q, np.array([[0.0, 0.0], [0.0, np.sqrt((1 + e) / (1 - e))]])


def ias15(until, e, tolerance):
    sim = rebound.Simulation()
    for m, (x, y), (vx, vy) in zip(*bodies(e)):
        sim.add(m=m, x=x, y=y, vx=vx, vy=vy)
    sim.N_active = 1 if e is not None else 3
    sim.integrator = "ias15"
    sim.integrator.epsilon = tolerance
    start = time.process_time()
    sim.integrate(until)
    seconds = time.process_time() - start
    return seconds, np.array([[b.x, b.y] for b in sim.particles])


def heyoka_of(e, tolerance):
    m, q, v = bodies(e)
    if e is not None:
        x, y, vx, vy = hy.make_vars("x", "y", "vx", "vy")
        cube = (x**2 + y**2) ** -1.5
        system = [(x, vx), (y, vy), (vx, -x * cube), (vy, -y * cube)]
        state = [*q[1], *v[1]]
    else:
        names = [[f"{name}{i}" for name in ("x", "y", "vx", "vy")] for i in range(3)]
        variables = [hy.make_vars(*body) for body in names]
        system, state = [], []
        for i, (x, y, vx, vy) in enumerate(variables):
            ax, ay = 0.0, 0.0
            for j, (xj, yj, _, _) in enumerate(variables):
                if i != j:
                    cube = ((xj - x) ** 2 + (yj - y) ** 2) ** -1.5
                    ax, ay = ax + m[j] * (xj - x) * cube, ay + m[j] * (yj - y) * cube
            system += [(x, vx), (y, vy), (vx, ax), (vy, ay)]
            state += [*q[i], *v[i]]
    return hy.taylor_adaptive(system, np.array(state), tol=tolerance), np.array(state)


def heyoka_runs(until, e, tolerance):
    integrator, initial = heyoka_of(e, tolerance)
    for _ in range(ROUNDS):
        integrator.time = 0.0
        integrator.state[:] = initial
        start = time.process_time()
        integrator.propagate_until(until)
        seconds = time.process_time() - start
        yield seconds, integrator.state.reshape(-1, 4)[:, :2].copy()


def main():
    references = {}
    for line in open(sys.argv[1]):
        name, *numbers = line.split()
        references[name] = np.array([float(number) for number in numbers[:-1]]).reshape(-1, 2)
    for name, (until, e) in PROBLEMS.items():
        if len(sys.argv) > 2 and sys.argv[2] != name:
            continue
        # with a tolerance of 0.1 IAS15 did not finish the Pythagorean problem in 8 minutes
        least = 5.0 if e is None else 0.0
        tolerances = 10.0 ** -np.arange(least, 13.0, 1.0)
        runs = [("ias15", t, lambda t=t: (ias15(until, e, t) for _ in range(ROUNDS))) for t in tolerances]
        if hy is not None:
            runs += [("heyoka", t, lambda t=t: heyoka_runs(until, e, t)) for t in 10.0 ** -np.arange(6.0, 19.0, 1.0)]
        for method, tolerance, run in runs:
            results = list(run())
            q = results[0][1]
            q = q[1:] if len(q) == 2 and e is not None else q
            error = np.sqrt(np.sum((q - references[name]) ** 2))
            print(f"{name} {method} {tolerance:.0e} {min(seconds for seconds, _ in results):.3e} {error:.2e}", flush=True)


main()
