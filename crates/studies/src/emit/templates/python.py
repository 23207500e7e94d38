‹provenance›
"""Steps of q' = T_p(p), p' = -U_q(q), where H = T(p) + U(q).

A step costs ‹cost›.

    from ‹identifier› import integrate

‹if not gradient_kicks›
    q, p = integrate(q, p, h=1/64, steps=1000, gradient=lambda q: q)
‹end›
‹if gradient_kicks›
    q, p = integrate(q, p, h=1/64, steps=1000, gradient=lambda q: q, hessian_product=lambda q, v: v)
‹end›

q and p are NumPy arrays of one shape, and gradient(q) is U_q(q).
‹if gradient_kicks›
hessian_product(q, v) is U_qq(q) v.
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
`python ‹identifier›.py` tests this file.
"""

import numpy as np

‹weights›


def unit_masses(p):
    return p


‹if kept›
def step(q, p, h, ‹parameters›, kept=None):
    """One step: q, p, and what the next step may take over as kept, so that it evaluates less."""
‹if kept_gradient›
    g = gradient(q) if kept is None else kept
‹end›
‹if kept_curvature›
    if kept is None:
        g = gradient(q)
        kept = g, hessian_product(q, velocity(g))
    g, w = kept
‹end›
    ‹step›
‹if kept_gradient›
    return q, p, g
‹end›
‹if kept_curvature›
    return q, p, (g, w)
‹end›
‹end›
‹if not kept›
def step(q, p, h, ‹parameters›):
    """One step: q and p."""
    ‹step›
    return q, p
‹end›


‹if processed›
def pre(q, p, h, ‹parameters›):
    """The state at which the steps begin, from that of the trajectory."""
    ‹pre›
    return q, p


def post(q, p, h, ‹parameters›):
    """The state of the trajectory, from that which steps have reached."""
    ‹post›
    return q, p


‹end›
def integrate(q, p, h, steps, ‹parameters›):
    """q and p after this number of steps of size h."""
    q, p = np.asarray(q, dtype=float), np.asarray(p, dtype=float)
‹if processed›
    q, p = pre(q, p, h, ‹arguments›)
‹end›
‹if kept›
    kept = None
‹end›
    for _ in range(steps):
‹if kept›
        q, p, kept = step(q, p, h, ‹arguments›, kept)
‹end›
‹if not kept›
        q, p = step(q, p, h, ‹arguments›)
‹end›
‹if processed›
    return post(q, p, h, ‹arguments›)
‹end›
‹if not processed›
    return q, p
‹end›


def self_test():
    """Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order."""

    def gradient(q):
        r2 = q[0] * q[0] + q[1] * q[1]
        return q / (r2 * np.sqrt(r2))

‹if gradient_kicks›
    def hessian_product(q, v):
        r2 = q[0] * q[0] + q[1] * q[1]
        return (v - 3 * (q[0] * v[0] + q[1] * v[1]) / r2 * q) / (r2 * np.sqrt(r2))

‹end›
    def error(h, steps, q, p):
        found = integrate([0.4, 0.0], [0.0, 2.0], h, steps, ‹test_arguments›)
        return np.max(np.abs(np.subtract(found, (q, p))))

