"""Masses and initial states of two planets from noisy positions, and a pair potential from a trajectory: the examples of docs/derivatives.md.

    pip install shadowstep scipy
    python fit_orbits.py
"""

import numpy as np
from scipy.optimize import least_squares, minimize

import shadowstep

G = 2.9591220828559115e-4  # AU³/(solar mass · day²)


def planets():
    """Two planets as heavy as Jupiter and Saturn, whose periods are nearly 2 : 1, so that their masses show."""
    names = ["m[1]", "m[2]"]
    true = shadowstep.Problem(
        pair="-g*m_i*m_j/sqrt(r2)", dimensions=2, bodies={"m": [1, 9.5e-4, 2.9e-4]}, g=G, q=[0, 0, 1, 0, -1.6, 0], v=[0, 0, 0, 0.0172, 0, -0.0136]
    )
    run = {"scheme": "blanes-moan-srkn6b", "h": "2", "until": 4000, "every": 40}
    seen = [2, 3, 4, 5]  # the coordinates of the planets
    noise = 1e-4
    made = shadowstep.integrate(true, **run)
    observed = made.q[:, seen] + noise * np.random.default_rng(1).standard_normal(made.q[:, seen].shape)

    coordinates = [true.coordinates[i] for i in seen]
    momenta = [true.momenta[i] for i in seen]
    q, p = true.initial

    def at(x):
        """The problem at masses, positions and velocities of the planets."""
        masses, positions, velocities = np.split(x, [2, 6])
        at_p = p.copy()
        at_p[2:] = np.repeat(masses, 2) * velocities
        at_q = q.copy()
        at_q[2:] = positions
        return true.replaced(dict(zip(names, masses)), q=at_q, p=at_p)

    def residuals(x):
        return ((shadowstep.integrate(at(x), **run).q[:, seen] - observed) / noise).ravel()

    def jacobian(x):
        found = shadowstep.derivatives(at(x), by=[*names, *coordinates, *momenta], **run).of_q[:, seen].reshape(-1, 10)
        masses, velocities = np.repeat(x[:2], 2), x[6:]
        by_masses, by_q, by_p = np.split(found, [2, 6], axis=1)
        # p = m v
        by_masses = by_masses + np.stack([by_p[:, :2] @ velocities[:2], by_p[:, 2:] @ velocities[2:]], axis=1)
        return np.concatenate([by_masses, by_q, by_p * masses], axis=1) / noise

    exact = np.concatenate([[9.5e-4, 2.9e-4], q[2:], p[2:] / np.repeat([9.5e-4, 2.9e-4], 2)])
    start = exact * (1 + 0.002 * np.random.default_rng(2).standard_normal(10)) * np.repeat([0.5, 1], [2, 8])
    found = least_squares(residuals, start, jacobian, x_scale="jac", verbose=2)
    errors = np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))
    print(f"planets: {found.nfev} runs, {found.njev} Jacobians, χ²/(n − 10) = {2 * found.cost / (observed.size - 10):.3f}")
    for name, value, error, right in zip(["m_1", "m_2"], found.x, errors, exact):
        print(f"  {name} = ({value * 1e4:.4f} ± {error * 1e4:.4f})e-4, true {right * 1e4:.4f}e-4, begun at {start[int(name[-1]) - 1] * 1e4:.2f}e-4")


def pair_potential():
    """ε and σ of Lennard-Jones' potential, from the positions of seven atoms."""
    angles = np.arange(6) * np.pi / 3
    hexagon = 1.12 * np.array([[0, 0], *np.stack([np.cos(angles), np.sin(angles)], axis=1)])
    v = 0.3 * np.random.default_rng(3).standard_normal(14)
    cluster = shadowstep.Problem(
        pair="4*epsilon*(sigma^12/r2^6 - sigma^6/r2^3)", dimensions=2, bodies=7, epsilon=1, sigma=1, q=hexagon.ravel(), p=v
    )
    run = {"scheme": "blanes-moan-srkn6b", "h": "1/100", "until": 4, "every": 10}
    observed = shadowstep.integrate(cluster, **run).q

    def loss(x):
        def distance(q, p):
            return ((q - observed) ** 2).sum(), 2 * (q - observed), None

        found = shadowstep.gradient(distance, cluster.replaced({"epsilon": x[0], "sigma": x[1]}), by=["epsilon", "sigma"], **run)
        return found.value, np.array(list(found.by.values()))

    found = minimize(loss, [0.9, 1.02], jac=True, method="BFGS", options={"gtol": 1e-9})
    print(f"pair potential: {found.nfev} gradients, ε = {found.x[0]:.9f}, σ = {found.x[1]:.9f}, true 1 and 1, sum of squares {found.fun:.1e}")


if __name__ == "__main__":
    planets()
    pair_potential()
