"""The problems: how long they run, what their energies are, and which errors are measured."""

from dataclasses import dataclass
from math import pi
from typing import Callable

import numpy as np


@dataclass(frozen=True)
class Problem:
    key: str
    title: str
    # The name of the system for the contestants.
    system: str
    until: float
    # The states that are looked at for the error of H, equally far apart.
    samples: int
    # Force evaluations of the sweeps: the fewest, the most, and the factor from one to the next.
    evaluations: tuple[float, float, float]
    # Steps of the reference solution of order 10; none where positions are not compared, 1 for an exact flow.
    reference_steps: int | None
    # Whether the error of H is reported as well as the one of the position.
    energy: bool
    description: str
    # Decades of error in the tables.
    decades: tuple[int, int] = (3, 13)
    rounds: int = 7

    @property
    def initial(self):
        """The system whose initial state it has."""
        return self.system.removesuffix("-120")


PROBLEMS = [
    Problem(
        "kepler", "Kepler, e = 0.6, 100 periods", "kepler", 200 * pi, 1, (8e3, 4e6, 2**0.5), 1, False,
        "Kepler's problem in the plane with eccentricity 0.6 from its pericentre for 100 periods. The error is the distance from "
        "the exact position at the end; the semi-major axis is 1.",
    ),
    Problem(
        "henon-heiles", "Hénon–Heiles to t = 10⁴", "henon-heiles", 1e4, 100, (3e4, 8e6, 2.0), 80_000, True,
        "The Hénon–Heiles problem from p₁ = 0.1, a regular orbit, to t = 10⁴, which are 1600 oscillations. Its size is about 0.1.",
    ),
    Problem(
        "outer-200000", "The Sun and the outer planets, 200 000 days", "outer-solar-system", 2e5, 100, (4e2, 5e5, 2.0), 20_000, True,
        "The Sun, Jupiter, Saturn, Uranus, Neptune and Pluto for 200 000 days, 46 periods of Jupiter, in astronomical units.",
    ),
    Problem(
        "outer-10000000", "The Sun and the outer planets, 10⁷ days", "outer-solar-system", 1e7, 100, (3e4, 1.6e7, 2.0), None, True,
        "The same for 10⁷ days, 2300 periods of Jupiter. Only the error of H is compared; "
        "the times are medians of three rounds.",
        decades=(3, 11), rounds=3,
    ),
    Problem(
        "fput", "Fermi–Pasta–Ulam–Tsingou chain to t = 1000", "fput-alpha", 1e3, 100, (4e3, 1e6, 2.0), 20_000, True,
        "32 bodies between walls, joined by springs with quadratic forces, from their first mode to t = 1000.",
    ),
    Problem(
        "argon", "500 argon atoms, 5 ps", "argon", 5e-3, 10, (250, 4000, 2.0), None, True,
        "500 argon atoms in free space, a crystal at 60 K at the start, for 5 ps at constant energy; all 124 750 pairs interact, "
        "without a cut-off. Only the error of H is compared.",
    ),
    Problem(
        "kepler-120", "Kepler, e = 0.6, 100 periods, at 120 digits", "kepler-120", 200 * pi, 1, (8e3, 2.6e5, 2.0), 1, False,
        "The first problem again, in MPFR's numbers of 120 digits. The C program is written as one writes it for a paper: in place, "
        "with merged kicks and without needless operations.", (1, 5),
    ),
]


def kepler(q, initial):
    return -1 / np.hypot(*q)


def henon_heiles(q, initial):
    x, y = q
    return (x * x + y * y) / 2 + x * x * y - y**3 / 3


def pairs(q):
    """The distances of all pairs of bodies in space, and the indices of their bodies."""
    bodies = q.reshape(-1, 3)
    i, j = np.triu_indices(len(bodies), 1)
    return np.linalg.norm(bodies[i] - bodies[j], axis=1), i, j


def outer(q, initial):
    distance, i, j = pairs(q)
    m = initial.mass[::3]
    return -initial.parameters[0] * np.sum(m[i] * m[j] / distance)


def fput(q, initial):
    d = np.diff(q, prepend=0.0, append=0.0)
    return np.sum(d * d / 2 + initial.parameters[0] * d**3 / 3)


def argon(q, initial):
    epsilon, sigma = initial.parameters
    s6 = (sigma / pairs(q)[0]) ** 6
    return 4 * epsilon * np.sum(s6 * s6 - s6)


POTENTIALS: dict[str, Callable] = {
    "kepler": kepler,
    "henon-heiles": henon_heiles,
    "outer-solar-system": outer,
    "fput-alpha": fput,
    "argon": argon,
}


def energy(system, q, p, initial):
    return np.sum(p * p / initial.mass) / 2 + POTENTIALS[system](q, initial)
