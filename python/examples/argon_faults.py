"""Five faults in runs of 500 argon atoms with ASE, and what the shadow energy says of each: the table of docs/recorded-trajectories.md.

    pip install shadowstep ase
    python argon_faults.py [seed] [fault ...]

Each run takes some 400 evaluations of ASE's Lennard-Jones forces, a minute or two.
"""

import sys

import numpy as np
from ase import units
from ase.calculators.lj import LennardJones
from ase.lattice.cubic import FaceCenteredCubic
from ase.md.velocitydistribution import Stationary, thermalize_momenta
from ase.md.verlet import VelocityVerlet

from shadowstep.ase import ShadowMonitor

ARGON = {"sigma": 3.4, "epsilon": 0.0104, "rc": 10.2}


class Noisy(LennardJones):
    """Forces with independent errors of 1e-3 eV/Å."""

    random = np.random.default_rng(101)

    def calculate(self, *arguments, **keywords):
        super().calculate(*arguments, **keywords)
        forces = self.results["forces"]
        self.results["forces"] = forces + 1e-3 * self.random.normal(size=forces.shape)


class Late(LennardJones):
    """A list of neighbours that is renewed in 100 steps."""

    evaluations = 0

    def calculate(self, *arguments, **keywords):
        if getattr(self, "nl", None) is not None and not hasattr(self.nl, "renew"):
            self.nl.renew = self.nl.update
            self.nl.update = self.now_and_then
        super().calculate(*arguments, **keywords)

    def now_and_then(self, atoms):
        self.evaluations += 1
        return self.nl.renew(atoms) if self.evaluations % 100 == 0 else False


class Truncated(LennardJones):
    """u(r) is 0 beyond the cutoff and unchanged within; ASE's own calculator takes u(r_c) from it."""

    def calculate(self, *arguments, **keywords):
        super().calculate(*arguments, **keywords)
        sigma, epsilon, rc = (self.parameters[name] for name in ("sigma", "epsilon", "rc"))
        q, sides = self.atoms.positions, self.atoms.cell.lengths()
        d = q[:, None] - q[None]
        d -= sides * np.rint(d / sides)
        pairs = (np.count_nonzero((d**2).sum(axis=2) < rc**2) - len(q)) // 2
        at_cutoff = 4 * epsilon * ((sigma / rc) ** 12 - (sigma / rc) ** 6)
        for name in ("energy", "free_energy"):
            self.results[name] += pairs * at_cutoff


# the calculator, and the step in fs
FAULTS = {
    "none": (lambda: LennardJones(smooth=True, **ARGON), 5),
    "noise": (lambda: Noisy(smooth=True, **ARGON), 5),
    "late list": (lambda: Late(smooth=True, **ARGON), 5),
    "truncated": (lambda: Truncated(**ARGON), 5),
    "shifted": (lambda: LennardJones(**ARGON), 5),
    "large step": (lambda: LennardJones(smooth=True, **ARGON), 50),
}


def main(seed, faults):
    atoms = FaceCenteredCubic("Ar", size=(5, 5, 5), latticeconstant=5.46, pbc=True)
    thermalize_momenta(atoms, 200, rng=np.random.default_rng(seed))
    Stationary(atoms)
    atoms.calc = LennardJones(smooth=True, **ARGON)
    VelocityVerlet(atoms, 5 * units.fs).run(120)
    for fault in faults:
        calculator, step = FAULTS[fault]
        copy = atoms.copy()
        copy.calc = calculator()
        dyn = VelocityVerlet(copy, step * units.fs)
        monitors = {"all states": ShadowMonitor(copy, dyn), "windows of 9 states in 12 steps": ShadowMonitor(copy, dyn, every=12, window=9)}
        dyn.run(400)
        for states, monitor in monitors.items():
            print(f"{fault}, seed {seed}, {states}: {monitor.diagnosis()}\n", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1, sys.argv[2:] or list(FAULTS))
