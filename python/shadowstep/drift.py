"""The drift of the modified energy."""

from __future__ import annotations

import os
from typing import Any, Union

from . import _shadowstep
from .arguments import check
from .estimator import options
from .exact import Number
from .integration import run_of
from .problem import Problem, problem_of
from .progress import bar
from .scheme import Scheme


def drift(
    problem: Union[Problem, str],
    scheme: Union[Scheme, str, os.PathLike[str]],
    h: Number,
    until: Number,
    *,
    digits: Union[int, str] = "double",
    mpfr: bool = False,
    estimator: str = "bilinear",
    order: int | None = None,
    max_order: int | None = None,
    stop: str | None = None,
    rule: str | None = None,
    accuracy: Number | None = None,
    control: bool = False,
    progress: bool | None = None,
) -> dict[str, Any]:
    """The drift max − min of the modified energy over a run, beside the error of H (Moan & Niesen).

    Parameters
    ----------
    scheme
        A scheme, or ``"exact-flow"`` for the exact flow of a shipped problem, on which the drift is the estimator's own error.
    h, until
        As in `integrate`; in transformed time, too, the run ends with the last whole step before ``until``.
    estimator, order, max_order, stop, rule, accuracy
        As in `integrate`; by default the best of E_2, E_4, E_8, …, E_64 for each state. ``estimator="central"`` is that of Moan and Niesen.
    control
        Whether the same is computed on the exact flow, where that is known.

    Returns
    -------
    dict
        What ``shadowstep drift --json`` prints: ``drift``, ``minimum``, ``maximum``, ``energy_error``, ``permanent_change``, ``control``,
        ``summary`` with the verdict, …; energies are decimal texts.

    Examples
    --------
    >>> import shadowstep
    >>> kepler = shadowstep.Problem("kepler", eccentricity="3/5")
    >>> found = shadowstep.drift(kepler, "stormer-verlet", h="1/20", until=20, digits=50, order=12)
    >>> float(found["drift"]) < 1e-4 < float(found["energy_error"]["largest"])
    True
    """
    given = check(drift, locals())
    problem = problem_of(problem)
    run = run_of({**given, "scheme": None if isinstance(scheme, str) and scheme == "exact-flow" else scheme})
    chosen = options(estimator, order, max_order, stop, rule, accuracy)
    with bar(None, "steps", progress) as reach:
        return _shadowstep.drift(run, problem.name, chosen, control, reach)
