"""Gradients of a function of the end state by the initial state, in time and memory, beside diffrax: the outer planets, as a function of JAX.

    pip install shadowstep jax diffrax
    python gradients.py            # all contestants, each in a process of its own

Both make steps with one evaluation of the forces: Störmer and Verlet's, and diffrax's SemiImplicitEuler, whose order is 1. diffrax keeps states at checkpoints and
makes the steps between them again (RecursiveCheckpointAdjoint); its BacksolveAdjoint, which integrates back, does not take such a solver.
"""

import resource
import statistics
import subprocess
import sys
import time
from fractions import Fraction

STEPS = (1_000, 10_000, 100_000)
CONTESTANTS = ("shadowstep", "diffrax")
H = 10.0


def measured(contestant, steps):
    import jax
    import jax.numpy as jnp
    import numpy as np

    import shadowstep
    import shadowstep.jax

    jax.config.update("jax_enable_x64", True)
    problem = shadowstep.Problem("outer-solar-system")
    q, p = map(jnp.asarray, problem.initial)
    if contestant == "shadowstep":
        flow = shadowstep.jax.flow(problem, "stormer-verlet", H, steps=steps, every=steps)

        def end(q, p):
            return flow(q, p)[0][-1]
    else:
        import diffrax

        bodies = ("sun", "jupiter", "saturn", "uranus", "neptune", "pluto")
        g, *each = (float(Fraction(problem.number(name))) for name in ("g", *(f"m_{body}" for body in bodies)))
        masses = np.repeat(each, 3)
        pairs = [(i, j) for i in range(6) for j in range(i)]

        def potential(q):
            q = q.reshape(6, 3)
            return sum(-g * each[i] * each[j] / jnp.sqrt(((q[i] - q[j]) ** 2).sum()) for i, j in pairs)

        kick, drift = jax.grad(potential), lambda p: p / masses
        terms = diffrax.ODETerm(lambda t, p, args: drift(p)), diffrax.ODETerm(lambda t, q, args: -kick(q))

        def end(q, p):
            saved = diffrax.SaveAt(t1=True)
            options = {"saveat": saved, "adjoint": diffrax.RecursiveCheckpointAdjoint(), "max_steps": steps + 1}
            found = diffrax.diffeqsolve(terms, diffrax.SemiImplicitEuler(), 0.0, steps * H, H, (q, p), **options)
            return found.ys[0][-1]

    def loss(q, p):
        return (end(q, p) ** 2).sum()

    forward, backward = jax.jit(loss), jax.jit(jax.grad(loss, argnums=(0, 1)))
    times = []
    for function in (forward, backward):
        jax.block_until_ready(function(q, p))
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        each = []
        for _ in range(5):
            begun = time.perf_counter()
            found = jax.block_until_ready(function(q, p))
            each.append(time.perf_counter() - begun)
        times.append(statistics.median(each))
    return times[0], times[1], before / 1024, float(jnp.linalg.norm(found[0]))


def main():
    print("| steps | | forwards, ms | gradient, ms | ratio | peak memory, MB |\n| --- | --- | --- | --- | --- | --- |")
    for steps in STEPS:
        for contestant in CONTESTANTS:
            done = subprocess.run([sys.executable, __file__, contestant, str(steps)], capture_output=True, text=True)
            print(done.stdout.strip() or f"| {steps} | {contestant} | failed: {done.stderr.strip().splitlines()[-1]} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        forwards, backwards, memory, _ = measured(sys.argv[1], int(sys.argv[2]))
        print(f"| {sys.argv[2]} | {sys.argv[1]} | {1e3 * forwards:.1f} | {1e3 * backwards:.1f} | {backwards / forwards:.1f} | {memory:.0f} |")
    else:
        main()
