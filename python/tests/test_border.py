"""Between Python and Rust: panics, interruptions, threads, copies, and what wrong arguments are told."""

import copy
import ctypes
import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, InternalError, Monitor, Problem, Scheme, _shadowstep, border, integrate


class PanicException(BaseException):
    """As PyO3 has it: not an `Exception`."""


def test_a_panic_is_an_ordinary_exception():
    def panics():
        raise PanicException("called `Option::unwrap()` on a `None` value")

    with pytest.raises(RuntimeError, match=r"called `Option::unwrap\(\)` on a `None` value \(a fault of shadowstep ") as error:
        border.ordinary(panics)()
    assert isinstance(error.value, InternalError) and error.value.__cause__ is None
    with pytest.raises(KeyboardInterrupt):
        border.ordinary(lambda: (_ for _ in ()).throw(KeyboardInterrupt))()


def test_every_function_and_method_of_the_compiled_module_is_at_the_border():
    def is_closed(member):
        member = member.__func__ if isinstance(member, staticmethod) else member.fget if isinstance(member, property) else member
        return getattr(member, "__code__", None) is border.ordinary(len).__code__

    functions = [name for name, value in vars(_shadowstep).items() if callable(value) and not isinstance(value, type)]
    assert {"integrate", "drift", "advise", "run_scene", "command"} <= set(functions)
    assert all(is_closed(getattr(_shadowstep, name)) for name in functions)
    for kind in (_shadowstep.Given, _shadowstep.Table, _shadowstep.Monitor, _shadowstep.Observer):
        members = {name: member for name, member in vars(kind).items() if not name.startswith("__")}
        assert members and all(is_closed(member) for member in members.values()), members


@pytest.fixture
def interrupted():
    """Sends Ctrl-C after 0.2 s, and waits for the end of a call that would take hours."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    def ends(call):
        threading.Timer(0.2, signal.raise_signal, [signal.SIGINT]).start()
        with pytest.raises(KeyboardInterrupt):
            call()

    yield ends
    signal.signal(signal.SIGINT, before)


SLOW = 'problem.name = "kepler"\nrun = { scheme = "yoshida4", step = "1/1000", steps = 1000000000, digits = 120 }\noutput.energy = { every = 1000000000 }\n'
MANY = """
problem = { potential = "x^2/2 + a*x^4", coordinates = ["x"], parameters = { a = "b" } }
initial = { q = [1], p = [0] }
run = { scheme = "yoshida4", step = "1/1000", steps = 1000000000, digits = "double" }
output.energy = { every = 1000000000 }
ensemble.columns = { b = [0, 1, 2] }
"""


@pytest.mark.parametrize(
    "call",
    [
        lambda: shadowstep.drift("kepler", "sofroniou-spaletta10-35", h="1/20", until=100_000, digits=300),
        lambda: shadowstep.drift("kepler", "exact-flow", h="1/20", until=50_000, digits=250),
        lambda: shadowstep.integrate("kepler", "yoshida4", h="1/1000", steps=10**9, every=10**9, estimator="central"),
        lambda: shadowstep.work_precision("kepler", 10**6, ["yoshida4"], seconds=60),
        lambda: shadowstep.advise("kepler", 10**6, 1e-8, seconds=60),
        lambda: shadowstep.run(SLOW),
        lambda: shadowstep.run(MANY),
        lambda: Monitor("kepler", "yoshida4", h="1/1000").step(10**12),
    ],
)
def test_ctrl_c_ends_every_computation_soon(call, interrupted):
    interrupted(call)


def test_a_monitor_works_in_all_threads_and_leaves_the_lock():
    monitor = Monitor("kepler", "yoshida4", h="1/100", every=100)
    alone = Monitor("kepler", "yoshida4", h="1/100", every=100)
    threads = [threading.Thread(target=lambda: [monitor.step(100) for _ in range(50)]) for _ in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    alone.step(20_000)
    assert monitor.n == 20_000 and all(np.array_equal(a, b) for a, b in zip(monitor.state, alone.state))
    assert monitor.newest == alone.newest and monitor.report() == alone.report()
    counted, done = [], threading.Event()

    def count():
        while not done.is_set():
            counted.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    monitor.step(1_000_000)
    done.set()
    thread.join()
    assert len(counted) > 20


def test_a_monitor_goes_on_after_ctrl_c(interrupted):
    monitor = Monitor("pendulum", "stormer-verlet", h="1/10")
    interrupted(lambda: monitor.step(10**12))
    n = monitor.n
    monitor.step(10)
    assert 0 < n < 10**12 and monitor.n == n + 10


FORKED = """
import os
from shadowstep import Monitor

monitor = Monitor("pendulum", "stormer-verlet", h="1/10")
child = os.fork()
if child == 0:
    try:
        monitor.step(1)
    except RuntimeError as error:
        os._exit(0 if "belongs to the process that made it" in str(error) else 1)
    os._exit(2)
raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


# in a process without threads, which JAX has: they are not forked
@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_monitor_is_refused_in_a_forked_process():
    assert subprocess.run([sys.executable, "-c", FORKED], timeout=60).returncode == 0


def spring(q):
    """½ q²"""
    return 0.5 * q @ q, q


PROBLEMS = [
    Problem("kepler", eccentricity="3/5"),
    Problem("k*x^2/2", q={"x": 1}, p=[0], k=4),
    Problem(pair="-m_i*m_j/sqrt(r2)", dimensions=2, bodies={"m": [1, "1/1000"]}, q=[0, 0, 1, 0], v=[0, 0, 0, 1]),
    Problem(spring, q=[1.0, 0.5], p=[0.0, 1.0]),
]


@pytest.mark.parametrize("problem", PROBLEMS, ids=repr)
def test_problems_are_pickled_and_copied(problem):
    expected = integrate(problem, "stormer-verlet", h="1/20", steps=20)
    for again in (pickle.loads(pickle.dumps(problem)), copy.deepcopy(problem), copy.copy(problem)):
        found = integrate(again, "stormer-verlet", h="1/20", steps=20)
        assert repr(again) == repr(problem) and np.array_equal(found.q, expected.q) and np.array_equal(found.energy, expected.energy)


def test_a_problem_of_a_scene_is_pickled_with_its_text(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(shadowstep.scene("pendulum"))
    pickled = pickle.dumps(Problem.from_scene(path))
    path.unlink()
    assert pickle.loads(pickled).energy == Problem("pendulum").energy


def test_the_address_of_a_c_function_is_copied_and_not_pickled():
    function = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)(lambda q, gradient: 0.0)
    problem = Problem(ctypes.cast(function, ctypes.c_void_p).value, q=[1.0], p=[0.0])
    assert copy.deepcopy(problem).energy == problem.energy
    with pytest.raises(TypeError, match="belongs to its process"):
        pickle.dumps(problem)


def test_schemes_are_pickled_and_copied(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(Scheme("stormer-verlet").text.replace("stormer-verlet", "mine"))
    for scheme in (Scheme("yoshida4"), Scheme(str(path)), Scheme(path.read_text())):
        for again in (pickle.loads(pickle.dumps(scheme)), copy.deepcopy(scheme)):
            assert repr(again) == repr(scheme) and again.name == scheme.name and again.maps == scheme.maps


def test_coordinates_of_a_formula_have_names():
    with pytest.raises(InputError, match=r'q must name the coordinates of the formula: q=\{"x": 1, "y": 0\}'):
        Problem("x^2/2", q=[1], p=[0])
    assert Problem("x^2/2", coordinates=["x"], q=[1], p=[0]).dimension == 1


def test_names_of_problems_are_problems():
    kepler = Problem("kepler")
    assert np.array_equal(integrate("kepler", "yoshida4", h=0.1, steps=9).q, integrate(kepler, "yoshida4", h=0.1, steps=9).q)
    with pytest.raises(InputError, match="problem = 'keppler' is not the name of a shipped problem; did you mean 'kepler'?"):
        integrate("keppler", "yoshida4", h=0.1, steps=9)
    with pytest.raises(InputError, match=r"problem = 'x\^2' .* write shadowstep.Problem"):
        integrate("x^2", "yoshida4", h=0.1, steps=9)


@pytest.mark.parametrize(
    "name, call",
    [
        ("problem", lambda: integrate(3, "yoshida4", h=0.1, steps=9)),
        ("problem", lambda: shadowstep.drift(None, "yoshida4", h=0.1, until=9)),
        ("problem", lambda: shadowstep.advise([], 10, 1e-6)),
        ("scheme", lambda: integrate("kepler", 4, h=0.1, steps=9)),
        ("scheme", lambda: Monitor("kepler", None, h=0.1)),
        ("schemes", lambda: shadowstep.work_precision("kepler", 10, 4)),
        ("h", lambda: integrate("kepler", "yoshida4", h=[0.1], steps=9)),
        ("until", lambda: integrate("kepler", "yoshida4", h=0.1, until=object())),
        ("steps", lambda: integrate("kepler", "yoshida4", h=0.1, steps="9")),
        ("every", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, every=1.5)),
        ("end", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, end=5)),
        ("section", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, section=3)),
        ("direction", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, section="x", direction=1)),
        ("digits", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, digits=[30])),
        ("mpfr", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, mpfr="yes")),
        ("estimator", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, estimator=8)),
        ("order", lambda: integrate("kepler", "yoshida4", h=0.1, steps=9, estimator="bilinear", order="8")),
        ("stop", lambda: shadowstep.drift("kepler", "yoshida4", h=0.1, until=9, stop=3)),
        ("accuracy", lambda: shadowstep.drift("kepler", "yoshida4", h=0.1, until=9, accuracy=[])),
        ("control", lambda: shadowstep.drift("kepler", "yoshida4", h=0.1, until=9, control="no")),
        ("tolerance", lambda: shadowstep.advise("kepler", 10, None)),
        ("tolerance", lambda: shadowstep.advise("kepler", 10, "small")),
        ("seconds", lambda: shadowstep.advise("kepler", 10, 1e-6, seconds="long")),
        ("of", lambda: shadowstep.advise("kepler", 10, 1e-6, of=1)),
        ("cost", lambda: shadowstep.advise("kepler", 10, 1e-6, cost=[])),
        ("table", lambda: Scheme(4)),
        ("target", lambda: Scheme("yoshida4").emit(3)),
        ("system", lambda: Problem(1.5, q=[1], p=[0])),
        ("q", lambda: Problem(spring, q=1.0, p=[0])),
        ("q", lambda: Problem("x^2", q=[None], p=[0], coordinates=["x"])),
        ("masses", lambda: Problem("x^2", q={"x": 1}, p=[0], masses=[None])),
        ("name", lambda: shadowstep.scene(3)),
        ("scene", lambda: shadowstep.run(3)),
    ],
)
def test_wrong_types_name_their_argument(name, call):
    with pytest.raises((TypeError, ValueError)) as error:
        call()
    assert re.match(rf"(the )?{name}\b", str(error.value)), str(error.value)


def test_rows_at_the_ends_have_no_shadow_energy():
    orbit = integrate("pendulum", "stormer-verlet", h=0.1, steps=200)
    values, errors = shadowstep.shadow_energy(orbit.q, orbit.p, (-np.cos(orbit.q[:, 0]), -np.sin(orbit.q)), h=0.1)
    known = np.flatnonzero(np.isfinite(values))
    assert np.array_equal(known, np.arange(known[0], known[-1] + 1)) and known[0] == 8 and known[-1] == 192
    assert np.array_equal(known, np.flatnonzero(np.isfinite(errors)))


def test_advice_is_printed_as_a_table():
    advice = shadowstep.advise("pendulum", 50, 1e-6, seconds=0.2)
    head, *rows, verified = str(advice).splitlines()
    assert head.split() == ["scheme", "h", "steps", "predicted", "forces", "seconds"] and len(rows) == len(advice.choices)
    assert rows[0].split()[0] == advice.choices[0].scheme and verified.startswith("verified: ")
    assert len({len(line) for line in (head, *rows)}) == 1
    none = shadowstep.advise("pendulum", 50, 1e-30, seconds=0.2)
    # and no runs are made that cannot meet it
    assert str(none) == none.reason and none.reason.startswith("No scheme meets the tolerance")


def test_forces_that_ask_what_waits_for_them_are_one_error():
    """They waited for each other without an end."""
    asked = []

    def forces(q):
        for ask in asked:
            ask()
        return 0.5 * q @ q, q

    problem = Problem(forces, q=[1.0], p=[0.0])
    monitor, other = (Monitor(problem, "stormer-verlet", "1/10") for _ in range(2))
    for ask in (lambda: monitor.step(1), lambda: monitor.state, lambda: monitor.report(), lambda: monitor.n, lambda: other.step(1)):
        asked[:] = [ask]
        with pytest.raises(RuntimeError, match="the forces of a monitor cannot ask the monitor itself, which waits for them"):
            monitor.step(1)
    asked[:] = [lambda: integrate(problem, "stormer-verlet", "1/10", steps=1)]
    for call in (lambda: integrate(problem, "stormer-verlet", "1/10", steps=1), lambda: monitor.step(1), lambda: shadowstep.drift(problem, "stormer-verlet", "1/10", 1, digits="double")):
        with pytest.raises(RecursionError, match="compute what needs these forces again"):
            call()
    asked[:] = [lambda: integrate("pendulum", "stormer-verlet", "1/10", steps=1)]  # what ends is right
    n = monitor.n
    monitor.step(2)
    assert monitor.n == n + 2


def test_an_observer_is_shared_by_threads():
    observer = shadowstep.Observer([1.0], 0.1)
    threads = [threading.Thread(target=lambda: [observer.observe([1.0], [0.0], 0.0, [0.0]) for _ in range(500)]) for _ in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert observer.diagnosis().states == 2000


def test_what_a_problem_and_a_scheme_give_cannot_change_them():
    k = np.array([0.0, 1.0])
    problem = Problem("k*x^2/2 + y^2", q={"x": 1, "y": 2}, p=k, k=4)
    k[1] = 7
    sections = problem.sections
    for change in (
        lambda: sections["problem"].update(potential="x"),
        lambda: sections["problem"]["parameters"].__setitem__("k", 5),
        lambda: sections["initial"]["q"].__setitem__(0, 5),
        lambda: sections.__setitem__("problem", {}),
    ):
        with pytest.raises((TypeError, AttributeError)):
            change()
    problem.initial[0][0] = 9
    problem.coordinates[0] = "z"
    assert problem.replaced({"k": 2}).energy == 5.5 and problem.energy == 6.5 and problem.coordinates == ["x", "y"]
    scheme = Scheme("yoshida4")
    scheme.record["maps"].clear()
    scheme.maps.clear()
    assert len(scheme.maps) == 7
    monitor = Monitor("pendulum", "stormer-verlet", "1/10")
    monitor.state[0][0] = 5
    assert monitor.state[0][0] == Problem("pendulum").initial[0][0]
