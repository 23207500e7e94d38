"""Every function that takes a scene, with the rows of cli/tests/crosses: each cell works, or is refused by one sentence. docs/what-works-with-what.md has the cells of the program."""

import subprocess
import sys
import warnings
from fractions import Fraction
from inspect import signature
from pathlib import Path
from random import Random

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Monitor, Problem, RunError, advise, chaos, derivatives, drift, gradient, integrate, lyapunov, megno, run, sweep, work_precision

FOLDER = Path(__file__).resolve().parents[2] / "cli/tests/crosses"


class Row:
    """Lines ``# key: value``, of which the first is a title, and a part of a scene."""

    def __init__(self, path):
        lines = path.read_text(encoding="utf-8").splitlines()
        self.name = path.stem
        self.keys = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
        self.text = "\n".join(line for line in lines if not line.startswith("#")) + "\n"

    def value(self, key):
        """A value of [run]."""
        return next(line for line in self.text.splitlines() if line.startswith(f"{key} = ")).split(" = ")[1].strip('"')

    def faulty(self):
        right, wrong = self.keys["wrong"].split(" => ")
        row = object.__new__(Row)
        row.name, row.keys, row.text = self.name, self.keys, self.text.replace(right, wrong, 1)
        return row


SYSTEMS = {row.name: row for row in map(Row, sorted((FOLDER / "systems").glob("*.toml")))}
RUNS = {row.name: row for row in map(Row, sorted((FOLDER / "runs").glob("*.toml")))}
STEPS = 8


def step(system, way):
    return way.value("step").replace("h", system.keys["step"])


def end(system, way):
    return f"{STEPS}*({step(system, way)})"


def scene(system, way):
    text = way.text.replace('"h"', f'"{system.keys["step"]}"').replace("-h", f"-{system.keys['step']}").replace("*h", f"*{system.keys['step']}")
    return system.text + (text.replace("trajectory = { every = 2 }\n", "") if is_ensemble(system) else text)


def is_ensemble(system):
    return "varied" not in system.keys


def problem(system, folder):
    path = folder / "scene.toml"
    path.write_text(system.text)
    return Problem.from_scene(path)


def scheme(way):
    name = way.value("scheme")
    return str(FOLDER / name) if name.endswith(".toml") else name


def first(way):
    return way.value("first") if "\nfirst = " in way.text else None


def digits(way):
    flags = way.keys["numbers"].split()
    return flags[1] if flags[0] == "--digits" else flags[0].removeprefix("--")


def estimator(way):
    """The flags of the command line as keywords."""
    words = way.keys["estimator"].split()
    flags = {"estimator": "central"} | {flag.removeprefix("--").replace("-", "_"): value for flag, value in zip(words[::2], words[1::2])}
    return {name: int(value) if value.isdigit() else value for name, value in flags.items()}


def finite(values):
    assert len(values) > 0 and np.all(np.isfinite(np.asarray(values, dtype=float))), values


def integrated(system, way, folder):
    numbers = {"digits": digits(way), "mpfr": "--mpfr" in way.keys["numbers"]}
    found = integrate(problem(system, folder), scheme(way), step(system, way), steps=STEPS, first=first(way), values={"H": "E"}, **numbers, **estimator(way))
    finite(found.modified_energy)
    assert np.array_equal(found.values["H"], found.energy)
    energy = found.energy.astype(float)
    assert np.all(np.abs(energy - energy[0]) < 0.1 * abs(energy[0]))


def drifted(system, way, folder):
    mpfr = "--mpfr" in way.keys["numbers"]
    found = drift(problem(system, folder), scheme(way), step(system, way), end(system, way), digits=digits(way), mpfr=mpfr, **estimator(way))
    finite([found["drift"]])


def followed(system, way, folder):
    mpfr = "--mpfr" in way.keys["numbers"]
    found = chaos(problem(system, folder), scheme(way), step(system, way), steps=STEPS, first=first(way), digits=digits(way), mpfr=mpfr)
    finite([found.at.lyapunov, found.at_half.lyapunov, found.at.sali])
    assert found.conclusion == "not decided: the run is too short"
    for function, value in ((lyapunov, found.at.lyapunov), (megno, found.at.mean_megno)):
        indicator = function(problem(system, folder), scheme(way), step(system, way), steps=STEPS, first=first(way), digits=digits(way), mpfr=mpfr)
        assert (indicator.value, indicator.uncertainty, indicator.verdict) == (value, np.inf, "undecided")


def differentiation(system, way, folder):
    posed = problem(system, folder)
    options = {"steps": STEPS, "first": first(way), "digits": digits(way), "mpfr": "--mpfr" in way.keys["numbers"], "every": STEPS}
    by = [posed.coordinates[0], posed.momenta[-1]]
    return (posed, scheme(way), step(system, way)), options, derivatives(posed, scheme(way), step(system, way), by=by, **options)


def differentiated(system, way, folder):
    run, options, found = differentiation(system, way, folder)
    finite(found.of_p[-1].ravel())
    vectors = np.eye(2 * run[0].dimension, dtype=int)[[0, -1]]
    tangent = integrate(*run, tangent=vectors, **options).tangent
    assert np.array_equal(tangent, np.moveaxis(np.concatenate([found.of_q, found.of_p], axis=1), 2, 1))


def differentiated_backwards(system, way, folder):
    run, options, found = differentiation(system, way, folder)

    def first_at_end(q, p):
        of_q = np.zeros_like(q)
        of_q[-1, 0] = 1.0
        return q[-1, 0], of_q, None

    by = gradient(first_at_end, *run, by=found.by, **options).by
    assert np.allclose([float(x) for x in by.values()], found.of_q[-1, 0].astype(float), rtol=1e-9, atol=1e-9)


def monitored(system, way, folder):
    monitor = Monitor(problem(system, folder), scheme(way), step(system, way), order=4, every=1, digits=digits(way))
    monitor.step(40)
    finite([monitor.energy, monitor.report().modified])
    assert monitor.report().steps == 40


def compared(system, way, folder):
    [curve] = work_precision(problem(system, folder), end(system, way), [scheme(way)], first=first(way), steps=[8, 32], digits=digits(way))
    coarse, fine = (measured.energy_error for measured in curve.runs)
    assert fine < max(coarse, 1e-13)


def advised(system, way, folder):
    advice = advise(problem(system, folder), end(system, way), 1e-2, schemes=[scheme(way)], first=first(way), digits=digits(way), seconds=1)
    assert advice.verified <= 1e-2


def ran(system, way, folder):
    table = FOLDER / "own-scheme.toml"
    (folder / table.name).write_text(table.read_text())
    path = folder / "scene.toml"
    path.write_text(scene(system, way))
    columns = run(path).columns
    finite(columns["modified_drift" if is_ensemble(system) else "t"])


def swept(system, way, folder):
    table = FOLDER / "own-scheme.toml"
    (folder / table.name).write_text(table.read_text())
    path = folder / "sweep.toml"
    axis = f'[axes]\nh = ["{system.keys["step"]}", "{Fraction(system.keys["step"]) / 2}"]\n[keep]\nvalues = ["energy_error"]\n'
    path.write_text(system.text + way.text + axis)
    found = sweep(path, folder / "out")
    finite(found["energy_error"])
    assert len(found["energy_error"]) == 2


FUNCTIONS = {"integrate": integrated, "drift": drifted, "chaos": followed, "derivatives": differentiated, "gradient": differentiated_backwards, "Monitor": monitored, "work_precision": compared, "advise": advised, "run": ran, "sweep": swept}

# Of [run] the first two of these read a scheme by its name or table only, and the last two no `mpfr`.
OF_PROBLEMS = ["drift", "Monitor", "chaos", "derivatives", "gradient", "integrate", "work_precision", "advise"]
LONG = "double-double", "digits", "mpfr", "many-digits"
REFUSED = {("ensemble", function) for function in [*OF_PROBLEMS, "sweep"]} | {(way, "Monitor") for way in LONG}
REFUSED |= {("many-digits", function) for function in ("work_precision", "advise")}
# particles do not act on bodies: the whole is not a Hamiltonian system
REFUSED |= {(system, "gradient") for system in SYSTEMS if "particles" in system}
# a formula has no slow forces
NESTED = "multiple-steps"
WITHOUT_MPFR = {"mpfr", "many-digits"}
NOT_TAKEN = {("displaced", function) for function in OF_PROBLEMS} | {("drift-first", function) for function in OF_PROBLEMS[:2]}
NOT_TAKEN |= {("mpfr", function) for function in ("work_precision", "advise")}


def has_mpfr():
    try:
        integrate(Problem("pendulum"), "stormer-verlet", "1/10", steps=1, digits=320)
    except InputError:
        return False
    return True


@pytest.mark.skipif(has_mpfr(), reason="this package has MPFR")
@pytest.mark.parametrize("more, digits", [("--digits 308", 308), ("--digits 20 --mpfr", 20)])
def test_the_command_line_without_mpfr_says_so(more, digits):
    words = "drift kepler --scheme stormer-verlet --step 1/20 --until 2 --order 8 --no-summary".split()
    done = subprocess.run([sys.executable, "-m", "shadowstep", *words, *more.split()], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith(f"error: {digits} digits need MPFR, which this program was built without")
    shadowstep.command(*words, "--digits", "307")  # as many as limbs have


CELLS = [(system, "double", function) for system in SYSTEMS for function in FUNCTIONS]
CELLS += [("formula", way, function) for way in RUNS for function in FUNCTIONS if (way, function) not in NOT_TAKEN]
CELLS += [(system, NESTED, function) for system in SYSTEMS if system.startswith("slow") for function in FUNCTIONS]


@pytest.mark.parametrize("system, way, function", CELLS)
@pytest.mark.filterwarnings("ignore")
def test_every_cell_works_or_says_why(system, way, function, tmp_path):
    refused = (system, function) in REFUSED or (way, function) in REFUSED or (way in WITHOUT_MPFR and not has_mpfr())
    refused |= way == NESTED and not system.startswith("slow")
    if not refused:
        FUNCTIONS[function](SYSTEMS[system], RUNS[way], tmp_path)
        return
    with pytest.raises(InputError) as refusal:
        FUNCTIONS[function](SYSTEMS[system], RUNS[way], tmp_path)
    assert str(refusal.value).strip()


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_every_fault_is_refused_with_its_place(system, function, tmp_path):
    with pytest.raises(InputError, match=r"\.toml:\d+:\d+: "), warnings.catch_warnings():
        FUNCTIONS[function](SYSTEMS[system].faulty(), RUNS["double"], tmp_path)


def spring(q):
    return float(q @ q) / 2, q.copy()


def centre(q):
    r = np.sqrt(q @ q + 0.01)
    return -1 / r, q / r**3


def waves(q):
    return float(np.cos(q).sum()), -np.sin(q)


def flat(q):
    return 0.0, np.zeros(len(q))


def singular(q):
    with np.errstate(all="ignore"):
        return float((1 / q).sum()), -1 / q**2


FORCES = [spring, centre, waves, flat, singular]
SOME = {
    "digits": ["double", "compensated", "double-double", 30],
    "first": ["kick", "drift"],
    "every": [1, 3],
    "section": ["q1", "p1 - q1"],
    "direction": ["both", "down"],
    "end": ["q1 > 1/2", "E > 100", "t > 1/3"],
    "estimator": ["bilinear", "central"],
    "order": [2, 4, 1],
    "max_order": [6, 40],
    "summary": [True],
    "windows": [16, 300],
    "gradient_kicks": ["exact", "displaced"],
    "mpfr": [True],
    "accuracy": ["1e-8"],
    "stop": ["early"],
    "rule": ["robust"],
}
OF_FORCES = ["stormer-verlet", "yoshida4", "ruth3", "blanes-moan-srkn6b", "escorihuela4-6", "abah864", "symplectic-euler", "chin-4a"]


def drawn_options(random, function):
    """Some of the options that a function has."""
    known = signature(function).parameters
    return {name: random.choice(values) for name, values in SOME.items() if name in known and random.random() < 0.07}


def done_with_forces(random, posed, scheme, h):
    """A function with random options, and what it gives."""
    of_steps = {"integrate": integrate, "chaos": chaos, "lyapunov": lyapunov, "megno": megno, "derivatives": derivatives, "Monitor": Monitor}
    name = random.choice([*of_steps, *["integrate", "Monitor", "drift"] * 3, "gradient", "work_precision", "advise"])
    steps = random.choice([1, 3, 20])
    if name == "gradient":
        return gradient(lambda q, p: (q[-1].sum(), None, None), posed, scheme, h, steps=steps, **drawn_options(random, gradient))
    if name == "drift":
        return drift(posed, scheme, h, f"{steps}*({h})", **{"digits": "double"} | drawn_options(random, drift))
    if name == "work_precision":
        return work_precision(posed, 1, [scheme], steps=[10, 20], seconds=0.1, **drawn_options(random, work_precision))
    if name == "advise":
        return advise(posed, 1, random.choice([1e-3, 1e-9]), schemes=[scheme], seconds=0.1, **drawn_options(random, advise))
    if name == "Monitor":
        monitor = Monitor(posed, scheme, h, **drawn_options(random, Monitor))
        monitor.step(steps)
        return monitor.report()
    return of_steps[name](posed, scheme, h, steps=steps, **drawn_options(random, of_steps[name]))


def ran_with_forces(seed):
    """Whether a random function of a random problem worked; otherwise it was refused."""
    random = Random(seed)
    count = random.choice([1, 2, 3])
    numbers = ["1/3", 0.5, 1, "sqrt(2)/3", -0.25]
    state = {name: [random.choice(numbers) for _ in range(count)] for name in ("q", "p")}
    masses = [random.choice([1, "1/2", 3]) for _ in range(count)] if random.random() < 0.3 else None
    posed = Problem(random.choice(FORCES), **state, masses=masses)
    try:
        done_with_forces(random, posed, random.choice(OF_FORCES), random.choice(["1/10", "1/50", "-1/20", "3"]))
    except (InputError, RunError) as refusal:
        assert str(refusal).strip()
        return False
    return True


@pytest.mark.parametrize("first", range(0, 200, 50))
@pytest.mark.filterwarnings("ignore")
def test_forces_of_the_caller_work_or_are_refused(first):
    ran = 0
    for seed in range(first, first + 50):
        print(f"seed {seed}")  # the last one is the culprit
        ran += ran_with_forces(seed)
    assert ran >= 15, ran
