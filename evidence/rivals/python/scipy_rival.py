"""scipy's DOP853, its explicit method of highest order. The absolute tolerance is the relative one times the size of the state."""

import time

import numpy as np
from scipy.integrate import solve_ivp

from gradients import GRADIENTS
from protocol import serve


def answer(request, initial):
    gradient, half = GRADIENTS[request.problem], len(initial.q)

    def right_side(_, y):
        if half == 2:
            gx, gy = gradient(y[:2].tolist(), initial)
            return y[2], y[3], -gx, -gy
        return np.concatenate((y[half:] / initial.mass, -np.asarray(gradient(y[:half], initial))))

    y = np.concatenate((initial.q, initial.p))
    size = np.repeat([np.abs(initial.q).max(), np.abs(initial.p).max()], half)
    size[size == 0] = 1
    tolerances = dict(rtol=request.tolerance, atol=request.tolerance * size)
    times = np.linspace(0, request.until, request.samples + 1)[1:]
    start = time.process_time()
    found = solve_ivp(right_side, (0, request.until), y, method="DOP853", t_eval=times, **tolerances)
    seconds = time.process_time() - start
    return seconds, [(y[:half], y[half:]) for y in found.y.T]


serve(answer)
