"""Fifty close encounters of two planets beside IAS15, MERCURIUS, TRACE and WHFast of REBOUND 5.2.2.

    build/venv/bin/python encounters.py ../../target/release/shadowstep

Two planets of 1e-5 to 1e-3 of the star's mass with e up to 0.2 come closer than one mutual Hill radius within 10 years. After 10 years: the change of the energy, the distance from
the positions by IAS15 (in AU, all bodies), and the CPU time of a run; of ours without that of a run of one step, which reads the scene. Median, nine tenths, largest.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import rebound

G = 39.47841760435743
OURS = [("stormer-verlet", 80, 4, 3), ("stormer-verlet", 160, 4, 3), ("stormer-verlet", 160, 4, 5), ("mclachlan-aba84", 80, 32, 3)]


def simulation(bodies, integrator="ias15", dt=None):
    found = rebound.Simulation()
    found.G = G
    for m, x, y, z, vx, vy, vz in bodies:
        found.add(m=m, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    found.integrator = integrator
    if dt:
        found.dt = dt
    return found


def encounters(count=50):
    """Initial states with the Hill radius: those whose planets meet, by IAS15."""
    random = np.random.default_rng(35)
    found = []
    while len(found) < count:
        masses, a = 10 ** random.uniform(-5, -3, 2), (1, random.uniform(1.0, 1.3))
        start = rebound.Simulation()
        start.G = G
        start.add(m=1)
        for mass, axis in zip(masses, a):
            angles = dict(zip(("Omega", "omega", "M"), random.uniform(0, 2 * np.pi, 3)))
            start.add(m=mass, a=axis, e=random.uniform(0, 0.2), inc=random.uniform(0, 0.01), **angles)
        start.move_to_com()
        bodies = [(p.m, *p.xyz, *p.vxyz) for p in start.particles]
        hill = (masses.sum() / 3) ** (1 / 3) * (1 + a[1]) / 2
        least, when = np.inf, 0
        for t in np.arange(0, 10, 0.002):
            start.integrate(t, exact_finish_time=0)
            distance = np.linalg.norm(np.subtract(start.particles[1].xyz, start.particles[2].xyz)) / hill
            if distance < least:
                least, when = distance, start.t
        if least < 1 and 0.5 < when < 9.5 and max(np.linalg.norm(p.xyz) for p in start.particles) < 20:
            found.append((bodies, float(hill), float(least)))
    return found


def theirs(bodies, integrator, dt):
    run = simulation(bodies, integrator, dt)
    before, begin = run.energy(), time.process_time()
    run.integrate(10, exact_finish_time=1)
    return abs(run.energy() / before - 1), np.array([p.xyz for p in run.particles]), time.process_time() - begin


def ours(program, bodies, hill, scheme, per_year, substeps, radii):
    def run(steps):
        text = f'[problem]\nparameters = {{ g = "{G!r}" }}\nparts = "wisdom-holman-heliocentric"\nencounters = {{ within = "{radii * hill!r}", substeps = {substeps} }}\n'
        for body in bodies:
            text += f"[[body]]\nmass = {body[0]!r}\nq = {list(body[1:4])!r}\nv = {list(body[4:])!r}\n"
        text += f'[run]\nscheme = "{scheme}"\nstep = "1/{per_year}"\nsteps = {steps}\ndigits = "double"\n[output]\nenergy = {{ every = {steps} }}\ntrajectory = {{ every = {steps} }}\n'
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "scene.toml"
            scene.write_text(text)
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            out = subprocess.run([program, "run", "--no-summary", scene], check=True, capture_output=True, text=True).stdout
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        rows = [[float(cell) for cell in row.split(",")] for row in out.splitlines() if row[0].isdigit()]
        return abs(rows[-1][2] / rows[0][2] - 1), np.array(rows[-1][3:12]).reshape(3, 3), seconds

    energy, positions, seconds = run(10 * per_year)
    return energy, positions, seconds - run(1)[2]


def line(name, runs, references):
    energies = np.sort([energy for energy, _, _ in runs])
    errors = np.sort([np.linalg.norm(positions - reference) for (_, positions, _), reference in zip(runs, references)])
    quantiles = lambda values: " | ".join(f"{values[place]:.1e}" for place in (len(values) // 2, len(values) * 9 // 10, -1))
    print(f"| {name} | {quantiles(energies)} | {quantiles(errors)} | {1000 * np.mean([seconds for _, _, seconds in runs]):.1f} |", flush=True)


def main(program):
    all_encounters = encounters()
    print(f"closest approaches: {', '.join(f'{least:.2g}' for _, _, least in sorted(all_encounters, key=lambda found: found[2])[:10])}, … Hill radii")
    references = [theirs(bodies, "ias15", None)[1] for bodies, _, _ in all_encounters]
    print("| | energy, median | nine tenths | largest | position, median | nine tenths | largest | ms |\n| --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, integrator, dt in [
        ("IAS15", "ias15", None),
        ("MERCURIUS, 1/40", "mercurius", 1 / 40),
        ("MERCURIUS, 1/160", "mercurius", 1 / 160),
        ("TRACE, 1/40", "trace", 1 / 40),
        ("TRACE, 1/160", "trace", 1 / 160),
        ("WHFast, 1/160", "whfast", 1 / 160),
    ]:
        line(name, [theirs(bodies, integrator, dt) for bodies, _, _ in all_encounters], references)
    for scheme, per_year, substeps, radii in OURS:
        runs = [ours(program, bodies, hill, scheme, per_year, substeps, radii) for bodies, hill, _ in all_encounters]
        line(f"`{scheme}`, 1/{per_year}, {substeps} substeps, {radii} Hill radii", runs, references)


if __name__ == "__main__":
    main(sys.argv[1])
