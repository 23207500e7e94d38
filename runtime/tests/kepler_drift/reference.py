"""Writes cases.txt: Kepler drifts of random orbits and times, by mpmath with 60 digits.

    python3 runtime/tests/kepler_drift/reference.py > runtime/tests/kepler_drift/cases.txt

A line has μ, q (3), v (3) and t, each the shortest text of an f64, then s = ∫dt/r, q and v at the time t.
Eccentricities are 0 … 0.9999, 1 ± 1e-8 … 1e-14 and up to 10, times 1e-6 … 30 periods of both signs.
"""

import math
import random

import mpmath
from mpmath import mpf

mpmath.mp.dps = 80


def eccentricity():
    kind = random.random()
    if kind < 0.2:
        return random.uniform(0, 0.3)
    if kind < 0.5:
        return 1 - 10 ** random.uniform(-4, 0)
    if kind < 0.75:
        return 1 + random.choice([10 ** random.uniform(-6, 0.95), 9 * random.random()])
    return 1 + random.choice([-1, 1]) * 10 ** random.uniform(-14, -8)


def rotated(x, y, z, angles):
    """Rotates about the axes z, x, z."""
    a, b, c = angles
    x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
    y, z = y * math.cos(b) - z * math.sin(b), y * math.sin(b) + z * math.cos(b)
    return x * math.cos(c) - y * math.sin(c), x * math.sin(c) + y * math.cos(c), z


def case():
    e, pericentre, mu = eccentricity(), 10 ** random.uniform(-1, 1), 10 ** random.uniform(-1.5, 1.5)
    if abs(e - 1) < 1e-7:
        anomaly = random.uniform(-3, 3)
    elif e > 1:
        anomaly = random.uniform(-1, 1) * (math.acos(-1 / e) - 0.05)
    else:
        anomaly = random.uniform(-math.pi, math.pi)
    p = pericentre * (1 + e)
    r, k = p / (1 + e * math.cos(anomaly)), math.sqrt(mu / p)
    angles = [random.uniform(0, 2 * math.pi) for _ in range(3)]
    q = rotated(r * math.cos(anomaly), r * math.sin(anomaly), 0, angles)
    v = rotated(-k * math.sin(anomaly), k * (e + math.cos(anomaly)), 0, angles)
    size = pericentre / (1 - e) if e < 0.9999 else pericentre
    period = 2 * math.pi * math.sqrt(size**3 / mu)
    t = period * 10 ** random.uniform(-6, math.log10(30)) * random.choice([-1, 1])
    return [mu, *q, *v, t]


def g_functions(alpha, s):
    """G₀ … G₃, by their series where the elementary functions would cancel."""
    z = alpha * s * s
    if abs(z) < 1e-4:
        c2, c3 = (mpmath.fsum((-z) ** n / mpmath.factorial(2 * n + k) for n in range(20)) for k in (2, 3))
        return 1 - z * c2, s * (1 - z * c3), s * s * c2, s**3 * c3
    k = mpmath.sqrt(abs(alpha))
    g0, g1 = (mpmath.cos(k * s), mpmath.sin(k * s) / k) if alpha > 0 else (mpmath.cosh(k * s), mpmath.sinh(k * s) / k)
    return g0, g1, (1 - g0) / alpha, (s - g1) / alpha


def drift(mu, x, y, z, vx, vy, vz, t):
    q, v = mpmath.matrix([x, y, z]), mpmath.matrix([vx, vy, vz])
    r0, eta = mpmath.norm(q), mpmath.fdot(q, v)
    alpha = 2 * mu / r0 - mpmath.fdot(v, v)
    zeta = mu - alpha * r0

    def equation(s):
        g0, g1, g2, g3 = g_functions(alpha, s)
        return r0 * s + eta * g2 + zeta * g3 - t

    # the left side grows: two bounds, between which it is bisected, then Newton's steps
    low, high = mpf(-1), mpf(1)
    while equation(low) > 0:
        low *= 2
    while equation(high) < 0:
        high *= 2
    for _ in range(120):
        middle = (low + high) / 2
        low, high = (middle, high) if equation(middle) < 0 else (low, middle)
    s = (low + high) / 2
    for _ in range(3):
        g0, g1, g2, g3 = g_functions(alpha, s)
        r = r0 + eta * g1 + zeta * g2
        s -= (r0 * s + eta * g2 + zeta * g3 - t) / r
    g0, g1, g2, g3 = g_functions(alpha, s)
    r = r0 + eta * g1 + zeta * g2
    f, g, f_dot, g_dot = 1 - mu * g2 / r0, t - mu * g3, -mu * g1 / (r0 * r), 1 - mu * g2 / r
    return [s, *(f * q + g * v), *(f_dot * q + g_dot * v)]


if __name__ == "__main__":
    random.seed(1)
    for _ in range(200):
        numbers = case()
        found = drift(*map(mpf, numbers))
        print(*map(repr, numbers), *(mpmath.nstr(x, 60, min_fixed=0, max_fixed=0) for x in found))
