"""The modified energy of other programs' trajectories: arrays, ASE and OpenMM."""

import numpy as np
import pytest

import shadowstep
from shadowstep import InputError, Problem, diagnose, integrate, shadow_energy

KEPLER = Problem("kepler", eccentricity="1/5")


def orbit(scheme="stormer-verlet", h=0.05, steps=200):
    return integrate(KEPLER, scheme, h=h, steps=steps, estimator="bilinear", order=8)


def kepler(q):
    """U and the forces."""
    r = np.linalg.norm(q, axis=1)
    return -1 / r, -q / r[:, None] ** 3


def test_a_log_gives_the_values_of_the_run():
    run = orbit()
    energies, forces = kepler(run.q)
    values, errors = shadow_energy(run.q, run.p, (energies, forces), h=0.05)
    inside = ~np.isnan(values)
    # E_8 with its error needs 8 states on either side
    assert inside.sum() == 201 - 16 and inside[8] and not inside[7]
    assert np.allclose(values[inside], run.modified_energy[inside], rtol=0, atol=1e-13)
    # round-off of the steps moves H̄ of the run itself
    moved = np.ptp(run.modified_energy[inside])
    assert np.all(np.abs(values[inside] - values[8]) <= moved + 3 * errors[8:193].max())
    # for U = −1/r the rate qᵀU_q − 2U is −3U
    of_rates, _ = shadow_energy(run.q, run.p, (energies, -3 * energies), h=0.05)
    assert np.allclose(values[inside], of_rates[inside], rtol=0, atol=1e-12)


@pytest.mark.parametrize("scheme", ["stormer-verlet", "yoshida4"])
def test_steps_that_are_made_again_give_the_bits_of_the_run(scheme):
    run = orbit(scheme)
    values, _ = shadow_energy(run.q, run.p, KEPLER, h=0.05, scheme=scheme)
    assert np.array_equal(values[8:193], run.modified_energy[8:193])


def test_momenta_at_half_steps_are_converted():
    run = orbit()
    energies, forces = kepler(run.q)
    expected, _ = shadow_energy(run.q, run.p, (energies, forces), h=0.05)
    half_steps = run.p - 0.025 * forces
    found, _ = shadow_energy(run.q, half_steps, (energies, forces), h=0.05, half_steps=True)
    assert np.allclose(found[8:193], expected[8:193], rtol=0, atol=1e-13)
    rows = np.vstack([half_steps, run.p[-1] + 0.025 * forces[-1]])
    found, _ = shadow_energy(run.q, rows, KEPLER, h=0.05, half_steps=True)
    assert np.allclose(found[8:193], expected[8:193], rtol=0, atol=1e-13)


def test_what_does_not_fit_is_refused():
    run = orbit(steps=30)
    energies, forces = kepler(run.q)
    with pytest.raises(InputError, match="30 states of 2 numbers are 60"):
        shadow_energy(run.q, run.p, (energies[:-1], forces), h=0.05)
    with pytest.raises(InputError, match="mass of coordinate 1 is -1"):
        shadow_energy(run.q, run.p, (energies, forces), h=0.05, masses=[1, -1])
    with pytest.raises(InputError, match="nonzero"):
        shadow_energy(run.q, run.p, (energies, forces), h=0)
    with pytest.raises(InputError, match=r"window = 12 is not known\s+hint: a window has 9 or 17 states"):
        diagnose(run.q, run.p, (energies, forces), h=0.05, window=12)
    with pytest.raises(InputError, match="31, 31, 30 and 31 states"):
        diagnose(run.q, run.p, (energies[:-1], forces), h=0.05)
    with pytest.raises(InputError, match="which image it came to is not decided"):
        shadow_energy(np.zeros((2, 3)) + [[0.0], [3.0]], np.zeros((2, 3)), (np.zeros(2), np.zeros((2, 3))), h=1, cell=[8, 8, 8])


def test_states_of_other_steps_are_warned_of():
    run = orbit()
    energies, forces = kepler(run.q)
    half_steps = run.p - 0.025 * forces
    wrong = {"undeclared momenta of leapfrog": (half_steps, 0.05, 1.0), "another step size": (run.p, 0.0501, 1.0), "velocities": (run.p, 0.05, 2.0)}
    for what, (p, h, mass) in wrong.items():
        with pytest.warns(UserWarning, match="not those of velocity Verlet"):
            shadow_energy(run.q, p, (energies, forces), h=h, masses=mass)
        assert diagnose(run.q, p, (energies, forces), h=h, masses=mass).cause == "other-steps", what


def test_numbers_that_are_not_finite_have_their_place():
    q, p, forces = np.zeros((60, 4, 3)), np.zeros((60, 4, 3)), np.zeros((60, 4, 3))
    forces[50, 3, 1] = np.nan
    for call in (shadow_energy, diagnose):
        with pytest.raises(InputError, match="the gradient of state 50 is NaN at coordinate 10: y of particle 3"):
            call(q, p, (np.zeros(60), forces), h=1)
    with pytest.raises(InputError, match="a diagnosis needs forces"):
        diagnose(q, p, (np.zeros(60), np.zeros(60)), h=1)


def argon(calculator, temperature=150):
    """108 atoms of a crystal, some of them on their way."""
    build = pytest.importorskip("ase.lattice.cubic")
    from ase.md.velocitydistribution import Stationary, thermalize_momenta

    atoms = build.FaceCenteredCubic("Ar", size=(3, 3, 3), latticeconstant=5.5, pbc=True)
    thermalize_momenta(atoms, temperature, rng=np.random.default_rng(1))
    Stationary(atoms)
    atoms.calc = calculator
    return atoms


def lennard_jones(**settings):
    lj = pytest.importorskip("ase.calculators.lj")

    class Noisy(lj.LennardJones):
        noise = 0.0
        random = np.random.default_rng(2)

        def calculate(self, *arguments, **keywords):
            super().calculate(*arguments, **keywords)
            forces = self.results["forces"]
            self.results["forces"] = forces + self.noise * self.random.normal(size=forces.shape)

    return Noisy(sigma=3.4, epsilon=0.0104, rc=7.5, **settings)


def followed(atoms, femtoseconds=5.0, steps=120, every=1, window=17):
    from ase import units
    from ase.md.verlet import VelocityVerlet

    from shadowstep.ase import ShadowMonitor

    dyn = VelocityVerlet(atoms, femtoseconds * units.fs)
    monitor = ShadowMonitor(atoms, dyn, every=every, window=window)
    dyn.run(steps)
    return monitor


def test_ase_in_order():
    monitor = followed(argon(lennard_jones(smooth=True)))
    found = monitor.diagnosis()
    assert (found.cause, found.states, found.estimates) == ("nothing", 121, 105), str(found)
    # the steps are those of velocity Verlet to round-off
    assert found.off_q < 1e-9 and found.off_p < 1e-9, str(found)
    values = monitor.values
    assert np.ptp(values["modified_energy"]) < 0.01 * np.ptp(values["energy"])


def test_ase_with_noise():
    calculator = lennard_jones(smooth=True)
    calculator.noise = 1e-3
    for found in (followed(argon(calculator)).diagnosis(), followed(argon(calculator), steps=400, every=12, window=9).diagnosis()):
        assert found.cause == "noise" and abs(found.size / 1e-3 - 1) < 0.05, str(found)


def test_ase_with_a_time_step_that_is_too_large():
    found = followed(argon(lennard_jones(smooth=True)), femtoseconds=50, steps=200).diagnosis()
    # a cutoff may hide in it
    assert found.cause == "undecided" and "steps of half the size tell these apart" in str(found), str(found)


def test_ase_windows_and_emt():
    build, emt = pytest.importorskip("ase.build"), pytest.importorskip("ase.calculators.emt")
    from ase.md.velocitydistribution import thermalize_momenta

    atoms = build.bulk("Cu", cubic=True)
    thermalize_momenta(atoms, 300, rng=np.random.default_rng(1))
    atoms.calc = emt.EMT()
    monitor = followed(atoms, femtoseconds=2, steps=400, every=50)
    assert monitor.values["n"].tolist() == list(range(8, 400, 50))
    assert np.ptp(monitor.values["modified_energy"]) < 0.01 * np.ptp(monitor.values["energy"])


def test_ase_with_fixed_atoms_wrapped_positions_and_units():
    constraints = pytest.importorskip("ase.constraints")
    from ase import units
    from ase.md.verlet import VelocityVerlet

    from shadowstep.ase import ShadowMonitor

    atoms = argon(lennard_jones(smooth=True))
    atoms.set_constraint(constraints.FixAtoms(range(36)))

    class Wrapped(VelocityVerlet):
        """The same steps."""

    dyn = Wrapped(atoms, 5 * units.fs)
    monitor = ShadowMonitor(atoms, dyn)
    dyn.attach(atoms.wrap, interval=7)
    dyn.run(120)
    found = monitor.diagnosis()
    assert found.cause == "nothing" and found.off_q < 1e-9, str(found)
    assert np.ptp(monitor.values["modified_energy"]) < 0.01 * np.ptp(monitor.values["energy"])
    assert " eV, " in found.reason and " in 520.00 fs" in found.reason, found.reason


def test_ase_what_has_no_modified_energy_is_refused():
    langevin = pytest.importorskip("ase.md.langevin")
    from ase import units
    from ase.constraints import FixBondLengths
    from ase.md.verlet import VelocityVerlet

    from shadowstep.ase import ShadowMonitor

    atoms = argon(lennard_jones(smooth=True))
    with pytest.raises(InputError, match="the dynamics are Langevin"):
        ShadowMonitor(atoms, langevin.Langevin(atoms, units.fs, temperature_K=100, friction=0.01))

    class Other(VelocityVerlet):
        def step(self, forces=None):
            return super().step(forces)

    with pytest.raises(InputError, match="the dynamics are Other"):
        ShadowMonitor(atoms, Other(atoms, units.fs))
    atoms.set_constraint(FixBondLengths([(0, 1)]))
    with pytest.raises(InputError, match="the atoms have FixBondLengths"):
        ShadowMonitor(atoms, VelocityVerlet(atoms, units.fs))


def fluid(platform, integrator=None, femtoseconds=5, others=(), fixed=()):
    """108 atoms of argon in OpenMM, with a force that is smooth at the cutoff."""
    openmm = pytest.importorskip("openmm")
    from openmm import app, unit

    atoms = argon(None)
    system = openmm.System()
    side = atoms.cell.lengths()[0] / 10
    system.setDefaultPeriodicBoxVectors(*(np.eye(3) * side))
    force = openmm.CustomNonbondedForce("4*0.996*((0.34/r)^12-(0.34/r)^6)")
    force.setNonbondedMethod(openmm.CustomNonbondedForce.CutoffPeriodic)
    force.setCutoffDistance(0.75)
    force.setUseSwitchingFunction(True)
    force.setSwitchingDistance(0.5)
    topology = app.Topology()
    chain = topology.addChain()
    for i, mass in enumerate(atoms.get_masses()):
        system.addParticle(0 if i in fixed else mass)
        force.addParticle([])
        topology.addAtom("Ar", app.Element.getBySymbol("Ar"), topology.addResidue("Ar", chain))
    for other in (force, *others):
        system.addForce(other)
    integrator = integrator or openmm.VerletIntegrator(femtoseconds * unit.femtosecond)
    simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName(platform))
    simulation.context.setPositions(atoms.positions / 10)
    simulation.context.setVelocitiesToTemperature(150, 1)
    return simulation


@pytest.mark.parametrize("platform", ["Reference", "CPU"])
def test_openmm_in_order(platform):
    from_openmm = pytest.importorskip("shadowstep.openmm")
    simulation = fluid(platform)
    reporter = from_openmm.ShadowReporter(simulation)
    simulation.reporters.append(reporter)
    simulation.step(400)
    found = reporter.diagnosis()
    assert (found.cause, found.states) == ("nothing", 400), str(found)
    # leapfrog to the round-off of the program: double and single precision
    assert max(found.off_q, found.off_p) < (1e-9 if platform == "Reference" else 1e-3), str(found)


def test_openmm_with_particles_that_do_not_move():
    from_openmm = pytest.importorskip("shadowstep.openmm")
    simulation = fluid("Reference", fixed=range(30))
    reporter = from_openmm.ShadowReporter(simulation)
    simulation.reporters.append(reporter)
    simulation.step(200)
    found = reporter.diagnosis()
    assert found.cause == "nothing" and max(found.off_q, found.off_p) < 1e-9, str(found)
    assert "kJ/mol" in found.reason and " ps" in found.reason


def test_openmm_windows():
    from_openmm = pytest.importorskip("shadowstep.openmm")
    simulation = fluid("Reference")
    reporter = from_openmm.ShadowReporter(simulation, every=100)
    simulation.reporters.append(reporter)
    simulation.step(400)
    # OpenMM does not report the state 0, so that the first window is a state short
    assert reporter.values["n"].tolist() == [108, 208, 308]


def made(scheme, femtoseconds, **options):
    """A CustomIntegrator from the emitted module of a scheme."""
    from openmm import unit

    module = {"__name__": "emitted"}
    exec(shadowstep.Scheme(scheme).emit("openmm"), module)
    return module["make_integrator"](femtoseconds * unit.femtosecond, **options)


@pytest.mark.parametrize("scheme, femtoseconds", [("stormer-verlet", 5), ("pefrl", 10), ("symplectic-euler", 5)])
def test_openmm_with_emitted_integrators(scheme, femtoseconds):
    """The modified energy is conserved to a small part of the energy error."""
    from_openmm = pytest.importorskip("shadowstep.openmm")
    runs = {}
    for increments in (True, False):
        simulation = fluid("Reference", made(scheme, femtoseconds, increments=increments))
        if increments:
            reporter = from_openmm.ShadowReporter(simulation)
            simulation.reporters.append(reporter)
        simulation.step(200)
        runs[increments] = simulation.context.getState(getPositions=True).getPositions(asNumpy=True)._value
    # the sums change no bit of the states
    assert (runs[True] == runs[False]).all()
    found = reporter.diagnosis()
    assert found.cause == "nothing" and max(found.off_q, found.off_p) < 1e-9, str(found)
    values = reporter.values
    assert np.ptp(values["modified_energy"]) < 0.05 * np.ptp(values["energy"])


def test_openmm_verlet_with_increments_has_the_values_of_velocity_verlet():
    from_openmm = pytest.importorskip("shadowstep.openmm")
    found = []
    for integrator in (made("stormer-verlet", 5, increments=True), None):
        simulation = fluid("Reference", integrator)
        if integrator is None:
            # leapfrog begins half a step before
            state = simulation.context.getState(getVelocities=True, getForces=True)
            forces, masses = state.getForces(asNumpy=True)._value, np.array([simulation.system.getParticleMass(i)._value for i in range(108)])
            simulation.context.setVelocities(state.getVelocities(asNumpy=True)._value - 0.0025 * forces / masses[:, None])
        reporter = from_openmm.ShadowReporter(simulation)
        simulation.reporters.append(reporter)
        simulation.step(60)
        found.append(reporter.values["modified_energy"])
    # two orders of the same sums, in kJ/mol, over 60 chaotic steps
    assert np.abs(found[0] - found[1]).max() < 1e-8


def test_openmm_what_has_no_modified_energy_is_refused():
    openmm = pytest.importorskip("openmm")
    from shadowstep.openmm import ShadowReporter

    with pytest.raises(InputError, match="the integrator is LangevinMiddleIntegrator"):
        ShadowReporter(fluid("Reference", openmm.LangevinMiddleIntegrator(100, 1, 0.001)))
    with pytest.raises(InputError, match=r"the integrator is CustomIntegrator: .*make_integrator\(step_size, increments=True\)"):
        ShadowReporter(fluid("Reference", made("pefrl", 5)))
    with pytest.raises(InputError, match=r"CMMotionRemover.*createSystem\(removeCMMotion=False\)"):
        ShadowReporter(fluid("Reference", others=[openmm.CMMotionRemover()]))


def test_all_are_exported():
    assert shadowstep.Observer([1.0], h="1/10").window == 17
    assert shadowstep.Observer([1.0], h="1/10", window=9).window == 9
