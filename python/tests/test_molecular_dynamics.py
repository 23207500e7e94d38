"""What of ASE's and OpenMM's systems the modified energy takes, refuses, or has nothing to do with; and runs with steps that are far too large."""

import inspect

import numpy as np
import pytest

from shadowstep import InputError

MASSES = 6 * [39.948]


def argon(timestep, calculator=None, temperature=150, pbc=True, **options):
    """Eight atoms of argon in a small box, or a bound cluster of them, and their dynamics; the time step in fs."""
    ase = pytest.importorskip("ase")
    from ase import units
    from ase.calculators.lj import LennardJones
    from ase.md.verlet import VelocityVerlet

    q = 3.9 * np.stack(np.meshgrid(*3 * [range(2)], indexing="ij"), axis=-1).reshape(-1, 3)
    atoms = ase.Atoms("Ar8", positions=q, cell=3 * [7.8], pbc=pbc, **options)
    atoms.calc = calculator or LennardJones(sigma=3.4, epsilon=0.0103, rc=3.8 if pbc else 12, smooth=True, ro=3.0 if pbc else 10)
    atoms.set_momenta(np.random.default_rng(1).standard_normal((8, 3)) * np.sqrt(39.948 * temperature * units.kB))
    return atoms, VelocityVerlet(atoms, timestep=timestep * units.fs)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("is_periodic", [True, False])
@pytest.mark.parametrize("timestep", [150, 300, 1e3, 1e4, 1e6])
def test_ase_with_steps_that_are_far_too_large_runs_to_its_end(timestep, is_periodic):
    from shadowstep.ase import ShadowMonitor

    atoms, dynamics = argon(timestep, temperature=150 if is_periodic else 10, pbc=is_periodic)
    monitor = ShadowMonitor(atoms, dynamics)
    dynamics.run(60)
    assert dynamics.nsteps == 60
    found = monitor.diagnosis()
    assert found.cause == "time-step", str(found)
    assert found.reason in str(found) and "time step is too large" in found.reason


def test_ase_where_something_else_moves_the_atoms_it_is_not_the_time_step():
    from shadowstep.ase import ShadowMonitor

    atoms, dynamics = argon(2)
    monitor = ShadowMonitor(atoms, dynamics)
    dynamics.run(20)
    atoms.positions[3] += 3.5
    dynamics.run(20)
    found = monitor.diagnosis()
    assert found.cause in ("undecided", "other-steps", "jumps", "time-step") and dynamics.nsteps == 40
    assert "state 21" in found.reason and "moved by" in found.reason


def test_ase_a_calculator_without_forces_is_refused_before_the_run():
    from ase.calculators.calculator import Calculator

    from shadowstep.ase import ShadowMonitor

    atoms, dynamics = argon(2, calculator=Calculator())
    with pytest.raises(InputError, match="the calculator of the atoms gives no energy and forces"):
        ShadowMonitor(atoms, dynamics)


def test_ase_each_part_of_atoms_is_mapped_refused_or_without_a_part():
    pytest.importorskip("ase")
    import ase.constraints
    from ase.md.verlet import VelocityVerlet

    from shadowstep.ase import ShadowMonitor

    atoms, dynamics = argon(2, tags=range(8), magmoms=8 * [0], charges=8 * [0], masses=8 * [39.948], info={"a": 1}, celldisp=[0, 0, 0])
    fates = {
        "mapped": "arrays _calc _cellobj _pbc",
        "refused, or mapped of atoms that are held": "_constraints",
        "no part in the motion": "_celldisp info",
    }
    of_arrays = {"mapped": "positions momenta masses", "no part: the calculator has its own use of them": "numbers tags initial_magmoms initial_charges"}
    of_dynamics = {"mapped": "atoms dt nsteps", "no part": "_master _orig_trajectory comm logfile masses max_steps observers trajectory"}
    for known, found in ((fates, vars(atoms)), (of_arrays, atoms.arrays), (of_dynamics, vars(dynamics))):
        assert sorted(" ".join(known.values()).split()) == sorted(found)
    assert set(inspect.signature(VelocityVerlet.__init__).parameters) == {"self", "atoms", "timestep", "trajectory", "logfile", "loginterval", "kwargs"}
    # all constraints of this and later versions but one are refused
    constraints = [name for name in ase.constraints.__all__ if inspect.isclass(getattr(ase.constraints, name))]
    assert "FixAtoms" in constraints and len(constraints) > 10
    for name in set(constraints) - {"FixAtoms"}:
        kind = getattr(ase.constraints, name)
        atoms._constraints = [object.__new__(kind)]
        with pytest.raises(InputError, match=f"the atoms have {name}, with which the steps are no velocity Verlet"):
            ShadowMonitor(atoms, dynamics)


def particles(forces=(), masses=MASSES, femtoseconds=5.0, change=None):
    """Six particles in OpenMM with a bond between each two that follow."""
    openmm = pytest.importorskip("openmm")
    from openmm import app, unit

    system, topology = openmm.System(), app.Topology()
    chain, bonds = topology.addChain(), openmm.HarmonicBondForce()
    for i, mass in enumerate(masses):
        system.addParticle(mass)
        topology.addAtom("Ar", app.Element.getBySymbol("Ar"), topology.addResidue("Ar", chain))
        if i:
            bonds.addBond(i - 1, i, 0.35, 1e4)
    for force in (bonds, *forces):
        system.addForce(force)
    integrator = openmm.VerletIntegrator(femtoseconds * unit.femtosecond)
    if change:
        change(system, integrator)
    simulation = app.Simulation(topology, system, integrator, openmm.Platform.getPlatformByName("Reference"))
    simulation.context.setPositions([[0.36 * i, 0.01 * i * i, 0] for i in range(len(masses))])
    return simulation


@pytest.mark.parametrize("femtoseconds", [200.0, 1e3, 1e5])
def test_openmm_with_steps_that_are_far_too_large_says_so(femtoseconds):
    from shadowstep.openmm import ShadowReporter

    simulation = particles(femtoseconds=femtoseconds)
    reporter = ShadowReporter(simulation)
    simulation.reporters.append(reporter)
    try:
        simulation.step(60)
    except Exception as error:  # noqa: BLE001
        # OpenMM itself stops a run whose positions are not finite
        assert "NaN" in str(error), error
    assert reporter.diagnosis().cause == "time-step", str(reporter.diagnosis())


WITH_AN_ENERGY = """
    ATMForce AmoebaGeneralizedKirkwoodForce AmoebaMultipoleForce AmoebaTorsionTorsionForce AmoebaVdwForce AmoebaWcaDispersionForce CMAPTorsionForce ConstantPotentialForce
    CustomAngleForce CustomBondForce CustomCVForce CustomCentroidBondForce CustomCompoundBondForce CustomExternalForce CustomGBForce CustomHbondForce CustomManyParticleForce
    CustomNonbondedForce CustomTorsionForce CustomVolumeForce DrudeForce GBSAOBCForce GayBerneForce HarmonicAngleForce HarmonicBondForce HippoNonbondedForce LCPOForce
    NonbondedForce OrientationRestraintForce PeriodicTorsionForce PythonForce RBTorsionForce RGForce RMSDForce
"""


def test_openmm_each_force_has_an_energy_or_is_refused():
    openmm = pytest.importorskip("openmm")
    from shadowstep.openmm import _OTHER, ShadowReporter

    def kinds(of):
        own = [kind for kind in of.__subclasses__() if kind.__module__ == of.__module__]
        return {of.__name__} | {name for kind in own for name in kinds(kind)}

    # a force of a new version is in neither list
    assert kinds(openmm.Force) - {"Force"} <= {*WITH_AN_ENERGY.split(), *_OTHER}
    assert {name for name in dir(openmm.System) if name.startswith(("get", "is", "uses"))} == {
        *("getForce", "getForces", "getNumForces"),  # each has an energy or is refused
        *("getNumParticles", "getParticleMass"),  # mapped; those of mass 0 do not move
        *("getNumConstraints", "getConstraintParameters", "isVirtualSite", "getVirtualSite"),  # refused
        *("getDefaultPeriodicBoxVectors", "usesPeriodicBoundaryConditions"),  # no part: positions are not wrapped
    }
    for force, name in (
        (openmm.AndersenThermostat(100, 1), "AndersenThermostat"),
        (openmm.CMMotionRemover(), "CMMotionRemover"),
    ):
        with pytest.raises(InputError, match=name):
            ShadowReporter(particles([force]))


def test_openmm_constraints_virtual_sites_and_forces_that_are_left_out_are_refused():
    openmm = pytest.importorskip("openmm")
    from shadowstep.openmm import ShadowReporter

    def of_a_group(system, integrator):
        system.getForce(0).setForceGroup(2)
        integrator.setIntegrationForceGroups({0, 1})

    def with_a_site(system, integrator):
        system.setParticleMass(5, 0)
        system.setVirtualSite(5, openmm.TwoParticleAverageSite(0, 1, 0.5, 0.5))

    for change, sentence in (
        (lambda system, integrator: system.addConstraint(0, 1, 0.36), "the system has 1 constraints"),
        (with_a_site, "virtual sites"),
        (of_a_group, "leaves out the forces of group 2"),
    ):
        with pytest.raises(InputError, match=sentence):
            ShadowReporter(particles(change=change))
    with pytest.raises(InputError, match="all particles have mass 0"):
        ShadowReporter(particles(masses=6 * [0]))
    with pytest.raises(InputError, match=r"simulation must be an openmm\.app\.Simulation, not int"):
        ShadowReporter(3)
