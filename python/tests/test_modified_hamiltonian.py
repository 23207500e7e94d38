"""The modified Hamiltonian as formulas, beside modified energies, which know none."""

from __future__ import annotations

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Problem, modified_hamiltonian

PLANETS = Problem(
    parts="wisdom-holman",
    parameters={"g": 1},
    body=[
        {"mass": 1, "q": [0, 0], "v": [0, 0]},
        {"mass": "1/100", "q": [1, 0], "v": [0, 1]},
        {"mass": "1/300", "q": [0, 2], "v": ["-7/10", 0]},
    ],
)
DRIVEN = Problem("x^4/4 - a*x*cos(t)", q={"x": "1/2"}, p=["1/3"], a="1/5")


@pytest.mark.parametrize(
    ("problem", "scheme", "grade"),
    [
        ("henon-heiles", "stormer-verlet", 8),
        ("kepler", "yoshida4", 6),
        (Problem("k*x^2/2 + x^4", q={"x": 1}, p=[0], k=3), "stormer-verlet", 6),
        (PLANETS, "stormer-verlet", 2),
        (DRIVEN, "stormer-verlet", 6),
    ],
    ids=["henon-heiles", "kepler", "parameter", "planets", "explicit-time"],
)
def test_values_are_modified_energies(problem, scheme: str, grade: int) -> None:
    h = "1/40"
    run = shadowstep.integrate(problem, scheme, h=h, until=4, estimator="bilinear", order=16)
    hamiltonian = modified_hamiltonian(problem, scheme, grade)
    values = hamiltonian(run.q, run.p, h, run.t if problem is DRIVEN else None)
    known = ~np.isnan(run.modified_energy)
    assert known.sum() > 100
    largest = np.abs(run.energy - run.modified_energy)[known].max()
    difference = np.abs(values - run.modified_energy)[known].max()
    # the powers of h that are left out, and round-off
    assert difference < 1e-2 * largest + 1e-14, (difference, largest)
    one = hamiltonian(run.q[3], run.p[3], h, run.t[3] if problem is DRIVEN else None)
    assert one == values[3]


def test_series_and_notations() -> None:
    assert shadowstep.Scheme("symplectic-euler").modified(1) == {1: {"[K,D]": "1/2"}}
    assert shadowstep.Scheme("stormer-verlet").modified(2, parts=3)[2]["[B,[A,C]]"] == "-1/6"
    assert modified_hamiltonian("pendulum", "stormer-verlet", 2, notation="rust").terms == {2: "-q.sin().powi(2)/24.0 + p.powi(2)*q.cos()/12.0"}
    assert repr(modified_hamiltonian("pendulum", "stormer-verlet", 2)) == "H = p^2/2 - cos(q)\nH_3 = -sin(q)^2/24 + p^2*cos(q)/12"


def test_wrong_inputs() -> None:
    with pytest.raises(InputError, match="there is no notation `tex`"):
        modified_hamiltonian("pendulum", "stormer-verlet", notation="tex")
    with pytest.raises(InputError, match="a function has none"):
        modified_hamiltonian(Problem(lambda q: (q @ q / 2, q), q=[1.0], p=[0.0]), "stormer-verlet")
    with pytest.raises(InputError, match="t is missing"):
        modified_hamiltonian(DRIVEN, "stormer-verlet", 2)([0.5], [0.3, 0.0], "1/10")
    with pytest.raises(InputError, match="grade = 11 is too large"):
        modified_hamiltonian("pendulum", "stormer-verlet", 11)


@pytest.mark.parametrize("names", [("h", "lambda"), ("class", "h"), ("total", "np"), ("None", "t"), ("lambda", "lambda_")])
def test_any_name_may_be_that_of_a_coordinate_or_a_parameter(names: tuple[str, str]) -> None:
    def values(x: str, k: str):
        problem = Problem(f"{k}*{x}^4/4 + sin({x})", q={x: "1/2"}, p=["1/3"], parameters={k: 3})
        return modified_hamiltonian(problem, "stormer-verlet", 4)([0.5], [1 / 3], "1/4", 7.0)

    assert values(*names) == values("x", "k")
    # H at this state is 0.58186: the function is not that of another name
    assert abs(values(*names) - (1 / 18 + 3 / 64 + np.sin(0.5))) < 1e-2


def test_a_name_with_two_meanings_is_refused_in_a_condition() -> None:
    problem = Problem("x^2/2 - E*x", q={"x": 1}, p=[0], E=3)
    with pytest.raises(InputError, match="`E` could be the parameter or the energy H here"):
        shadowstep.integrate(problem, "yoshida4", h="1/10", until=1, end="x*E > 4")
    with pytest.raises(InputError, match="`E` could be the parameter or the energy H here"):
        shadowstep.integrate(problem, "yoshida4", h="1/10", until=1, section="x - E")


def test_a_physical_time_that_no_run_reaches_is_refused() -> None:
    problem = Problem("kepler", time={"transform": "logarithmic"})
    with pytest.raises(InputError, match="steps of 1/20 until 1e300 are 5e301 steps at the rate of physical time at the start"):
        shadowstep.integrate(problem, "yoshida4", h="1/20", until="1e300")
    with pytest.raises(InputError) as refused:
        shadowstep.integrate(problem, "yoshida4", h="1/20", until=10**300)
    assert len(str(refused.value)) < 300
