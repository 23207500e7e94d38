"""The modified Hamiltonian of a scheme as formulas."""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ._shadowstep import InputError, modified_formulas
from .arguments import check, numbers
from .exact import Number, count, exact
from .problem import Problem, problem_of
from .scheme import Scheme, table_of


class ModifiedHamiltonian:
    """H + h H_2 + h² H_3 + … up to a power of h: formulas, and their values."""

    def __init__(self, problem: Problem, hamiltonian: str, terms: dict[int, str], function: str, arguments: list[str]) -> None:
        self._problem = problem
        self.hamiltonian = hamiltonian
        """H"""
        self.terms = terms
        """The formulas of H_(n+1) by the power n of h; those that are 0 are left out."""
        self.function = function
        """A function of Python, ``modified_hamiltonian(h, x, …, px, …)``, as text. A name that it cannot have has ``_`` appended."""
        self._arguments = arguments

    def __call__(self, q: npt.ArrayLike, p: npt.ArrayLike, h: Number, t: npt.ArrayLike | None = None) -> npt.NDArray[np.float64]:
        """Its values in double precision.

        Parameters
        ----------
        q, p
            A state, of shape (d,), or many, (…, d), as trajectories have them.
        h
            The step size.
        t
            The times, where H depends on t.
        """
        function = self._compiled
        values: dict[str, Any] = {name: _number(value, name) for name, value in self._problem._given.parameters}
        for name, names, columns in (("q", self._problem.coordinates, q), ("p", self._problem.momenta, p)):
            of_states = numbers(columns, name)
            if of_states.ndim == 0 or of_states.shape[-1] > len(names):
                raise InputError(f"{name} has the shape {of_states.shape}: its last axis must have {len(names)} numbers, one for each coordinate")
            values.update(zip(names, np.moveaxis(of_states, -1, 0)))
        if t is not None and all(name != "t" for name, _ in self._problem._given.parameters):
            values["t"] = numbers(t, "t")
        for name in self._arguments:
            if name not in values:
                raise InputError(f"{name} is missing: H depends on it; give t, or positions and momenta of all coordinates")
        return np.asarray(function(_number(h, "h"), *(values[name] for name in self._arguments)))

    @cached_property
    def _compiled(self) -> Any:
        space: dict[str, Any] = {}
        exec(compile(self.function, "modified_hamiltonian", "exec"), space)  # noqa: S102: this package has written it
        return space["modified_hamiltonian"]

    def __repr__(self) -> str:
        lines = [f"H = {self.hamiltonian}", *(f"H_{power + 1} = {formula}" for power, formula in self.terms.items())]
        return "\n".join(lines)


def modified_hamiltonian(
    problem: Problem | str, scheme: Scheme | str, grade: int = 4, *, notation: str = "text", digits: int = 17
) -> ModifiedHamiltonian:
    """The Hamiltonian whose flow the steps of a scheme are, up to a power of h, as formulas in q and p.

    A step of size h is the flow over h of H + h H_2 + h² H_3 + …, an asymptotic series by the formula of Baker, Campbell and Hausdorff, whose brackets are
    derivatives: [F, G] = F_p·G_q − F_q·G_p. The estimates of the modified energy are values of this function, which need no formula.

    Parameters
    ----------
    problem
        A problem whose H is given by formulas; planets with their orbits, and transformed time, too.
    scheme
        A scheme or its name; of a processed one it is that of the processed step.
    grade
        The highest power of h, at most 10.
    notation
        ``"text"``, ``"latex"``, ``"rust"`` or ``"numpy"``.
    digits
        Significant digits of numbers that are no short fractions.

    Raises
    ------
    InputError
        A problem without formulas, such as one with a function for its forces; a scheme that is not for it; too many terms.

    Examples
    --------
    >>> import shadowstep
    >>> H = shadowstep.modified_hamiltonian("pendulum", "stormer-verlet", grade=2)
    >>> H.terms
    {2: '-sin(q)^2/24 + p^2*cos(q)/12'}
    >>> run = shadowstep.integrate("pendulum", "stormer-verlet", h="1/4", until=50)
    >>> drift = H(run.q, run.p, "1/4")
    >>> bool(np.ptp(drift) < 0.05 * np.ptp(run.energy))
    True
    """
    check(modified_hamiltonian, locals())
    made = problem_of(problem)
    hamiltonian, terms, function, arguments = modified_formulas(
        made._given, table_of(scheme), count(grade, "grade", most=10), notation, count(digits, "digits", most=300)
    )
    return ModifiedHamiltonian(made, hamiltonian, dict(terms), function, arguments)


def _number(value: Number, what: str) -> float:
    text = exact(value, what)
    try:
        return float(Fraction(text))
    except (ValueError, ZeroDivisionError):
        raise InputError(f"{what} = {text!r} is not a number: write a decimal or a fraction such as '1/10'") from None
