"""Indicators of chaos along a trajectory."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Union

from . import _shadowstep
from .exact import Number, count
from .integration import run_of
from .problem import Problem
from .progress import bar
from .scheme import Scheme


@dataclass(frozen=True)
class Indicators:
    """What tangent vectors show along one run, from t = 0."""

    h: float
    steps: int
    time: float
    """The length of the run, physical where time is transformed."""
    motion: str
    """``"regular"``, ``"chaotic"`` or ``"undecided"``, by the growth of the first vector."""
    exponent: float | None
    """The largest Lyapunov exponent, over the last three quarters of the run; None of fewer than 64 measurements."""
    exponent_error: float | None
    """Twice its standard error, from its scatter over parts of the run."""
    lyapunov: float
    """The finite-time exponent log(|δ(t)|/|δ(0)|)/t of the whole run."""
    megno: float
    """MEGNO, Y."""
    mean_megno: float
    """Its mean: 2 on regular orbits, 0 where all frequencies are constant; it grows with the time on chaotic ones."""
    sali: float | None
    """SALI of the first two vectors: it tends to 0 exponentially on chaotic orbits."""
    gali: float | None
    """GALI of all vectors, if there are three or more."""
    exponents: list[list[float]] | None
    """The exponents of orthonormal vectors with twice their standard errors, the largest first."""
    summary: dict[str, Any]
    """The error of H and the verdict of the modified energy, as of a scene."""


@dataclass(frozen=True)
class Chaos:
    """Whether a trajectory is chaotic, and whether its step size makes it so."""

    conclusion: str
    """What the runs say, in a sentence."""
    at: Indicators
    """At the step size h."""
    at_half: Indicators | None
    """At h/2, if that was asked for."""


def chaos(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    steps: int | None = None,
    first: str | None = None,
    gradient_kicks: str = "exact",
    vectors: int = 2,
    exponents: int | None = None,
    every: int = 1,
    half: bool = True,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    progress: bool | None = None,
) -> Chaos:
    """Whether the trajectory from the problem's initial state is chaotic: Lyapunov exponents, MEGNO, SALI and GALI by tangent vectors.

    The run is made at h and at h/2: chaos that only the larger step has is of the step.

    Parameters
    ----------
    problem, scheme, h, until, steps, first, gradient_kicks, digits, mpfr, progress
        As in `integrate`.
    vectors
        The number of tangent vectors: 2 give SALI, more GALI of all of them.
    exponents
        This number of the largest Lyapunov exponents, of orthonormal vectors, in place of SALI.
    every
        Vectors are measured, and made orthonormal, every ``every`` steps.
    half
        Whether the run is made at h/2 too.

    Raises
    ------
    InputError
        Forces that the caller computes, as they have no second derivatives; more vectors than a state has components; more digits than 327.
    RunError
        A state or an energy that is not finite.

    Examples
    --------
    >>> import shadowstep
    >>> star = shadowstep.Problem("(x^2 + y^2)/2 + x^2*y - y^3/3", q={"x": 0, "y": "-1/4"}, p=["0.42081", 0])
    >>> found = shadowstep.chaos(star, "blanes-moan-srkn6b", h="1/5", until=2000)
    >>> found.conclusion
    'chaotic at both step sizes with the same exponent: of the problem'
    >>> 0.02 < found.at.exponent < 0.08
    True
    """
    run = run_of(problem, scheme, h, until, steps, first, gradient_kicks, every, digits, mpfr)
    exponents = None if exponents is None else count(exponents, "exponents")
    with bar(None, "steps", progress) as reach:
        found = _shadowstep.chaos(run, vectors=count(vectors, "vectors"), exponents=exponents, half=half, progress=reach)
    found = json.loads(found)
    records = [_indicators(record) for record in found["records"]]
    return Chaos(found["conclusion"], records[0], records[1] if half else None)


def _indicators(record: dict[str, Any]) -> Indicators:
    names = ("time", "motion", "exponent", "exponent_error", "lyapunov", "megno", "mean_megno", "sali", "gali", "exponents", "summary")
    values: dict[str, Any] = {name: record.get(name) for name in names}
    return Indicators(h=float(Fraction(record["step"])), steps=record["steps"], **values)
