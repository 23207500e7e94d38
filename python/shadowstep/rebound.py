"""Planetary systems of REBOUND."""

from __future__ import annotations

import os
from typing import Any, Union

import rebound

from ._shadowstep import InputError
from .problem import Problem


def problem(simulation: Union[Any, str, os.PathLike[str]], snapshot: int = -1, parts: str | None = "wisdom-holman", **others: Any) -> Problem:
    """The bodies of a simulation or of a snapshot of its archive as a `Problem`, with their very numbers.

    H is that of point masses with REBOUND's G, in the frame of the simulation; forces of REBOUNDx, softening and radii are not in it.

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
        A body of mass 0 before one with mass, softening, fewer than two bodies with mass, an archive that cannot be read.

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
    if not isinstance(simulation, rebound.Simulation):
        path = os.fspath(simulation)
        try:
            simulation = rebound.Simulationarchive(path)[snapshot]
        except (RuntimeError, ValueError, IndexError, OSError) as error:
            raise InputError(f"{path}: snapshot {snapshot} of a REBOUND archive cannot be read: {error}") from error
    if simulation.softening != 0:
        raise InputError(f"the simulation has a softening of {simulation.softening}: write the energy of two bodies as `pair`")
    bodies = [
        {"mass": particle.m, "q": [particle.x, particle.y, particle.z], "v": [particle.vx, particle.vy, particle.vz]} for particle in simulation.particles
    ]
    return Problem(parts=parts, body=bodies, parameters={"g": simulation.G}, **others)
