"""Planetary systems of REBOUND, whose own integrator is the yardstick."""

import warnings

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
        with warnings.catch_warnings(record=True) as notes:
            warnings.simplefilter("always")
            found = problem(path, snapshot, parts=None)
        assert [str(note.message) for note in notes] == ([f"of the simulation, the problem has not: t = {t}, which is t = 0 here"] if t else [])
        run = shadowstep.integrate(found, "yoshida4", "1/100", steps=1)
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


# What becomes of each field of a simulation that REBOUND saves, and of its particles: a field of a new version is none of them.
MAPPED = "G N N_active testparticle_type is_synchronized _particles"
REFUSED = "softening N_ghost_x N_ghost_y N_ghost_z _additional_forces _pre_timestep_modifications _post_timestep_modifications _gravity _gravity_custom _boundary integrator"
NOTED = "t N_var _particles_var N_var_config var_config _collision exit_max_distance exit_min_distance _odes _N_odes _N_allocated_odes _heartbeat"
# with the boundary and the integrator that are refused, collisions that are noted, forces that are refused, or without any part in the motion
NO_PART = {
    "of the shearing sheet": "OMEGA OMEGAZ",
    "of boxes": "root_size N_root_x N_root_y N_root_z",
    "of collisions": "collisions N_allocated_collisions N_collisions N_targets minimum_collision_velocity collisions_plog collisions_log_n _coefficient_of_restitution _collision_resolve",
    "of additional forces": "force_is_velocity_dependent extras _extras_cleanup _free_particle_ap",
    "of variational particles": "_calculate_megno _megno_Ys _megno_Yss _megno_cov_Yt _megno_var_t _megno_mean_t _megno_mean_Y _megno_initial_t _megno_n _messages_var_rescale_warning",
    "of how attraction and steps are computed": "dt dt_last_done steps_done did_modify_particles gravity_cs N_allocated_gravity_cs _tree_root opening_angle2 gravity_ignore exact_finish_time "
    "testparticle_hidewarnings",
    "of names": "_N_map _map _name_list _N_name_list _name_hash_table",
    "of the program": "N_allocated _status _output_timing_last save_messages messages _messages_timestep_warning usleep _display_view _display_data _server_data track_energy_offset energy_offset "
    "walltime walltime_last_step walltime_last_steps _walltime_last_steps_sum _walltime_last_steps_N python_unit_t python_unit_l python_unit_m rand_seed simulationarchive_version "
    "simulationarchive_auto_interval simulationarchive_auto_walltime simulationarchive_auto_step simulationarchive_next simulationarchive_next_step _simulationarchive_filename _key_callback",
}
OF_PARTICLES = {"mapped": "x y z vx vy vz m", "no part": "ax ay az r _name ap _sim"}


@pytest.mark.skipif(not rebound.__version__.startswith("5."), reason="other versions have other fields")
def test_each_field_is_mapped_refused_or_noted():
    known = " ".join([MAPPED, REFUSED, NOTED, *NO_PART.values()]).split()
    assert sorted(known) == sorted(name for name, *_ in rebound.Simulation._fields_)
    assert sorted(" ".join(OF_PARTICLES.values()).split()) == sorted(name for name, *_ in rebound.Particle._fields_)


def set_field(name, value):
    def change(simulation):
        setattr(simulation, name, value)

    return change


def with_ghosts(simulation):
    simulation.N_ghost_x = 1


@pytest.mark.parametrize(
    "change, sentence",
    [
        (set_field("softening", 0.1), "softening of 0.1"),
        (set_field("additional_forces", lambda simulation: None), "has additional_forces, of which no energy is known"),
        (set_field("pre_timestep_modifications", lambda simulation: None), "has pre_timestep_modifications"),
        (set_field("post_timestep_modifications", lambda simulation: None), "has post_timestep_modifications"),
        (set_field("gravity", "none"), "the gravity of the simulation is 'none'"),
        (set_field("boundary", "periodic"), "the boundary 'periodic'"),
        (set_field("boundary", "shear"), "the boundary 'shear'"),
        (set_field("integrator", "sei"), "the integrator of the simulation is 'sei'"),
        (with_ghosts, "ghost boxes"),
    ],
)
def test_what_h_has_not_is_refused(change, sentence):
    simulation = system()
    change(simulation)
    with pytest.raises(shadowstep.InputError, match=sentence):
        problem(simulation)


@pytest.mark.parametrize(
    "change, note",
    [
        (set_field("t", 12.5), "t = 12.5, which is t = 0 here"),
        (set_field("collision", "direct"), "collisions ('direct')"),
        (set_field("boundary", "open"), "the open boundary"),
        (set_field("exit_max_distance", 9.0), "the distances that end the run"),
        (set_field("exit_min_distance", 0.1), "the distances that end the run"),
        (set_field("heartbeat", lambda simulation: None), "the heartbeat"),
        (lambda simulation: simulation.add_variation(), "variational particles"),
        (lambda simulation: simulation.create_ode(length=1), "differential equations of its own"),
    ],
)
def test_what_the_problem_has_not_is_noted(change, note):
    simulation = system()
    change(simulation)
    with pytest.warns(UserWarning) as notes:
        found = problem(simulation)
    assert note in str(notes[0].message) and found.dimension == 9
    assert found.energy == problem(system()).energy


def test_masses_that_act_on_nothing_are_0():
    """In REBOUND a third body of 0.05 with N_active = 2 leaves the others alone; with all active it does not."""
    simulation = rebound.Simulation()
    simulation.add(m=1)
    simulation.add(m=1e-3, a=1, e=0.1)
    simulation.add(m=0.05, a=2.5, e=0.2, f=1)
    ends = {}
    for active in (2, 3):
        simulation.N_active = active
        with warnings.catch_warnings(record=True) as notes:
            warnings.simplefilter("always")
            run = shadowstep.integrate(problem(simulation, parts=None), "kahan-li8", "1/100", until=60, every=6000)
        assert [("N_active = 2" in str(note.message)) for note in notes] == ([True] if active == 2 else [])
        copied = simulation.copy()
        copied.integrator = "ias15"
        copied.integrate(60, exact_finish_time=1)
        ends[active] = run.q[-1]
        # both are right to some 1e-12
        assert np.abs(run.q[-1] - np.ravel([particle.xyz for particle in copied.particles])).max() < 1e-9
    assert np.abs(ends[2] - ends[3]).max() > 0.1


def test_bodies_that_attract_the_others_only_are_refused_unless_that_is_the_same():
    simulation = system()
    simulation.testparticle_type = 1
    simulation.N_active = 2
    expected = problem(system()).energy
    assert problem(simulation).energy == expected  # one body has no other of its kind
    simulation.N_active = 1
    with pytest.raises(shadowstep.InputError, match="attract the others and not each other"):
        problem(simulation)
    simulation.N_active = 2
    simulation.add(a=5)
    with pytest.raises(shadowstep.InputError, match="set N_active = 3"):
        problem(simulation)


def test_a_state_between_two_steps_is_synchronised(tmp_path):
    """Without it WHFast's particles are half a step away."""
    path = str(tmp_path / "archive.bin")

    def run(safe_mode):
        simulation = system()
        simulation.integrator = "whfast"
        simulation.integrator.safe_mode = safe_mode
        simulation.dt = 0.05
        return simulation

    simulation = run(0)
    simulation.save_to_file(path, interval=0.1)
    simulation.integrate(0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # REBOUND's own, and the time
        between = rebound.Simulationarchive(path)[2]
        assert not between.is_synchronized
        found = problem(path, 2, parts=None)
    whole = run(1)
    whole.integrate(between.t)
    expected = [x for particle in whole.particles for x in particle.xyz]
    moved = [x for particle in between.particles for x in particle.xyz]
    assert np.abs(found.initial[0] - expected).max() < 1e-13 < 1e-4 < np.abs(np.subtract(moved, expected)).max()
