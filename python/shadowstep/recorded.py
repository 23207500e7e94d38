"""The modified energy of trajectories that other programs have computed."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Union

import numpy as np

from . import _shadowstep
from .arguments import check, naming, numbers
from .border import WrongType
from .estimator import order_of
from .exact import Number, count, exact
from .monitor import Sample
from .problem import Problem
from .scheme import Scheme, table_of


class ShadowEnergy(NamedTuple):
    """The modified energy along a log."""

    values: np.ndarray
    """H̄ of each state, of shape (n,): NaN at the ends, where an estimate has too few states. For an odd k, H̄ between the state and the next one."""
    errors: np.ndarray
    """The estimated errors."""


def shadow_energy(
    q: Any,
    p: Any,
    potential: Union[Problem, tuple[Any, Any]],
    h: Number,
    k: int = 8,
    *,
    masses: Any = 1.0,
    scheme: Union[Scheme, str, os.PathLike[str]] = "stormer-verlet",
    half_steps: bool = False,
    cell: Any = None,
) -> ShadowEnergy:
    """The modified energy H̄ along states of another program, by the estimator E_k.

    Parameters
    ----------
    q, p
        Positions and momenta at equal distances h in time, of shape (n, d) or (n, atoms, 3).
    potential
        A pair (U, forces) with the forces in the shape of q, or (U, rate) with the rate qᵀU_q − 2U of shape (n,), as the program has logged them; or a `Problem`, in
        which each step is then made again.
    masses
        One for all, for each atom, or for each coordinate. A `Problem` has its own.
    scheme
        The scheme of the steps, where a `Problem` is given; logs are those of velocity Verlet.
    half_steps
        Whether the momenta are those of leapfrog: half a step before each state where forces are given, else with a row more than there are states, for those
        before and after.
    cell
        The vectors of a periodic box, of shape (3, 3) or three lengths, where positions are wrapped into it.

    Returns
    -------
    ShadowEnergy
        Values and errors of shape (n,). Both are NaN in the rows at the two ends, about k of each, where an estimate has too few states: take
        ``numpy.nanmax`` and the like, or leave these rows out.

    Warns
    -----
    UserWarning
        If logged forces show that the states are not those of velocity Verlet with these masses and this h, as where momenta of leapfrog are not declared, velocities
        are given for momenta, or positions are wrapped.

    Examples
    --------
    >>> import numpy as np, shadowstep
    >>> orbit = shadowstep.integrate(shadowstep.Problem("pendulum"), "stormer-verlet", h=0.1, steps=200)
    >>> values, errors = shadowstep.shadow_energy(orbit.q, orbit.p, (-np.cos(orbit.q[:, 0]), -np.sin(orbit.q)), h=0.1)
    >>> bool(np.nanmax(values) - np.nanmin(values) < 1e-10 < 1e-4 < np.ptp(orbit.energy))
    True
    """
    check(shadow_energy, locals())
    q, p = _rows(q, "q"), _rows(p, "p")
    vectors = None if cell is None else _cell(cell, q.shape[1]).tolist()
    states = {"q": q, "p": p, "h": exact(h, "h"), "half_steps": half_steps, "cell": vectors}
    if isinstance(potential, Problem):
        if q.shape[1] != potential.dimension:
            raise _shadowstep.InputError(f"the states have {q.shape[1]} coordinates, and the problem has {potential.dimension}")
        return ShadowEnergy(*_shadowstep.energies_of_states(states, potential._given, table_of(scheme), order_of(k, "k")))
    energies, derivatives = _pair(potential)
    gradients = None if derivatives.ndim == 1 else -_rows(derivatives, "the forces of potential")
    rates = derivatives if derivatives.ndim == 1 else None
    found, other_steps = _shadowstep.energies_of_log(states, energies, gradients, rates, _masses(masses, q.shape[1]), order_of(k, "k"))
    if other_steps is not None:
        warnings.warn(f"{other_steps}; the modified energy is that of other steps", stacklevel=2)
    return ShadowEnergy(*found)


@dataclass(frozen=True)
class Diagnosis:
    """What moves the energy of a trajectory that another program has computed. Printed, it is some lines with the numbers."""

    cause: str
    """``nothing``, ``time-step``, ``noise``, ``forces-not-smooth``, ``energy-not-smooth``, ``jumps``, ``not-the-gradient``, ``noisy-energy``, ``other-steps``,
    ``digits`` or ``undecided``."""
    size: float | None
    """Of noise of the forces, its size in these; of jumps and of noise of U, that in the energy."""
    reason: str
    """The cause, a sentence with numbers."""
    text: str
    states: int
    """How many states were taken."""
    estimates: int
    """How many estimates H̄ there are."""
    kinetic: float
    """The mean kinetic energy T."""
    energy_error: float
    """max − min of H."""
    method_error: float
    """The method's part of it: max − min of H − H̄."""
    change: float
    """The last H̄ less the first one."""
    range: float
    """max − min of H̄."""
    moved: float
    """That beyond three errors of the estimates on both sides."""
    known_to: float
    """The median of the errors of H̄."""
    time: float
    """From the first estimate to the last."""
    forces: float | None
    """The root mean square of the forces."""
    force_differences: float | None
    """That of their differences in time: of noise, its size."""
    exponent: float | None
    """How the squares of these grow with the distance of the states: 0 for noise, 1 where U′ jumps, 3 where U″ does, large for smooth forces."""
    excess: float | None
    """What H̄ changes by in a step, squared, beside what noise of the forces would make of it: 1 for noise."""
    energy_differences: float | None
    """The root mean square of the differences of U in time: of noise of U, its size."""
    energy_exponent: float | None
    """As ``exponent``, of U: 0 for noise of U, 1 where U jumps."""
    in_a_step: float
    """What H̄ changes by in a step, rms, if that is independent from step to step."""
    growth: float
    """1 if it is; 2 and more where H̄ changes slowly, small where it goes to and fro."""
    isolation: float
    """How far the changes of H̄ are those of few states: 1 for noise."""
    off_q: float | None
    """By how much q of the states differs from the steps, as a part of them."""
    off_p: float | None
    """The same of p."""
    reordered: int | None
    """The first state whose coordinates are those of the step in another order, as where a file is not sorted by atoms."""
    jumps: list[tuple[int, float]]
    """States before which H̄ changes suddenly, and by how much, the largest first."""

    def __str__(self) -> str:
        return self.text


class Observer:
    """Follows a trajectory that another program computes by velocity Verlet or leapfrog, or by another splitting whose increments it sums.

    Parameters
    ----------
    masses
        One for each coordinate, or for each atom in space.
    h
        The step size.
    window
        How many states follow each other at least: 17, or 9, which tell less of small faults and give the error of H̄ by its last term.
    cell
        The vectors of a periodic box, where positions are wrapped into it.

    Examples
    --------
    >>> import numpy as np, shadowstep
    >>> orbit = shadowstep.integrate(shadowstep.Problem("pendulum"), "stormer-verlet", h=0.1, steps=200)
    >>> observer = shadowstep.Observer([1.0], h=0.1)
    >>> for q, p in zip(orbit.q, orbit.p):
    ...     sample = observer.observe(q, p, energy=-np.cos(q[0]), forces=-np.sin(q))
    >>> sample.n, observer.diagnosis().cause
    (192, 'nothing')
    """

    def __init__(self, masses: Any, h: Number, *, window: int = 17, cell: Any = None, periodic: Sequence[bool] = (True, True, True)) -> None:
        check(Observer.__init__, locals())
        masses = _checked(numbers(masses, "masses").ravel())
        along = numbers(periodic, "periodic")
        if along.shape != (3,):
            raise _shadowstep.InputError(f"periodic has the shape {along.shape}: give three of True and False, one for each box vector")
        cell = None if cell is None else _cell(cell, len(masses)).tolist()
        self._observer = _shadowstep.Observer.of(masses.tolist(), exact(h, "h"), count(window, "window"), cell, (along != 0).tolist())

    @property
    def window(self) -> int:
        """How many successive states a window needs."""
        return self._observer.window

    def begin(self, n: int) -> None:
        """A new window begins: the next state is the state n, which does not follow the newest by a step."""
        with naming("n"):
            self._observer.begin(count(n, "n", least=-(2**63)))

    def observe(self, q: Any, p: Any, energy: float, forces: Any, *, half_step: bool = False, step: tuple[Any, Any, float] | None = None) -> Sample | None:
        """Takes the next state; gives the estimate that it completes.

        Parameters
        ----------
        q, p, forces
            Of the state, of any shape with a number for each coordinate.
        energy
            U(q)
        half_step
            Whether p is that of leapfrog, half a step before q.
        step
            Of another splitting than these two: what the step to the state added to q and p, and Σ h a ((q_s - q)ᵀU_q(q_s) - 2U(q_s)) over its kicks
            by h a at q_s, q being that before the step. Of the first state it does not matter.
        """
        check(Observer.observe, locals())
        if step is not None and (not isinstance(step, (tuple, list)) or len(step) != 3):
            raise WrongType("step must be what it added to q and p, and the sum over its kicks")
        energy = float(numbers(energy, "energy").reshape(()))
        if not np.isfinite(energy):
            raise _shadowstep.InputError(f"energy is {energy}: give the states before it; a run that overflows has steps that are too large")
        made = None if step is None else (_flat(step[0], "step"), _flat(step[1], "step"), float(numbers(step[2], "step").reshape(())))
        with naming("forces", "^the gradient"), naming("step", " has increments,"):
            found = self._observer.observe(_flat(q, "q"), _flat(p, "p"), energy, -_flat(forces, "forces"), bool(half_step), made)
        return None if found is None else Sample(*found)

    @property
    def values(self) -> dict[str, np.ndarray]:
        """Arrays ``n``, ``modified_energy``, ``error`` and ``energy`` of all states that have an estimate."""
        n, (modified, error, energy) = self._observer.values()
        return {"n": n, "modified_energy": modified, "error": error, "energy": energy}

    def diagnosis(self) -> Diagnosis:
        """What moves the energy, as far as the states so far tell."""
        return self._in_units(None)

    def _in_units(self, units: tuple[str, str, float] | None) -> Diagnosis:
        return Diagnosis(**self._observer.diagnosis(units))


def diagnose(
    q: Any,
    p: Any,
    potential: tuple[Any, Any],
    h: Number,
    *,
    masses: Any = 1.0,
    half_steps: bool = False,
    cell: Any = None,
    window: int = 17,
) -> Diagnosis:
    """What moves the energy of a log of q, p, U and forces; the arguments are those of `shadow_energy` and `Observer`.

    Examples
    --------
    >>> import numpy as np, shadowstep
    >>> orbit = shadowstep.integrate(shadowstep.Problem("pendulum"), "stormer-verlet", h=0.1, steps=200)
    >>> U, forces = -np.cos(orbit.q[:, 0]), -np.sin(orbit.q)
    >>> shadowstep.diagnose(orbit.q, orbit.p, (U, forces), h=0.1).cause
    'nothing'
    >>> shadowstep.diagnose(orbit.q, orbit.p, (U, forces), h=0.101).cause
    'other-steps'
    """
    check(diagnose, locals())
    energies, forces = _pair(potential)
    q = numbers(q, "q")
    if forces.ndim == 1 and q.ndim > 1:
        raise _shadowstep.InputError("a diagnosis needs forces, in the shape of q; a rate qᵀU_q − 2U does not tell the causes apart")
    q, p, forces = _rows(q, "q"), _rows(p, "p"), _rows(forces, "the forces of potential")
    if not len(q) == len(p) == len(energies) == len(forces):
        lengths = f"{len(q)}, {len(p)}, {len(energies)} and {len(forces)}"
        raise _shadowstep.InputError(f"q, p, U and forces have {lengths} states: give as many of each")
    observer = Observer(_masses(masses, q.shape[1]), h, window=window, cell=cell)
    for state in zip(q, p, energies, forces):
        observer.observe(*state, half_step=half_steps)
    return observer.diagnosis()


def _flat(array: Any, name: str) -> np.ndarray:
    return np.ascontiguousarray(numbers(array, name)).ravel()


def _rows(array: Any, name: str) -> np.ndarray:
    array = np.ascontiguousarray(numbers(array, name))
    if array.size == 0:
        raise _shadowstep.InputError(f"{name} has the shape {array.shape}: there are no states")
    return array.reshape(len(array), -1)


def _pair(potential: Any) -> tuple[np.ndarray, np.ndarray]:
    """U of each state, and the forces or the rate."""
    if not isinstance(potential, (tuple, list)) or len(potential) != 2:
        raise WrongType("potential must be a pair (U, forces), or a Problem where it may be one")
    energies, derivatives = numbers(potential[0], "U of potential"), numbers(potential[1], "the forces of potential")
    if energies.ndim != 1 or derivatives.ndim == 0:
        raise _shadowstep.InputError(f"U of potential has the shape {energies.shape}: give one number for each state")
    return np.ascontiguousarray(energies), derivatives


def _masses(masses: Any, dimension: int) -> list[float]:
    masses = _checked(numbers(masses, "masses").ravel())
    if masses.size == 1:
        return [float(masses[0])] * dimension
    return (np.repeat(masses, 3) if 3 * masses.size == dimension else masses).tolist()


def _checked(masses: np.ndarray) -> np.ndarray:
    wrong = np.flatnonzero(~((masses > 0) & np.isfinite(masses)))
    if masses.size == 0 or wrong.size:
        what = f"the mass of coordinate {wrong[0]} is {masses[wrong[0]]:g}" if wrong.size else "there are none"
        raise _shadowstep.InputError(f"masses: {what}; give a positive and finite one for each coordinate or particle")
    return masses


def _cell(cell: Any, dimension: int) -> np.ndarray:
    if dimension % 3:
        raise _shadowstep.InputError(f"a cell needs three coordinates for each particle, and there are {dimension} coordinates")
    cell = numbers(cell, "cell")
    cell = np.diag(cell) if cell.shape == (3,) else cell
    if cell.shape != (3, 3):
        raise _shadowstep.InputError(f"cell has the shape {cell.shape}: give three lengths, or three vectors, (3, 3)")
    return cell
