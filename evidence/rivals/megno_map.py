"""The map of docs/sweeps/planet-between.toml beside REBOUND's: which orbits are regular, by MEGNO of the same steps.

    ../../target/release/shadowstep sweep ../../docs/sweeps/planet-between.toml --out map
    build/venv/bin/python megno_map.py map/results.csv build/megno-map.csv 2      # on two cores

Both make Wisdom–Holman steps in Jacobi coordinates. A run is regular for REBOUND if its mean MEGNO is within 0.5 of 2, and chaotic if it is 4 or more. Where one
program calls a run regular and the other chaotic, by the word or by the same limits, MEGNO is also computed from the logarithms of the lengths of REBOUND's
vectors, and over ten times as many steps.
REBOUND's values are saved in the second file, and are read from there if it exists.
"""

import csv
import math
import sys
import time
from collections import Counter
from multiprocessing import Pool
from pathlib import Path

import rebound
from megno import of_lengths

STEPS, DT = 100_000, math.pi / 10
LOOKED_AT = 12


def simulation(a, e, seed=0):
    sim = rebound.Simulation()
    sim.integrator = "whfast"
    sim.add(m=1)
    sim.add(m=1e-3, a=1, e=0.05)
    sim.add(m=1e-6, a=a, e=e, omega=math.pi / 2, M=math.radians(120))
    sim.add(m=3e-4, a=3, e=0.05, M=math.radians(200))
    sim.dt = DT
    sim.move_to_com()
    sim.init_megno(seed=seed)
    return sim


def of_rebound(place):
    """REBOUND's own mean MEGNO, and the CPU time of the steps."""
    sim = simulation(*place)
    before = time.process_time()
    sim.steps(STEPS)
    return sim.megno(), time.process_time() - before


def mean_of_lengths(place, steps, seed):
    """REBOUND's own mean MEGNO, and that of the lengths of its vectors."""
    sim = simulation(*place, seed)
    *_, (_, _, mean) = of_lengths(sim, steps)
    return sim.megno(), mean


def word(megno):
    if not math.isfinite(megno):
        return "not finite"
    return "regular" if abs(megno - 2) <= 0.5 else "chaotic" if megno >= 4 else "undecided"


def rows(path):
    with open(path) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def computed(places, path, processes):
    if not path.exists():
        with Pool(processes) as pool:
            found = pool.map(of_rebound, places, chunksize=20)
        path.write_text("megno,seconds\n" + "".join(f"{megno!r},{seconds!r}\n" for megno, seconds in found))
    return [(float(row["megno"]), float(row["seconds"])) for row in rows(path)]


def table(pairs):
    words = sorted({word for pair in pairs for word in pair})
    count = Counter(pairs)
    print("| ours / REBOUND | " + " | ".join(words) + " |\n|" + " --- |" * (len(words) + 1))
    for own in words:
        print(f"| {own} | " + " | ".join(str(count[own, other]) for other in words) + " |")


def main(results, saved, processes):
    own = rows(results)
    places = [(float(row["a_double"]), float(row["e_double"])) for row in own]
    rivals = computed(places, Path(saved), int(processes))
    print(f"REBOUND: {sum(seconds for _, seconds in rivals):.0f} s of CPU time\n\nby the words of `motion`, and by the same limits of the mean MEGNO:\n")
    words = [word(megno) for megno, _ in rivals]
    table([(row["motion"], other) for row, other in zip(own, words)])
    print()
    table([(word(float(row["megno"])), other) for row, other in zip(own, words)])
    of_motion = [{row["motion"], other} for row, other in zip(own, words)]
    of_megno = [{word(float(row["megno"])), other} for row, other in zip(own, words)]
    opposed = [k for k in range(len(own)) if {"regular", "chaotic"} in (of_motion[k], of_megno[k])]
    print(f"\n{len(opposed)} runs are opposed; of REBOUND's vectors with seeds 0 and 1, and of seed 0 over ten times the steps: its sum, from the lengths")
    for k in opposed[:: max(1, len(opposed) // LOOKED_AT)]:
        runs = [mean_of_lengths(places[k], steps, seed) for steps, seed in ((STEPS, 0), (STEPS, 1), (10 * STEPS, 0))]
        found = "; ".join(f"{sums:.2f}, {lengths:.2f}" for sums, lengths in runs)
        print(f"a = {own[k]['a']}, e = {own[k]['e']}: ours {own[k]['motion']}, {float(own[k]['megno']):.2f}; REBOUND {found}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
