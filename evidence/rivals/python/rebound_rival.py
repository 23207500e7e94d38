"""REBOUND by its Python package: the whole integration is one call into C."""

import time

import numpy as np
import rebound

from protocol import serve


def simulation(request, initial):
    sim = rebound.Simulation()
    if request.problem == "kepler":
        # a body without mass around one that rests
        sim.add(m=1.0)
        (x, y), (vx, vy) = initial.q, initial.p
        sim.add(m=0.0, x=x, y=y, vx=vx, vy=vy)
        sim.N_active = 1
    else:
        sim.G = initial.parameters[0]
        for m, (x, y, z), (vx, vy, vz) in bodies(initial):
            sim.add(m=m, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    return sim


def bodies(initial):
    return zip(initial.mass[::3], initial.q.reshape(-1, 3), (initial.p / initial.mass).reshape(-1, 3))


def choose(sim, request):
    """Sets the integrator; True if its steps are fixed."""
    name, *option = request.method.split("-")
    sim.integrator = name
    if name == "ias15":
        sim.integrator.epsilon = request.tolerance
        return False
    sim.dt = request.until / request.steps
    if name == "leapfrog":
        sim.integrator.order = int(option[0])
        return True
    sim.integrator.safe_mode = 0  # as the manual advises for speed
    if name == "whfast" and option:
        sim.integrator.corrector = int(option[0])
    if name == "saba":
        sim.integrator.type = option[0]
    if name == "eos":
        sim.integrator.phi0, sim.integrator.phi1, sim.integrator.n = option[0], option[1], int(option[2])
    return True


def state(sim, initial):
    particles = list(sim.particles)
    if len(initial.q) == 2:
        orbiting = particles[1]
        return [orbiting.x, orbiting.y], [orbiting.vx, orbiting.vy]
    q = np.array([particle.xyz for particle in particles]).ravel()
    return q, initial.mass * np.array([particle.vxyz for particle in particles]).ravel()


def answer(request, initial):
    sim = simulation(request, initial)
    fixed = choose(sim, request)
    seconds, states = 0.0, []
    for sample in range(1, request.samples + 1):
        start = time.process_time()
        if fixed:
            sim.steps(request.steps // request.samples)
            sim.synchronize()
        else:
            sim.integrate(request.until * sample / request.samples)
        seconds += time.process_time() - start
        states.append(state(sim, initial))
    return seconds, states


serve(answer)
