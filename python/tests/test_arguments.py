"""Wrong values for the arguments of every public function: each is an `InputError` with the name of the argument."""

import inspect
import random
import re
import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Monitor, Observer, Problem, RunError, Scheme

ORBIT = shadowstep.integrate("pendulum", "stormer-verlet", h=0.1, steps=40)
U, FORCES = -np.cos(ORBIT.q[:, 0]), -np.sin(ORBIT.q)
SPRING = Problem("k*x^2/2", q={"x": 1}, p=[0], k=4)
RUN = {"problem": "pendulum", "scheme": "yoshida4", "h": "1/10", "steps": 4}
SEARCH = 'order = 2\nkinetic = "any"\nstages = 2\nminimise = "effective-error"\n'
PRINTED = """
name = "forest-ruth"
order = 4
kinetic = "any"
[stages]
kick = [0.6756, -0.1756, -0.1756, 0.6756]
drift = [1.3512, -1.7024, 1.3512, 0]
"""


def loss(q, p):
    return float((q**2).sum()), 2 * q, None


def spring(q):
    return 0.5 * q @ q, q


# What each function is called with where its arguments are right.
CALLS = {
    "integrate": (shadowstep.integrate, {**RUN, "progress": False}),
    "drift": (shadowstep.drift, {"problem": "pendulum", "scheme": "yoshida4", "h": "1/10", "until": "1", "digits": 30, "progress": False}),
    "chaos": (shadowstep.chaos, {**RUN, "vectors": 2, "progress": False}),
    "lyapunov": (shadowstep.lyapunov, {**RUN, "progress": False}),
    "megno": (shadowstep.megno, {**RUN, "progress": False}),
    "derivatives": (shadowstep.derivatives, {**RUN, "by": ["q"], "progress": False}),
    "gradient": (shadowstep.gradient, {"loss": loss, **RUN, "by": ["q"], "progress": False}),
    "Flow": (shadowstep.Flow, {**RUN}),
    "Flow.states": (shadowstep.Flow(**RUN).states, {"q": [1.0], "p": [0.0], "numbers": ()}),
    "ensemble": (shadowstep.ensemble, {**RUN, "q": [[1.0]], "p": [[0.0]], "progress": False}),
    "modified_hamiltonian": (shadowstep.modified_hamiltonian, {"problem": "pendulum", "scheme": "yoshida4", "grade": 2}),
    "ModifiedHamiltonian": (shadowstep.modified_hamiltonian("pendulum", "yoshida4", 2), {"q": [1.0], "p": [0.0], "h": "1/10"}),
    "Monitor": (Monitor, {"problem": "pendulum", "scheme": "yoshida4", "h": "1/10"}),
    "Monitor.step": (Monitor("pendulum", "yoshida4", "1/10").step, {"steps": 3}),
    "Problem": (Problem, {"system": "k*x^2/2", "q": {"x": 1}, "p": [0], "parameters": {"k": 1}}),
    "Problem of forces": (Problem, {"system": spring, "q": [1.0], "p": [0.0]}),
    "Problem.replaced": (SPRING.replaced, {"numbers": {"k": 2}}),
    "Problem.number": (SPRING.number, {"name": "k"}),
    "Problem.from_scene": (Problem.from_scene, {"path": "nowhere.toml"}),
    "Observer": (Observer, {"masses": [1.0], "h": "1/10"}),
    "Observer.begin": (Observer([1.0], 0.1).begin, {"n": 0}),
    "Observer.observe": (Observer([1.0], 0.1).observe, {"q": [1.0], "p": [0.0], "energy": 0.0, "forces": [1.0]}),
    "diagnose": (shadowstep.diagnose, {"q": ORBIT.q, "p": ORBIT.p, "potential": (U, FORCES), "h": 0.1}),
    "shadow_energy": (shadowstep.shadow_energy, {"q": ORBIT.q, "p": ORBIT.p, "potential": (U, FORCES), "h": 0.1}),
    "run": (shadowstep.run, {"scene": "problem.name = 'pendulum'\nrun = { scheme = 'yoshida4', step = 1, steps = 2 }\noutput.energy = true\n", "progress": False}),
    "scene": (shadowstep.scene, {"name": "kepler"}),
    "open": (shadowstep.open, {"path": "nowhere.csv"}),
    "Scheme": (Scheme, {"table": "yoshida4"}),
    "Scheme.emit": (Scheme("yoshida4").emit, {"target": "c"}),
    "Scheme.proposal": (Scheme("yoshida4").proposal, {"frequencies": [1.0, 2.0], "steps": 3}),
    "Scheme.modified": (Scheme("yoshida4").modified, {"grade": 2}),
    "Scheme.polish": (Scheme.polish, {"table": PRINTED, "digits": 30}),
    "search": (shadowstep.search, {"request": SEARCH, "starts": 1, "digits": 30}),
    "sweep": (shadowstep.sweep, {"path": "nowhere.toml", "out": "out"}),
    "work_precision": (shadowstep.work_precision, {"problem": "pendulum", "until": 1, "schemes": ["yoshida4"], "steps": [10], "progress": False}),
    "advise": (shadowstep.advise, {"problem": "pendulum", "until": 1, "tolerance": 1e-4, "schemes": ["yoshida4"], "seconds": 0.05, "progress": False}),
    "Trajectory.mpmath": (ORBIT.mpmath, {"name": "q"}),
}


class Odd:
    """Nothing that any argument is."""

    def __repr__(self):
        return "odd"


WRONG = [
    3,
    -1,
    0,
    2**80,
    -(2**70),
    1.5,
    1e300,
    float("nan"),
    float("inf"),
    1 + 2j,
    True,
    "",
    "nonsense",
    "1/0",
    "a\0b",
    "\ud800",
    b"bytes",
    Decimal("sNaN"),
    Decimal("Infinity"),
    Fraction(1, 3),
    [],
    [[]],
    [1, [2]],
    [[1, 2], [3]],
    [None],
    ["x", 3],
    [1.0, 2.0, 3.0],
    (),
    {},
    {"x": None},
    {"x": "nonsense"},
    {3: 4},
    {"x": {"y": []}},
    {1, 2},
    np.zeros(0),
    np.zeros((2, 0)),
    np.array(2.5),
    np.array([np.nan]),
    np.array(["a"]),
    np.array([1j]),
    np.array([None]),
    np.datetime64("2020-01-01"),
    np.float32(np.inf),
    range(3),
    object,
    Odd(),
    lambda *given: None,
]


def cases():
    random.seed(71)
    for name, (function, right) in CALLS.items():
        for argument in inspect.signature(function).parameters.values():
            if argument.kind is argument.VAR_KEYWORD:
                continue
            # what a function of the caller raises is its own
            functions = argument.name in ("loss", "system")
            for value in random.sample([value for value in WRONG if not (functions and callable(value))], 8):
                yield name, argument.name, value


CASES = list(cases())


def refused(name, argument, value):
    """What is raised; None where the value is taken."""
    function, right = CALLS[name]
    given = {**right, argument: value}
    if argument == "until" and name not in ("drift", "work_precision", "advise"):
        given.pop("steps", None)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            function(**given)
    except (InputError, RunError, OSError) as error:
        return error
    return None


# Of [problem] and the sections beside it, which Problem takes as they are.
KEYS = ["q", "p", "v", "time", "body", "nonsense", *(key for key, _ in shadowstep._shadowstep.problem_keys() if key not in ("name", "potential"))]
PROBLEMS = [
    {"system": "x^2/2", "q": {"x": 1}, "p": [0]},
    {"pair": "-m_i*m_j/sqrt(r2)", "dimensions": 2, "bodies": {"m": [1, "1/1000"]}, "q": [0, 0, 1, 0], "v": [0, 0, 0, 1]},
    {"body": [{"mass": 1}, {"mass": "1/1000", "a": 1}], "parameters": {"g": 1}, "parts": "wisdom-holman"},
    {"system": "kepler"},
]
OF_KEYS = [*WRONG, {"function": "nonsense"}, {"potential": 3}, [{"mass": 1}], [{"mass": None}], [3], {"m": [1, None]}, {"count": 2**70}, [["a"]]]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("given", PROBLEMS, ids=lambda given: next(iter(given)))
def test_wrong_values_of_keys_of_a_problem_name_them(given, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    wrong = []
    for key in KEYS:
        for value in OF_KEYS:
            try:
                Problem(**{**given, key: value})
            except InputError as error:
                if not re.search(rf"\b({'|'.join([key, *given])})\b", str(error)):
                    wrong.append(f"{key}={value!r}: not named: {error}")
            except Exception as other:  # noqa: BLE001
                wrong.append(f"{key}={value!r}: {type(other).__name__}: {other}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", CALLS)
def test_wrong_values_name_their_argument(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    wrong = []
    for _, argument, value in (case for case in CASES if case[0] == name):
        try:
            error = refused(name, argument, value)
        except Exception as other:  # noqa: BLE001
            wrong.append(f"{argument}={value!r}: {type(other).__name__}: {other}")
            continue
        # or that of another one, with which it does not go together
        if isinstance(error, InputError) and not re.search(rf"\b({'|'.join([argument, *CALLS[name][1]])})\b", str(error)):
            wrong.append(f"{argument}={value!r}: not named: {error}")
    assert not wrong, "\n".join(wrong)


def test_every_public_function_is_drawn():
    public = {name for name in shadowstep.__all__ if callable(getattr(shadowstep, name)) and not (isinstance(getattr(shadowstep, name), type) and hasattr(getattr(shadowstep, name), "__dataclass_fields__"))}
    others = {"schemes", "command", "InputError", "InternalError", "RunError", "WrongType", "Sample", "ShadowEnergy"}
    assert public - others == {name.partition(".")[0] for name in CALLS if "of forces" not in name and "." not in name}
