"""The acceptance of BlackJAX's sampler with the coefficients of a file beside what `shadowstep sampling` computes: `sampling.py FOLDER NAME RECORD`."""

import importlib
import json
import sys

import blackjax
import jax
import jax.numpy as jnp

CHAINS, DRAWS = 16, 500


def accepted(integrator, frequencies, h, steps):
    """The acceptance of each of several chains that begin in equilibrium."""
    sampler = blackjax.hmc(lambda q: -((frequencies * q) ** 2).sum() / 2, h, jnp.ones_like(frequencies), steps, integrator=integrator)

    def draw(state, key):
        state, info = sampler.step(key, state)
        return state, info.acceptance_rate

    def chain(key):
        first, rest = jax.random.split(key)
        start = sampler.init(jax.random.normal(first, frequencies.shape) / frequencies)
        return jax.lax.scan(draw, start, jax.random.split(rest, DRAWS))[1].mean()

    return jax.jit(jax.vmap(chain))(jax.random.split(jax.random.key(1), CHAINS))


if __name__ == "__main__":
    folder, name, record = sys.argv[1:]
    sys.path.insert(0, folder)
    jax.config.update("jax_enable_x64", True)
    record = json.loads(record)
    found = accepted(importlib.import_module(name).integrator, jnp.arange(1, 101) / 100, record["step"], record["steps"])
    error = found.std(ddof=1) / CHAINS**0.5
    print(f"acceptance {found.mean():.4f} ± {error:.4f}, computed {record['acceptance']:.4f}")
    raise SystemExit(0 if abs(found.mean() - record["acceptance"]) < 4 * error < 0.04 else "they differ")
