"""Secular frequencies of the Sun, Jupiter and Saturn by REBOUND's Wisdom–Holman maps, beside those of the example `secular-frequencies`.

    build/venv/bin/python secular.py DAYS YEARS      # as 400 10000000

The initial state, the means over a thousand years and the frequency analysis are those of `runtime/examples/secular-frequencies.rs`, which has the reference:
give its g_5 and g_6 in arcseconds a year as two more words for errors.
"""

import sys

import numpy as np
import rebound

MASSES = [1.00000597682, 0.000954786104043, 0.000285583733151]
POSITIONS = [[0, 0, 0], [-3.5023653, -3.8169847, -1.5507963], [9.0755314, -3.0458353, -1.6483708]]
VELOCITIES = [[0, 0, 0], [0.00565429, -0.00412490, -0.00190589], [0.00168318, 0.00483525, 0.00192462]]
G, YEAR = 2.95912208286e-4, 365.25
# corrector and kernel
MAPS = {"whfast": (0, "default"), "whfast-17": (17, "default"), "whckm": (17, "modifiedkick"), "whckl": (17, "lazy")}
# a mean over a thousand years is one of that number of states
STATES = 64


def simulation(days, corrector, kernel):
    sim = rebound.Simulation()
    sim.G = G
    for mass, (x, y, z), (vx, vy, vz) in zip(MASSES, POSITIONS, VELOCITIES):
        sim.add(m=mass, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    sim.integrator = "whfast"
    sim.integrator.corrector, sim.integrator.kernel = corrector, kernel
    sim.integrator.safe_mode, sim.dt = 0, days
    return sim


def eccentricities(sim):
    """e exp(iϖ) of the Kepler orbits in Jacobi coordinates."""
    particles = list(sim.particles)
    centre, moving, inner = np.zeros(3), np.zeros(3), MASSES[0]
    sun = particles[0]
    centre, moving = np.array(sun.xyz), np.array(sun.vxyz)
    for body, mass in zip(particles[1:], MASSES[1:]):
        q, v = np.array(body.xyz) - centre, np.array(body.vxyz) - moving
        mu = G * (inner + mass)
        e = (v @ v / mu - 1 / np.linalg.norm(q)) * q - (q @ v / mu) * v
        yield e[0] + 1j * e[1]
        centre, moving, inner = centre + mass / (inner + mass) * q, moving + mass / (inner + mass) * v, inner + mass


def frequency(samples, interval):
    """The ω of the largest term, by the square of Hann's window."""
    n = np.arange(len(samples))
    window = (1 - np.cos(2 * np.pi * (n + 0.5) / len(n))) ** 2 * samples
    padded = np.fft.fft(window, 4 * len(n))
    width = 2 * np.pi / len(n)
    low = np.fft.fftfreq(4 * len(n))[np.argmax(abs(padded))] * 2 * np.pi - width / 2
    high, golden = low + width, (5**0.5 - 1) / 2
    while high - low > 1e-9 * width:
        a, b = high - golden * (high - low), low + golden * (high - low)
        if abs(np.sum(window * np.exp(-1j * a * n))) > abs(np.sum(window * np.exp(-1j * b * n))):
            high = b
        else:
            low = a
    return (low + high) / 2 / interval


def main(days, years, *reference):
    days, years = float(days), float(years)
    steps = round(1000 * YEAR / days / STATES)
    for name, (corrector, kernel) in MAPS.items():
        sim, means = simulation(days, corrector, kernel), []
        for _ in range(int(years * YEAR / (days * steps * STATES))):
            total = np.zeros(2, dtype=complex)
            for _ in range(STATES):
                sim.steps(steps)
                sim.synchronize()
                total += np.array(list(eccentricities(sim)))
            means.append(total / STATES)
        found = [frequency(column, days * steps * STATES) for column in np.array(means).T]
        arcseconds = [np.degrees(omega) * 3600 * YEAR for omega in found]
        errors = [f"{value / float(exact) - 1:+.1e}" for value, exact in zip(arcseconds, reference)]
        print(f"| {name} | {' | '.join(errors) or ' | '.join(f'{value:.7f}' for value in arcseconds)} |", flush=True)


main(*sys.argv[1:])
