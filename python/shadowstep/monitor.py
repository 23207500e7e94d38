"""The monitor of the modified energy, for loops of one's own."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, NamedTuple, Union

import numpy as np

from . import _shadowstep
from .arguments import check
from .estimator import order_of
from .exact import Number, count, exact
from .problem import Problem, given_of
from .scheme import Scheme, table_of


class Sample(NamedTuple):
    """The modified energy in the middle of a window of states."""

    n: int
    """The state in the middle of the window."""
    modified_energy: float
    """H̄"""
    error: float | None
    """Its estimated error."""
    energy: float
    """H of the same state."""


@dataclass(frozen=True)
class Report:
    """What a run has shown so far, with a verdict on the step size. Printed, it is some lines with the numbers."""

    verdict: str
    """``bounded``, ``near-resonance``, ``drifts``, ``not-the-gradient``, ``not-smooth``, ``not-conserved``, ``inconsistent``, ``too-large``,
    ``round-off``, ``undecided``, or ``light-bodies`` where the energy error is bounded and a light body is not resolved."""
    is_bounded: bool
    """Whether the energy error is bounded, or round-off, and all light bodies are resolved; ``energy_error / kinetic`` is its size."""
    reason: str
    """The reason, a sentence with numbers."""
    text: str
    steps: int
    """How many steps were made."""
    windows: int
    """In how many windows the modified energy was estimated."""
    time: float
    """The time that the steps took, steps times |h|."""
    energy_error: float
    """max − min of H."""
    kinetic: float
    """The mean kinetic energy."""
    method_least: float | None
    """The least H − H̄: the part of the method in the energy error; None where H̄ is not known well enough for it."""
    method_largest: float | None
    """The largest H − H̄."""
    method_rms: float | None
    """The root mean square of H − H̄."""
    modified: float
    """The newest accurate H̄."""
    range: float
    """max − min of the accurate H̄."""
    change: float
    """The newest accurate H̄ less the first one."""
    moved: float
    """How far H̄ moved beyond its errors."""
    permanent_bound: float | None
    """A net change of the energy, from the beginning to the end, is excluded above this; None for fewer than 16 windows."""
    permanent_change: float | None
    """A permanent change, where one was measured."""
    resolution: float | None
    """The largest error of the accurate H̄."""
    worst_error: float | None
    """The largest error of the most accurate H̄ of a part of the run."""
    round_off: float
    """The expected effect of round-off on H̄."""
    steps_per_turn: float | None
    """In how many steps the fastest motion turns once."""
    irregular: float | None
    """0 for one oscillation, 1 for noise."""
    planets: dict[str, Any] | None
    """Of planets: ``epsilon``, the largest part of a kick beside the force of the Kepler orbit, ``of`` which planet, and the ``closest`` approach
    of two with their distance in Hill radii, and that of ``particles`` of mass 0 to planets, over all states; None of other systems."""
    light: list[dict[str, Any]]
    """Of light planets and particles: the closest approach to a heavier planet, with ``n``, ``bodies``, ``hill_radii``, the ``steps`` in the local time
    scale, and whether these are enough: ``resolved``."""

    def __str__(self) -> str:
        return self.text


class Monitor:
    """A system with its steps, whose modified energy is followed from a window of states now and then.

    It computes in a thread of its own: all threads of Python may use it, one after the other, and other threads run meanwhile. After Ctrl-C in `step`, ``n``
    says how many steps were made.

    Parameters
    ----------
    problem, scheme, h
        As in `integrate`.
    order
        The k of the estimator E_k, which needs k + 1 states.
    every
        The number of steps from a window to the next.
    digits
        ``"double"`` or ``"compensated"``.

    Examples
    --------
    >>> import shadowstep
    >>> monitor = shadowstep.Monitor(shadowstep.Problem("pendulum"), "stormer-verlet", h=0.1, every=100)
    >>> for _ in range(100):
    ...     monitor.step(100)
    >>> report = monitor.report()
    >>> report.verdict, report.steps
    ('bounded', 10000)
    >>> report.permanent_bound < 1e-3 * report.energy_error
    True
    """

    def __init__(
        self,
        problem: Union[Problem, str],
        scheme: Union[Scheme, str, os.PathLike[str]],
        h: Number,
        *,
        order: int = 8,
        every: int = 100,
        digits: str = "double",
    ) -> None:
        check(Monitor.__init__, locals())
        self._monitor: Any = _shadowstep.Monitor.of(
            given_of(problem), table_of(scheme), exact(h, "h"), order_of(order), count(every, "every"), str(digits)
        )

    def step(self, steps: int = 1) -> None:
        """Makes steps.

        Raises
        ------
        RunError
            A state of a window, or its energy, that is not finite.
        """
        self._monitor.step(count(steps, "steps", least=0))

    @property
    def n(self) -> int:
        """The number of the present state."""
        return self._monitor.n

    @property
    def state(self) -> tuple[np.ndarray, np.ndarray]:
        """q and p of the present state, of shape (d,)."""
        q, p = self._monitor.state()
        return q, p

    @property
    def energy(self) -> float:
        """H of the present state."""
        return self._monitor.energy()

    @property
    def newest(self) -> Sample | None:
        """The newest estimate; None before the first window is complete."""
        newest = self._monitor.newest
        return None if newest is None else Sample(*newest)

    def report(self) -> Report:
        """The report on the run so far."""
        return Report(**self._monitor.report())
