"""The modified energy of molecular dynamics with OpenMM."""

from __future__ import annotations

from typing import Any

import numpy as np
import openmm
import openmm.app
from openmm import unit

from ._shadowstep import InputError
from .arguments import check
from .border import WrongType
from .exact import count
from .following import Following
from .recorded import Observer

# What changes states between the steps; all other forces have an energy.
_OTHER = (
    "CMMotionRemover",
    "AndersenThermostat",
    "MonteCarloBarostat",
    "MonteCarloAnisotropicBarostat",
    "MonteCarloMembraneBarostat",
    "MonteCarloFlexibleBarostat",
    "RPMDMonteCarloBarostat",
)

_PER_DOF, _GLOBAL = ("shadow_dx", "shadow_dv"), "shadow_dbeta"


def _sums_increments(integrator: Any) -> bool:
    if not isinstance(integrator, openmm.CustomIntegrator):
        return False
    per_dof = {integrator.getPerDofVariableName(i) for i in range(integrator.getNumPerDofVariables())}
    names = {integrator.getGlobalVariableName(i) for i in range(integrator.getNumGlobalVariables())}
    return per_dof.issuperset(_PER_DOF) and _GLOBAL in names


class ShadowReporter(Following):
    """A reporter that follows the modified energy of a simulation with OpenMM's `VerletIntegrator` or another splitting, and says what moves the energy.

    It raises nothing during the run: where steps are so large that the states cannot be followed, `diagnosis` says so. Energies are in kJ/mol, forces in kJ/mol/nm, and texts
    have times in ps. Momenta of `VerletIntegrator` are those of leapfrog, half a step before the positions; they are converted exactly, by the forces. Another splitting is
    a `CustomIntegrator` that sums the increments of its steps, as ``make_integrator(step_size, increments=True)`` of `Scheme.emit` does.

    Parameters
    ----------
    simulation
        An `openmm.app.Simulation` with such an integrator; no constraints, virtual sites, thermostats, barostats or `CMMotionRemover`
        (``createSystem(removeCMMotion=False)``). Particles of mass 0 do not move, and are left out. Append the reporter to its ``reporters``.
    every
        The number of steps from a window of successive states to the next; at ``window`` and below, all states.
    window
        17 states, or 9, which tell less of small faults.
    """

    def __init__(self, simulation: Any, every: int = 1, window: int = 17) -> None:
        check(ShadowReporter.__init__, locals())
        if not isinstance(simulation, openmm.app.Simulation):
            raise WrongType(f"simulation must be an openmm.app.Simulation, not {type(simulation).__name__}")
        integrator, system = simulation.context.getIntegrator(), simulation.system
        self._increments = integrator if _sums_increments(integrator) else None
        if not (self._increments or isinstance(integrator, openmm.VerletIntegrator)):
            found, use = type(integrator).__name__, "openmm.VerletIntegrator, or a splitting made by make_integrator(step_size, increments=True)"
            raise InputError(f"the modified energy is that of a splitting whose increments are known, and the integrator is {found}: use {use}")
        if system.getNumConstraints():
            raise InputError(f"the system has {system.getNumConstraints()} constraints, with which the steps are no leapfrog: make it without")
        others = [type(force).__name__ for force in system.getForces() if type(force).__name__ in _OTHER]
        if others:
            how = "createSystem(removeCMMotion=False)" if others == ["CMMotionRemover"] else "remove it"
            raise InputError(f"the system has {', '.join(others)}, which changes states between the steps: {how}")
        particles = range(system.getNumParticles())
        if any(system.isVirtualSite(i) for i in particles):
            raise InputError("the system has virtual sites, whose positions are no coordinates of their own: make it without")
        masses = np.array([system.getParticleMass(i).value_in_unit(unit.dalton) for i in particles])
        # OpenMM does not move particles of mass 0
        self._free = masses > 0
        if not self._free.any():
            raise InputError("all particles have mass 0, so that nothing moves")
        groups = {force.getForceGroup() for force in system.getForces()}
        left_out = [group for group in sorted(groups) if not integrator.getIntegrationForceGroups() >> group & 1]
        if left_out:
            raise InputError(f"the integrator leaves out the forces of group {left_out[0]}, whose energy states have: integrate all groups")
        h = integrator.getStepSize().value_in_unit(unit.picosecond)
        moving = np.repeat(masses[self._free], 3)
        super().__init__(Observer(moving, h, window=window), h, moving, count(every, "every"), ("kJ/mol", "ps", 1.0))

    def describeNextReport(self, simulation: Any) -> tuple[int, bool, bool, bool, bool, bool]:
        """OpenMM asks this: in how many steps the next state is needed, and what of it. Positions are not wrapped."""
        window, done = self._observer.window, simulation.currentStep
        is_taken = self._every <= window or (done + 1) % self._every < window
        wait = 1 if is_taken else self._every - done % self._every
        return (wait, True, True, True, True, False)

    def report(self, simulation: Any, state: Any) -> None:
        """OpenMM gives a state."""
        n = simulation.currentStep
        step: dict[str, Any] = {"half_step": True}
        if self._increments is not None:
            dq, dv = (np.array(self._increments.getPerDofVariableByName(name))[self._free] for name in _PER_DOF)
            step = {"step": (dq, dv.ravel() * self._masses, self._increments.getGlobalVariableByName(_GLOBAL))}
        self._follow(n, lambda: self._state(state), **step)

    def _state(self, state: Any) -> tuple[np.ndarray, np.ndarray, float, np.ndarray]:
        number = lambda quantity, of: np.asarray(quantity.value_in_unit(of))  # noqa: E731
        q = number(state.getPositions(asNumpy=True), unit.nanometer)
        v = number(state.getVelocities(asNumpy=True), unit.nanometer / unit.picosecond)
        forces = number(state.getForces(asNumpy=True), unit.kilojoule_per_mole / unit.nanometer)
        energy = state.getPotentialEnergy().value_in_unit(unit.kilojoule_per_mole)
        q, v, forces = (of[self._free] for of in (q, v, forces))
        return q, v.ravel() * self._masses, energy, forces
