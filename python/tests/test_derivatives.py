"""Derivatives forwards and backwards: beside closed forms, differences with 40 digits and one another; functions of JAX and PyTorch."""

from fractions import Fraction

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Problem, derivatives, gradient, integrate

SUN = {"name": "sun", "mass": 1, "q": [0, 0, 0], "v": [0, 0, 0]}
EARTH = {"name": "earth", "mass": "1/300", "a": 1, "e": "1/10"}
JUPITER = {"name": "jupiter", "mass": 0.001, "q": [0, 5, 0], "v": [-0.4, 0, 0.1]}

SYSTEMS = {
    "formula": (Problem("k*x^2/2 + x^4/4", q={"x": 1}, p=["1/3"], k=2.5), ["x", "px", "k", "h"]),
    "masses": (Problem("x^2/2 + x^2*y^2 + y^4", q={"x": 1, "y": 0.3}, p=[0, 1], masses=[1, np.float64(2)]), ["masses[1]", "y"]),
    "a default": (Problem("kepler"), ["eccentricity", "x", "py"]),
    "a matrix": (Problem(parts=["px^2/2 + k*x^2/2", "x^4/4"], coordinates=["x"], k=2, q=[1], p=[0]), ["k", "px", "h"]),
    "a linear part": (Problem("k*x^2 + x^4/4", parts="linear", q={"x": 1}, p=[0], k=4, masses=["3/2"]), ["k", "masses[0]", "h"]),
    "pairs": (
        Problem(pair="-m_i*m_j/sqrt(r2)", dimensions=2, bodies={"m": np.array([1, 0.01])}, q=[0, 0, 1, 0], v=[0, 0, 0, 1]),
        ["m[1]", "q2_1"],
    ),
    "planets": (Problem(parts="wisdom-holman", body=[SUN, EARTH, JUPITER], g=1), ["body.earth.mass", "body[1].e", "body[2].q[1]", "g", "h"]),
    "particles": (Problem(parts="wisdom-holman", body=[SUN, EARTH, JUPITER, {"name": "ceres", "mass": 0, "a": 2.8, "e": "1/13"}], g=1), ["body.earth.mass", "body[3].e", "body[2].q[1]", "g", "h"]),
}
# whose steps are symplectic
HAMILTONIAN = [system for system in SYSTEMS if system != "particles"]


def coordinate(problem, name):
    """The name that the problem has, of a coordinate that was meant by its place."""
    return problem.coordinates[2] if name == "q2_1" else name


@pytest.mark.parametrize("system", SYSTEMS)
def test_derivatives_are_differences(system):
    problem, names = SYSTEMS[system]
    names = [coordinate(problem, name) for name in names]
    scheme = "aba1064" if system in ("planets", "particles") else "yoshida4"
    found = derivatives(problem, scheme, "1/20", steps=40, every=15, by=names)
    assert list(found.n) == [0, 15, 30, 40]
    plain = integrate(problem, scheme, "1/20", steps=40, every=15)
    assert np.array_equal(found.q, plain.q) and np.array_equal(found.p, plain.p)
    distance = Fraction(1, 10**12)
    for k, name in enumerate(names):
        ends = []
        for sign in (1, -1):
            moved, h = problem, Fraction(1, 20)
            if name == "h":
                h += sign * distance
            elif name in problem.coordinates + problem.momenta:
                halves = {"q": list(problem.initial[0]), "p": list(problem.initial[1])}
                half, i = ("q", problem.coordinates.index(name)) if name in problem.coordinates else ("p", problem.momenta.index(name))
                halves[half][i] = Fraction(halves[half][i]) + sign * distance
                moved = problem.replaced(**halves)
            else:
                moved = problem.replaced({name: f"({problem.number(name)}) + ({sign * distance})"})
            end = integrate(moved, scheme, h, steps=40, every=40, digits=40)
            ends.append([Fraction(x) for x in [*end.q[-1], *end.p[-1]]])
        expected = np.array([float((a - b) / (2 * distance)) for a, b in zip(*ends)])
        column = np.concatenate([found.of_q[-1, :, k], found.of_p[-1, :, k]])
        # by the initial state in double precision; the difference is right to 1e-24
        assert np.allclose(column, expected, rtol=0, atol=1e-11 * np.abs(expected).max()), name


@pytest.mark.parametrize("system", HAMILTONIAN)
@pytest.mark.parametrize("digits", ["double", "compensated", "double-double", 30])
def test_gradients_are_derivatives(system, digits):
    problem, names = SYSTEMS[system]
    names = [coordinate(problem, name) for name in names]
    scheme = "aba1064" if system == "planets" else "yoshida4"
    run = {"h": "1/20", "steps": 25, "every": 10, "by": names, "digits": digits}
    forwards = derivatives(problem, scheme, **run)
    weights = np.random.default_rng(1).standard_normal((2, *forwards.q.shape))

    def loss(q, p):
        return (weights[0] * q + weights[1] * p).sum(), weights[0], weights[1]

    found = gradient(loss, problem, scheme, **run)
    assert found.reversal_error < 1e-12
    for k, name in enumerate(names):
        expected = (weights[0] * forwards.of_q[:, :, k].astype(float)).sum() + (weights[1] * forwards.of_p[:, :, k].astype(float)).sum()
        assert float(found.by[name]) == pytest.approx(expected, rel=1e-11, abs=1e-11), name


def test_gradients_of_particles_are_refused():
    problem, _ = SYSTEMS["particles"]
    with pytest.raises(InputError, match="bodies of mass 0 do not act on the others"):
        gradient(lambda q, p: (q.sum(), np.ones_like(q), np.zeros_like(p)), problem, "aba1064", h="1/20", steps=2)


def test_derivatives_of_the_oscillator_are_those_of_its_closed_form():
    found = derivatives(Problem("k*x^2/2", q={"x": 1}, p=[0.5], k=4), "bce-rkn8-17", "1/50", until=3, every=150)
    t, omega = 3.0, 2.0
    exact = [[np.cos(omega * t), np.sin(omega * t) / omega], [-omega * np.sin(omega * t), np.cos(omega * t)]]
    assert found.by == ["x", "px"]
    assert np.allclose([found.of_q[-1, 0], found.of_p[-1, 0]], exact, rtol=0, atol=1e-12)


# values at which formulas have fewer constants than beside them
SPECIAL = {
    "parts": (Problem(parts=["px^2/2", "k*x^2/2 + x^4/4"], coordinates=["x"], q=["4/5"], p=["1/9"], k=1), "k", ["1", "2", "3", "1/2", "1/3", "1/10", "-1", "100", "0"]),
    "a field": (Problem("k*x^2/2 + y^4/4", vector_potential=["-y/4", "x/4"], q={"x": 1, "y": "1/3"}, p=[0, "1/7"], k=1), "k", ["1", "2", "1/3", "0"]),
    "time": (Problem(parts=["px^2/2", "x^2/2 + x*cos(k*t)"], coordinates=["x"], q=[1], p=[0], k=1), "k", ["1", "2", "1/2"]),
    "masses in time": (Problem("x^4/4 + x*cos(t)", q={"x": 1}, p=["1/3"]), "masses[0]", ["1", "2"]),
    "masses": (Problem("x^2/2 + x^2*y^2 + y^4", q={"x": 1, "y": 0.3}, p=[0, 1]), "masses[1]", ["1", "1/3"]),
    "Arenstorf": (
        Problem(parts=["(px^2 + py^2)/2 + y*px - x*py", "-(1 - mu)/sqrt((x + mu)^2 + y^2) - mu/sqrt((x - 1 + mu)^2 + y^2)"],
                coordinates=["x", "y"], q=["994/1000", 0], p=[0, "-1"], mu="1/80"),
        "mu",
        ["1/80", "1/82"],
    ),
}


@pytest.mark.parametrize("system", SPECIAL)
def test_derivatives_follow_the_symbol_whatever_its_value(system):
    problem, name, values = SPECIAL[system]
    run = {"h": "1/100", "steps": 20, "every": 20}
    distance = Fraction(1, 10**12)
    for value in values:
        here = problem.replaced({name: value})
        found = derivatives(here, "yoshida4", by=[name], **run)
        plain = integrate(here, "yoshida4", **run)
        assert np.array_equal(found.q, plain.q) and np.array_equal(found.p, plain.p)
        ends = []
        for sign in (1, -1):
            end = integrate(problem.replaced({name: Fraction(value) + sign * distance}), "yoshida4", digits=40, **run)
            ends.append([Fraction(x) for x in [*end.q[-1], *end.p[-1]]])
        expected = np.array([float((a - b) / (2 * distance)) for a, b in zip(*ends)])
        assert np.allclose([*found.of_q[-1, :, 0], *found.of_p[-1, :, 0]], expected, rtol=0, atol=1e-11 * np.abs(expected).max()), value
        back = gradient(lambda q, p: (0.0, np.eye(len(q))[-1][:, None] + 0 * q, None), here, "yoshida4", by=[name], **run)
        assert back.by[name] == pytest.approx(expected[: len(expected) // 2].sum(), rel=1e-10)


def test_tangent_vectors_of_a_run_are_derivatives_along_them():
    problem = SYSTEMS["pairs"][0]
    rng = np.random.default_rng(2)
    vectors = rng.standard_normal((3, 2 * problem.dimension))
    options = {"h": "1/20", "steps": 25, "every": 10}
    run = integrate(problem, "yoshida4", tangent=vectors, **options)
    all_columns = derivatives(problem, "yoshida4", **options)
    expected = np.concatenate([all_columns.of_q, all_columns.of_p], axis=1) @ vectors.T
    assert run.tangent.shape == (4, 3, 2 * problem.dimension)
    assert np.array_equal(run.tangent[0], vectors)
    assert np.allclose(run.tangent, np.moveaxis(expected, 2, 1), rtol=0, atol=1e-12)
    assert integrate(problem, "yoshida4", **options).tangent is None
    precise = integrate(problem, "yoshida4", tangent=vectors.tolist(), digits=30, **options)
    assert np.allclose(precise.tangent.astype(float), run.tangent, rtol=1e-12, atol=1e-12)


def test_tangent_vectors_go_as_far_as_the_run():
    pendulum = Problem("pendulum")
    run = integrate(pendulum, "yoshida4", "1/10", until=100, end="p < 0", every=5, tangent=[["1/3", 0]])
    assert run.t[-1] == 1.7 and run.tangent.shape == (5, 1, 2)
    assert np.array_equal(run.tangent[-1], integrate(pendulum, "yoshida4", "1/10", steps=17, tangent=[["1/3", 0]]).tangent[-1])
    own = Problem(lambda q: (0.5 * q @ q, q), q=[1.0], p=[0.0])
    transformed = Problem("kepler", time={"transform": "logarithmic"})
    for problem, vectors, message in [
        (pendulum, [[1, 0, 0]], "a tangent vector has 3 components, not 2"),
        (pendulum, [1, 0], "`tangent` is not a list of vectors"),
        (pendulum, [], "`tangent` is not a list of vectors"),
        (own, [[1, 0]], "second derivatives"),
        (transformed, [[1, 0, 0, 0]], "the number of steps"),
    ]:
        with pytest.raises(InputError, match=message):
            integrate(problem, "yoshida4", "1/20", until=1, tangent=vectors)


def test_more_digits_are_texts():
    found = derivatives("pendulum", "yoshida4", "1/10", steps=3, digits=30, by=["q"])
    assert found.of_q.dtype == object and len(found.of_q[-1, 0, 0]) > 25


def test_what_is_not_known_is_refused():
    spring = Problem("k*x^2/2", q={"x": 1}, p=[0], k=4)
    vanishing = Problem(parts=["px^2/2 + k*x^4", "x^4/4"], coordinates=["x"], k=0, q=[1], p=[0])
    own = Problem(lambda q: (0.5 * q @ q, q), q=[1.0], p=[0.0])
    for problem, by, message in [
        (spring, ["kk"], "'kk' is not a number of the problem; did you mean 'k'"),
        (spring, ["masses[3]"], r"'masses\[3\]' is not a number of the problem"),
        (vanishing, ["k"], "derivatives by k are not known: no values beside k = 0 can be used"),
        (own, None, "second derivatives"),
        (SYSTEMS["planets"][0], ["body.earth"], "several numbers; write one of them"),
    ]:
        with pytest.raises(InputError, match=message):
            derivatives(problem, "yoshida4" if problem is not SYSTEMS["planets"][0] else "aba1064", "1/20", steps=2, by=by)
    with pytest.raises(InputError, match="the number of steps"):
        derivatives(Problem("kepler", time={"transform": "logarithmic"}), "yoshida4", "1/20", until=1)
    with pytest.raises(InputError, match=r"the derivatives by q have the shape \(1,\), not \(3, 1\)"):
        gradient(lambda q, p: (0.0, np.zeros(1), None), spring, "yoshida4", "1/20", steps=2)


def test_a_function_of_jax():
    jax = pytest.importorskip("jax")
    from jax.test_util import check_grads

    import shadowstep.jax

    jax.config.update("jax_enable_x64", True)
    problem, _ = SYSTEMS["formula"]
    states = shadowstep.jax.flow(problem, "yoshida4", "1/20", steps=25, every=10, by=["k", "h"])
    q, p, numbers = jax.numpy.array([1.0]), jax.numpy.array([1 / 3]), jax.numpy.array([2.5, 0.05])

    def loss(q, p, numbers):
        of_q, of_p = states(q, p, numbers)
        return (of_q**2).sum() + jax.numpy.sin(of_p).sum()

    found = jax.jit(jax.grad(loss, argnums=(0, 1, 2)))(q, p, numbers)

    def by_hand(q, p):
        return (q**2).sum() + np.sin(p).sum(), 2 * q, np.cos(p)

    expected = gradient(by_hand, problem.replaced(q=[1.0], p=[1 / 3]), "yoshida4", "1/20", steps=25, every=10, by=["x", "px", "k", "h"])
    assert np.allclose(np.concatenate(found), list(expected.by.values()), rtol=1e-13)
    several = jax.vmap(jax.grad(loss), in_axes=(0, None, None))(jax.numpy.array([[1.0], [0.5]]), p, numbers)
    assert several.shape == (2, 1) and several[0, 0] == found[0][0]
    check_grads(loss, (q, p, numbers), order=1, modes=["rev"], rtol=1e-3)


def test_a_function_of_torch():
    torch = pytest.importorskip("torch")
    import shadowstep.torch

    problem, _ = SYSTEMS["formula"]
    states = shadowstep.torch.flow(problem, "yoshida4", "1/20", steps=25, every=10, by=["k", "h"])
    given = [torch.tensor(values, dtype=torch.float64, requires_grad=True) for values in ([1.0], [1 / 3], [2.5, 0.05])]
    assert torch.autograd.gradcheck(states, given, eps=1e-6, atol=1e-6)
    with pytest.raises(InputError, match="there are 1 numbers for the 2 names"):
        states(*given[:2], torch.tensor([2.5]))


def test_numbers_are_replaced_by_their_names():
    planets, _ = SYSTEMS["planets"]
    moved = planets.replaced({"body.earth.mass": "1/7", "body[2].q[1]": 6})
    assert moved.number("body[1].mass") == "1/7" and moved.number("body.jupiter.q[1]") == 6
    assert planets.number("body.earth.mass") == "1/300"
    with pytest.raises(InputError, match="the state of this problem is in its bodies"):
        planets.replaced(q=np.zeros(9))
