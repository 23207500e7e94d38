"""What monitors of other programs' runs have in common: they follow the states, and never stop the run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from .monitor import Sample
from .recorded import Diagnosis, Observer

# The step is too large where H changes in it by this part of the kinetic energy or more, as for the monitor;
_TOO_LARGE = 0.4
# and a move is that of a step where it is off by less than this part of itself.
_OF_A_STEP = 1e-3

State = tuple[np.ndarray, np.ndarray, float, np.ndarray]


class Following:
    """States one by one, in windows; what the observer cannot take ends the following, not the run."""

    def __init__(self, observer: Observer, h: float, masses: np.ndarray, every: int, units: tuple[str, str, float]) -> None:
        self._observer = observer
        self._h, self._masses, self._every, self._units = h, masses, every, units
        self._before: int | None = None
        self._last: State | None = None
        self._energies: list[float] = []
        self._kinetic: list[float] = []
        self._end: tuple[str, str] | None = None
        self.newest: Sample | None = None
        """The newest estimate; None before the first."""

    def _is_taken(self, n: int) -> bool:
        return self._every <= self._observer.window or n % self._every < self._observer.window

    def _follow(self, n: int, state: Callable[[], State], **observed: Any) -> None:
        """Takes the state n. Nothing is raised: it would stop the run of the other program."""
        if self._end is not None or n == self._before:
            return
        given: State | None = None
        try:
            if n != (0 if self._before is None else self._before + 1):
                self._observer.begin(n)
                self._last = None
            q, p, energy, forces = given = state()
            self._before = n
            sample = self._observer.observe(q, p, energy, forces, **observed)
        except Exception as error:  # noqa: BLE001, whatever it is, the run goes on
            self._end = self._concluded(n, str(error).splitlines()[0], given)
            return
        self.newest = sample or self.newest
        self._last = given
        if observed.get("half_step"):
            p = p + self._h / 2 * np.ravel(forces)
        self._kinetic.append(float((np.ravel(p) ** 2 / self._masses).sum() / 2))
        self._energies.append(self._kinetic[-1] + energy)

    def _concluded(self, n: int, error: str, given: State | None) -> tuple[str, str]:
        """The cause and the reason, where a state cannot be followed."""
        if self._has_lost_energy() or (given is not None and self._is_a_step(given[0])):
            return "time-step", f"the time step is too large: the run cannot be followed to state {n}: {error}"
        return "undecided", f"not decided: the run cannot be followed to state {n}: {error}"

    def _has_lost_energy(self) -> bool:
        return len(self._energies) > 1 and self._largest_change() >= _TOO_LARGE

    def _largest_change(self) -> float:
        """What H changes by from a state to the next, as a part of the median of T."""
        return float(np.abs(np.diff(self._energies)).max() / np.median(self._kinetic))

    def _is_a_step(self, q: np.ndarray) -> bool:
        """Whether the newest state moves to these positions by a step, however far that is."""
        if self._last is None:
            return False
        before, p, _, forces = (np.ravel(of) for of in self._last)
        move = self._h * (p + self._h / 2 * forces) / self._masses
        found = np.ravel(q) - before
        return bool(np.linalg.norm(found - move) <= _OF_A_STEP * np.linalg.norm(move))

    @property
    def values(self) -> dict[str, np.ndarray]:
        """Arrays ``n``, ``modified_energy``, ``error`` and ``energy`` of all states that have an estimate, in the units of `diagnosis`."""
        return self._observer.values

    def diagnosis(self) -> Diagnosis:
        """What moves the energy, as far as the states so far tell; a state that cannot be followed, as where steps are far too large, ends them."""
        found = self._observer._in_units(self._units)
        end = self._end
        if end is None and found.cause in ("undecided", "jumps") and self._has_lost_energy():
            # estimates are of the middles of windows, and the energy may be lost before
            end = "time-step", f"the time step is too large: H changes by {self._largest_change():.1e} of T in a step"
        if end is None:
            return found
        cause, reason = end
        head, *lines = found.text.splitlines()
        count = head[head.index("(") :]
        return replace(found, cause=cause, reason=reason, text="\n".join([f"{cause.replace('-', ' ')} {count}", *lines[:-1], f"  {reason}"]))
