"""Planetary systems of REBOUND, whose own integrator is the yardstick."""

import numpy as np
import pytest

import shadowstep

rebound = pytest.importorskip("rebound")
from shadowstep.rebound import problem  # noqa: E402


def system():
    simulation = rebound.Simulation()
    simulation.add(m=1)
    simulation.add(m=1e-3, a=1, e=0.1, inc=0.2, f=1)
    simulation.add(m=3e-4, a=2.1, e=0.05, Omega=2, f=3)
    simulation.move_to_com()
    return simulation


@pytest.mark.parametrize("parts", ["wisdom-holman", "wisdom-holman-heliocentric", None])
def test_the_bodies_move_as_in_rebound(parts):
    simulation = system()
    run = shadowstep.integrate(problem(simulation, parts=parts), "kahan-li8", "1/100", steps=1000, every=1000)
    simulation.integrator = "ias15"
    simulation.integrate(10, exact_finish_time=1)
    for i, particle in enumerate(simulation.particles):
        # both are right to some 1e-13
        assert np.allclose(run.q[-1, 3 * i : 3 * i + 3], particle.xyz, rtol=0, atol=1e-11)
        assert np.allclose(run.p[-1, 3 * i : 3 * i + 3], particle.m * np.array(particle.vxyz), rtol=0, atol=1e-11)


@pytest.mark.parametrize("parts", ["wisdom-holman", "wisdom-holman-heliocentric", None])
def test_particles_of_mass_0_move_as_in_rebound(parts):
    simulation = system()
    simulation.N_active = simulation.N
    alone = shadowstep.integrate(problem(simulation, parts=parts), "kahan-li8", "1/100", steps=1000, every=1000)
    for a in [0.3, 1.5, 4]:
        simulation.add(a=a, e=0.1, inc=0.3, f=a)
    run = shadowstep.integrate(problem(simulation, parts=parts), "kahan-li8", "1/100", steps=1000, every=1000)
    assert (run.q[:, :9] == alone.q).all() and (run.p[:, :9] == alone.p).all() and (run.energy == alone.energy).all()
    simulation.integrator = "ias15"
    simulation.integrate(10, exact_finish_time=1)
    for i in range(3, 6):
        particle = simulation.particles[i]
        # momenta are velocities; a step is a fortieth of the innermost revolution
        assert np.allclose(run.q[-1, 3 * i : 3 * i + 3], particle.xyz, rtol=0, atol=1e-6)
        assert np.allclose(run.p[-1, 3 * i : 3 * i + 3], particle.vxyz, rtol=0, atol=1e-5)


def test_a_snapshot_of_an_archive_has_its_very_numbers(tmp_path):
    simulation, path = system(), tmp_path / "archive.bin"
    simulation.save_to_file(str(path))
    simulation.integrate(3)
    simulation.save_to_file(str(path))
    for snapshot, t in [(0, 0), (-1, simulation.t)]:
        expected = rebound.Simulationarchive(str(path))[snapshot]
        assert expected.t == t
        run = shadowstep.integrate(problem(path, snapshot, parts=None), "yoshida4", "1/100", steps=1)
        assert run.q[0].tolist() == [x for particle in expected.particles for x in particle.xyz]
    with pytest.raises(shadowstep.InputError, match="snapshot 7 of a REBOUND archive cannot be read"):
        problem(path, 7)


def test_other_simulations_are_refused():
    simulation = system()
    simulation.add(a=5)
    simulation.add(m=1e-3, a=7)
    with pytest.raises(shadowstep.InputError, match="a body of mass 0 is before a body with mass"):
        problem(simulation)
    simulation = system()
    simulation.softening = 0.1
    with pytest.raises(shadowstep.InputError, match="softening of 0.1"):
        problem(simulation)
