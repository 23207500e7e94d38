"""pyhamsys: symplectic splitting schemes in Python, with the package's own maps for H = T(p) + U(q)."""

import time
from functools import partial

import numpy as np
from pyhamsys import Parameters, solve_ivp_symp
from pyhamsys.pyhamsys import chi_potential, chi_potential_star

from gradients import GRADIENTS
from protocol import serve


def answer(request, initial):
    half, gradient = len(initial.q), GRADIENTS[request.problem]

    def of_state(chi):
        """The package's map takes x, p of mass 1 and changes them in place."""
        slope = lambda _, x: np.asarray(gradient(x, initial)) / initial.mass
        part = partial(chi, dvdx=slope)

        def whole(h, t, y):
            y = y.copy()
            _, x, p = part(h, t, y[:half], y[half:])
            return np.concatenate((x, p))

        return whole

    y = np.concatenate((initial.q, initial.p / initial.mass))
    # the package takes one step more between two samples than a step size asks for
    asked = max(request.steps - request.samples - 0.5, 0.5)
    parameters = Parameters(solver=request.method, step=request.until / asked)
    times = np.linspace(0, request.until, request.samples + 1)
    start = time.process_time()
    found = solve_ivp_symp(of_state(chi_potential), of_state(chi_potential_star), (0, request.until), y, times, parameters)
    seconds = time.process_time() - start
    return seconds, [(y[:half], y[half:] * initial.mass) for y in found.y.T[1:]]


serve(answer)
