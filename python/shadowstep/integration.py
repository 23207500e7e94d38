"""Runs into arrays."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _shadowstep
from ._shadowstep import InputError
from .arguments import check
from .estimator import options_if_any
from .exact import Number, count, exact
from .problem import Problem, given_of
from .progress import bar
from .scheme import Scheme, table_of

if TYPE_CHECKING:
    import pandas
    import xarray


_OF_STATES = ("t", "q", "p", "energy", "modified_energy", "modified_energy_error", "tangent")


@dataclass(frozen=True, repr=False)
class Trajectory:
    """States of a run, n of them with d coordinates.

    In double precision all are arrays of float64. With more digits they are arrays of decimal texts, which read back to the same
    numbers; `mpmath` converts them.
    """

    n: np.ndarray
    """The numbers of the states, of shape (n,); at a surface of section those of the states before."""
    t: np.ndarray
    """Their times t = n h, of shape (n,); in transformed time the physical ones."""
    q: np.ndarray
    """Positions, of shape (n, d)."""
    p: np.ndarray
    """Momenta, of shape (n, d)."""
    energy: np.ndarray
    """H, of shape (n,)."""
    coordinates: list[str]
    """The names of the coordinates."""
    momenta: list[str]
    """The names of the momenta."""
    force_evaluations: int | None
    """Evaluations of the gradient, those for the states that only the estimator needs included; None of a file."""
    modified_energy: np.ndarray | None = None
    """The modified energy H̄, of shape (n,), if an estimator was asked for."""
    modified_energy_error: np.ndarray | None = None
    """Its estimated error."""
    order: np.ndarray | None = None
    """The k of E_k or the m of D_m of each estimate."""
    planets: dict[str, Any] | None = None
    """Of planets: ``epsilon``, the largest part of a kick beside the force of the Kepler orbit, ``of`` which planet, and the ``closest`` approach
    of two with their distance in Hill radii, and that of ``particles`` of mass 0 to planets, over the states that are kept; None of other systems."""
    is_between: bool = False
    """Whether the modified energies belong to the times t + h/2; the last one is then NaN."""
    notes: list[str] = field(default_factory=list)
    """What should be known of the run; each was a warning, too."""
    metadata: dict[str, Any] = field(default_factory=dict)
    """Of a file: what determined the run."""
    indicators: dict[str, np.ndarray] = field(default_factory=dict)
    """Of a file with `chaos`: lyapunov, megno, mean_megno and sali, each of shape (n,)."""
    values: dict[str, np.ndarray] = field(default_factory=dict)
    """Of `values`, and of a file with `elements`: each column, of shape (n,). Elements are heliocentric unless the scene has a ``centre``, and Jacobi ones in REBOUND."""
    summary: dict[str, Any] | None = None
    """What the run has shown, if that was asked for: the verdict, the error of H, close encounters, …; see ``summary_text``."""
    summary_text: str = "There is no summary: integrate(…, summary=True) makes one, and run(…).summary is that of a scene."
    """The same as lines."""
    tangent: np.ndarray | None = None
    """The tangent vectors (δq, δp) at the states, of shape (n, vectors, 2d), if first ones were given."""

    def mpmath(self, name: str, digits: int | None = None) -> list[Any]:
        """Numbers of more digits as those of mpmath: nested lists of `mpf` in the shape of the array.

        ``digits`` sets ``mpmath.mp.dps``, which is otherwise taken as it is.
        """
        import mpmath

        check(Trajectory.mpmath, locals())
        if name not in _OF_STATES:
            raise InputError(f"name = {name!r} is not an array of the trajectory: it is one of {', '.join(_OF_STATES)}")
        if getattr(self, name) is None:
            raise InputError(f"name = {name!r}: the trajectory has no such array")
        if digits is not None:
            mpmath.mp.dps = count(digits, "digits")
        convert = np.vectorize(mpmath.mpf, otypes=[object])
        return convert(getattr(self, name)).tolist()

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each state, with columns n, t, those of the coordinates and momenta, energy, modified_energy and its error, and of a file its values and
        indicators of chaos."""
        import pandas

        columns = {"n": self.n, "t": self.t}
        columns |= {name: self.q[:, i] for i, name in enumerate(self.coordinates)}
        columns |= {name: self.p[:, i] for i, name in enumerate(self.momenta)}
        columns |= self._functions()
        return pandas.DataFrame(columns)

    def to_xarray(self) -> xarray.Dataset:
        """q and p over time and coordinates; energies, values and indicators over time."""
        import xarray

        data: dict[str, Any] = {"q": (("time", "coordinate"), self.q), "p": (("time", "coordinate"), self.p)}
        data |= {name: (("time",), values) for name, values in self._functions().items()}
        return xarray.Dataset(data, coords={"time": self.t, "n": (("time",), self.n), "coordinate": self.coordinates})

    def _functions(self) -> dict[str, np.ndarray]:
        """What has one number at each state: energies, values and indicators."""
        energies = {"energy": self.energy, "modified_energy": self.modified_energy, "modified_energy_error": self.modified_energy_error}
        return {**{name: numbers for name, numbers in energies.items() if numbers is not None}, **self.values, **self.indicators}

    def __len__(self) -> int:
        return len(self.n)

    def __repr__(self) -> str:
        modified = "" if self.modified_energy is None else ", with modified energies"
        times = f", t = {self.t[0]} to {self.t[-1]}" if len(self) else ""
        return f"Trajectory({len(self)} states of {self.q.shape[1]} coordinates{times}{modified})"


def integrate(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number | None = None,
    *,
    steps: int | None = None,
    end: str | None = None,
    section: str | None = None,
    direction: str | None = None,
    first: str | None = None,
    gradient_kicks: str = "exact",
    every: int | None = None,
    values: Mapping[str, str] | None = None,
    tangent: Sequence[Sequence[Number]] | np.ndarray | None = None,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    estimator: str | None = None,
    order: int | None = None,
    max_order: int | None = None,
    stop: str | None = None,
    rule: str | None = None,
    accuracy: Number | None = None,
    summary: bool = False,
    windows: int | None = None,
    progress: bool | None = None,
) -> Trajectory:
    """Makes a run of a scheme from the problem's initial state.

    A step alternates kicks p ← p − h a_s U_q(q) and drifts q ← q + h b_s T_p(p).

    Parameters
    ----------
    problem
        H and the initial state, or the name of a shipped problem.
    scheme
        A scheme, or the name or path of one.
    h
        The step size, exact: ``"1/20"``; a float is the decimal that Python prints. A negative one goes back in time.
    until, steps
        One of the two: the time at which the run ends at the latest, or the number of steps. In transformed time h is a step of s and ``until`` a
        physical time, to which a last step is made.
    end
        A condition that ends the run before, at the first state after t = 0 that meets it: one comparison of formulas in the coordinates, momenta,
        parameters, t and the energy E, such as ``"x^2 + y^2 > 100"``.
    section, direction
        A surface of section: in place of states at equal times those are kept at which this formula in the coordinates, momenta, parameters and the energy E becomes
        0, ``direction="up"`` growing (the default), ``"down"`` falling, or ``"both"``. Each is found by a step of a part of h from the state before, so it is
        a point of the trajectory with the error of one step (M. Hénon, Physica D 5 (1982) 412); `Trajectory.n` is the number of the state before. Up and down
        are in the order of the steps. Not found are two crossings within a step and zeros without a change of sign; a pole is no crossing.
    first
        ``"kick"`` or ``"drift"``: what steps begin with, in place of what the table has.
    gradient_kicks
        ``"exact"``, or ``"displaced"``, which needs no second derivatives.
    every
        The states 0, every, 2 every, … and the last one are kept; all by default.
    values
        Formulas whose values at the kept states are arrays in `Trajectory.values`, by their names, in the coordinates, momenta, parameters, t, the energy E and
        quantities such as ``kinetic`` and ``distance(earth, moon)``: ``{"r": "sqrt(x^2 + y^2)"}``; ``shadowstep scene --explain`` lists all.
    tangent
        Tangent vectors (δq, δp) at t = 0, of 2d components each, which the derivative of each step takes along: δ ← DΦ δ, where a kick is
        δp ← δp − h a_s U_qq δq and a drift δq ← δq + h b_s T_pp δp. They are neither normalised nor made orthogonal; each costs about twice a run.
        In transformed time steps are given. See `derivatives` for derivatives by parameters, and `lyapunov` for growth.
    digits
        ``"double"``, ``"compensated"`` (double precision in which q and p are sums with remainders), ``"double-double"``, or a number of
        decimal digits.
    mpfr
        MPFR's numbers for these digits, in wheels that are built with it.
    estimator
        ``"bilinear"`` (E_k) or ``"central"`` (D_m), for the modified energies of the states that are kept; None for none.
    order
        Its k or m; by default for each state the best of k = 2, 4, 8, … and ``max_order``, or of all m up to it. ``stop``, ``rule`` and ``accuracy`` say how that is found:
        see ``shadowstep drift --help``.
    summary
        Whether the run is followed for a summary with a verdict on the step size; `Trajectory.summary_text` is printed.
    windows
        In about how many windows of 17 states, spread over the run, the summary compares modified energies: 256 if none is given, at least 16.
    progress
        Whether to show a progress bar, for which tqdm is needed; by default on a terminal or in a notebook, on runs of more than a second.

    Raises
    ------
    InputError
        What is wrong with an argument, and what would be right.
    RunError
        A state or an energy that is not finite.

    Examples
    --------
    >>> import shadowstep
    >>> run = shadowstep.integrate(shadowstep.Problem("pendulum"), "stormer-verlet", h="1/10", until=10)
    >>> run
    Trajectory(101 states of 1 coordinates, t = 0.0 to 10.0)
    >>> run.q.shape, run.force_evaluations
    ((101, 1), 101)
    >>> shadowstep.integrate(shadowstep.Problem("pendulum"), "stormer-verlet", h="1/10", until=100, summary=True).summary["verdict"]
    'bounded'
    >>> precise = shadowstep.integrate(shadowstep.Problem("pendulum"), "yoshida4", h="1/10", steps=3, digits=50)
    >>> precise.t[-1]
    '0.3'
    >>> nearby = shadowstep.integrate(shadowstep.Problem("pendulum"), "yoshida4", h="1/10", until=10, tangent=[[1, 0], [0, 1]])
    >>> nearby.tangent.shape
    (101, 2, 2)
    >>> abs(float(np.linalg.det(nearby.tangent[-1])) - 1) < 1e-12  # steps are symplectic
    True
    >>> turned = shadowstep.integrate(shadowstep.Problem("pendulum"), "yoshida4", h="1/10", until=100, end="p < 0")
    >>> float(turned.t[-1])
    1.7
    >>> orbit = shadowstep.integrate(shadowstep.Problem("kepler"), "yoshida4", h="1/20", until=10, values={"r": "sqrt(x^2 + y^2)", "L": "x*py - y*px"})
    >>> bool(np.ptp(orbit.values["r"]) > 1), bool(np.ptp(orbit.values["L"]) < 1e-14)
    (True, True)
    >>> galaxy = shadowstep.Problem("henon-heiles")
    >>> cut = shadowstep.integrate(galaxy, "blanes-moan-srkn11b", h="1/10", until=1000, section="x")
    >>> cut.q.shape, bool(abs(cut.q[:, 0]).max() < 1e-14), bool((cut.p[:, 0] > 0).all())
    ((158, 2), True, True)
    """
    given = check(integrate, locals())
    if section is None and direction is not None:
        raise InputError(f'direction={direction!r} requires a section: section="x"')
    for what, value in (("every", every), ("estimator", estimator), ("tangent", tangent)):
        if section is not None and value is not None:
            raise InputError(f"{what} is given beside a section, whose states are the crossings only; remove one of the two")
    if windows is not None and not summary:
        raise InputError("windows are of a summary: add summary=True")
    if windows is not None and windows < _shadowstep.LEAST_WINDOWS:
        raise InputError(f"windows must be at least {_shadowstep.LEAST_WINDOWS}, not {windows}")
    run = run_of({**given, "every": 1 if every is None else every})
    wanted = {
        "end": end,
        "section": None if section is None else (section, direction or "up"),
        "values": list(_formulas(values or {}).items()),
        "estimator": options_if_any(estimator, order=order, max_order=max_order, stop=stop, rule=rule, accuracy=accuracy),
        "summary": summary,
        "windows": windows,
        "tangent": tangent is not None,
    }
    vectors = None if tangent is None else _texts(tangent)
    with bar(run["steps"], "steps", progress) as reach:
        found = _shadowstep.integrate(run, wanted, reach)
        if vectors is not None:  # as far as the run went
            n, (_, columns) = _shadowstep.derivatives({**run, "last": abs(int(found["n"][-1]))}, vectors, reach)
            found["tangent"] = vectors_of(columns, len(n))
    for note in found["notes"]:
        warnings.warn(note, stacklevel=2)
    rows, (coordinates, momenta) = len(found["n"]), run["problem"].names
    if section is not None and not rows:
        warnings.warn(f"the trajectory does not cross section={section!r}, direction={direction or 'up'!r}", stacklevel=2)
    for name in ("q", "p"):
        found[name] = found[name].reshape(rows, len(coordinates))
    found["values"] = dict(zip(values or {}, found["values"]))
    return Trajectory(coordinates=coordinates, momenta=momenta, **found)


def _formulas(values: Mapping[str, str]) -> dict[str, str]:
    for name, formula in values.items():
        if not (isinstance(name, str) and isinstance(formula, str)):
            raise InputError(f"values has {name!r}: {formula!r}, which is not a name with a formula: values={{'r': 'sqrt(x^2 + y^2)'}}")
    return dict(values)


def _texts(tangent: Sequence[Sequence[Number]] | np.ndarray) -> list[list[str]]:
    try:
        vectors = np.asarray(tangent, dtype=object)
    except ValueError:  # rows of different lengths, with arrays
        vectors = np.empty(0)
    if vectors.ndim != 2 or len(vectors) == 0:
        raise InputError("`tangent` is not a list of vectors: tangent = [[1, 0], [0, 1]]")
    return [[exact(x, "tangent") for x in vector] for vector in vectors.tolist()]


def vectors_of(columns: Sequence[np.ndarray], rows: int) -> np.ndarray:
    """Tangent vectors at a number of states, of shape (rows, vectors, 2d), from the flat array of each."""
    return np.stack([column.reshape(rows, -1) for column in columns], axis=1)


def run_of(given: Mapping[str, Any]) -> dict[str, Any]:
    """A run as the compiled module takes it, from the arguments of a function; what it has not as an argument has its default."""
    steps, until, scheme = given.get("steps"), given["until"], given["scheme"]
    return {
        "problem": given_of(given["problem"]),
        "scheme": None if scheme is None else table_of(scheme),
        "h": exact(given["h"], "h"),
        "steps": None if steps is None else count(steps, "steps"),
        "until": None if until is None else exact(until, "until"),
        "last": None,
        "first": given.get("first"),
        "gradient_kicks": given.get("gradient_kicks", "exact"),
        "every": count(given.get("every", 1), "every"),
        "digits": str(given.get("digits", "double")),
        "mpfr": given.get("mpfr", False),
    }
