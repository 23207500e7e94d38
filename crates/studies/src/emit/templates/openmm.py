‹provenance›
"""An integrator of OpenMM, with ‹evaluations› a step.

    from ‹identifier› import make_integrator

    integrator = make_integrator(2 * unit.femtoseconds)
    simulation = Simulation(topology, system, integrator)

It is for systems without constraints and virtual sites, and has no thermostat. What changes the
state by itself, such as a barostat or CMMotionRemover, acts at the beginning of each step.
`python ‹identifier›.py` tests this file.
"""

‹if order_shows›
import math

‹end›
import openmm

‹weights›


def make_integrator(step_size, increments=False):
    """A CustomIntegrator with this step size.

    With increments it sums what each step adds to x, v and beta (less x at its beginning times
    the increment of p): shadowstep.openmm.ShadowReporter has the modified energy from these.
    """
    integrator = openmm.CustomIntegrator(step_size)

    def kick(weight):
        if increments:
            integrator.addComputeSum("shadow_sum", "shadow_dx * f")
            integrator.addComputeGlobal("shadow_dbeta", f"shadow_dbeta - {weight!r} * dt * (shadow_sum + 2 * energy)")
            integrator.addComputePerDof("shadow_dv", f"shadow_dv + {weight!r} * dt * f / m")
        integrator.addComputePerDof("v", f"v + {weight!r} * dt * f / m")

    def drift(weight):
        if increments:
            integrator.addComputePerDof("shadow_dx", f"shadow_dx + {weight!r} * dt * v")
        integrator.addComputePerDof("x", f"x + {weight!r} * dt * v")

    integrator.addUpdateContextState()
    if increments:
        for name in "shadow_dbeta", "shadow_sum":
            integrator.addGlobalVariable(name, 0)
        for name in "shadow_dx", "shadow_dv":
            integrator.addPerDofVariable(name, 0)
            integrator.addComputePerDof(name, "0")
        integrator.addComputeGlobal("shadow_dbeta", "0")
    ‹step›
    return integrator


def self_test():
    """Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order."""

    def error(h, steps, q, p):
        system = openmm.System()
        system.addParticle(1)
        potential = openmm.CustomExternalForce("-1 / sqrt(x^2 + y^2)")
        potential.addParticle(0)
        system.addForce(potential)
        platform = openmm.Platform.getPlatformByName("Reference")
        integrator = make_integrator(h)
        context = openmm.Context(system, integrator, platform)
        context.setPositions([(0.4, 0, 0)])
        context.setVelocities([(0, 2, 0)])
        integrator.step(steps)
        state = context.getState(getPositions=True, getVelocities=True)
        found = [*state.getPositions()[0]._value[:2], *state.getVelocities()[0]._value[:2]]
        return max(abs(a - b) for a, b in zip(found, q + p))

    distance = error(‹h›, ‹count›, [‹end_q›], [‹end_p›])
    agreement = "the bits of Shadowstep" if distance == 0 else f"{distance:.1e} from Shadowstep"
    print(f"‹name›: ‹count› steps of ‹part›: {agreement}")
    passed = distance < ‹tolerance›
‹if order_shows›

    exact = [‹exact_q›], [‹exact_p›]  # at t = ‹time›
    ratio = error(‹time› / ‹coarse›, ‹coarse›, *exact) / error(‹time› / ‹fine›, ‹fine›, *exact)
    order = math.log2(ratio)
    print(f"‹name›: order {order:.2f} observed, ‹order› proved")
    passed = passed and order > ‹order› - 0.5
‹end›
    return passed


if __name__ == "__main__":
    raise SystemExit(0 if self_test() else "‹name›: the self-test has failed")
