‹provenance›
"""Steps of q' = T_p(p), p' = -U_q(q), where H = T(p) + U(q).

A step costs ‹cost›.

    import jax
    jax.config.update("jax_enable_x64", True)
    from ‹identifier› import integrate

    q, p = integrate(q, p, h=1/64, steps=1000, gradient=jax.grad(potential))

q and p are arrays of one shape, and gradient(q) is U_q(q).
‹if gradient_kicks›
The product of a gradient kick with the second derivatives is taken of the gradient by jax.jvp.
‹end›
‹if every_kinetic›
velocity(p) is T_p(p), by default p, that of unit masses.
‹end›
‹if not every_kinetic›
velocity(p) is p/m, by default p; the order is for quadratic T only.
‹end›
‹if processed›
A trajectory begins with the pre-map and is read through the post-map.
‹end›
All functions are pure and can be compiled, mapped and differentiated, in both modes.
Without x64 JAX computes in single precision, to which it then rounds the weights too.
`python ‹identifier›.py` tests this file.
"""

from functools import partial

import jax
import jax.numpy as jnp

‹weights›


def unit_masses(p):
    return p


‹if gradient_kicks›
def curvature(q, g, gradient, velocity):
    """U_qq(q) v with the velocity v that g has in the place of p."""
    return jax.jvp(gradient, (q,), (velocity(g),))[1]


‹end›
‹if kept_gradient›
def step(q, p, g, h, gradient, velocity=unit_masses):
    """One step: q, p and g = U_q(q), which the next step takes over."""
    ‹step›
    return q, p, g
‹end›
‹if kept_curvature›
def step(q, p, g, w, h, gradient, velocity=unit_masses):
    """One step: q, p, g = U_q(q) and w = curvature(q, g), which the next step takes over."""
    ‹step›
    return q, p, g, w
‹end›
‹if not kept›
def step(q, p, h, gradient, velocity=unit_masses):
    """One step: q and p."""
    ‹step›
    return q, p
‹end›


‹if processed›
def pre(q, p, h, gradient, velocity=unit_masses):
    """The state at which the steps begin, from that of the trajectory."""
    ‹pre›
    return q, p


def post(q, p, h, gradient, velocity=unit_masses):
    """The state of the trajectory, from that which steps have reached."""
    ‹post›
    return q, p


‹end›
@partial(jax.jit, static_argnames=("steps", "gradient", "velocity"))
def integrate(q, p, h, steps, gradient, velocity=unit_masses):
    """q and p after this number of steps of size h."""
‹if processed›
    q, p = pre(q, p, h, gradient, velocity)
‹end›
‹if kept›
    g = gradient(q)
‹end›
‹if kept_curvature›
    w = curvature(q, g, gradient, velocity)
‹end›
‹if not kept›
    q, p = jax.lax.fori_loop(0, steps, lambda _, state: step(*state, h, gradient, velocity), (q, p))
‹end›
‹if kept_gradient›
    q, p, g = jax.lax.fori_loop(0, steps, lambda _, state: step(*state, h, gradient, velocity), (q, p, g))
‹end›
‹if kept_curvature›
    state = jax.lax.fori_loop(0, steps, lambda _, state: step(*state, h, gradient, velocity), (q, p, g, w))
    q, p = state[:2]
‹end›
‹if processed›
    return post(q, p, h, gradient, velocity)
‹end›
‹if not processed›
    return q, p
‹end›


def self_test():
    """Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order."""
    jax.config.update("jax_enable_x64", True)

    def gradient(q):
        r2 = q[0] * q[0] + q[1] * q[1]
        return q / (r2 * jnp.sqrt(r2))

    def error(h, steps, q, p):
        found = integrate(jnp.array([0.4, 0.0]), jnp.array([0.0, 2.0]), h, steps, gradient)
        return float(jnp.max(jnp.abs(jnp.array(found) - jnp.array([q, p]))))

