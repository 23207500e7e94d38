"""The Sun and the eight planets with relativity's potential: the shipped scene `relativity` beside REBOUND 5.2.2 with `gr_potential` of REBOUNDx 5.1.0.

    build/venv/bin/pip install setuptools wheel && build/venv/bin/pip install --no-build-isolation reboundx==5.1.0
    build/venv/bin/python relativity.py ../../target/release/shadowstep YEARS      # as 1000

Positions at the end, in parts of the distance from the Sun; how far Mercury's pericentre is turned by the potential in a century; CPU time of a step.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import rebound
import reboundx

AU, LIGHT = 149597870.7, 299792.458 * 86400
CENTRAL = 'central = "-3*(g*m0)^2*m/(c^2*r^2)"\n'


def cpu_time():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


class Run:
    """A run of the scene: states at multiples of a number of days and at its end, and the CPU time that it took."""

    def __init__(self, program, scheme, digits, days, until, every=None, relativity=True):
        text = subprocess.run([program, "scene", "relativity"], check=True, capture_output=True, text=True).stdout
        text = text[: text.index("[run]")] if relativity else text[: text.index("[run]")].replace(CENTRAL, "")
        steps, every = until // days, (every or until) // days
        text += f'[run]\nscheme = "{scheme}"\nstep = "{days}"\nsteps = {steps}\ndigits = {digits}\n'
        text += f"[output]\ntrajectory = {{ every = {every} }}\n"
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "scene.toml"
            scene.write_text(text)
            before = cpu_time()
            rows = subprocess.run([program, "run", scene], check=True, capture_output=True, text=True).stdout.splitlines()
            self.seconds = cpu_time() - before
        named = dict(line[2:].split(": ", 1) for line in rows if line.startswith("# "))
        values = lambda name: np.array([float(eval(number)) for number in eval(named[name])])
        self.masses, self.steps = values("masses")[::3], steps
        self.g = float(eval(eval(named["parameters"])["g"]))
        rows = [row.split(",") for row in rows if row[0].isdigit()]
        self.times = np.array([float(row[1]) for row in rows])
        states = [np.array([float(number) for number in row[2:]]).reshape(2, -1, 3) for row in rows]
        self.states = [(q, p / self.masses[:, None]) for q, p in states]


def distance(a, b):
    """The largest difference of positions from the Sun, in parts of the distance, and whose."""
    a, b = a[1:] - a[0], b[1:] - b[0]
    parts = np.linalg.norm(a - b, axis=1) / np.linalg.norm(b, axis=1)
    return parts[0], parts[1:].max()


def turn(run):
    """How far Mercury's longitude of the pericentre, Ω + ω, turns in a century, by least squares, in arcseconds."""
    angles = []
    for q, v in run.states:
        q, v = q[1] - q[0], v[1] - v[0]
        mu = run.g * (run.masses[0] + run.masses[1])
        e = (v @ v / mu - 1 / np.linalg.norm(q)) * q - (q @ v / mu) * v
        h = np.cross(q, v)
        node = np.array([-h[1], h[0], 0])
        angles.append(np.arctan2(h[0], -h[1]) + np.arctan2(np.cross(node, e) @ h / np.linalg.norm(h), node @ e))
    return np.polyfit(run.times / 36525, angles, 1)[0] * 180 / np.pi * 3600


def by_rebound(run, days, integrator):
    sim = rebound.Simulation()
    sim.G = run.g
    for mass, (x, y, z), (vx, vy, vz) in zip(run.masses, *run.states[0]):
        sim.add(m=mass, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    extras = reboundx.Extras(sim)
    force = extras.load_force("gr_potential")
    extras.add_force(force)
    force.params["c"] = LIGHT / AU
    sim.integrator, sim.dt = integrator, days
    if integrator == "whfast":
        sim.integrator.safe_mode = 0
    before = time.process_time()
    if integrator == "whfast":
        sim.steps(run.steps)
        sim.synchronize()
    else:
        sim.integrate(run.times[-1])
    return np.array([particle.xyz for particle in sim.particles]), time.process_time() - before


def main(program, years):
    until = round(float(years) * 365.25 / 8) * 8
    fine, halved = (Run(program, "aba1064", '"double-double"', days, until) for days in (1, 2))
    exact = fine.states[-1][0]
    print("aba1064, h = 2 and h = 1: Mercury %.1e, others %.1e" % distance(halved.states[-1][0], exact))
    print("IAS15 and h = 1: Mercury %.1e, others %.1e" % distance(by_rebound(fine, 1, "ias15")[0], exact))
    for days in (8, 4):
        leapfrog = '"double"\nfirst = "drift"'
        ours = Run(program, "stormer-verlet", leapfrog, days, until)
        theirs, seconds = by_rebound(ours, days, "whfast")
        ends = (*distance(ours.states[-1][0], exact), *distance(theirs, exact))
        print(f"h = {days}: ours Mercury %.1e, others %.1e; WHFast %.1e, %.1e" % ends)
        # without the time of the start
        own = ours.seconds - Run(program, "stormer-verlet", leapfrog, days, days).seconds
        print(f"  {own / ours.steps * 1e9:.0f} ns a step, WHFast {seconds / ours.steps * 1e9:.0f} ns")
    turns = [turn(Run(program, "aba1064", '"double-double"', 2, 36528, 10, relativity)) for relativity in (True, False)]
    print(f"Mercury's pericentre turns by {turns[0] - turns[1]:.3f} arcseconds more in a century; alone by 42.980")


main(*sys.argv[1:])
