"""Runs: their arrays, number types, forces of one's own, and what is refused."""

import ctypes
import math
import signal
import threading
import time
import warnings
from fractions import Fraction

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Monitor, Problem, RunError, Scheme, integrate
from shadowstep.document import document


def verlet(q, p, gradient, h, steps):
    """Störmer–Verlet by hand, with the operations in the order in which Shadowstep makes them."""
    q, p = np.array(q), np.array(p)
    for _ in range(steps):
        p = p - (h / 2) * gradient(q)
        q = q + h * p
        p = p - (h / 2) * gradient(q)
    return q, p


def test_a_summary_has_the_windows_that_are_wanted():
    def windows(**wanted):
        run = integrate(Problem("pendulum"), "yoshida4", h="1/10", steps=9000, every=9000, summary=True, **wanted)
        return run.summary["modified_energy"]["windows"]

    # each 35 and 3 steps; the last 8 states end no window of 17
    assert [windows(), windows(windows=3000)] == [257, 2992]
    for message, wrong in (("at least 16, not 15", {"summary": True, "windows": 15}), ("add summary=True", {"windows": 1000})):
        with pytest.raises(InputError, match=message):
            integrate(Problem("pendulum"), "yoshida4", h="1/10", steps=10, **wrong)


def test_a_run_has_the_bits_of_a_loop_in_python():
    found = integrate(Problem("-cos(x)", q={"x": "1/2"}, p=["1/4"]), "stormer-verlet", h=0.125, steps=50)
    q, p = verlet([0.5], [0.25], np.sin, 0.125, 50)
    # one formula: the same operations; sin of NumPy and of Rust may differ in the last place, which 50 steps keep below 1e-14
    assert found.q.shape == (51, 1) and abs(found.q[-1, 0] - q[0]) < 1e-14 and abs(found.p[-1, 0] - p[0]) < 1e-14


def test_quadratic_potential_to_the_last_bit():
    found = integrate(Problem("x^2/2", q=[1], p=[0], coordinates=["x"]), "stormer-verlet", h=0.125, steps=50)
    q, p = verlet([1.0], [0.0], lambda q: q, 0.125, 50)
    assert found.q[-1, 0] == q[0] and found.p[-1, 0] == p[0]


def test_every_keeps_multiples_and_the_last_state():
    kepler = Problem("kepler")
    all_states = integrate(kepler, "yoshida4", h="1/20", steps=103)
    some = integrate(kepler, "yoshida4", h="1/20", steps=103, every=10)
    assert some.n.tolist() == [*range(0, 103, 10), 103]
    assert np.array_equal(some.q, all_states.q[some.n]) and np.array_equal(some.energy, all_states.energy[some.n])
    shadow = integrate(kepler, "yoshida4", h="1/20", steps=103, every=10, estimator="bilinear", order=8)
    assert np.array_equal(some.q, shadow.q) and some.n.tolist() == shadow.n.tolist()
    assert np.all(np.abs(shadow.modified_energy + 0.5) < 1e-3) and np.all(shadow.modified_energy_error > 0)


def test_an_estimator_between_the_states_has_no_last_value():
    shadow = integrate(Problem("pendulum"), "stormer-verlet", h="1/10", steps=20, estimator="bilinear", order=7)
    plain = integrate(Problem("pendulum"), "stormer-verlet", h="1/10", steps=20)
    assert shadow.is_between and math.isnan(shadow.modified_energy[-1]) and np.all(np.isfinite(shadow.modified_energy[:-1]))
    assert np.array_equal(plain.q, shadow.q)


def test_more_digits_are_texts_that_agree():
    kepler = Problem("kepler")
    double = integrate(kepler, "yoshida4", h="1/20", until=2)
    for digits in (30, "double-double", 120):
        precise = integrate(kepler, "yoshida4", h="1/20", until=2, digits=digits)
        assert precise.q.dtype == object and isinstance(precise.q[0, 0], str)
        # 40 steps of round-off
        assert np.allclose(precise.q.astype(float), double.q, rtol=0, atol=1e-13)
    import mpmath

    x = precise.mpmath("q", 120)[0][0]
    assert x == mpmath.mpf("0.4") and mpmath.mp.dps == 120


def test_a_float_is_the_decimal_that_is_printed():
    run = integrate(Problem("pendulum"), "stormer-verlet", h=0.1, until=0.3)
    assert run.n[-1] == 3 and run.t[-1] == 0.3
    assert integrate(Problem("pendulum"), "stormer-verlet", h=Fraction(1, 3), until=1).n[-1] == 3


def test_an_end_between_two_steps_is_a_warning():
    with pytest.warns(UserWarning, match="ends at"):
        run = integrate(Problem("pendulum"), "stormer-verlet", h="3/10", until=1)
    assert run.n[-1] == 3


def test_backwards():
    there = integrate(Problem("kepler"), "yoshida4", h="1/20", steps=100)
    q, p = there.q[-1].tolist(), there.p[-1].tolist()
    back = integrate(Problem("kepler", q=q, p=p), "yoshida4", h="-1/20", steps=100)
    # round-off of 200 steps
    assert np.allclose(back.q[-1], there.q[0], rtol=0, atol=1e-12)


def kepler_force(q):
    r = math.hypot(*q)
    return -1 / r, q / r**3


def test_a_python_function_for_the_forces():
    own = integrate(Problem(kepler_force, q=[0.4, 0.0], p=[0.0, 2.0]), "yoshida4", h="1/20", steps=100)
    formula = integrate(Problem("kepler"), "yoshida4", h="1/20", steps=100)
    # the operations differ, the motion is the same
    assert np.allclose(own.q, formula.q, rtol=0, atol=1e-11) and np.allclose(own.energy, formula.energy, rtol=0, atol=1e-12)


def test_a_c_function_of_ctypes_has_the_bits_of_the_python_function():
    @ctypes.CFUNCTYPE(ctypes.c_double, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_double))
    def spring(q, gradient):
        gradient[0], gradient[1] = q[0], 4 * q[1]
        return (q[0] ** 2 + 4 * q[1] ** 2) / 2

    address = ctypes.cast(spring, ctypes.c_void_p).value
    state = {"q": [1.0, 0.5], "p": [0.0, 0.25]}
    of_c = integrate(Problem(address, **state), "blanes-moan-srkn6b", h="1/10", steps=50)
    of_python = integrate(
        Problem(lambda q: ((q[0] ** 2 + 4 * q[1] ** 2) / 2, np.array([q[0], 4 * q[1]])), **state), "blanes-moan-srkn6b", h="1/10", steps=50
    )
    assert np.array_equal(of_c.q, of_python.q) and np.array_equal(of_c.energy, of_python.energy)


def test_a_c_function_of_cffi():
    cffi = pytest.importorskip("cffi")
    ffi = cffi.FFI()

    @ffi.callback("double(const double *, double *)")
    def spring(q, gradient):
        gradient[0] = q[0]
        return q[0] * q[0] / 2

    own = integrate(Problem(int(ffi.cast("uintptr_t", spring)), q=[1.0], p=[0.0]), "stormer-verlet", h=0.125, steps=50)
    q, _ = verlet([1.0], [0.0], lambda q: q, 0.125, 50)
    assert own.q[-1, 0] == q[0]


def test_a_numba_function():
    numba = pytest.importorskip("numba")

    @numba.cfunc("float64(CPointer(float64), CPointer(float64))")
    def spring(q, gradient):
        gradient[0] = q[0]
        return q[0] * q[0] / 2

    own = integrate(Problem(spring.address, q=[1.0], p=[0.0]), "stormer-verlet", h=0.125, steps=50)
    q, _ = verlet([1.0], [0.0], lambda q: q, 0.125, 50)
    assert own.q[-1, 0] == q[0]


def test_what_a_function_raises_comes_out():
    def wrong(q):
        if q[0] < 0.9:
            raise KeyError("no forces here")
        return 0.5 * q @ q, q

    problem = Problem(wrong, q=[1.0], p=[0.0])
    with pytest.raises(KeyError, match="no forces here"):
        integrate(problem, "stormer-verlet", h=0.1, steps=100)
    with pytest.raises(TypeError, match=r"must return \(U, gradient\)"):
        integrate(Problem(lambda q: q, q=[1.0], p=[0.0]), "stormer-verlet", h=0.1, steps=1)
    with pytest.raises(ValueError, match="the gradient has 2 numbers, and q has 1"):
        integrate(Problem(lambda q: (0.0, np.zeros(2)), q=[1.0], p=[0.0]), "stormer-verlet", h=0.1, steps=1)


def henon_heiles(wrong=lambda x, y: np.zeros(2)):
    def forces(q):
        x, y = q
        return (x**2 + y**2) / 2 + x**2 * y - y**3 / 3, np.array([x + 2 * x * y, y + x**2 - y**2]) + wrong(x, y)

    return forces


def chain(sign):
    """Bodies 0.1 apart between which there are springs of this length."""

    def forces(q):
        stretched = np.diff(q) - 0.1
        gradient = np.zeros_like(q)
        gradient[1:] += stretched
        gradient[:-1] -= stretched
        return (stretched @ stretched) / 2 - 1000.0, sign * gradient

    return forces


@pytest.mark.parametrize(
    "wrong",
    [lambda x, y: np.array([0, -2 * x**2]), lambda x, y: np.array([0, y**2]), lambda x, y: np.array([0.1 * x, 0.1 * y]), lambda x, y: np.array([-2 * x, -2 * y]), lambda x, y: np.array([0.005 * x, 0])],
)
def test_own_forces_with_a_wrong_gradient_are_warned_of(wrong):
    state = {"q": [0.4, -0.3], "p": [0.1, 0.2]}
    with pytest.warns(UserWarning, match="the gradient is not that of U: at t = 0"):
        Problem(henon_heiles(wrong), **state)
    with pytest.warns(UserWarning, match="the gradient is not that of U: at t = 0"):
        Problem(chain(-1.0), q=[0.1 * i for i in range(10)], p=[0] * 10)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Problem(henon_heiles(), **state)
        # a chain at rest, whose forces are round-off: the state beside it decides
        Problem(chain(1.0), q=[0.1 * i for i in range(10)], p=[0] * 10)
        # at rest, with noise, in single precision, at a large energy: no warning
        Problem(henon_heiles(), q=[0, 0], p=[0.1, 0.2])
        Problem(lambda q: (1e6 + q @ q / 2 + 1e-6 * np.random.default_rng().standard_normal(), q), q=[1.0, 2.0], p=[0, 0])
        Problem(lambda q: (float(np.float32(q @ q / 2)), q.astype(np.float32).astype(float)), q=[1.0, 2.0], p=[0, 0])
        Problem(lambda q: (-1 / np.linalg.norm(q), q / np.linalg.norm(q) ** 3), q=[1e-3, 1e-4], p=[0, 1])


@pytest.mark.parametrize(
    ("call", "message", "hint"),
    [
        (lambda: Problem("keppler"), "there is no problem `keppler`", "did you mean `kepler`?"),
        (lambda: Scheme("yoshida5"), "yoshida5", "did you mean"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0, until=1), "the step size must be nonzero", "1/10"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h="1/10"), "give either `until` or `steps`", "steps = 1000"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h="1/10", until=-1), "the signs differ", "negative values for both"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h="a", until=1), "`a`", "write an exact number"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, digits="quad"), "digits = quad", "decimal digits"),
        (lambda: integrate(Problem("kepler"), "stormer-verlet", h=0.1, until=1, digits=400), "400 digits need MPFR", "make wheel MPFR=1"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, estimator="trilinear"), "no estimator `trilinear`", "bilinear"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, estimator="bilinear", order=8, max_order=9), "max_order", "order"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, estimator="bilinear", order=0), "order = 0 is too small", "give 1 or more"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, order=8), "order=8 is an option of an estimator", "bilinear"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, every=-1), "every = -1 is too small", "give 1 or more"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, direction="up"), "direction='up' requires a section", 'section="x"'),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, section="x", direction="to"), 'direction = "to" is not known', '"both"'),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, section="x", every=2), "every is given beside a section", "remove one"),
        (
            lambda: integrate("henon-heiles", "chin-4a", h=0.1, until=1, section="x", gradient_kicks="displaced"),
            "displaced forces belong to whole steps",
            "remove the section",
        ),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, until=1, section="t"), "t is no coordinate here", "every"),
        (lambda: integrate(Problem("kepler"), "yoshida4", h=0.1, steps=10**20), "steps = 100000000000000000000 is too large", "or less"),
        (lambda: Monitor(Problem("kepler"), "yoshida4", h=0.1).step(-1), "steps = -1 is too small", "give 0 or more"),
        (
            lambda: integrate(Problem("x^4", q={"x": 1}, p=[0], kinetic="p^4", momenta=["p"]), "blanes-moan-srkn11b", h=0.1, until=1),
            "quadratic",
            "for every T(p)",
        ),
        (lambda: integrate(Problem(kepler_force, q=[1.0, 0], p=[0, 1]), "yoshida4", h=0.1, until=1, digits=50), "double precision", "formula"),
        (lambda: integrate(Problem(kepler_force, q=[1.0, 0], p=[0, 1]), "chin-4a", h=0.1, until=1), "gradient kicks", "formula"),
        (lambda: Problem(kepler_force, q=[1.0, 0], p=[0]), "2 coordinates and 1 momenta", "one for each coordinate"),
        (lambda: Problem("x^2 + y^2", q={"x": 1, "y": 0}, p={"px": 0}), "p has no 'py'", 'p={"px": …, "py": …}'),
        (lambda: Problem("x^2 + y^2", q={"x": 1, "y": 0}, v={"x": 0, "z": 0}), "v has 'z', which is none of its names", 'v={"x": …, "y": …}'),
        (lambda: Problem("x^2 + y^2", q={"x": 1, "y": 0}, p={"vy": 2, "vx": 0}), "p has 'vy', which is none of its names", 'p={"px": …, "py": …}'),
        (lambda: Problem("x^2 + y^2", q={"x": 1, "y": 0}, p=[0, 1], masess=[1, 2]), "Problem has no argument 'masess'", "did you mean 'masses'?"),
        (lambda: Problem("kepler", q={"x": 1, "y": 0, "z": 0}), "q has 'z'", 'q={"x": …, "y": …}'),
        (lambda: Problem(pair="d^2", dimensions=1, bodies={"m": [1, 1]}, q={"a": 0, "b": 1}, v=[0, 0]), "no names of coordinates", "lists"),
    ],
)
def test_wrong_input_has_a_sentence_and_a_hint(call, message, hint):
    with pytest.raises(InputError) as error:
        call()
    assert message in str(error.value), error.value
    assert hint in str(error.value), error.value
    assert isinstance(error.value, ValueError)


def test_names_are_taken_in_any_order():
    for system in ("kepler", "-1/sqrt(x^2 + y^2)"):
        for q in ({"x": 1, "y": 2}, {"y": 2, "x": 1}):
            # the order of q is that of the coordinates of a formula
            names = [*q] if "/" in system else ["x", "y"]
            for halves in ({"p": {"py": 4, "px": 3}}, {"p": {"y": 4, "x": 3}}, {"v": {"y": 4, "x": 3}}, {"v": {"vx": 3, "vy": 4}}):
                problem = Problem(system, q=q, **halves)
                assert problem.coordinates == names
                found = {name: (x, p) for name, x, p in zip(names, *problem.initial)}
                assert found == {"x": (1, 3), "y": (2, 4)}, halves
    own = Problem("-1/sqrt(x^2 + y^2)", q={"x": 1, "y": 2}, p={"w": 4, "u": 3}, momenta=["u", "w"])
    assert (own.momenta, [*own.initial[1]]) == (["u", "w"], [3, 4])
    assert [*own.replaced(q={"y": 5, "x": 6}).initial[0]] == [6, 5]


def test_a_fault_has_its_place():
    with pytest.raises(InputError) as error:
        Scheme('name = "mine"\norder = 4\nkinetic = "any"\n[stages]\nkick = ["1/2", "1/2"]\ndrift = [1, 0]\n')
    (fault,) = error.value.faults
    assert (fault["path"], fault["line"], fault["column"]) == ("table", 2, 9) and "order 2 holds" in fault["message"]


def test_a_run_that_fails_says_where():
    with pytest.raises(RunError, match="n = ") as error:
        integrate(Problem("-x^4", q={"x": 1}, p=[1]), "stormer-verlet", h=0.1, steps=1000)
    assert "smaller step size" in error.value.hint
    with pytest.raises(RunError) as error:
        integrate(Problem("x^2/2", q={"x": 1}, p=[0]), "stormer-verlet", h=3, steps=1000)
    assert "beyond the stability limit 2 of stormer-verlet" in error.value.hint


@pytest.fixture
def interruptible():
    """Ctrl-C as in a terminal: a program in the background may begin with SIGINT ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("digits", ["double", 120])
def test_ctrl_c_ends_a_run_soon(digits, interruptible):
    # the run would take hours
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        integrate(Problem("kepler"), "yoshida4", h="1/1000", steps=10**9, every=10**9, digits=digits)


def test_other_threads_run_meanwhile():
    counted = []
    done = threading.Event()

    def count():
        while not done.is_set():
            counted.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    integrate(Problem("kepler"), "yoshida4", h="1/100", steps=100_000, every=100_000, digits=60)
    done.set()
    thread.join()
    # if the lock were held, the thread could count only before and after the run
    assert len(counted) > 20


def test_tables():
    pandas = pytest.importorskip("pandas")
    run = integrate(Problem("kepler"), "yoshida4", h="1/20", steps=10, estimator="bilinear", order=8)
    frame = run.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame.columns) == ["n", "t", "x", "y", "px", "py", "energy", "modified_energy", "modified_energy_error"]
    assert np.array_equal(frame["x"], run.q[:, 0])
    pytest.importorskip("xarray")
    assert run.to_xarray()["q"].sel(coordinate="y").values.tolist() == run.q[:, 1].tolist()


def test_planets_and_transformed_time():
    run = integrate(Problem("kepler", eccentricity="9/10", time={"transform": "logarithmic"}), "yoshida4", h="1/20", steps=100)
    assert run.q.shape[1] == 2 and np.all(np.diff(run.t) > 0) and np.ptp(np.diff(run.t)) > 0.05
    assert np.allclose(run.energy, -0.5, atol=1e-2)


def test_transformed_time_ends_at_a_physical_time():
    kepler = Problem("kepler", eccentricity="9/10", time={"transform": "logarithmic"})
    exact = integrate(Problem("kepler", eccentricity="9/10"), "sofroniou-spaletta10-35", h="1/1000", until=20, every=20_000).q[-1]
    for first, estimator in [(None, None), ("kick", None), ("drift", "bilinear"), ("drift", "central")]:
        run = integrate(kepler, "sofroniou-spaletta6-13", h="1/20", until=20, first=first, estimator=estimator)
        assert abs(run.t[-1] - 20) < 1e-14 and np.all(np.diff(run.t) > 0) and abs(run.n[-1] - 400) < 40
        # of order 6 with a twentieth of the eccentric anomaly
        assert np.allclose(run.q[-1], exact, atol=1e-7), (first, estimator)
    assert integrate(kepler, "yoshida4", h="-1/20", until=-5).t[-1] + 5 == pytest.approx(0, abs=1e-14)
    # a step of s may be longer than the time
    assert abs(integrate(kepler, "yoshida4", h=2, until="1/10").t[-1] - 0.1) < 1e-15
    with pytest.raises(InputError, match="the signs differ"):
        integrate(kepler, "yoshida4", h="1/20", until=-5)
    # the study and the advice are for the same time
    curve = shadowstep.work_precision(kepler, 20, ["sofroniou-spaletta6-13"], steps=[400, 800])[0]
    assert curve.runs[0].position_error < 1e-7
    advice = shadowstep.advise(kepler, 20, 1e-6, schemes=["sofroniou-spaletta6-13"])
    found = integrate(kepler, "sofroniou-spaletta6-13", h=advice.choices[0].h, until=20).q[-1]
    assert abs(np.linalg.norm(found - exact) / advice.verified - 1) < 0.1


def test_steps_begin_with_the_map_that_is_asked_for_and_gradient_kicks_may_be_displaced():
    pendulum = Problem("pendulum")
    runs = [integrate(pendulum, "stormer-verlet", h="1/10", until=10, first=first).q[-1, 0] for first in (None, "kick", "drift")]
    assert runs[0] == runs[1] != runs[2]
    exact, displaced = (integrate(pendulum, "chin-4a", h="1/10", until=10, gradient_kicks=kicks).q[-1, 0] for kicks in ("exact", "displaced"))
    assert 0 < abs(exact - displaced) < 1e-4
    with pytest.raises(InputError, match="gradient_kicks"):
        integrate(pendulum, "yoshida4", h="1/10", until=10, gradient_kicks="displaced")
    with pytest.raises(InputError, match="first = \"sideways\""):
        integrate(pendulum, "yoshida4", h="1/10", until=10, first="sideways")


def test_planets_have_their_interactions():
    planets = Problem("outer-solar-system", parts="wisdom-holman")
    run = integrate(planets, "stormer-verlet", h=200, steps=300)
    assert 1e-3 < run.planets["epsilon"] < 1e-2 and run.planets["of"] == "saturn"
    assert run.planets["closest"]["bodies"] == ["jupiter", "saturn"]
    monitor = Monitor(planets, "stormer-verlet", h=200, every=10)
    monitor.step(300)
    report = monitor.report()
    assert report.planets == run.planets
    assert f"planets: interactions at most {run.planets['epsilon']:.1e}"[:-3] in str(report)
    assert integrate(Problem("kepler"), "stormer-verlet", h=0.1, steps=1).planets is None
    with pytest.warns(UserWarning, match="jupiter has 1.5 steps of 1 kick in a revolution"):
        integrate(planets, "stormer-verlet", h=2900, steps=3)


def test_a_monitor_names_light_bodies_that_the_steps_do_not_resolve():
    """A comet that passes Jupiter at 0.02 Hill radii: it has no part in the energy, whose error is bounded."""
    units = {"length": "AU", "time": "year", "mass": "solar"}
    bodies = [
        {"name": "sun", "mass": 1},
        {"name": "jupiter", "mass": "1/1047.35", "q": [5.2, 0], "v": [0, 2.756674112]},
        {"name": "comet", "mass": 0, "q": [3.4, -1], "v": [1.88, 3.25]},
    ]
    monitor = Monitor(Problem(body=bodies, units=units, parts="wisdom-holman"), "saba4", "1/20", every=1)
    monitor.step(20)
    assert monitor.report().light[0]["resolved"]
    monitor.step(80)
    report = monitor.report()
    assert (report.verdict, report.is_bounded) == ("light-bodies", False)
    assert report.light[0]["bodies"] == ["jupiter", "comet"] and not report.light[0]["resolved"]
    assert "comet near jupiter at n = 31" in report.reason and "comet not resolved" in str(report)


def test_monitor_of_a_loop():
    monitor = shadowstep.Monitor(Problem("kepler"), "stormer-verlet", h="1/20", every=50)
    farthest = 0.0
    for _ in range(200):
        monitor.step(50)
        q, _ = monitor.state
        farthest = max(farthest, float(np.hypot(*q)))
    report = monitor.report()
    assert monitor.n == 10_000 and abs(farthest - 1.6) < 0.1
    assert report.verdict == "bounded" and report.is_bounded and str(report).startswith("bounded: the energy error is ")
    assert abs(monitor.newest.modified_energy + 0.5) < 1e-2


def test_hamiltonians_that_depend_on_time():
    # x'' = -x + sin 2t
    forced = Problem("x^2/2 - x*sin(2*t)", coordinates=["x"], q=[1], p=[0])
    run = integrate(forced, "blanes-moan-srkn11b", h="1/20", until=10)
    exact = np.cos(run.t) + 2 / 3 * np.sin(run.t) - np.sin(2 * run.t) / 3
    assert run.q.shape == (201, 2) and np.allclose(run.q[:, 0], exact, atol=1e-13)
    assert np.allclose(run.q[:, 1], run.t, atol=1e-13) and np.ptp(run.energy) < 1e-12 and np.ptp(run.p[:, 1]) > 0.1
    # t and pt may be given, as states have them
    assert np.array_equal(integrate(forced.replaced(q=[1, 0], p=[0, 0]), "blanes-moan-srkn11b", h="1/20", until=10).q, run.q)
    with pytest.raises(InputError, match="t must be 0 at the start"):
        Problem("x^2/2 - x*sin(2*t)", coordinates=["x"], q=[1, 1], p=[0, 0])
    flow = shadowstep.Flow(forced, "yoshida4", "1/20", 1, every=20)
    q, p = flow.states([1, 0], [0, 0])
    by_q, by_p, _ = flow.pull_back([1, 0], [0, 0], (), [[0, 0], [1, 0]], [[0, 0], [0, 0]])
    # of a linear oscillator, by its initial position and momentum
    assert q.shape == (2, 2) and np.allclose([by_q[0], by_p[0]], [np.cos(1), np.sin(1)], atol=1e-5)


def test_hamiltonians_that_are_not_separable():
    problem = Problem(hamiltonian="(x^2 + 1)*(px^2 + 1)/2", coupling=20, q={"x": -3}, p=[0])
    run = integrate(problem, "blanes-moan-s6", h="1/400", until=10, every=400)
    # DOP853 of SciPy to 1e-13
    assert run.coordinates == ["x", "x_2"] and np.allclose(run.q[-1], -2.40223831, atol=1e-8) and np.allclose(run.p[-1], 0.69060951, atol=1e-8)
    assert np.array_equal(integrate(problem.replaced(q=run.q[0]), "blanes-moan-s6", h="1/400", until=10, every=400).q, run.q)
    # beside other ways `coupling` is a parameter
    assert Problem("coupling*x^2", q={"x": 1}, p=[0], coupling=3).energy == 3


def test_magnetic_fields_and_ends():
    charge = Problem("0", coordinates=["x", "y"], vector_potential=["-b*y/2", "b*x/2"], parameters={"b": "3/2"}, q=[0, 0], v=[1, 0])
    run = integrate(charge, "stormer-verlet", h="1/2", until=10, end="y < -1")
    angle = 1.5 * run.t
    assert np.allclose(run.q, np.transpose([np.sin(angle), np.cos(angle) - 1]) / 1.5, atol=1e-14)
    assert run.q[-1, 1] < -1 <= run.q[:-1, 1].min() and run.t[-1] == 1.5
    with pytest.raises(InputError, match="end:1:1: unknown name `z`"):
        integrate(charge, "stormer-verlet", h="1/2", until=10, end="y < z")


# with a processor, in transformed time, in decimal digits, of planets whose steps have other coordinates
@pytest.mark.parametrize(
    ("problem", "scheme", "h", "until", "section", "digits"),
    [
        (Problem("henon-heiles"), "blanes-moan-srkn11b", "1/10", 300, "x", "double"),
        (Problem("henon-heiles"), "bcm6-13", "1/10", 100, "y", "compensated"),
        (Problem("kepler"), "yoshida4", "1/40", 20, "px", 40),
        (Problem("kepler", time={"transform": "logarithmic"}), "yoshida4", "1/40", 20, "y", "double"),
        (Problem("outer-solar-system", parts="wisdom-holman"), "saba4", 100, 40000, "y_jupiter", "double"),
    ],
)
def test_crossings_have_the_bits_of_a_scene(problem, scheme, h, until, section, digits, tmp_path):
    cut = integrate(problem, scheme, h=h, until=until, section=section, direction="both", digits=digits)
    run = {"scheme": scheme, "step": h, "until": until, "digits": digits}
    output = {"trajectory": {"section": section, "direction": "both"}, "file": "cut.csv"}
    text = document({**problem.sections, "run": run, "output": output})
    (tmp_path / "scene.toml").write_text(text)
    shadowstep.run(tmp_path / "scene.toml", progress=False)
    scene = shadowstep.open(tmp_path / "cut.csv")
    assert len(cut) == len(scene) > 3
    for name in ("n", "t", "q", "p"):
        assert np.array_equal(getattr(cut, name), getattr(scene, name)), name


def test_crossings_are_those_of_another_program():
    scipy = pytest.importorskip("scipy.integrate")
    galaxy = Problem("henon-heiles")
    cut = integrate(galaxy, "blanes-moan-srkn11b", h="1/100", until=200, section="x")

    def crossing(_, state):
        return state[0]

    crossing.direction = 1
    found = scipy.solve_ivp(
        lambda _, s: [s[2], s[3], -s[0] - 2 * s[0] * s[1], -s[1] - s[0] ** 2 + s[1] ** 2],
        (0, 200), np.concatenate(galaxy.initial), events=crossing, method="DOP853", rtol=1e-12, atol=1e-13,
    )  # fmt: skip
    times = found.t_events[0][1:]  # without the start, where x = 0
    # scipy's errors, of which 200 units of time make some 1e-11
    assert np.allclose(times, cut.t, rtol=0, atol=1e-9)


def test_values_are_those_of_a_scene_at_states_and_crossings(tmp_path):
    problem = Problem("kepler", eccentricity="3/5")
    formulas = {"L": "x*py - y*px", "H": "E + 0*t", "nothing": "log(x - 9)"}
    scene = f'problem = {{ name = "kepler", parameters.eccentricity = "3/5" }}\nrun = {{ scheme = "yoshida4", step = "1/20", steps = 40, digits = DIGITS }}\noutput = {{ file = "a.csv", trajectory = true, values = {{ L = "{formulas["L"]}", H = "E" }} }}'
    for digits in ("double", 30):
        path = tmp_path / f"{digits}.toml"
        path.write_text(scene.replace("DIGITS", f'"{digits}"' if digits == "double" else str(digits)).replace("a.csv", f"{digits}.csv"))
        shadowstep.run(path)
        of_scene = shadowstep.open(tmp_path / f"{digits}.csv")
        found = integrate(problem, "yoshida4", h="1/20", steps=40, digits=digits, values=formulas)
        for name in ("L", "H"):
            assert np.array_equal(found.values[name], of_scene.values[name])
        assert np.array_equal(found.values["H"], found.energy) and set(map(str, found.values["nothing"])) == {"nan"}
    crossed = integrate(problem, "yoshida4", h="1/20", until=20, section="y", values={"x2": "x^2"})
    assert len(crossed) and np.array_equal(crossed.values["x2"], crossed.q[:, 0] ** 2)
    assert list(crossed.to_dataframe()["x2"]) == list(crossed.values["x2"])
    bodies = {"m": [1, 2]}
    pair = Problem(pair="-m_i*m_j/sqrt(r2)", dimensions=2, bodies=bodies, masses="m", q=[0, 0, 3, 1], p=[0, 0, 1, 1])
    momentum = integrate(pair, "yoshida4", h="1/100", steps=10, values={"L": "angular_momentum"}).values["L"]
    assert np.all(np.abs(momentum - 2) < 1e-14)  # 3·1 − 1·1, which steps conserve but for round-off


def test_wrong_values_are_refused_with_their_names():
    for values, message in (
        ({"energy": "x"}, "there is another column `energy`"),
        ({"x": "px"}, "there is another column `x`"),
        ({"r": "x + z"}, "r:1:5: unknown name `z`"),
        ({"r": 3}, "not a name with a formula"),
        (["x"], "values must be a mapping"),
    ):
        with pytest.raises(InputError, match=message):
            integrate(Problem("kepler"), "yoshida4", h="1/20", steps=2, values=values)


def test_a_section_that_is_never_crossed_has_no_states():
    for digits in ("double", 40):
        with pytest.warns(UserWarning, match="does not cross section='x - 100', direction='up'"):
            nothing = integrate("henon-heiles", "yoshida4", h="1/10", until=10, section="x - 100", digits=digits)
        assert repr(nothing) == "Trajectory(0 states of 2 coordinates)" and nothing.q.shape == (0, 2)


def test_notes_of_the_problem_are_warnings():
    pair = Problem(pair="4*(r2^-6 - r2^-3)", dimensions=1, bodies=2, cutoff=2.5, q=[0, 1.5], p=[0, 0])
    with pytest.warns(UserWarning, match="jumps at the cutoff"):
        run = integrate(pair, "stormer-verlet", h=0.01, steps=2)
    assert any("jumps at the cutoff" in note for note in run.notes)
