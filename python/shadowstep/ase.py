"""The modified energy of molecular dynamics with ASE."""

from __future__ import annotations

from typing import Any

import numpy as np
from ase import Atoms, units
from ase.constraints import FixAtoms
from ase.md.verlet import VelocityVerlet

from ._shadowstep import InputError
from .arguments import check
from .border import WrongType
from .exact import count
from .following import Following
from .recorded import Observer


class ShadowMonitor(Following):
    """Follows the modified energy of a run with ASE's `VelocityVerlet`, and says what moves the energy.

    It raises nothing during the run: where steps are so large that the states cannot be followed, `diagnosis` says so. Energies are in eV, forces in eV/Å, and texts
    have times in fs.

    Parameters
    ----------
    atoms
        The atoms, with a calculator that gives energies and forces. Positions that are wrapped into the cell during the run are unwrapped.
    dyn
        The dynamics: a `VelocityVerlet` of these atoms, or a subclass that makes the same steps. Atoms that `FixAtoms` holds are parameters of the potential, and left
        out; other constraints are refused. The monitor attaches itself.
    every
        The number of steps from a window of successive states to the next; at ``window`` and below, all states.
    window
        17 states, or 9, which tell less of small faults.

    Examples
    --------
    >>> import numpy as np
    >>> from ase import Atoms, units
    >>> from ase.build import bulk
    >>> from ase.calculators.emt import EMT
    >>> from ase.md.velocitydistribution import thermalize_momenta
    >>> from ase.md.verlet import VelocityVerlet
    >>> from shadowstep.ase import ShadowMonitor
    >>> atoms = bulk("Cu", cubic=True)
    >>> atoms.calc = EMT()
    >>> thermalize_momenta(atoms, 300, rng=np.random.default_rng(1))
    >>> dyn = VelocityVerlet(atoms, timestep=2 * units.fs)
    >>> monitor = ShadowMonitor(atoms, dyn)
    >>> dyn.run(100)
    True
    >>> monitor.diagnosis().cause
    'nothing'
    """

    def __init__(self, atoms: Any, dyn: Any, every: int = 1, window: int = 17) -> None:
        check(ShadowMonitor.__init__, locals())
        if not isinstance(atoms, Atoms):
            raise WrongType(f"atoms must be ase.Atoms, not {type(atoms).__name__}")
        if not isinstance(dyn, VelocityVerlet) or type(dyn).step is not VelocityVerlet.step:
            found = type(dyn).__name__
            raise InputError(f"dyn: the modified energy is that of velocity Verlet, and the dynamics are {found}: use ase.md.verlet.VelocityVerlet")
        if dyn.atoms is not atoms:
            raise InputError("the dynamics are those of other atoms")
        others = [type(constraint).__name__ for constraint in atoms.constraints if not isinstance(constraint, FixAtoms)]
        if others:
            raise InputError(f"the atoms have {', '.join(others)}, with which the steps are no velocity Verlet: remove it; atoms may be held by FixAtoms")
        self._free = np.setdiff1d(np.arange(len(atoms)), [i for constraint in atoms.constraints for i in constraint.get_indices()])
        if not len(self._free):
            raise InputError("all atoms are fixed")
        self._atoms = atoms
        self._dyn = dyn
        cell = atoms.cell.complete() if any(atoms.pbc) else None
        masses = np.repeat(atoms.get_masses()[self._free], 3)
        observer = Observer(masses, float(dyn.dt), window=window, cell=cell, periodic=atoms.pbc)
        super().__init__(observer, float(dyn.dt), masses, count(every, "every"), ("eV", "fs", 1 / units.fs))
        try:
            self._state()
        except Exception as error:
            raise InputError(f"the calculator of the atoms gives no energy and forces: {type(error).__name__}: {error}") from error
        dyn.attach(self._take, interval=1)

    def _take(self) -> None:
        if self._is_taken(self._dyn.nsteps):
            self._follow(self._dyn.nsteps, self._state)

    def _state(self) -> tuple[np.ndarray, np.ndarray, float, np.ndarray]:
        atoms = self._atoms
        energy = atoms.get_potential_energy(force_consistent=_is_force_consistent(atoms.calc))
        q, p, forces = (of[self._free] for of in (atoms.positions, atoms.get_momenta(), atoms.get_forces()))
        return q, p, energy, forces


def _is_force_consistent(calculator: Any) -> bool:
    """Whether the calculator has an energy of its own to which the forces belong, such as a free energy."""
    return "free_energy" in getattr(calculator, "implemented_properties", ())
