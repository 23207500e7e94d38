"""Planetary systems of REBOUND."""

from __future__ import annotations

import os
import warnings
from typing import Any, Union

import rebound

from ._shadowstep import InputError
from .arguments import check, path_of
from .problem import Problem


# Modules of REBOUND that compute the attraction of all point masses.
_ATTRACTIONS = ("basic", "compensated", "tree", "jacobi", "mercurius", "trace")

_FUNCTIONS = ("additional_forces", "pre_timestep_modifications", "post_timestep_modifications")


def problem(simulation: Union[Any, str, os.PathLike[str]], snapshot: int = -1, parts: str | None = "wisdom-holman", **others: Any) -> Problem:
    """The bodies of a simulation or of a snapshot of its archive as a `Problem`, with their very numbers.

    H is that of point masses with REBOUND's G, in the frame of the simulation. Bodies from ``N_active`` on that act on nothing are bodies of mass 0. Radii, the integrator and its
    step have no part in H; an integrator between two steps is synchronised, in a copy.

    Parameters
    ----------
    simulation
        A `rebound.Simulation`, or the path of an archive.
    snapshot
        Of an archive: the number of the snapshot, from 0, or from the end if it is negative.
    parts
        How H is split; None for T(p) and U(q).
    **others
        As of `Problem`.

    Raises
    ------
    InputError
        What H has not: softening, additional forces and modifications between steps, another attraction than that of all point masses, periodic and shearing boxes, bodies from
        ``N_active`` on that act on the others only; a body of mass 0 before one with mass, fewer than two bodies with mass, an archive that cannot be read.

    Warns
    -----
    UserWarning
        What the simulation has and the problem has not: a time other than 0, masses that act on nothing, collisions, open boundaries, distances that end the run, variational
        particles, differential equations of the user's own and a heartbeat.

    Examples
    --------
    >>> import rebound
    >>> simulation = rebound.Simulation()
    >>> simulation.add(m=1)
    >>> simulation.add(m=1e-3, a=1, e=0.1)
    >>> simulation.add(m=1e-3, a=2)
    >>> problem(simulation).dimension
    9
    """
    check(problem, locals())
    if not isinstance(simulation, rebound.Simulation):
        path = path_of(simulation, "simulation")
        try:
            simulation = rebound.Simulationarchive(path)[snapshot]
        except (RuntimeError, ValueError, IndexError, OSError) as error:
            raise InputError(f"{path}: snapshot {snapshot} of a REBOUND archive cannot be read: {error}") from error
    _refuse_other_forces(simulation)
    if not simulation.is_synchronized:
        simulation = simulation.copy()
        simulation.synchronize()
    particles = list(simulation.particles)[: getattr(simulation, "N_real", simulation.N)]
    masses, notes = _acting_masses(simulation, [particle.m for particle in particles])
    notes += _left_out(simulation)
    if notes:
        warnings.warn(f"of the simulation, the problem has not: {'; '.join(notes)}", stacklevel=2)
    bodies = [
        {"mass": mass, "q": [particle.x, particle.y, particle.z], "v": [particle.vx, particle.vy, particle.vz]} for mass, particle in zip(masses, particles)
    ]
    return Problem(parts=parts, body=bodies, parameters={"g": simulation.G}, **others)


def _refuse_other_forces(simulation: Any) -> None:
    """Refuses what moves the bodies besides the attraction of point masses."""
    if simulation.softening != 0:
        raise InputError(f"the simulation has a softening of {simulation.softening}: write the energy of two bodies as `pair`")
    functions = [name for name in _FUNCTIONS if getattr(simulation, f"_{name}")]
    if functions:
        raise InputError(f"the simulation has {functions[0]}, of which no energy is known: remove it, and write its energy as `external`")
    if simulation.gravity not in _ATTRACTIONS:
        raise InputError(f"the gravity of the simulation is {simulation.gravity!r}, not that of point masses: use 'basic'")
    if simulation.boundary not in ("none", "open") or any((simulation.N_ghost_x, simulation.N_ghost_y, simulation.N_ghost_z)):
        raise InputError(f"the simulation has the boundary {simulation.boundary!r} or ghost boxes, and bodies here move in open space: remove them")
    integrator = getattr(simulation.integrator, "name", simulation.integrator)
    if integrator in (b"sei", "sei"):
        raise InputError("the integrator of the simulation is 'sei', of a shearing sheet, whose H is another: use one for planets")


def _acting_masses(simulation: Any, masses: list[float]) -> tuple[list[float], list[str]]:
    """The masses that attract, which bodies from N_active on have only if they act on the others, and what is changed by that."""
    active = simulation.N_active
    if not 0 <= active < len(masses):
        return masses, []
    heavy = [i for i in range(active, len(masses)) if masses[i] != 0]
    if simulation.testparticle_type == 0:
        notes = [f"the masses of the particles {', '.join(map(str, heavy))}, which act on nothing from N_active = {active} on"] if heavy else []
        return [*masses[:active], *[0.0] * (len(masses) - active)], notes
    if len(heavy) > 1:
        raise InputError(
            f"the {len(heavy)} particles with mass from N_active = {active} on attract the others and not each other (testparticle_type = 1), "
            "which is no attraction of point masses: set testparticle_type = 0, or N_active = -1"
        )
    # one alone has nothing that it could fail to attract but particles of mass 0
    if heavy and len(masses) > active + 1:
        raise InputError(f"particle {heavy[0]} attracts the bodies before N_active = {active} and not the particles after (testparticle_type = 1): set N_active = {heavy[0] + 1}")
    return masses, []


def _left_out(simulation: Any) -> list[str]:
    """What the simulation has besides H, and the problem has not."""
    return [
        note
        for there, note in (
            (simulation.t != 0, f"t = {simulation.t}, which is t = 0 here"),
            (simulation.collision != "none", f"collisions ({simulation.collision!r})"),
            (simulation.boundary == "open", "the open boundary, which removes bodies"),
            (simulation.exit_max_distance or simulation.exit_min_distance, "the distances that end the run"),
            (simulation.N_var, f"{simulation.N_var} variational particles, in place of which there is `tangent`"),
            (simulation._N_odes, "differential equations of its own"),
            (simulation._heartbeat, "the heartbeat"),
        )
        if there
    ]
