"""Proposals of Hamiltonian Monte Carlo, beside runs that are made."""

import numpy as np
import pytest

from shadowstep import InputError, Problem, Scheme, ensemble


def test_a_proposal_is_that_of_runs():
    omega, draws = np.array([0.6, 1.0, 1.7]), 4000
    found = Scheme("bcss3").proposal(omega, 7.5, steps=3)
    rng = np.random.default_rng(1)
    spring = Problem("(0.36*x^2 + y^2 + 2.89*z^2)/2", q={"x": 0, "y": 0, "z": 0}, p=[0, 0, 0])
    run = ensemble(
        spring, "bcss3", found.step, steps=3, q=rng.standard_normal((draws, 3)) / omega, p=rng.standard_normal((draws, 3))
    )
    change = run.energy_end - run.energy_start
    accepted = np.minimum(1, np.exp(-change))
    for values, computed in ((change, found.error), (accepted, found.acceptance)):
        assert abs(values.mean() - computed) < 4 * values.std() / np.sqrt(draws)
    assert found.error > 0.09 and found.gradients == 9 and found.cost == 9 / found.acceptance


def test_an_acceptance_has_the_fewest_steps():
    omega = np.arange(1, 101) / 100
    verlet = Scheme("stormer-verlet")
    found = verlet.proposal(omega, acceptance=0.8)
    assert found.acceptance >= 0.8 > verlet.proposal(omega, steps=found.steps - 1).acceptance
    least = verlet.proposal(omega)
    assert least.cost <= found.cost and least.error <= least.largest_error


@pytest.mark.parametrize(
    ("scheme", "arguments", "message"),
    [
        ("ruth3", {}, "ruth3 is not symmetric"),
        ("blanes6-7", {}, "blanes6-7 is a processed scheme"),
        ("bcss3", {"frequencies": []}, "there are no frequencies"),
        ("bcss3", {"frequencies": [1, -1]}, "frequency 2 is -1, and must be positive"),
        ("bcss3", {"acceptance": 0.5, "steps": 3}, "acceptance and steps exclude each other"),
        ("bcss3", {"time": 100, "steps": 3}, "3 steps of bcss3 are not stable over the time 100"),
        ("bcss3", {"steps": 0}, "steps = 0 is too small"),
    ],
)
def test_wrong_requests_are_refused(scheme, arguments, message):
    with pytest.raises(InputError, match=message):
        Scheme(scheme).proposal(**{"frequencies": [1.0], **arguments})
