"""What a tangent vector costs in REBOUND's WHFast, beside `cargo bench -p shadowstep --bench tangent`: nanoseconds of CPU time a step.

    build/venv/bin/python tangent.py        # medians of 21 rounds in which both take turns

Planets of 10⁻⁵ of the star, of that bench: a step is a drift and a kick in Jacobi coordinates, as steps are not synchronised.
"""

import math
import time
from statistics import median

import rebound

ROUNDS, STEPS, H = 21, 20_000, 0.3


def simulation(planets, vectors):
    sim = rebound.Simulation()
    sim.add(m=1.0)
    for i in range(planets):
        r, angle = 1.6**i, 2.4 * i
        speed = 1.03 / math.sqrt(r)
        sim.add(m=1e-5, x=r * math.cos(angle), y=r * math.sin(angle), z=0.01 * r, vx=-speed * math.sin(angle), vy=speed * math.cos(angle))
    sim.integrator, sim.dt = "whfast", H
    sim.integrator.safe_mode = False
    for _ in range(vectors):
        variation = sim.add_variation()
        for k in range(planets + 1):
            variation.particles[k].x = math.sin(7 * k + 1)
            variation.particles[k].vy = math.sin(7 * k + 3)
    return sim


def main():
    print("| planets | plain | 1 vector | ratio |\n| --- | --- | --- | --- |")
    for planets in (2, 8):
        contestants, times = [simulation(planets, vectors) for vectors in (0, 1)], [[], []]
        for _ in range(ROUNDS):
            for sim, own in zip(contestants, times):
                start = time.thread_time_ns()
                sim.steps(STEPS)
                own.append((time.thread_time_ns() - start) / STEPS)
        ratio = median(b / a for a, b in zip(*times))
        print(f"| {planets} | {median(times[0]):.0f} | {median(times[1]):.0f} | {ratio:.2f} |")


if __name__ == "__main__":
    main()
