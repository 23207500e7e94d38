‹provenance›
"""An integrator of mici, which costs ‹cost› a step.

    import mici
    from ‹identifier› import make_integrator

    system = mici.systems.EuclideanMetricSystem(neg_log_dens=neg_log_dens, grad_neg_log_dens=grad_neg_log_dens)
    integrator = make_integrator(system, step_size=0.5)

`shadowstep sampling ‹name›` computes a step size for a Gaussian density.
‹if not every_kinetic›
The order is for h2 = T quadratic in p only, as of EuclideanMetricSystem.
‹end›
`python ‹identifier›.py` tests this file.
"""

import numpy as np
from mici.integrators import SymmetricCompositionIntegrator
from mici.states import ChainState
from mici.systems import EuclideanMetricSystem

‹weights›

# of all flows in turn; mici computes the others from the free ones
coefficients = [‹coefficients›]
free_coefficients = coefficients[:‹free›]


def make_integrator(system, step_size=None):
    """An integrator of a system with the flows of h1 and h2."""
    return SymmetricCompositionIntegrator(system, free_coefficients, step_size=step_size, initial_h1_flow_step=‹kick_first›)


def self_test():
    """Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order."""

    def gradient(q):
        r2 = q[0] * q[0] + q[1] * q[1]
        return q / (r2 * np.sqrt(r2))

    def error(h, steps, q, p):
        system = EuclideanMetricSystem(neg_log_dens=lambda q: -1 / np.hypot(*q), grad_neg_log_dens=gradient)
        integrator = make_integrator(system, h)
        state = ChainState(pos=np.array([0.4, 0.0]), mom=np.array([0.0, 2.0]), dir=1)
        for _ in range(steps):
            state = integrator.step(state)
        return np.max(np.abs(np.subtract((state.pos, state.mom), (q, p))))

