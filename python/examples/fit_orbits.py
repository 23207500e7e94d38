"""Masses and initial states of two planets from noisy positions, and a pair potential from a trajectory: the examples of docs/derivatives.md.

    pip install shadowstep scipy
    python fit_orbits.py
"""

import numpy as np
from scipy.optimize import least_squares, minimize

import shadowstep


def planets():
    """Two planets as heavy as Jupiter and Saturn near a resonance of 2 : 1, so that their masses show in their positions."""
    bodies = [
        {"name": "star", "mass": 1},
        {"name": "b", "mass": 9.5e-4, "a": 1, "e": 0.05, "pericentre": 30, "M": 10},
        {"name": "c", "mass": 2.9e-4, "a": 1.6, "e": 0.08, "pericentre": 200, "M": 300},
    ]
    units = {"length": "AU", "time": "day", "mass": "solar"}
    true = shadowstep.Problem(parts="wisdom-holman", units=units, body=bodies)
    run = {"scheme": "aba1064", "h": "10", "until": 1820, "every": 2}
    names = [f"body.{planet}.{element}" for planet in "bc" for element in ("mass", "a", "e", "pericentre", "M")]
    noise = 1e-4  # AU

    def seen(q):
        """The positions of the planets in the plane, from the star."""
        return np.concatenate([q[:, 3:5] - q[:, :2], q[:, 6:8] - q[:, :2]], axis=1) / noise

    exact = np.array([float(true.number(name)) for name in names])
    clean = seen(shadowstep.integrate(true, **run).q)
    observed = clean + np.random.default_rng(1).standard_normal(clean.shape)

    def residuals(x):
        return (seen(shadowstep.integrate(true.replaced(dict(zip(names, x))), **run).q) - observed).ravel()

    def jacobian(x):
        return seen(shadowstep.derivatives(true.replaced(dict(zip(names, x))), by=names, **run).of_q).reshape(-1, len(names))

    start = exact * np.where([name.endswith("mass") for name in names], 0.5, 1 + 0.01 * np.random.default_rng(2).standard_normal(10))
    found = least_squares(residuals, start, jacobian, x_scale="jac")
    errors = np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))
    print(f"planets: {found.nfev} runs, {found.njev} with derivatives; χ² = {2 * found.cost:.0f} of {observed.size} numbers")
    for name, value, error, right, begun in zip(names, found.x, errors, exact, start):
        print(f"  {name:17} {value:.7f} ± {error:.7f}, true {right}, begun at {begun:.6f}")


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
