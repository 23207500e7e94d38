"""Ensembles, drift, work-precision, advice, scenes, the command line, types."""

import pickle
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Problem, RunError


def test_an_ensemble_has_the_bits_of_its_trajectories():
    henon_heiles = Problem("henon-heiles")
    q = np.array([[0.0, y] for y in np.linspace(-0.3, 0.3, 21)])
    p = np.tile([0.3, 0.1], (21, 1))
    found = shadowstep.ensemble(henon_heiles, "yoshida4", "1/10", steps=200, q=q, p=p, every=50)
    assert found.q.shape == (21, 2) and found.modified_drift is None and np.all(found.not_finite == -1)
    for t in (0, 7, 20):
        alone = shadowstep.integrate(Problem("henon-heiles", q=q[t], p=p[t]), "yoshida4", "1/10", steps=200, every=50)
        assert np.array_equal(found.q[t], alone.q[-1]) and np.array_equal(found.p[t], alone.p[-1])
        # the same states, whose energies were computed in other orders
        assert found.energy_error[t] == pytest.approx(np.abs(alone.energy / alone.energy[0] - 1).max(), rel=1e-6)


def test_an_ensemble_over_a_parameter_of_a_formula():
    spring = Problem("k*x^2/2", q={"x": 1}, p=[0], k=1)
    k = np.array([0.5, 1.0, 2.0])
    found = shadowstep.ensemble(spring, "stormer-verlet", 0.125, steps=80, parameters={"k": k}, every=8, order=4)
    for t in range(3):
        alone = shadowstep.integrate(Problem("k*x^2/2", q={"x": 1}, p=[0], k=k[t]), "stormer-verlet", 0.125, steps=80)
        assert found.q[t, 0] == alone.q[-1, 0]
    # the modified energy of the oscillator is conserved; E_4 sees it up to its own error
    assert np.all(found.modified_drift < 1e-3)
    assert np.allclose(found.energy_start, k / 2) and np.all(np.abs(found.energy_end / found.energy_start - 1) <= found.energy_error)
    assert np.all(np.abs(found.modified_end - found.modified_start) <= found.modified_drift)


def test_wrong_shapes_of_an_ensemble_are_refused():
    kepler = Problem("kepler")
    with pytest.raises(ValueError, match=r"q must have the shape \(n, 2\), not \(5, 3\)"):
        shadowstep.ensemble(kepler, "yoshida4", 0.1, steps=1, q=np.zeros((5, 3)))
    with pytest.raises(ValueError, match=r"\[2, 3\]"):
        shadowstep.ensemble(kepler, "yoshida4", 0.1, steps=1, q=np.ones((2, 2)), parameters={"eccentricity": np.zeros(3)})
    with pytest.raises(ValueError, match="needs q, p or parameters"):
        shadowstep.ensemble(kepler, "yoshida4", 0.1, steps=1)
    with pytest.raises(ValueError, match="eccentricity of trajectory 1 is nan"):
        shadowstep.ensemble(kepler, "yoshida4", 0.1, steps=1, parameters={"eccentricity": np.array([0.1, np.nan])})


def test_drift_is_that_of_the_command_line():
    kepler = Problem("kepler")
    found = shadowstep.drift(kepler, "stormer-verlet", "1/20", 10, digits=40, order=8, control=True)
    words = "drift kepler --scheme stormer-verlet --step 1/20 --until 10 --digits 40 --order 8 --json --control"
    import json

    printed = json.loads(shadowstep.command(*words.split()))
    for seconds in (found, printed, found["control"], printed["control"]):
        seconds.pop("seconds")
    assert found == printed
    on_exact_flow = shadowstep.drift(kepler, "exact-flow", "1/20", 10, digits=40, order=8)
    assert on_exact_flow["drift"] == found["control"]["drift"]
    with pytest.raises(InputError, match='mpfr requires a number of digits, not digits = "double"'):
        shadowstep.drift(kepler, "stormer-verlet", "1/20", 10, mpfr=True)


def test_drift_ends_with_the_last_whole_step_before_a_physical_time():
    kepler = Problem("kepler", time={"transform": "logarithmic"})
    run = shadowstep.integrate(kepler, "yoshida4", "1/20", until=10)
    found = shadowstep.drift(kepler, "yoshida4", "1/20", 10, order=8)
    assert (found["steps"], float(found["end"])) == (run.n[-2], run.t[-2]) and run.n[-1] == 196
    with pytest.raises(InputError, match="a step of 2 is longer than the run until 1/10"):
        shadowstep.drift(kepler, "yoshida4", 2, "1/10")


def test_work_precision_measures_the_order():
    curves = shadowstep.work_precision(Problem("pendulum"), 20, ["stormer-verlet", "yoshida4", "blanes-moan-srkn11b"], steps=[100, 200])
    orders = [np.log2(curve.runs[0].position_error / curve.runs[1].position_error) for curve in curves]
    # errors of higher order are left at these steps
    assert np.allclose(orders, [2, 4, 6], atol=0.4), orders
    assert [curve.order for curve in curves] == [2, 4, 6]
    by_size = shadowstep.work_precision(Problem("pendulum"), 20, ["stormer-verlet"], h=["1/10", "1/5"])[0]
    assert [(run.steps, run.position_error) for run in by_size.runs] == [(run.steps, run.position_error) for run in curves[0].runs]


def test_steps_of_all_schemes_begin_with_a_map():
    pendulum, schemes = Problem("pendulum"), ["stormer-verlet"]
    curves = {first: shadowstep.work_precision(pendulum, 2, schemes, first=first, steps=[20])[0] for first in ["kick", "drift"]}
    precise = shadowstep.integrate(pendulum, "bce-rkn8-17", "1/80", until=2)
    for first, curve in curves.items():
        run = shadowstep.integrate(pendulum, "stormer-verlet", "1/10", until=2, first=first)
        assert np.isclose(curve.runs[0].position_error, abs(run.q[-1, 0] - precise.q[-1, 0]), rtol=1e-6)
    assert not np.isclose(*(curve.runs[0].position_error for curve in curves.values()), rtol=0.1)
    advice = shadowstep.advise(pendulum, 2, 1e-4, first="drift", seconds=2)
    assert advice.verified <= 1e-4 and all(choice.scheme != "blanes-moan-srkn11b" for choice in advice.choices)
    with pytest.raises(InputError, match="order 6 is claimed"):
        shadowstep.advise(pendulum, 2, 1e-4, first="drift", schemes=["blanes-moan-srkn11b"])
    with pytest.raises(InputError, match='first = "drifts" is not known'):
        shadowstep.advise(pendulum, 2, 1e-4, first="drifts")


def test_advice_beside_a_dominant_part_has_near_integrable_schemes():
    planets = Problem("outer-solar-system", parts="wisdom-holman")
    for schemes in [(), "near-integrable"]:
        advice = shadowstep.advise(planets, 8000, 1e-4, schemes=schemes, seconds=8)
        best = advice.choices[0]
        assert advice.verified <= 1e-4 and best.flows > 0, advice
        assert 0.1 < best.predicted / advice.verified < 100, advice
    with pytest.raises(InputError, match="near-integrably"):
        shadowstep.advise(planets, 8000, 1e-4, schemes="near-integrably")
    nothing = shadowstep.advise(Problem("henon-heiles"), 10**6, 1e-30, of="energy", seconds=0.001)
    assert not nothing.choices and nothing.untried + nothing.extrapolated


def test_advice_meets_its_tolerance():
    advice = shadowstep.advise(Problem("pendulum"), 40, 1e-7, seconds=4, schemes=["yoshida4", "blanes-moan-srkn11b"])
    assert advice.verified <= 1e-7
    best = advice.choices[0]
    run = shadowstep.integrate(Problem("pendulum"), best.scheme, best.h, until=40, every=10**9)
    precise = shadowstep.integrate(Problem("pendulum"), "bce-rkn8-17", "1/80", until=40, every=10**9)
    assert abs(run.q[-1, 0] - precise.q[-1, 0]) <= 1e-7
    with pytest.raises(InputError, match="must be positive"):
        shadowstep.advise(Problem("pendulum"), 40, 0.0)
    with pytest.raises(InputError, match='of = "momentum" is not known'):
        shadowstep.advise(Problem("pendulum"), 40, 1e-6, of="momentum")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: shadowstep.work_precision(Problem("pendulum"), 10, seconds=-1.0), "seconds = -1.0"),
        (lambda: shadowstep.work_precision(Problem("pendulum"), 10, steps=[0, 100]), "steps = 0 is too small"),
        (lambda: shadowstep.work_precision(Problem("pendulum"), 10, steps=[100], h=["1/10"]), "without steps"),
        (lambda: shadowstep.work_precision(Problem("pendulum"), 10, h=["3/7"]), "until 10 is not a multiple of the step 3/7"),
        (lambda: shadowstep.advise(Problem("pendulum"), 10, 1e-6, seconds=float("nan")), "seconds = nan"),
        (lambda: shadowstep.shadow_energy(np.zeros((20, 1)), np.zeros((20, 1)), Problem("pendulum"), h=0), "step size must be nonzero"),
        (lambda: shadowstep.shadow_energy(np.zeros((20, 3)), np.zeros((20, 3)), Problem("pendulum"), h=0.1), "3 coordinates, and the problem has 1"),
    ],
)
def test_impossible_numbers_are_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()


SCENE = """
problem.name = "kepler"
run = { scheme = "yoshida4", step = "1/20", steps = 100, digits = "double" }
output = { energy = { every = 10 }%s }
"""


def test_scenes(tmp_path):
    outcome = shadowstep.run(SCENE % "")
    assert list(outcome.columns) == ["n", "t", "energy"] and len(outcome.to_dataframe()) == 11
    path = tmp_path / "scene.toml"
    path.write_text(SCENE % ', file = "kepler.csv"')
    assert shadowstep.run(path).columns is None
    rows = [line for line in (tmp_path / "kepler.csv").read_text().splitlines() if not line.startswith("#")]
    assert rows == [line for line in outcome.text.splitlines() if not line.startswith("#")]
    with pytest.raises(InputError, match="scene.toml:2:16") as error:
        shadowstep.run('\nproblem.name = "keppler"\n')
    assert {"path": "scene.toml", "line": 2, "column": 16} in [{key: fault[key] for key in ("path", "line", "column")} for fault in error.value.faults]


def test_the_command_line(tmp_path):
    done = subprocess.run([sys.executable, "-m", "shadowstep", "schemes", "show", "yoshida4", "--json"], capture_output=True, text=True)
    assert done.returncode == 0 and '"name":"yoshida4"' in done.stdout.replace('": "', '":"')
    with pytest.raises(InputError, match="no problem"):
        shadowstep.command("drift", "keppler", "--scheme", "yoshida4", "--step", "0.1", "--until", "1")
    with pytest.raises(RunError, match="n = "):
        words = ["--potential", "-x^4", "--q", "x=1", "--p", "1", "--scheme", "yoshida4", "--step", "0.1", "--until", "9"]
        shadowstep.command("drift", *words)
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(SCENE.replace('"1/20"', '"h"') % "" + '\n[axes]\nh = ["1/20", "1/40"]\n[keep]\nvalues = ["energy_error"]\n')
    columns = shadowstep.sweep(sweep, tmp_path / "out")
    assert columns["energy_error"][0] > columns["energy_error"][1] > 0


def test_types():
    api = pytest.importorskip("mypy.api")
    package = Path(shadowstep.__file__).parent
    assert (package / "py.typed").exists()
    found, errors, status = api.run(["--ignore-missing-imports", "--python-version", "3.10", "--package", "shadowstep"])
    assert status == 0, found + errors


@pytest.mark.parametrize(("ending", "digits"), [("csv", '"double"'), ("csv", "30"), ("jsonl", '"double"'), ("jsonl", "30"), ("npy", '"double"')])
def test_files_of_runs_are_opened(tmp_path, ending, digits):
    scene = tmp_path / "kepler.toml"
    output = f'{{ file = "kepler.{ending}", trajectory = {{ every = 2 }}, energy = true, modified_energy = {{ order = 4, every = 5 }}, values = {{ r = "x^2 + y^2", every = 4 }} }}'
    scene.write_text(f'problem.name = "kepler"\nrun = {{ scheme = "yoshida4", step = "1/10", steps = 20, digits = {digits} }}\noutput = {output}')
    shadowstep.run(scene)
    read = shadowstep.open(tmp_path / f"kepler.{ending}")
    made = shadowstep.integrate("kepler", "yoshida4", "1/10", steps=20, digits=digits.strip('"') if "double" in digits else 30, estimator="bilinear", order=4)
    assert np.array_equal(read.q[::2], made.q[::2]) and np.array_equal(read.p[::2], made.p[::2]) and np.array_equal(read.t, made.t)
    assert np.array_equal(read.energy, made.energy) and np.array_equal(read.n, made.n)
    assert np.array_equal(read.modified_energy[::5], made.modified_energy[::5]) and read.order[5] == 4
    assert np.isnan(read.q[1].astype(float)).all() and np.isnan(float(read.modified_energy[1]))
    assert (read.coordinates, read.momenta, read.force_evaluations) == (["x", "y"], ["px", "py"], None)
    assert read.metadata["scheme"] == "yoshida4" and read.metadata["values"] == {"r": "x^2 + y^2"}
    r = read.values["r"].astype(float)
    assert np.allclose(r[::4], (made.q[::4].astype(float) ** 2).sum(axis=1), rtol=1e-15) and np.isnan(r[1])
    assert list(read.to_dataframe().columns)[-1] == "r" and "r" in read.to_xarray()
    file = tmp_path / f"kepler.{ending}"
    file.write_bytes(file.read_bytes()[:-6])
    with pytest.raises(shadowstep.InputError, match=f"kepler.{ending}"):
        shadowstep.open(file)


def test_a_file_of_something_else_is_refused(tmp_path):
    (tmp_path / "table.csv").write_text("a,b\n1,2\n")
    with pytest.raises(shadowstep.InputError, match="is no file of `shadowstep run`"):
        shadowstep.open(tmp_path / "table.csv")


def test_files_that_end_too_early_are_noticed(tmp_path):
    scene = """
    problem.name = "kepler"
    run = {{ scheme = "yoshida4", step = "1/10", steps = {steps}, digits = "double" }}
    output = {{ file = "kepler.csv", {columns}, summary = false }}
    """
    for columns in ("trajectory = true", "trajectory = { every = 7 }, energy = { every = 10 }", "trajectory.section = 'y'"):
        for steps in (66, 70, 71):
            (tmp_path / "kepler.toml").write_text(scene.format(steps=steps, columns=columns))
            (tmp_path / "kepler.csv").unlink(missing_ok=True)
            shadowstep.run(tmp_path / "kepler.toml", progress=False)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                shadowstep.open(tmp_path / "kepler.csv")
    (tmp_path / "kepler.toml").write_text(scene.format(steps=66, columns="trajectory = { every = 7 }, energy = { every = 10 }"))
    (tmp_path / "kepler.csv").unlink()
    shadowstep.run(tmp_path / "kepler.toml", progress=False)
    lines = (tmp_path / "kepler.csv").read_text().splitlines(keepends=True)
    (tmp_path / "kepler.csv").write_text("".join(lines[:-4]))
    with pytest.warns(UserWarning, match="kepler.csv ends at n = 49, and its run has 66 steps: copy the file again"):
        shadowstep.open(tmp_path / "kepler.csv")
    # one whose number of steps is not known before
    transformed = scene.replace("steps = {steps}", "until = 2") + "\n[time]\ntransform = 'logarithmic'\n"
    for columns in ("modified_energy = { order = 2 }", "trajectory = true"):
        (tmp_path / "kepler.toml").write_text(transformed.format(columns=columns))
        (tmp_path / "kepler.csv").unlink()
        shadowstep.run(tmp_path / "kepler.toml", progress=False)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            read = shadowstep.open(tmp_path / "kepler.csv")
        assert (read.t[-1] == 2) == (columns == "trajectory = true")
    lines = (tmp_path / "kepler.csv").read_text().splitlines(keepends=True)
    (tmp_path / "kepler.csv").write_text("".join(lines[:-1]))
    with pytest.warns(UserWarning, match="kepler.csv ends at t = 1.9[0-9]*, and its run at t = 2: copy the file again"):
        shadowstep.open(tmp_path / "kepler.csv")


def spring(q):
    return 0.5 * float(q @ q), q


def kepler(q):
    r = float(np.sqrt(q @ q))
    return -1 / r, q / r**3


@pytest.mark.parametrize("digits", ["double", "compensated"])
def test_work_precision_of_a_function_has_a_reference_in_double_precision(digits):
    """Its errors are those beside the exact flow, or they are not known."""
    problem = Problem(spring, q=[1.0], p=[0.0])
    for seconds in (0.05, 0.5):
        for steps in ([100, 200, 400, 6400], None):
            (curve,) = shadowstep.work_precision(problem, 10, ["blanes-moan-srkn11b"], steps=steps, seconds=seconds, digits=digits)
            for run in curve.runs:
                made = shadowstep.integrate(problem, "blanes-moan-srkn11b", f"10/{run.steps}", steps=run.steps, every=run.steps, digits=digits)
                true = abs(float(made.q[-1, 0]) - np.cos(10))
                if run.position_error is not None:
                    assert abs(run.position_error - true) < 0.25 * run.position_error, run
                elif run.position_error_below is not None:
                    assert true < 1.5 * run.position_error_below, run


def test_advice_for_a_function_meets_its_tolerance():
    shipped = Problem("kepler", eccentricity="3/5")
    problem = Problem(kepler, q=[0.4, 0.0], p=[0.0, 2.0])
    for tolerance in (1e-5, 1e-9):
        advice = shadowstep.advise(problem, 5, tolerance, schemes=["yoshida4", "blanes-moan-srkn11b"], seconds=2)
        best = advice.choices[0]
        end = shadowstep.integrate(problem, best.scheme, best.h, until=5, every=10**9).q[-1]
        precise = shadowstep.integrate(shipped, "sofroniou-spaletta10-35", "1/200", until=5, every=10**9, digits=30).q[-1].astype(float)
        assert np.linalg.norm(end - precise) <= 1.1 * advice.verified and advice.verified <= tolerance
    # less than double precision has is refused, in a sentence
    none = shadowstep.advise(problem, 5, 1e-20, schemes=["yoshida4"], seconds=0.2)
    assert not none.choices and none.reason.startswith("No ")
    with pytest.raises(InputError, match="folder: results for a function are not kept"):
        shadowstep.work_precision(problem, 1, ["yoshida4"], steps=[10], folder="kept")


def test_what_forces_raise_ends_a_study_at_once():
    """And not after the hour that the study may take."""
    calls = 0

    def failing(q):
        nonlocal calls
        calls += 1
        if calls == 500:
            raise ZeroDivisionError("call 500")
        return kepler(q)

    problem = Problem(failing, q=[0.4, 0.0], p=[0.0, 2.0])
    for study in (
        lambda: shadowstep.work_precision(problem, 100, ["yoshida4"], seconds=3600),
        lambda: shadowstep.advise(problem, 100, 1e-9, schemes=["yoshida4"], seconds=3600),
    ):
        calls = 0
        with pytest.raises(ZeroDivisionError, match="call 500"):
            study()


def test_records_with_many_columns(tmp_path):
    lines = [f"{2 + i / 500},0.05,{i / 100}" for i in range(600)]
    (tmp_path / "particles.csv").write_text("\n".join(["a,e,M", *lines]) + "\n")
    bodies = '[[body]]\nname = "sun"\nmass = 1\n[[body]]\nname = "jupiter"\nmass = 0.001\na = 5\n'
    run = '[run]\nscheme = "saba4"\nstep = "1/2"\nsteps = 4\ndigits = "double"\n'
    output = '[output]\nfile = "out.npy"\nplot = "out.svg"\ntrajectory = true\nenergy = true\nelements = true\n'
    (tmp_path / "scene.toml").write_text(f'[problem]\nparameters.g = 40\nparticles = "particles.csv"\n{bodies}{run}{output}')
    shadowstep.command("run", tmp_path / "scene.toml", "--no-summary")
    head = (tmp_path / "out.npy").read_bytes()
    assert int.from_bytes(head[8:12], "little") > 65_535
    # the head is longer than what NumPy reads without being told so
    rows = np.load(tmp_path / "out.npy", max_header_size=1 << 20)
    read = shadowstep.open(tmp_path / "out.npy")
    semimajor = [name for name in rows.dtype.names if name.startswith("a_")]
    assert len(rows) == 5 and len(semimajor) == 601
    first = np.array([rows[name][0] for name in semimajor[1:]])
    assert np.allclose(first, 2 + np.arange(600) / 500, rtol=1e-12)
    assert np.array_equal(read.q, rows["q"]) and np.array_equal(read.values[semimajor[7]], rows[semimajor[7]])


def test_the_files_of_a_scene_lie_in_its_folder(tmp_path):
    (tmp_path / "own").mkdir()
    scene = tmp_path / "own" / "scene.toml"
    text = SCENE % f', file = "{tmp_path}/rows.csv"'
    scene.write_text(text)
    with pytest.raises(InputError, match="is outside of the folder of this file"):
        shadowstep.run(scene)
    assert not (tmp_path / "rows.csv").exists()
    shadowstep.run(scene, allow_outside=True)
    rows = (tmp_path / "rows.csv").read_bytes()
    # a text is an argument
    (tmp_path / "rows.csv").unlink()
    shadowstep.run(text)
    assert (tmp_path / "rows.csv").read_bytes().splitlines()[-1] == rows.splitlines()[-1]
    sweep = tmp_path / "own" / "sweep.toml"
    (tmp_path / "one.toml").write_text(SCENE.replace('"1/20"', '"h"') % "")
    sweep.write_text('scene = "../one.toml"\n[axes]\nh = ["1/20", "1/40"]\n[keep]\nvalues = ["energy_error"]\n')
    with pytest.raises(InputError, match="is outside of the folder of this file"):
        shadowstep.sweep(sweep, tmp_path / "out")
    assert len(shadowstep.sweep(sweep, tmp_path / "out", allow_outside=True)["h"]) == 2


def test_the_files_of_arguments_can_be_anywhere(tmp_path, monkeypatch):
    (tmp_path / "particles.csv").write_text("a,e\n3,0.1\n")
    (tmp_path / "own").mkdir()
    monkeypatch.chdir(tmp_path / "own")
    star, planet = {"name": "star", "mass": 1}, {"name": "planet", "mass": "1/1000", "a": 1}
    given = shadowstep.Problem(body=[star, planet], particles=str(tmp_path / "particles.csv"), parameters={"g": 40})
    assert len(given.coordinates) == 9
    text = '[problem]\nparameters.g = 40\nparticles = "../particles.csv"\n[[body]]\nname = "star"\nmass = 1\n[[body]]\nname = "planet"\nmass = 0.001\na = 1\n'
    (tmp_path / "own" / "problem").write_text(text)
    with pytest.raises(InputError, match="is outside of the folder of this file"):
        shadowstep.Problem.from_scene("problem")
    allowed = shadowstep.Problem.from_scene("problem", allow_outside=True)
    assert pickle.loads(pickle.dumps(allowed)).coordinates == given.coordinates
