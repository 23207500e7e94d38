"""Speed against error, and advice on a scheme and a step size."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Union

from . import _shadowstep
from .arguments import check, is_list, path_of
from .border import WrongType
from .exact import Number, count, exact
from .problem import Problem, given_of
from .progress import bar
from .scheme import Scheme, table_of

Schemes = Iterable[Union[Scheme, str, "os.PathLike[str]"]]


@dataclass(frozen=True)
class Measurement:
    """One run of a scheme."""

    steps: int
    h: float
    evaluations: int
    """Evaluations of the forces."""
    seconds: float
    """Of its steps alone, in one thread."""
    position_error: float | None
    """|q − q_ref| at the end; None where the reference does not resolve it."""
    position_error_below: float | None
    """A bound in its place."""
    energy_error: float | None
    """The largest |H(t) − H(0)|, as a part of |H(0)| unless that is 0; None if it is not finite."""
    permanent_bound: float | None
    """A permanent change of the modified energy above this is excluded."""
    verdict: str
    """The monitor's verdict on the step size."""
    failed: float | None
    """The time at which a state was not finite, as a part of the run."""


@dataclass(frozen=True)
class Curve:
    """The runs of a scheme, the one with the fewest steps first."""

    scheme: str
    order: int
    """The order that is proved for the problem's T(p)."""
    evaluations_per_step: int
    seconds_per_step: float
    runs: list[Measurement]


def work_precision(
    problem: Union[Problem, str],
    until: Number,
    schemes: Schemes = (),
    *,
    first: str | None = None,
    steps: Sequence[int] | None = None,
    h: Sequence[Number] | None = None,
    digits: Union[int, str] = "double",
    seconds: float = 2.0,
    folder: Union[str, os.PathLike[str], None] = None,
    progress: bool | None = None,
) -> list[Curve]:
    """What each scheme pays for an error, from its stability limit down to round-off.

    Errors of positions are those beside the exact flow where it is known, else beside a scheme of order 10 with more digits.

    Parameters
    ----------
    until
        The end of the runs, a physical time.
    schemes
        By default a dozen that are valid for the problem; ``"all"`` are those of the catalogue, ``"near-integrable"`` those with orders for A + εB.
    first
        As in `integrate`: what the steps of all schemes begin with. Default schemes whose order would not hold are left out.
    steps
        The numbers of steps of the runs; by default equal numbers of evaluations for all schemes.
    h
        Step sizes in place of ``steps``, of which ``until`` is a multiple; in transformed time any steps of s.
    seconds
        The time for the runs of a scheme, where ``steps`` and ``h`` are None.
    folder
        Keeps results there, and continues with what it has; not for a function for the forces, whose runs are compared with others in double precision.

    Examples
    --------
    >>> import shadowstep
    >>> curves = shadowstep.work_precision(shadowstep.Problem("pendulum"), 20, ["stormer-verlet", "yoshida4"], steps=[100, 200, 400])
    >>> [round(curve.runs[-2].position_error / curve.runs[-1].position_error) for curve in curves]
    [4, 16]
    """
    comparison = _comparison(check(work_precision, locals()))
    given = None if steps is None else sorted(count(number, "steps") for number in steps)
    if given == []:
        raise _shadowstep.InputError(f"steps = {steps}: give numbers of steps such as [100, 200, 400]")
    sizes = None if h is None else [exact(size, "h") for size in h]
    if sizes is not None and (given is not None or not sizes):
        raise _shadowstep.InputError(f"h = {h}: give step sizes such as ['1/10', '1/20'], without steps")
    with _folder(folder, problem) as path, bar(1000, "", progress) as reach:
        found = _shadowstep.work_precision({**comparison, "folder": path}, given, sizes, reach)
    return [Curve(**{**curve, "runs": [Measurement(**run) for run in curve["runs"]]}) for curve in found]


@dataclass(frozen=True)
class Choice:
    """A scheme and a step size with what is expected of them."""

    scheme: str
    h: str
    """The exact step size."""
    steps: int
    predicted: float
    """The error that is expected."""
    evaluations: float
    """Evaluations of the forces."""
    hessian_products: int
    """Hessian–vector products, one in each gradient kick."""
    flows: int
    """Flows of a dominant part, such as Kepler orbits."""
    seconds: float
    stable_step: float | None
    """The largest stable step for the fastest oscillation at the start."""
    conserved_up_to: float | None
    """The largest step up to which the verdict was bounded or round-off."""
    lost_from: float | None
    """The smallest step at which the modified energy was lost."""

    def _cells(self) -> tuple[str, ...]:
        return self.scheme, self.h if len(self.h) <= 40 else f"until/{self.steps}", str(self.steps), f"{self.predicted:.2e}", f"{self.evaluations:.0f}", f"{self.seconds:.3g}"


@dataclass(frozen=True)
class Advice:
    """A scheme and a step size for a tolerance; ``choices`` is empty if no scheme meets it. Printed, it is a table of the choices."""

    choices: list[Choice]
    """The best first, with up to two alternatives."""
    verified: float | None
    """The error of a run of the first one over all of the time, to a tenth."""
    at_most: bool
    """Whether ``verified`` is a bound instead: the reference resolves no more."""
    least: float | None
    """Where no scheme meets the tolerance: the smallest error that was found."""
    reason: str | None
    """Why there is no choice, in a sentence."""
    untried: list[str]
    """Schemes that the search had no time for."""
    extrapolated: list[str]
    """Schemes whose runs ended, for the time, before the tolerance."""

    def __str__(self) -> str:
        if not self.choices:
            return str(self.reason)
        bound = "at most " if self.at_most else ""
        rows = [["scheme", "h", "steps", "predicted", "forces", "seconds"], *([*choice._cells()] for choice in self.choices)]
        widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
        lines = ["  ".join(f"{cell:<{width}}" if column == 0 else f"{cell:>{width}}" for column, (cell, width) in enumerate(zip(row, widths))) for row in rows]
        return "\n".join([*lines, f"verified: a run of {self.choices[0].scheme} over all of the time has the error {bound}{self.verified:.2e}"])


def advise(
    problem: Union[Problem, str],
    until: Number,
    tolerance: float,
    *,
    of: str = "position",
    cost: str = "forces",
    schemes: Schemes = (),
    first: str | None = None,
    digits: Union[int, str] = "double",
    seconds: float = 30.0,
    folder: Union[str, os.PathLike[str], None] = None,
    progress: bool | None = None,
) -> Advice:
    """A scheme and a step size for a tolerance: predicted from runs over a part of the time, and verified by one over all of it.

    Parameters
    ----------
    tolerance
        The largest error, in the units of ``of``.
    of
        Which error: ``"position"`` at the end, a distance in the units of q; ``"energy"``, the largest |H(t) − H(0)|, or ``"permanent"``, the permanent
        change of the modified energy, as parts of |H(0)| unless that is 0.
    cost
        What is to be small: ``"forces"``, with which Hessian–vector products and flows of a dominant part are counted, or ``"time"``.
    schemes
        As in `work_precision`. Beside a dominant part, such as Kepler orbits, near-integrable schemes are among the default ones.
    first
        As in `work_precision`.
    seconds
        The time of the search on all cores; the runs that verify the choice take what they take.

    Examples
    --------
    >>> import shadowstep
    >>> advice = shadowstep.advise(shadowstep.Problem("pendulum"), 50, 1e-6, seconds=4)
    >>> advice.verified <= 1e-6, len(advice.choices) > 0
    (True, True)
    >>> str(advice).split()[:6]
    ['scheme', 'h', 'steps', 'predicted', 'forces', 'seconds']
    """
    comparison = _comparison(check(advise, locals()))
    with _folder(folder, problem) as path, bar(1000, "", progress) as reach:
        found = _shadowstep.advise({**comparison, "folder": path}, float(tolerance), of, cost, reach)
    return Advice(**{**found, "choices": [Choice(**choice) for choice in found["choices"]]})


def _comparison(given: Mapping[str, Any]) -> dict[str, Any]:
    """What the compiled module takes, from the arguments of a function."""
    group, tables = _tables(given["schemes"])
    seconds = given["seconds"]
    if not 1e-3 <= seconds <= 1e6:
        raise _shadowstep.InputError(f"seconds = {seconds}: give a number of seconds from 0.001 to 1000000")
    return {
        "problem": given_of(given["problem"]),
        "until": exact(given["until"], "until"),
        "schemes": tables,
        "group": group,
        "first": given["first"],
        "digits": str(given["digits"]),
        "seconds": seconds,
    }


def _tables(schemes: Schemes) -> tuple[str | None, list[Any]]:
    """The word of a group of schemes, or the schemes."""
    if isinstance(schemes, str) and schemes in ("all", "near-integrable"):
        return schemes, []
    if isinstance(schemes, (str, os.PathLike, Scheme)):
        schemes = [schemes]
    if not is_list(schemes):
        raise WrongType(f"schemes must be schemes or their names, such as ['yoshida4', 'pefrl'], not {type(schemes).__name__}")
    return None, [table_of(scheme, "schemes") for scheme in schemes]


@contextmanager
def _folder(folder: Union[str, os.PathLike[str], None], problem: Union[Problem, str]) -> Iterator[str]:
    if folder is not None:
        if isinstance(problem, Problem) and problem.name == "forces":
            raise _shadowstep.InputError("folder: results for a function are not kept, as nothing tells it from another function; leave folder out")
        path = path_of(folder, "folder")
        os.makedirs(path, exist_ok=True)
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="shadowstep-") as path:
        yield path
