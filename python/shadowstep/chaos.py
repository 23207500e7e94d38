"""Indicators of chaos along a trajectory."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Union

from . import _shadowstep
from .arguments import check
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
    """Half the width of its interval of 95 %, from its scatter over parts of the run."""
    lyapunov: float | None
    """The finite-time exponent log(|δ(t)|/|δ(0)|)/t of the whole run; None of a run without a step."""
    megno: float
    """MEGNO, Y."""
    mean_megno: float | None
    """Its mean Ȳ: 2 on regular orbits, 0 where all frequencies are constant; it grows with the time on chaotic ones. None of a run without a step."""
    mean_megno_error: float | None
    """|Ȳ(t) − Ȳ(t/2)|; None of fewer than 64 measurements."""
    sali: float | None
    """SALI of the first two vectors: it tends to 0 exponentially on chaotic orbits."""
    gali: float | None
    """GALI of all vectors, if there are three or more."""
    exponents: list[list[float]] | None
    """The exponents of orthonormal vectors with their errors, the largest first."""
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
    run = run_of(check(chaos, locals()))
    exponents = None if exponents is None else count(exponents, "exponents")
    with bar(None, "steps", progress) as reach:
        found = _shadowstep.chaos(run, count(vectors, "vectors"), exponents, half, reach)
    records = [_indicators(record) for record in found["records"]]
    return Chaos(found["conclusion"], records[0], records[1] if half else None)


@dataclass(frozen=True)
class Indicator:
    """One indicator of chaos along a run."""

    value: float | None
    """Its value; None of a run without a step."""
    uncertainty: float
    """The error of the value; infinite of fewer than 64 measurements."""
    verdict: str
    """``"regular"``, ``"chaotic"`` or ``"undecided"``, as `Indicators.motion`."""


def lyapunov(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    steps: int | None = None,
    first: str | None = None,
    gradient_kicks: str = "exact",
    every: int = 1,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    progress: bool | None = None,
) -> Indicator:
    """The largest Lyapunov exponent λ = lim log(|δ(t)|/|δ(0)|)/t of the trajectory from the problem's initial state, by one tangent vector δ.

    The value is the growth over the last three quarters of the run, divided by their length, and its uncertainty half the width of an
    interval of 95 %: the largest of Student's intervals by the means over 6, 4 and 3 parts of them. Exponents of all vectors, and whether chaos is of the step size, are in `chaos`, which makes the run.

    G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9.

    Parameters
    ----------
    problem, scheme, h, until, steps, first, gradient_kicks, every, digits, mpfr, progress
        As in `chaos`.

    Raises
    ------
    InputError, RunError
        As `chaos`.

    Examples
    --------
    >>> import shadowstep
    >>> star = shadowstep.Problem("(x^2 + y^2)/2 + x^2*y - y^3/3", q={"x": 0, "y": "-1/4"}, p=["0.42081", 0])
    >>> found = shadowstep.lyapunov(star, "blanes-moan-srkn6b", h="1/5", until=2000)
    >>> found.verdict, 0.02 < found.value - found.uncertainty, found.value + found.uncertainty < 0.09
    ('chaotic', True, True)
    """
    along = chaos(**check(lyapunov, locals()), vectors=1, half=False).at
    return _indicator(along.motion, along.lyapunov if along.exponent is None else along.exponent, along.exponent_error)


def megno(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    steps: int | None = None,
    first: str | None = None,
    gradient_kicks: str = "exact",
    every: int = 1,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    progress: bool | None = None,
) -> Indicator:
    """The mean MEGNO, Ȳ(t) = (1/t) ∫ Y(s) ds of Y(t) = (2/t) ∫ L'(s) s ds, L(t) = log(|δ(t)|/|δ(0)|), of the trajectory from the problem's initial state.

    On regular orbits it tends to 2, or to 0 where all frequencies are constant; on chaotic ones it grows as λt/2. The uncertainty is |Ȳ(t) − Ȳ(t/2)|,
    which on a chaotic orbit is about half of the value, as there is no limit.

    P. M. Cincotta, C. Simó, Astron. Astrophys. Suppl. 147 (2000) 205; P. M. Cincotta, C. M. Giordano, C. Simó, Physica D 182 (2003) 151.

    Parameters
    ----------
    problem, scheme, h, until, steps, first, gradient_kicks, every, digits, mpfr, progress
        As in `chaos`.

    Raises
    ------
    InputError, RunError
        As `chaos`.

    Examples
    --------
    >>> import shadowstep
    >>> found = shadowstep.megno("pendulum", "yoshida4", h="1/10", until=2000)
    >>> found.verdict, abs(found.value - 2) < 0.05, found.uncertainty < 0.05
    ('regular', True, True)
    """
    along = chaos(**check(megno, locals()), vectors=1, half=False).at
    return _indicator(along.motion, along.mean_megno, along.mean_megno_error)


def _indicator(motion: str, value: float | None, uncertainty: float | None) -> Indicator:
    return Indicator(value, math.inf if uncertainty is None else uncertainty, motion)


def _indicators(record: dict[str, Any]) -> Indicators:
    names = [name for name in Indicators.__dataclass_fields__ if name not in ("h", "steps")]
    values: dict[str, Any] = {name: record.get(name) for name in names}
    return Indicators(h=float(Fraction(record["step"])), steps=record["steps"], **values)
