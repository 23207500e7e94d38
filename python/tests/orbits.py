"""How often `motion` is right: orbits whose motion is known, and orbits whose motion is taken from runs that are ten times as long, with 30 digits.

    python orbits.py            # the truths, and the tables of docs/chaos.md: some 20 minutes on two cores

The thresholds of `motion` were not chosen by these orbits. Starts are spread by fractional parts, so that they are always the same ones.
"""

import math
import warnings
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Optional

from shadowstep import Problem, RunError, chaos

LENGTHS = 4000, 40_000
"""Numbers of steps of the runs whose verdicts are counted."""
LONGER = 10 * LENGTHS[-1]


TRUTHS = {
    "integrable": "rrrrrrrrrrrrrrrrrrrrrr",
    "large steps": "c",
    "linear maps": "cccccccc",
    "Henon-Heiles": "rrrrrrrrrrrrrrrrrrrrrrrrcrcccrrcccrrcccccccrcccrcccccccccccc",
    "standard map": "rrrrrrrrrrrrccccrrrrrccrccccrrcrcccrcccccccccccccccccccccccc",
    "restricted problem": "rrrrrrrrrrlrrrcbrrlcrrlr",
    "two planets": "rlrcccrrrlrrrlrrrlrrbccr",
}
"""What `print_truths` found: regular, between, chaotic, or lost, as a planet that is thrown out after chaos."""


def truths():
    words = {word[0]: word for word in ("regular", "between", "chaotic", "lost")}
    return [words[letter] for family in FAMILIES for letter in TRUTHS[family]]


@dataclass(frozen=True)
class Orbit:
    family: str
    name: str
    problem: Problem
    scheme: str
    h: str
    period: float
    """About the shortest period of the motion."""
    truth: Optional[str] = None
    """Where it is known without a run."""

    def follow(self, steps, digits="double", every=1):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            first = "drift" if self.family == "two planets" else None
            options = {"first": first, "vectors": 1, "half": False, "every": every, "progress": False}
            return chaos(self.problem, self.scheme, self.h, steps=steps, digits=digits, **options).at


def spread(count, ranges):
    """Places in a box, by fractional parts of multiples of the powers of 1/φ, x^(n + 1) = x + 1 in n dimensions: M. Roberts' sequence."""
    base = 2.0
    for _ in range(60):
        base = (1 + base) ** (1 / (len(ranges) + 1))
    for i in range(1, count + 1):
        yield [round(low + (high - low) * ((0.5 + i / base ** (k + 1)) % 1), 9) for k, (low, high) in enumerate(ranges)]


TODA = "(exp(2*y + 2*sqrt(3)*x) + exp(2*y - 2*sqrt(3)*x) + exp(-4*y))/24"


def large_steps():
    """H is integrable, but the steps are not: the first run of this file, which had it among the integrable systems, showed it."""
    problem = Problem(TODA, q={"x": 0.3, "y": -1}, p=[2, 1])
    yield Orbit("large steps", "Toda's lattice of three at a high energy", problem, "blanes-moan-srkn6b", "1/5", 2 * math.pi)


def integrable():
    """H with as many integrals in involution as degrees of freedom."""
    accurate = "blanes-moan-srkn6b"
    for e, h in (("0", "1/3"), ("3/10", "1/5"), ("3/5", "1/10"), ("9/10", "1/60")):
        yield Orbit("integrable", f"Kepler, e = {e}", Problem("kepler", eccentricity=e), accurate, h, 2 * math.pi, "regular")
    for p in ("1", "1.9", "1.99", "2.5"):
        yield Orbit("integrable", f"pendulum, p = {p}", Problem("pendulum", q=[0], p=[p]), accurate, "1/3", 2 * math.pi, "regular")
    formulas = {
        "Toda's lattice of three": (TODA, "1/5", 2 * math.pi, ((0.2, 0.1, 0.3, 0.1), (0, 0.5, 1, -0.4))),
        "Toda's lattice of three at a high energy": (TODA, "1/20", 2 * math.pi, ((0.3, -1, 2, 1),)),
        "isochrone potential": ("-1/(1 + sqrt(1 + x^2 + y^2))", "1/2", 12.0, ((1, 0, 0.1, 0.3), (2, 0, -0.1, 0.15), (0.5, 0, 0, 0.7))),
        "logarithmic potential": ("log(1/10 + x^2 + y^2)/2", "1/10", 2.0, ((1, 0, 0.1, 0.3), (0.3, 0, 0.5, 0.2), (1, 0, 0, 1))),
        "x^4 + 6x^2y^2 + y^4": ("(x^4 + 6*x^2*y^2 + y^4)/4", "1/10", 4.0, ((1, 0.2, 0, 0.3), (0.4, -0.5, 0.2, 0.6))),
        "Henon-Heiles with + y^3/3": ("(x^2 + y^2)/2 + x^2*y + y^3/3", "1/5", 2 * math.pi, ((0.1, 0.05, 0.1, 0.05), (0.1, -0.1, 0.15, 0))),
        "two oscillators": ("x^2/2 + y^2", "1/5", 2 * math.pi, ((1, 0.3, 0, 0.7),)),
    }
    for name, (formula, h, period, starts) in formulas.items():
        for x, y, px, py in starts:
            problem = Problem(formula, q={"x": x, "y": y}, p=[px, py])
            yield Orbit("integrable", f"{name} from {x}, {y}", problem, accurate, h, period, "regular")


def hyperbolic():
    """Linear maps of the torus, whose exponents are logarithms of eigenvalues."""
    for h in ("1/2", "1", "3/2", "2"):
        yield Orbit("linear maps", f"cat map, h = {h}", Problem("-q^2/2", q={"q": 0}, p=[0]), "symplectic-euler", h, float(eval(h)), "chaotic")
        coupled = Problem("-x^2/2 - x*y/2 - y^2", q={"x": 0, "y": 0}, p=[0, 0])
        yield Orbit("linear maps", f"two cat maps, h = {h}", coupled, "symplectic-euler", h, float(eval(h)), "chaotic")


def henon_heiles():
    for energy in ("1/12", "1/10", "1/8", "0.145", "1/6"):
        e = float(eval(energy))
        places = [(y, py) for y, py in spread(400, ((-0.5, 1), (-0.6, 0.6))) if y * y / 2 - y**3 / 3 + py * py / 2 < e and y * y / 2 - y**3 / 3 < 1 / 6 and y < 1]
        for y, py in places[:12]:
            px = math.sqrt(2 * e - py * py - y * y + 2 * y**3 / 3)
            yield Orbit("Henon-Heiles", f"E = {energy}, y = {y}, py = {py}", Problem("henon-heiles", q=[0, y], p=[px, py]), "blanes-moan-srkn6b", "1/5", 2 * math.pi)


def standard_map():
    for k in ("0.6", "1", "1.5", "2.5", "5"):
        h = math.sqrt(float(k))
        for q, action in spread(12, ((-math.pi, math.pi), (-math.pi, math.pi))):
            yield Orbit("standard map", f"K = {k}, q = {q}, I = {action}", Problem("pendulum", q=[q], p=[action / h]), "symplectic-euler", f"sqrt({k})", 2 * math.pi / h)


def restricted():
    """A body without mass beside a planet of 1/1000 on a circle, in the frame that turns with it."""
    parts = ["(px^2 + py^2)/2 - x*py + y*px", "-(1 - mu)/sqrt((x + mu)^2 + y^2) - mu/sqrt((x - 1 + mu)^2 + y^2)"]
    for a, e in spread(24, ((0.5, 0.85), (0, 0.25))):
        speed = math.sqrt((1 + e) / (a * (1 - e)))
        problem = Problem(parts=parts, coordinates=["x", "y"], mu="1/1000", q=[a * (1 - e), 0], p=[0, speed])
        yield Orbit("restricted problem", f"a = {a}, e = {e}", problem, "blanes-moan-s6", "1/20", 2 * math.pi * a**1.5)


def two_planets():
    """Of 1/1000 of the star each."""
    for a, m in spread(24, ((1.2, 1.6), (0, 360))):
        bodies = [{"name": "star", "mass": 1}, {"name": "inner", "mass": "1/1000", "a": 1, "e": "1/20"}, {"name": "outer", "mass": "1/1000", "a": a, "e": "1/20", "M": m}]
        problem = Problem(parts="wisdom-holman", g=1, barycentric=True, elements="jacobi", body=bodies)
        yield Orbit("two planets", f"a = {a}, M = {m}", problem, "stormer-verlet", "pi/20", 2 * math.pi)


def truth(orbit):
    """By the growth L from the end of the run to that of one ten times as long, with 30 digits: growth like t has 2.3, like t² 4.6. Where it ends after exponential
    growth, a body was thrown out."""
    if orbit.truth is not None:
        return orbit.truth
    try:
        short, long = (orbit.follow(steps, 30, every=10) for steps in (LENGTHS[-1], LONGER))
    except RunError:
        return "lost"
    before, after = (at.lyapunov * at.time for at in (short, long))
    if after - before > 30:
        return "chaotic"
    return "lost" if before > 30 else "regular" if after - before < 6.6 else "between"


def verdict(orbit, steps):
    try:
        return orbit.follow(steps).motion
    except RunError:
        return "lost"


ALL = [orbit for family in (integrable, large_steps, hyperbolic, henon_heiles, standard_map, restricted, two_planets) for orbit in family()]
FAMILIES = list(dict.fromkeys(orbit.family for orbit in ALL))


def print_truths(pool):
    for family in FAMILIES:
        letters = "".join(found[0] for found in pool.map(truth, [orbit for orbit in ALL if orbit.family == family]))
        print(f'    "{family}": "{letters}",', flush=True)


def print_matrix(pool, steps):
    verdicts = list(pool.map(lambda orbit: verdict(orbit, steps), ALL))
    counts = Counter(zip(truths(), verdicts))
    print(f"\n| {steps} steps | regular | undecided | chaotic | lost |\n| --- | --- | --- | --- | --- |")
    for true in ("regular", "between", "chaotic", "lost"):
        print(f"| {true} | " + " | ".join(str(counts[true, said]) for said in ("regular", "undecided", "chaotic", "lost")) + " |")
    for family in FAMILIES:
        own = Counter((true, said) for orbit, true, said in zip(ALL, truths(), verdicts) if orbit.family == family)
        print(f"  {family}:", ", ".join(f"{true} called {said} {count}" for (true, said), count in sorted(own.items())), flush=True)
    for orbit, true, said in zip(ALL, truths(), verdicts):
        if (true, said) in (("regular", "chaotic"), ("chaotic", "regular")):
            print("  wrong:", orbit.family, orbit.name, true, said)


def long_runs(pool, periods=1_000_000):
    def follow(orbit):
        at = orbit.follow(math.ceil(periods * orbit.period / float(eval(orbit.h))), every=50)
        print(f"  {orbit.name}: {at.steps} steps, {at.motion}, mean MEGNO {at.mean_megno:.4f}", flush=True)
        return at.motion

    print(f"\n{periods} periods of integrable systems")
    print(Counter(pool.map(follow, [orbit for orbit in ALL if orbit.truth == "regular"])))


def main():
    with ThreadPoolExecutor(2) as pool:
        print_truths(pool)
        for steps in LENGTHS:
            print_matrix(pool, steps)
        long_runs(pool)


if __name__ == "__main__":
    main()
