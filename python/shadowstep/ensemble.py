"""Many trajectories at once, in vector instructions and on all cores."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from . import _shadowstep
from .arguments import check, naming, numbers
from .document import document
from .estimator import order_of
from .exact import Number, count, exact
from .problem import Problem, problem_of
from .progress import bar
from .scheme import Scheme, table_of


@dataclass(frozen=True, repr=False)
class Ensemble:
    """The ends of n trajectories of d coordinates."""

    q: np.ndarray
    """Positions at the end, of shape (n, d)."""
    p: np.ndarray
    """Momenta at the end, of shape (n, d)."""
    energy_error: np.ndarray
    """The largest |H − H(0)|/|H(0)| at the states that were looked at, of shape (n,), NaN where H(0) = 0."""
    energy_start: np.ndarray
    """H at the beginning, of shape (n,)."""
    energy_end: np.ndarray
    """H at the end, of shape (n,), NaN of a trajectory that is not finite."""
    modified_drift: np.ndarray | None
    """max − min of the modified energy, of shape (n,), if it was asked for."""
    modified_start: np.ndarray | None
    """The first estimate of the modified energy, of shape (n,)."""
    modified_end: np.ndarray | None
    """The last estimate, of shape (n,), NaN of a trajectory that is not finite."""
    not_finite: np.ndarray
    """The first n at which a state was found not to be finite; −1 for none."""

    def __len__(self) -> int:
        return len(self.q)

    def __repr__(self) -> str:
        lost = int(np.count_nonzero(self.not_finite >= 0))
        return f"Ensemble({len(self)} trajectories of {self.q.shape[1]} coordinates, {lost} not finite)"


def ensemble(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    steps: int | None = None,
    q: np.ndarray | None = None,
    p: np.ndarray | None = None,
    parameters: Mapping[str, np.ndarray] | None = None,
    every: int | None = None,
    order: int | None = None,
    digits: str = "double",
    progress: bool | None = None,
) -> Ensemble:
    """Computes trajectories that differ in their initial states and parameters.

    Each has the bits that it has alone, but for exp, log, sin and cos, whose last bits in vectors are other ones.

    Parameters
    ----------
    problem
        H, and what is the same in all trajectories; of a formula, a name or a pair.
    q, p
        Initial positions and momenta, of shape (n, d), in place of those of the problem.
    parameters
        Values of some parameters, each of shape (n,).
    every
        The number of steps after which H is looked at; by default at the end only.
    order
        The k of E_k for the modified energy, which is estimated wherever H is looked at; by default there is none.
    digits
        ``"double"`` or ``"compensated"``.

    Examples
    --------
    >>> import numpy as np
    >>> import shadowstep
    >>> kepler = shadowstep.Problem("kepler")
    >>> found = shadowstep.ensemble(kepler, "yoshida4", "1/20", until=50, parameters={"eccentricity": np.linspace(0, 0.8, 100)}, every=10)
    >>> found
    Ensemble(100 trajectories of 2 coordinates, 0 not finite)
    >>> bool(found.energy_error[0] < found.energy_error[50] < found.energy_error[99])
    True
    """
    check(ensemble, locals())
    problem = problem_of(problem)
    columns = _Columns()
    sections = dict(problem.sections)
    sections["problem"] = _with_parameters(sections["problem"], columns, parameters or {})
    initial = dict(sections.get("initial") or {})
    for name, values in (("q", q), ("p", p)):
        if values is not None:
            initial[name] = columns.of_states(name, numbers(values, name), problem.dimension)
    sections["initial"] = initial
    name = table_of(scheme).name
    run: dict[str, Any] = {"scheme": name, "step": exact(h, "h"), "digits": digits}
    steps = None if steps is None else count(steps, "steps")
    run |= {"until": None if until is None else exact(until, "until"), "steps": steps}
    sections["run"] = run
    look = {} if every is None else {"every": count(every, "every")}
    output: dict[str, Any] = {"energy": look or True} if every is not None else {}
    if order is not None:
        output["modified_energy"] = {"estimator": "bilinear", "order": order_of(order), **look}
    sections["output"] = output or {"energy": {"every": steps or 1_000_000_000}}
    with bar(None, "", progress) as reach, naming("h", r"^ *\d+ \| step = "):
        found = _shadowstep.ensemble(document(sections), *columns.all(), reach)
    for name in ("q", "p"):
        found[name] = found[name].reshape(len(found["not_finite"]), -1)
    if order is None:
        found.update(modified_drift=None, modified_start=None, modified_end=None)
    return Ensemble(**found)


class _Columns:
    """Columns with names that nothing else has."""

    def __init__(self) -> None:
        self.named: dict[str, np.ndarray] = {}

    def of_parameter(self, name: str, values: Any) -> str:
        values = numbers(values, f"parameters[{name!r}]")
        if values.ndim != 1:
            raise _shadowstep.InputError(f"parameters[{name!r}] must have the shape (n,), not {values.shape}")
        _refuse_infinite(name, values)
        self.named[f"ensemble_{name}"] = values
        return f"ensemble_{name}"

    def of_states(self, name: str, values: np.ndarray, dimension: int) -> list[str]:
        if values.ndim != 2 or values.shape[1] != dimension:
            raise _shadowstep.InputError(f"{name} must have the shape (n, {dimension}), not {values.shape}")
        _refuse_infinite(name, values)
        names = [f"ensemble_{name}{i + 1}" for i in range(dimension)]
        self.named.update(zip(names, values.T))
        return names

    def all(self) -> tuple[list[str], list[np.ndarray]]:
        if not self.named:
            raise _shadowstep.InputError("an ensemble needs q, p or parameters with a value for each trajectory")
        lengths = {len(column) for column in self.named.values()}
        if len(lengths) > 1:
            raise _shadowstep.InputError(f"q, p and parameters must have values for the same number of trajectories, not {sorted(lengths)}")
        return list(self.named), [np.ascontiguousarray(column) for column in self.named.values()]


def _refuse_infinite(name: str, values: np.ndarray) -> None:
    wrong = np.argwhere(~np.isfinite(values))
    if len(wrong) > 0:
        raise _shadowstep.InputError(f"{name} of trajectory {wrong[0][0]} is {values[tuple(wrong[0])]}: give finite numbers")


def _with_parameters(problem: Mapping[str, Any], columns: _Columns, parameters: Mapping[str, Any]) -> dict[str, Any]:
    named = {name: columns.of_parameter(name, values) for name, values in parameters.items()}
    given = {**(problem.get("parameters") or {}), **named}
    return {**problem, "parameters": given} if given else dict(problem)
