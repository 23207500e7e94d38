"""Splitting schemes with what is proved of them."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Union

from ._shadowstep import Table, emit, modified_series, polished, proposal, shipped_names
from .arguments import check, naming, numbers, path_of
from .border import WrongType
from .exact import count


@dataclass(frozen=True)
class Proposal:
    """A trajectory of Hamiltonian Monte Carlo on a Gaussian."""

    steps: int
    step: float
    """The step size h."""
    gradients: int
    """Evaluations of the gradient, Hessian–vector products counted as such."""
    error: float
    """The mean of ΔH in equilibrium, in units of the temperature."""
    largest_error: float
    """Its maximum over all numbers of such steps."""
    acceptance: float
    """The mean of min(1, exp(−ΔH))."""

    @property
    def cost(self) -> float:
        """Gradients per accepted trajectory."""
        return self.gradients / self.acceptance


class Scheme:
    """A splitting scheme, proved from its table of exact weights.

    Parameters
    ----------
    table
        The name of a shipped scheme, such as ``"yoshida4"``; the path of a table, which ends in ``.toml`` or has a separator; or the text
        of a table, which has line breaks.

    Raises
    ------
    InputError
        An unknown name; a table with faults: a claim that does not hold, for example, with its line and column.

    Examples
    --------
    >>> scheme = Scheme("blanes-moan-srkn11b")
    >>> scheme
    Scheme('blanes-moan-srkn11b': order 6 for quadratic T, 4 for every T(p), 11 forces a step)
    >>> scheme.symmetric, round(scheme.stability_limit, 2)
    (True, 3.14)
    >>> verlet = Scheme('''
    ... name = "velocity-verlet"
    ... order = 2
    ... kinetic = "any"
    ... [stages]
    ... kick = ["1/2", "1/2"]
    ... drift = [1, 0]
    ... ''')
    >>> verlet.maps
    [('kick', '1/2'), ('drift', '1'), ('kick', '1/2')]
    """

    _table: Table

    def __init__(self, table: Union[str, os.PathLike[str]]) -> None:
        text = path_of(table, "table")
        with naming("table"):
            self._table = Table.of_text(text, "table") if "\n" in text else Table.of_word(text)

    @staticmethod
    def polish(
        table: Union[str, os.PathLike[str]],
        digits: int | None = None,
        *,
        free: Iterable[str] = (),
        split_kicks: bool = False,
        closed_gaps: Iterable[float] = (),
    ) -> Scheme:
        """The scheme of a table of printed decimals, solved for from its order conditions to many digits; of a processed scheme with its processor.

        Parameters
        ----------
        table
            As for a scheme. Decimals that stand alone move; fractions and formulas stay as they are, and the claims need not hold yet.
        digits
            To which the conditions shall hold, at most 300; None for as many as can be.
        free
            Decimals that stay as printed: constants, or places such as ``"kick[2]"``.
        split_kicks
            The cubes of the kicks must sum to 0 too: kicks are themselves split, as in heliocentric coordinates.
        closed_gaps
            hω near which a step turns by a multiple of π, and must not be unstable.

        Raises
        ------
        InputError
            Faults of the table; conditions that no values near the printed ones meet, or that do not determine them.

        Examples
        --------
        >>> ruth = Scheme.polish('''
        ... name = "forest-ruth"
        ... order = 4
        ... kinetic = "any"
        ... [stages]
        ... kick = [0.6756, -0.1756, -0.1756, 0.6756]
        ... drift = [1.3512, -1.7024, 1.3512, 0]
        ... ''', 40)
        >>> ruth.maps[1][1][:20]
        '1.351207191959657634'
        """
        check(Scheme.polish, locals())
        number = None if digits is None else count(digits, "digits", most=300)
        gaps = numbers(list(closed_gaps), "closed_gaps").ravel().tolist()
        with naming("closed_gaps" if gaps else "table"):
            return Scheme(polished(path_of(table, "table"), number, list(free), bool(split_kicks), gaps))

    @property
    def name(self) -> str:
        """By which it was asked for."""
        return self._table.name

    @property
    def order(self) -> int | None:
        """The order r that is proved for every T(p), with errors of size h^r. None with gradient kicks, which there are for quadratic T only. Of a processed
        scheme the effective order; those of its kernel are in ``record["kernel"]``."""
        return self._table.facts()[1]

    @property
    def order_quadratic(self) -> int:
        """The order that is proved for T = ½pᵀM⁻¹p, of a processed scheme the effective one."""
        return self._table.facts()[2]

    @property
    def evaluations(self) -> int:
        """Evaluations of the forces in a step."""
        return self._table.facts()[3]

    @property
    def text(self) -> str:
        """The text of the table."""
        return self._table.text

    @property
    def record(self) -> dict[str, Any]:
        """Everything that is known: proofs, the leading error, stability, exact weights as texts. As ``shadowstep schemes show --json``."""
        return json.loads(self._record)

    @cached_property
    def _record(self) -> str:
        return self._table.record()

    @property
    def symmetric(self) -> bool:
        """Whether a step with −h undoes a step with h."""
        return self.record["symmetric"]

    @property
    def stability_limit(self) -> float | None:
        """The least hω at which an oscillation of frequency ω is unstable; None for a step of very many maps."""
        limit = self.record["stability_limit"]
        return None if limit is None else float(limit)

    @property
    def effective_error(self) -> float:
        """The norm of the leading error for quadratic T, at equal cost: (evaluations) times its r-th root, for schemes of equal order r. Of a processed scheme
        that after processing."""
        return self.record["effective_error_quadratic"]

    @property
    def maps(self) -> list[tuple[str, str]]:
        """The kicks, drifts and gradient kicks of a step with their exact weights as texts, in the order in which they are made."""
        return [(entry["map"], entry["weight"]) for entry in self.record["maps"]]

    @property
    def reference(self) -> str | None:
        """Where the scheme was published."""
        return self.record["reference"]

    @property
    def doi(self) -> str | None:
        """Its digital object identifier."""
        return self.record["doi"]

    def emit(self, target: str) -> str:
        """The step as code of another ecosystem, with its provenance and a self-test.

        Parameters
        ----------
        target
            ``"python"``, ``"jax"``, ``"c"``, ``"julia"``, ``"fortran"``, ``"openmm"``, ``"blackjax"``, ``"mici"``, ``"sundials"``, ``"petsc"`` or ``"latex"``.

        Raises
        ------
        InputError
            A scheme that the target cannot express, with the reason.

        Examples
        --------
        >>> code = Scheme("yoshida4").emit("python")
        >>> module = {"__name__": "yoshida4"}
        >>> exec(code, module)
        >>> q, p = module["integrate"]([1.0], [0.0], h=1 / 64, steps=64, gradient=lambda q: q)
        >>> import math
        >>> bool(abs(q[0] - math.cos(1)) < 1e-8)
        True
        """
        check(Scheme.emit, locals())
        return emit(self._table, target)

    def proposal(
        self,
        frequencies: Iterable[float],
        time: float | None = None,
        *,
        acceptance: float | None = None,
        steps: int | None = None,
    ) -> Proposal:
        """A trajectory of Hamiltonian Monte Carlo on a Gaussian: its step, expected error of the energy, acceptance and cost, computed exactly.

        Without ``acceptance`` and ``steps`` that with the least cost per accepted trajectory.

        Parameters
        ----------
        frequencies
            Those of the oscillators that p²/2 − log(density) is: 1/σ of a direction with standard deviation σ, and unit masses.
        time
            The length of the trajectory; None is a quarter of the longest period.
        acceptance
            The least acceptance, between 0 and 1, for which the fewest steps are looked for.
        steps
            The number of steps.

        Raises
        ------
        InputError
            A scheme that is not symmetric, or is processed: its steps are not reversible in time. A number out of range.

        Examples
        --------
        >>> frequencies = [j / 100 for j in range(1, 101)]
        >>> verlet, bcss3 = (Scheme(name).proposal(frequencies) for name in ("stormer-verlet", "bcss3"))
        >>> verlet.steps, round(verlet.acceptance, 3), round(verlet.cost)
        (166, 0.702, 237)
        >>> bcss3.steps, round(bcss3.acceptance, 3), round(bcss3.cost)
        (42, 0.907, 139)
        """
        check(Scheme.proposal, locals())
        number = None if steps is None else count(steps, "steps", most=10**9)
        length, least = (None if value is None else float(value) for value in (time, acceptance))
        of = numbers(list(frequencies), "frequencies").ravel().tolist()
        with naming("frequencies", "^frequency"):
            return Proposal(*proposal(self._table, of, length, least, number))

    def modified(self, grade: int = 4, *, parts: int | None = None, quadratic: bool = False, digits: int = 17) -> dict[int, dict[str, str]]:
        """The series of the modified Hamiltonian in brackets: the coefficients by the power n of h, of H_(n+1), and the bracket.

        K stands for U and D for T, or A, B, C, … for parts, and [F, G] = F_p·G_q − F_q·G_p. Coefficients are short fractions where they are exact,
        else decimals. :func:`modified_hamiltonian` has the formulas of a problem.

        Parameters
        ----------
        grade
            The highest power of h, at most 10.
        parts
            For H of 3 to 9 parts in place of T + U.
        quadratic
            Whether brackets that are 0 for every quadratic T are left out, as they are of schemes with gradient kicks.
        digits
            Significant digits of decimals.

        Raises
        ------
        InputError
            A scheme that is not for these parts; too many terms.

        Examples
        --------
        >>> Scheme("stormer-verlet").modified(2)
        {2: {'[K,[K,D]]': '-1/24', '[D,[D,K]]': '1/12'}}
        """
        check(Scheme.modified, locals())
        parts = None if parts is None else count(parts, "parts", least=3, most=9)
        series: dict[int, dict[str, str]] = {}
        terms = modified_series(self._table, count(grade, "grade", most=10), parts, quadratic, count(digits, "digits", most=300))
        for power, bracket, coefficient in terms:
            series.setdefault(power, {})[bracket] = coefficient
        return series

    def __reduce__(self) -> tuple[Any, ...]:
        # the text of the table, so that it is the same scheme wherever it is read again
        return _of_text, (self._table.text, self._table.path, self.name)

    def __repr__(self) -> str:
        name, general, quadratic, evaluations = self._table.facts()
        orders = f"order {quadratic}" if general == quadratic else f"order {quadratic} for quadratic T, {general or 'none'} for every T(p)"
        return f"Scheme({name!r}: {orders}, {evaluations} force{'s' if evaluations != 1 else ''} a step)"


def _of_text(text: str, path: str, name: str) -> Scheme:
    scheme = Scheme.__new__(Scheme)
    scheme._table = Table.of_text(text, path, name)
    return scheme


def table_of(scheme: Any, name: str = "scheme") -> Table:
    """The table of an argument ``scheme``: a scheme, or the name or path of one."""
    if isinstance(scheme, Scheme):
        return scheme._table
    if not isinstance(scheme, (str, os.PathLike)):
        raise WrongType(f"{name} must be a Scheme, or the name or path of one such as 'yoshida4', not {type(scheme).__name__}")
    path = path_of(scheme, name)
    with naming(name):
        return Scheme(path)._table


def schemes() -> list[str]:
    """The names of the shipped schemes.

    >>> "yoshida4" in schemes()
    True
    """
    return shipped_names()
