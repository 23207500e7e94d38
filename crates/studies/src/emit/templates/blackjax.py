‹provenance›
"""An integrator of BlackJAX's samplers, which costs ‹gradients› of the gradient a step.

    import blackjax
    from ‹identifier› import integrator

    sampler = blackjax.hmc(logdensity, step_size, inverse_mass_matrix, num_integration_steps, integrator=integrator)

`shadowstep sampling ‹name›` computes a step size for a Gaussian density.
‹if not every_kinetic›
The order is for T quadratic in p only, as a Euclidean metric has it.
‹end›
Without x64 JAX computes in single precision, to which it then rounds the weights too.
`python ‹identifier›.py` tests this file.
"""

import jax
import jax.numpy as jnp
from blackjax.mcmc.integrators import generate_euclidean_integrator, new_integrator_state

‹weights›

# of momentum and position in turn
coefficients = [‹coefficients›]
integrator = generate_euclidean_integrator(coefficients)


def self_test():
    """Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order."""
    jax.config.update("jax_enable_x64", True)

    def logdensity(q):
        return 1 / jnp.sqrt(q[0] * q[0] + q[1] * q[1])

    def error(h, steps, q, p):
        step = integrator(logdensity, lambda p: (p @ p) / 2)
        start = new_integrator_state(logdensity, jnp.array([0.4, 0.0]), jnp.array([0.0, 2.0]))
        end = jax.jit(lambda state: jax.lax.fori_loop(0, steps, lambda _, state: step(state, h), state))(start)
        return float(jnp.max(jnp.abs(jnp.array([end.position, end.momentum]) - jnp.array([q, p]))))

