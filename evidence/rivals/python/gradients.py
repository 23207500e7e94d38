"""The gradients of the potentials in Python: plain floats for few coordinates, numpy for many, as is faster."""

import numpy as np


def kepler(q, _):
    x, y = q
    r2 = x * x + y * y
    inverse_cube = 1 / (r2 * r2**0.5)
    return x * inverse_cube, y * inverse_cube


def henon_heiles(q, _):
    x, y = q
    return x + 2 * x * y, y + x * x - y * y


def outer(q, initial):
    bodies, m = q.reshape(6, 3), initial.mass[::3]
    difference = bodies[:, None] - bodies[None, :]
    r2 = np.einsum("ijk,ijk->ij", difference, difference)
    np.fill_diagonal(r2, 1)
    slope = initial.parameters[0] * m[:, None] * m / (r2 * np.sqrt(r2))
    return np.einsum("ij,ijk->ik", slope, difference).ravel()


def fput(q, initial):
    d = np.diff(q, prepend=0.0, append=0.0)
    force = d + initial.parameters[0] * d * d
    return force[:-1] - force[1:]


def argon(q, initial):
    epsilon, sigma = initial.parameters
    atoms = q.reshape(-1, 3)
    difference = atoms[:, None] - atoms[None, :]
    r2 = np.einsum("ijk,ijk->ij", difference, difference)
    np.fill_diagonal(r2, np.inf)
    s6 = (sigma * sigma / r2) ** 3
    slope = 24 * epsilon * (s6 - 2 * s6 * s6) / r2
    return np.einsum("ij,ijk->ik", slope, difference).ravel()


GRADIENTS = {
    "kepler": kepler,
    "henon-heiles": henon_heiles,
    "outer-solar-system": outer,
    "fput-alpha": fput,
    "argon": argon,
}
