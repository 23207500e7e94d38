"""MEGNO of two planets that seem regular, beside REBOUND's: hannorein/rebound, issue 701.

    build/venv/bin/python megno.py PROGRAM STEPS       # as ../../target/release/shadowstep 43900000; draws docs/pictures/megno.svg

REBOUND's WHFast and Shadowstep make the same steps, of a twentieth of the inner period. Of REBOUND's vectors MEGNO is computed twice: as REBOUND does, and from the
logarithms of their lengths every 100 steps.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import rebound

from picture import save

EARTH = 3.0034893488507934e-06
STAR, MASSES, AXES, ECCENTRICITIES = 0.12, [mass * EARTH / math.sin(133.0) for mass in (0.26, 1.07)], (0.029, 0.049), (0.61, 0.36)
SAMPLES, EVERY, POINTS = 20, 100, 800
PICTURE = Path(__file__).parents[2] / "docs" / "pictures" / "megno.svg"


def simulation():
    sim = rebound.Simulation()
    sim.integrator = "whfast"
    sim.add(m=STAR)
    for mass, a, e, turn in zip(MASSES, AXES, ECCENTRICITIES, (0, math.pi)):
        sim.add(m=mass, a=a, e=e, Omega=turn, pomega=turn)
    sim.dt = 0.05 * sim.particles[1].P
    sim.move_to_com()
    sim.init_megno(seed=0)
    return sim


def logarithm(sim):
    # REBOUND divides long vectors, and keeps the logarithm of what it divided by
    vectors = (sim.particles_var[k] for k in range(sim.N_var))
    return math.log(sum(x * x for v in vectors for x in (v.x, v.y, v.z, v.vx, v.vy, v.vz))) / 2 + sim.var_config[0]._lrescale


def of_lengths(sim, steps):
    """MEGNO and its mean from the lengths of REBOUND's vectors, each EVERY steps, with the number of steps."""
    first, grown, t, weighted, integral = logarithm(sim), 0.0, 0.0, 0.0, 0.0
    for n in range(1, steps // EVERY + 1):
        sim.steps(EVERY)
        before = 2 * weighted / t if t else 0.0
        now = logarithm(sim) - first
        weighted += (now - grown) * (sim.t + t) / 2
        integral += (before + 2 * weighted / sim.t) / 2 * (sim.t - t)
        grown, t = now, sim.t
        yield n * EVERY, 2 * weighted / t, integral / t


def of_rebound(steps):
    sim, points = simulation(), []
    for n, megno, mean in of_lengths(sim, steps):
        if n // EVERY % (steps // EVERY // POINTS) == 0:
            points.append((n, sim.megno(), mean))
        if n // EVERY % (steps // EVERY // SAMPLES) == 0:
            print(f"{n} steps: REBOUND's sum {sim.megno():.3f}, from its vectors Y = {megno:.3f}, mean {mean:.4f}", flush=True)
    return points


def draw(rebound_points, ours):
    matplotlib.rcParams |= {"svg.hashsalt": "shadowstep", "svg.fonttype": "none", "axes.unicode_minus": False, "font.family": "sans-serif", "font.size": 11}
    figure, axes = plt.subplots(figsize=(8, 4))
    n, total, mean = zip(*rebound_points)
    axes.plot(n, total, color="#D55E00", linewidth=1, label="REBOUND's sum")
    axes.plot(n, mean, color="#0072B2", linewidth=1.8, label="from the lengths of REBOUND's vectors")
    axes.plot(*zip(*ours), color="#000000", linewidth=1.8, linestyle="--", label="Shadowstep")
    axes.set(xlabel="steps", ylabel="mean MEGNO", ylim=(-10, 30))
    axes.grid(True, color="#DDDDDD", linewidth=0.6)
    axes.legend(loc="upper left", frameon=False)
    save(figure, PICTURE)


def series(program, folder, steps):
    """The mean of MEGNO by the rows of a run."""
    path = folder / "rows.toml"
    output = f'[output]\nfile = "rows.csv"\nsummary = false\nchaos = {{ every = {steps // POINTS} }}\n'
    path.write_text(scene(steps).partition("[output]")[0] + output)
    subprocess.run([program, "run", path], check=True, capture_output=True)
    with (folder / "rows.csv").open() as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(int(row["n"]), float(row["mean_megno"])) for row in rows if row["mean_megno"]]


def scene(steps):
    bodies = "".join(
        f'[[body]]\nname = "{name}"\nmass = {mass!r}\na = {a}\ne = {e}\nnode = {node}\n'
        for name, mass, a, e, node in zip("db", MASSES, AXES, ECCENTRICITIES, (0, 180))
    )
    return (
        f'[problem]\nparts = "wisdom-holman"\nparameters = {{ g = 1 }}\nbarycentric = true\nelements = "jacobi"\n[[body]]\nname = "star"\nmass = {STAR}\n{bodies}'
        f'[run]\nscheme = "stormer-verlet"\nfirst = "drift"\nstep = {simulation().dt!r}\nsteps = {steps}\ndigits = "double"\n[output]\nenergy = true\n'
    )


def main(program, steps):
    points = of_rebound(int(steps))
    with tempfile.TemporaryDirectory() as folder:
        draw(points, series(Path(program).resolve(), Path(folder), int(steps)))
        path = Path(folder) / "scene.toml"
        path.write_text(scene(steps))
        for vectors in ("1", "2"):
            found = subprocess.run([program, "chaos", path, "--one", "--json", "--vectors", vectors], check=True, capture_output=True, text=True)
            record = json.loads(found.stdout)
            print(f"Shadowstep, {vectors} vectors: Y = {record['megno']:.3f}, mean {record['mean_megno']:.4f}, {record['motion']}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
