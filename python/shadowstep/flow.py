"""Runs as functions of their initial state and of numbers of the problem."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Union

import numpy as np

from . import _shadowstep
from ._shadowstep import InputError
from .arguments import check, numbers
from .derivatives import covectors_of, variables_of
from .exact import Number, count
from .integration import integrate, run_of
from .problem import Problem, problem_of
from .scheme import Scheme


class Flow:
    """The states of a run as a function of its initial state and of numbers of the problem, with derivatives backwards: what `shadowstep.jax` and
    `shadowstep.torch` make functions of.

    Parameters
    ----------
    by
        Names of numbers, as in `derivatives`, whose values the function gets; ``"h"`` is the step size, at a fixed number of steps.
    problem, scheme, h, until, steps, first, gradient_kicks, every
        As in `integrate`.
    """

    def __init__(
        self,
        problem: Union[Problem, str],
        scheme: Union[Scheme, str, os.PathLike[str]],
        h: Number,
        until: Number | None = None,
        *,
        by: Sequence[str] = (),
        steps: int | None = None,
        first: str | None = None,
        gradient_kicks: str = "exact",
        every: int = 1,
    ) -> None:
        check(Flow.__init__, locals())
        self._problem, self._scheme, self._by = problem_of(problem), scheme, list(by)
        self._h = h
        every = count(every, "every")
        self._options: dict[str, Any] = {"first": first, "gradient_kicks": gradient_kicks, "every": every}
        if steps is None:  # of each step size
            made = integrate(self._problem, scheme, h, until, first=first, gradient_kicks=gradient_kicks, every=2**63 - 1, progress=False)
            steps = int(made.n[-1])
        self.steps = count(steps, "steps")
        """The number of steps."""
        self.dimension = self._problem.dimension
        """d, the number of coordinates."""
        self.rows = steps // every + 1 + (steps % every > 0)
        """The number of states that it has."""

    def _at(self, q: Any, p: Any, values: Any) -> tuple[Problem, Number]:
        q, p, given = numbers(q, "q"), numbers(p, "p"), numbers(values, "numbers")
        if given.shape != (len(self._by),):
            raise InputError(f"numbers: there are {given.size} for the {len(self._by)} names in `by`")
        for name, state in (("q", q), ("p", p)):
            if state.shape != (self.dimension,):
                raise InputError(f"{name} has the shape {state.shape}, not ({self.dimension},)")
        values = dict(zip(self._by, given.tolist()))
        h = values.pop("h", self._h)
        return self._problem.replaced(values, q=q, p=p), h

    def states(self, q: Any, p: Any, numbers: Any = ()) -> tuple[np.ndarray, np.ndarray]:
        """q and p of the states, of shape (rows, d), from the initial state q, p of shape (d,) with these values of the numbers."""
        problem, h = self._at(q, p, numbers)
        made = integrate(problem, self._scheme, h, steps=self.steps, progress=False, **self._options)
        return made.q, made.p

    def pull_back(self, q: Any, p: Any, numbers: Any, of_q: Any, of_p: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The derivatives of a function by q, p and the numbers, from those by the states, each of shape (rows, d)."""
        problem, h = self._at(q, p, numbers)
        variables = variables_of(problem, [*problem.coordinates, *problem.momenta, *self._by], "double", False)[1]
        run = run_of({"problem": problem, "scheme": self._scheme, "h": h, "until": None, "steps": self.steps, **self._options})
        covectors = covectors_of((self.rows, self.dimension), of_q, of_p)
        found, _ = _shadowstep.gradient(run, variables, covectors, None)
        by_q, by_p, by_numbers = np.split(found, [self.dimension, 2 * self.dimension])
        return by_q, by_p, by_numbers
