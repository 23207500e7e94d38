"""Derivatives of runs: forwards by tangent vectors, and backwards by steps back."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from . import _shadowstep
from ._shadowstep import Given, InputError
from .arguments import check, naming, numbers
from .border import WrongType
from .exact import Number, exact
from .integration import integrate, run_of, vectors_of
from .problem import Problem, problem_of
from .progress import bar
from .scheme import Scheme

Variable = tuple[str, int, "tuple[Given, Given] | None"]
Loss = Callable[[np.ndarray, np.ndarray], "tuple[float, Any, Any]"]


@dataclass(frozen=True, repr=False)
class Derivatives:
    """States of a run with their derivatives by k variables: n states of d coordinates.

    With more digits than double precision has, arrays are those of decimal texts.
    """

    by: list[str]
    """The names of the variables."""
    n: np.ndarray
    """The numbers of the states, of shape (n,)."""
    q: np.ndarray
    """Positions, of shape (n, d)."""
    p: np.ndarray
    """Momenta, of shape (n, d)."""
    of_q: np.ndarray
    """∂q/∂(variables), of shape (n, d, k)."""
    of_p: np.ndarray
    """∂p/∂(variables), of shape (n, d, k)."""

    def __repr__(self) -> str:
        return f"Derivatives({len(self.n)} states of {self.q.shape[1]} coordinates by {', '.join(self.by)})"


@dataclass(frozen=True)
class Gradient:
    """The value of a function of the states of a run, and its derivatives."""

    value: float
    """The value of the function."""
    by: dict[str, Any]
    """Its derivatives by the variables."""
    reversal_error: float
    """How far the steps back end from the initial state, as a part of the largest coordinate or momentum: by round-off, which grows with the steps."""


def derivatives(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    by: Sequence[str] | None = None,
    steps: int | None = None,
    first: str | None = None,
    gradient_kicks: str = "exact",
    every: int = 1,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    progress: bool | None = None,
) -> Derivatives:
    """The states of a run with their derivatives by the initial state, by parameters, masses and the step size: of the steps, not of the exact flow.

    Each variable costs a tangent vector, about twice a run; for a function of the states and many variables see `gradient`.

    Parameters
    ----------
    problem, scheme, h, until, steps, first, gradient_kicks, every, digits, mpfr, progress
        As in `integrate`. In transformed time steps are given.
    by
        The variables: names of coordinates and momenta, which mean the state at t = 0; names of numbers of the problem, as `Problem.replaced` has
        them; and ``"h"``, at a fixed number of steps. By default all coordinates and momenta.

    Raises
    ------
    InputError
        A name that the problem has not; a number beside which the problem has other parts, or none; forces that the caller computes, as they have no second derivatives.
    RunError
        A state or a derivative that is not finite.

    Examples
    --------
    >>> import shadowstep
    >>> spring = shadowstep.Problem("k*x^2/2", q={"x": 1}, p=[0], k=4)
    >>> found = shadowstep.derivatives(spring, "yoshida4", h="1/100", until=1, every=100, by=["x", "k"])
    >>> found.of_q.shape
    (2, 1, 2)
    >>> [round(float(x), 6) for x in found.of_q[-1, 0]]  # of cos(√k t): cos 2 and −sin(2)/4
    [-0.416147, -0.227324]
    """
    run = run_of(check(derivatives, locals()))
    names, variables = variables_of(problem, by, str(digits), mpfr)
    with bar(run["steps"], "steps", progress) as reach:
        n, (states, columns) = _shadowstep.derivatives(run, variables, reach)
    q, p = np.split(states.reshape(len(n), -1), 2, axis=1)
    vectors = vectors_of(columns, len(n)) if names else np.zeros((len(n), 0, 2 * q.shape[1]))
    of_q, of_p = np.split(np.moveaxis(vectors, 1, 2), 2, axis=1)
    return Derivatives(names, n, q, p, of_q, of_p)


def gradient(
    loss: Loss,
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    by: Sequence[str] | None = None,
    steps: int | None = None,
    first: str | None = None,
    gradient_kicks: str = "exact",
    every: int = 1,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    progress: bool | None = None,
) -> Gradient:
    """The derivatives of a function of the states by the initial state, by parameters, masses and the step size, backwards.

    The steps are made back with one tangent vector for the initial state, and one for each other variable; no states are kept but those that the
    function gets. For functions of JAX and PyTorch see `shadowstep.jax` and `shadowstep.torch`.

    Parameters
    ----------
    loss
        It gets q and p of the states 0, every, 2 every, … and of the last one, of shape (n, d) in double precision, and returns its value with its
        derivatives by q and by p, in the same shape; None means 0.
    problem, scheme, h, until, by, steps, first, gradient_kicks, every, digits, mpfr, progress
        As in `derivatives`.

    Raises
    ------
    InputError, RunError
        As `derivatives`.

    Examples
    --------
    >>> import numpy as np
    >>> import shadowstep
    >>> def distance(q, p):  # of the last state from (1, 1), squared
    ...     of_q = np.zeros_like(q)
    ...     of_q[-1] = 2*(q[-1] - 1)
    ...     return ((q[-1] - 1)**2).sum(), of_q, None
    >>> found = shadowstep.gradient(distance, "henon-heiles", "blanes-moan-srkn6b", h="1/5", until=10, by=["x", "px", "h"])
    >>> sorted(found.by)
    ['h', 'px', 'x']
    >>> found.reversal_error < 1e-12
    True
    """
    given = check(gradient, locals())
    names, variables = variables_of(problem, by, str(digits), mpfr)
    run = run_of(given)
    made = integrate(**{name: value for name, value in given.items() if name not in ("loss", "by")})
    q, p = (np.asarray(half, dtype=float) for half in (made.q, made.p))
    found = loss(q, p)
    if not isinstance(found, (tuple, list)) or len(found) != 3:
        raise WrongType("loss must return its value with its derivatives by q and by p, which may be None")
    value, of_q, of_p = found
    value = float(numbers(value, "the value of loss").reshape(()))
    covectors = covectors_of(q.shape, of_q, of_p)
    with bar(run["steps"], "steps", progress) as reach:
        by_names, error = _shadowstep.gradient(run, variables, covectors, reach)
    return Gradient(value, dict(zip(names, by_names.tolist())), error)


def covectors_of(shape: tuple[int, ...], of_q: Any, of_p: Any) -> np.ndarray:
    """The derivatives of a function by the states, flat."""
    halves = []
    for name, given in (("q", of_q), ("p", of_p)):
        half = np.zeros(shape) if given is None else numbers(given, f"of_{name}")
        if half.shape != shape:
            raise InputError(f"the derivatives by {name} have the shape {half.shape}, not {shape}")
        halves.append(half)
    return np.ascontiguousarray(np.concatenate(halves, axis=1)).ravel()


def variables_of(problem: Union[Problem, str], by: Sequence[str] | None, digits: str, mpfr: bool) -> tuple[list[str], list[Variable]]:
    """The names of the variables, by default those of the state, and what the compiled module takes."""
    problem = problem_of(problem)
    halves = (("q", problem.coordinates), ("p", problem.momenta))
    places = {name: (half, i, None) for half, all_names in halves for i, name in enumerate(all_names)}
    names = list(places if by is None else by)
    with naming("by"):
        return names, [places.get(name) or _number(problem, name, digits, mpfr) for name in names]


def _number(problem: Problem, name: str, digits: str, mpfr: bool) -> Variable:
    if name == "h" and "h" not in dict(problem._given.parameters):
        return name, 0, None
    value, distance = exact(problem.number(name), name), _shadowstep.distance_of(digits, mpfr)
    try:
        near, further = (problem.replaced({name: f"({value}) + {times}*{distance}"})._given for times in (1, 2))
    except InputError:
        raise InputError(f"derivatives by {name} are not known: no values beside {name} = {value} can be used") from None
    return name, 0, (near, further)
