"""Surfaces of section beside galpy's and scipy's: the error of the last crossing and the time for all.

    build/venv/bin/pip install galpy ../../target/wheels/shadowstep-*.whl
    build/venv/bin/python sections.py               # the table of docs/scenes.md, on a machine without other load

An orbit of Hénon and Heiles with E = 1/12 crosses x = 0 upwards. The yardstick is Shadowstep with 40 digits and steps of 1/100 of order 10.
"""

import time

import numpy as np
import shadowstep
from galpy.orbit import Orbit
from galpy.potential import HenonHeilesPotential
from scipy.integrate import solve_ivp

CROSSINGS, ROUNDS, UNTIL = 500, 5, 3400
Y, PY = "1/10", "1/20"
PX = f"sqrt(1/6 - ({PY})^2 - ({Y})^2 + 2*({Y})^3/3)"
START = shadowstep.Problem("(x^2 + y^2)/2 + x^2*y - y^3/3", q={"x": 0, "y": Y}, p=[PX, PY])


def ours(scheme, h, digits="double"):
    run = shadowstep.integrate(START, scheme, h=h, until=UNTIL, section="x", digits=digits)
    return np.array(run.q[CROSSINGS - 1, 1], dtype=float), np.array(run.p[CROSSINGS - 1, 1], dtype=float)


def of_scipy(tolerance):
    (x, y), (px, py) = START.initial

    def forces(_, z):
        x, y, px, py = z
        return px, py, -x - 2 * x * y, -y - x * x + y * y

    def crossing(_, z):
        return z[0]

    crossing.direction = 1
    found = solve_ivp(forces, (0, UNTIL), (x, y, px, py), method="DOP853", rtol=tolerance, atol=tolerance, events=crossing)
    # the start may be one
    first = 1 if found.t_events[0][0] < 1e-6 else 0
    return found.y_events[0][first + CROSSINGS - 1][[1, 3]]


def of_galpy(method, tolerance):
    (x, y), (px, py) = START.initial
    r, phi = np.hypot(x, y), np.arctan2(y, x)
    orbit = Orbit([r, (x * px + y * py) / r, (x * py - y * px) / r, phi])
    keyword = {"rtol": tolerance, "atol": tolerance} if tolerance else {}
    found = orbit.SOS(HenonHeilesPotential(amp=1.0), ncross=CROSSINGS + 1, surface="x", t0=0.0, method=method, **keyword)
    (y, py) = (np.ravel(values) for values in found)
    return y[CROSSINGS], py[CROSSINGS]


CONTESTANTS = [
    *((f"Shadowstep, `{scheme}`, step {h}", lambda scheme=scheme, h=h: ours(scheme, h)) for scheme, h in [("blanes-moan-srkn11b", "1/5"), ("blanes-moan-srkn11b", "1/10"), ("bce-rkn8-17", "1/4"), ("bce-rkn8-17", "1/6")]),
    *((f"scipy, DOP853, {tolerance:g}", lambda tolerance=tolerance: of_scipy(tolerance)) for tolerance in (1e-6, 1e-9, 1e-12)),
    *((f"galpy, `{method}`, {tolerance:g}", lambda method=method, tolerance=tolerance: of_galpy(method, tolerance)) for method in ("dop853_c", "dop853") for tolerance in (1e-6, 1e-9, 1e-12)),
]


def main():
    exact = ours("sofroniou-spaletta10-35", "1/100", digits=40)
    other = ours("sofroniou-spaletta8-21", "1/100", digits=40)
    print(f"The yardstick differs by {np.abs(np.subtract(exact, other)).max():.1e} from another scheme.\n")
    times = {name: [] for name, _ in CONTESTANTS}
    errors = {}
    for _ in range(ROUNDS):
        for name, run in CONTESTANTS:
            begin = time.perf_counter()
            found = run()
            times[name].append(time.perf_counter() - begin)
            errors[name] = np.abs(np.subtract(found, exact)).max()
    print("| | error | ms |\n| --- | --- | --- |")
    for name, _ in CONTESTANTS:
        print(f"| {name} | {errors[name]:.1e} | {1000 * np.median(times[name]):.3g} |")


if __name__ == "__main__":
    main()
