"""Particles of mass 0 in the field of the Sun and the giant planets by Wisdom–Holman maps, beside REBOUND's WHFast: CPU time a step and particle.

    cargo build --release -p shadowstep --example particles
    build/venv/bin/python particles.py ../../target/release/examples/particles 10000

REBOUND has `N_active` = 5 and `safe_mode` = 0. Both take turns; the ratio is that of the medians. The positions at the end are compared: the maps are the same.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import rebound

G, DAYS, ROUNDS = 2.95912208286e-4, 40, 9
# Hairer, Lubich & Wanner, Geometric Numerical Integration, table I.2.2
PLANETS = [
    (1.00000597682, 0, 0, 0, 0, 0, 0),
    (0.000954786104043, -3.5023653, -3.8169847, -1.5507963, 0.00565429, -0.00412490, -0.00190589),
    (0.000285583733151, 9.0755314, -3.0458353, -1.6483708, 0.00168318, 0.00483525, 0.00192462),
    (0.0000437273164546, 8.3101420, -16.2901086, -7.2521278, 0.00354178, 0.00137102, 0.00055029),
    (0.0000517759138449, 11.4707666, -25.7294829, -10.8169456, 0.00288930, 0.00114527, 0.00039677),
]


def bodies(particles):
    """The planets, and asteroids with semi-major axes of 2 to 3.6 AU, e up to 0.2 and i up to 0.2 rad."""
    sim = rebound.Simulation()
    sim.G = G
    sim.add(m=PLANETS[0][0])
    random = np.random.default_rng(10)
    for a, e, i, *angles in random.uniform([2, 0, 0, 0, 0, 0], [3.6, 0.2, 0.2, *[2 * np.pi] * 3], (particles, 6)):
        sim.add(m=0, a=a, e=e, inc=i, Omega=angles[0], omega=angles[1], M=angles[2], primary=sim.particles[0])
    return PLANETS + [(0.0, *p.xyz, *p.vxyz) for p in sim.particles[1:]]


def theirs(all_bodies, steps):
    sim = rebound.Simulation()
    sim.G = G
    for m, x, y, z, vx, vy, vz in all_bodies:
        sim.add(m=m, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    sim.N_active, sim.testparticle_type = len(PLANETS), 0
    sim.integrator = "whfast"
    sim.integrator.safe_mode, sim.dt = 0, DAYS
    begin = time.process_time()
    sim.steps(steps)
    taken = time.process_time() - begin
    sim.synchronize()
    return taken, np.array([p.xyz for p in sim.particles]).ravel()


def main(program, particles):
    particles = int(particles)
    steps = max(50, 20_000_000 // (particles + 5))
    all_bodies = bodies(particles)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bodies"
        file.write_text("\n".join(" ".join(map(repr, map(float, body))) for body in all_bodies))
        ours = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        seconds = {"ours": [], "REBOUND": []}
        for _ in range(ROUNDS):
            print(file, f"{G:.17g}", DAYS, steps, file=ours.stdin, flush=True)
            taken, *positions = map(float, ours.stdout.readline().split())
            seconds["ours"].append(taken)
            taken, expected = theirs(all_bodies, steps)
            seconds["REBOUND"].append(taken)
    median = {name: np.median(all_of) / steps / particles * 1e9 for name, all_of in seconds.items()}
    far = np.linalg.norm((np.array(positions) - expected).reshape(-1, 3), axis=1).max()
    for name, value in median.items():
        low, high = (np.quantile(seconds[name], part) / steps / particles * 1e9 for part in (0.25, 0.75))
        print(f"{name}: {value:.1f} ns a step and particle ({low:.1f} to {high:.1f})")
    print(f"ratio of medians {median['ours'] / median['REBOUND']:.2f}; positions after {steps} steps differ by at most {far:.1e} AU")


main(*sys.argv[1:])
