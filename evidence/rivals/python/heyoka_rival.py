"""heyoka: Taylor series of adaptive order and step size, compiled just in time for each problem and tolerance.

`taylor` is one trajectory; `batch` does as many at once as the processor's vectors hold, all alike here, and reports the time
divided by their number.
"""

import sys
import time
from functools import cache

import heyoka as hy
import numpy as np

from protocol import read_initial, serve

BATCH = hy.recommended_simd_size()


def potential(problem, q, initial):
    parameters = initial.parameters
    if problem == "kepler":
        return -1 / hy.sqrt(q[0] ** 2 + q[1] ** 2)
    if problem == "henon-heiles":
        return (q[0] ** 2 + q[1] ** 2) / 2 + q[0] ** 2 * q[1] - q[1] ** 3 / 3
    if problem == "fput-alpha":
        chain = [hy.expression(0.0), *q, hy.expression(0.0)]
        springs = [right - left for left, right in zip(chain, chain[1:])]
        return hy.sum([d**2 / 2 + parameters[0] * d**3 / 3 for d in springs])
    raise ValueError(f"no problem {problem}")


def equations(problem, initial):
    """The positions and the velocities with their derivatives."""
    if problem == "outer-solar-system":
        # the ready-made equations order the state by bodies: x, y, z, vx, vy, vz
        system = hy.model.nbody(6, masses=initial.mass[::3], Gconst=initial.parameters[0])
        blocks = np.arange(36).reshape(6, 6)
        return system, np.concatenate((blocks[:, :3].ravel(), blocks[:, 3:].ravel()))
    count = len(initial.q)
    q = hy.make_vars(*(f"q{i}" for i in range(count)))
    v = hy.make_vars(*(f"v{i}" for i in range(count)))
    energy = potential(problem, q, initial)
    system = list(zip(q, v)) + [(v[i], -hy.diff(energy, q[i]) / initial.mass[i]) for i in range(count)]
    return system, np.arange(2 * count)


@cache
def integrator(problem, tolerance, batch):
    """The compiled integrator, the order of its state, and its initial state."""
    initial = read_initial(problem)
    system, order = equations(problem, initial)
    state = np.empty(2 * len(initial.q))
    state[order] = np.concatenate((initial.q, initial.p / initial.mass))
    start = time.process_time()
    if batch:
        state = np.repeat(state[:, None], BATCH, axis=1)
        compiled = hy.taylor_adaptive_batch(system, state, tol=tolerance)
    else:
        compiled = hy.taylor_adaptive(system, state, tol=tolerance)
    print(f"compiled {problem} {tolerance} {time.process_time() - start:.3f} s", file=sys.stderr, flush=True)
    return compiled, order, state


def answer(request, initial):
    batch = request.method == "batch"
    compiled, order, state = integrator(request.problem, request.tolerance, batch)
    compiled.state[:] = state
    if batch:
        compiled.set_time(0.0)
    else:
        compiled.time = 0.0
    seconds, states = 0.0, []
    for sample in range(1, request.samples + 1):
        start = time.process_time()
        compiled.propagate_until(request.until * sample / request.samples)
        seconds += time.process_time() - start
        q, v = np.split((compiled.state[:, 0] if batch else compiled.state)[order], 2)
        states.append((q, v * initial.mass))
    return seconds / (BATCH if batch else 1), states


serve(answer)
