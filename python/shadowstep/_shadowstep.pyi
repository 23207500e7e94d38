"""The compiled module: plain values in and out. The package's own classes and functions are what its users call."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

__version__: str

class InputError(ValueError):
    hint: str | None
    faults: list[dict[str, Any]]

class RunError(ArithmeticError):
    hint: str | None

class Given:
    @staticmethod
    def of_text(text: str, path: str) -> Given: ...
    @staticmethod
    def of_file(path: str | os.PathLike[str]) -> Given: ...
    @staticmethod
    def of_forces(function: Any, q: Sequence[str], p: Sequence[str], masses: Sequence[str] | None) -> Given: ...
    @property
    def source(self) -> tuple[str, str] | None: ...
    @property
    def coordinates(self) -> list[str]: ...
    @property
    def momenta(self) -> list[str]: ...
    @property
    def initial(self) -> tuple[list[float], list[float]]: ...
    @property
    def energy(self) -> float: ...

class Table:
    @staticmethod
    def of_word(word: str) -> Table: ...
    @staticmethod
    def of_text(text: str, path: str, name: str | None = None) -> Table: ...
    @property
    def name(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def path(self) -> str: ...
    def record(self) -> str: ...
    def facts(self) -> tuple[str, int | None, int, int]: ...

class Monitor:
    @staticmethod
    def of(problem: Given, scheme: Table, h: str, *, order: int, every: int, digits: str) -> Monitor: ...
    def step(self, count: int) -> None: ...
    @property
    def n(self) -> int: ...
    def state(self) -> list[np.ndarray]: ...
    def energy(self) -> float: ...
    @property
    def newest(self) -> tuple[int, float, float | None, float] | None: ...
    def report(self) -> dict[str, Any]: ...

class Observer:
    @staticmethod
    def of(masses: Sequence[float], h: str, window: int, cell: list[list[float]] | None, periodic: Sequence[bool]) -> Observer: ...
    def begin(self, n: int) -> None: ...
    @property
    def window(self) -> int: ...
    def observe(
        self, q: np.ndarray, p: np.ndarray, energy: float, forces: np.ndarray, half_step: bool
    ) -> tuple[int, float, float, float] | None: ...
    def values(self) -> tuple[list[int], tuple[list[float], list[float], list[float]]]: ...
    def diagnosis(self, units: tuple[str, str, float] | None) -> dict[str, Any]: ...

Progress = Callable[[int], None] | None

def shipped_names() -> list[str]: ...
def problem_names() -> list[str]: ...
def emit(scheme: Table, target: str) -> str: ...
def command(arguments: Sequence[str], program: str | None) -> int: ...
def integrate(
    problem: Given,
    scheme: Table,
    h: str,
    *,
    steps: int | None,
    until: str | None,
    first: str | None,
    gradient_kicks: str,
    every: int,
    digits: str,
    mpfr: bool,
    options: Mapping[str, Any] | None,
    progress: Progress,
) -> dict[str, Any]: ...
def ensemble(text: str, names: Sequence[str], columns: Sequence[np.ndarray], *, progress: Progress) -> dict[str, Any]: ...
def chaos(
    problem: Given,
    scheme: Table,
    h: str,
    *,
    steps: int | None,
    until: str | None,
    first: str | None,
    gradient_kicks: str,
    vectors: int,
    exponents: int | None,
    every: int,
    half: bool,
    digits: str,
    mpfr: bool,
    progress: Progress,
) -> str: ...
def drift(
    problem: Given,
    name: str,
    scheme: Table | None,
    h: str,
    until: str,
    *,
    digits: str,
    mpfr: bool,
    options: Mapping[str, Any],
    control: bool,
    progress: Progress,
) -> str: ...
def work_precision(
    problem: Given,
    until: str,
    schemes: Sequence[Table],
    group: str | None,
    *,
    first: str | None,
    steps: Sequence[int] | None,
    digits: str,
    seconds: float,
    folder: str,
    progress: Progress,
) -> str: ...
def advise(
    problem: Given,
    until: str,
    tolerance: float,
    *,
    of: str,
    cost: str,
    schemes: Sequence[Table],
    group: str | None,
    first: str | None,
    digits: str,
    seconds: float,
    folder: str,
    progress: Progress,
) -> str: ...
def run_scene(
    path: str, text: str | None, *, restart: bool, progress: Progress
) -> tuple[str | None, tuple[str, str] | None, list[str]]: ...
def scene_text(name: str) -> str: ...
def energies_of_log(
    q: np.ndarray,
    p: np.ndarray,
    energies: np.ndarray,
    forces: np.ndarray | None,
    rates: np.ndarray | None,
    masses: Sequence[float],
    h: str,
    k: int,
) -> tuple[tuple[list[int], list[float], list[float]], str | None]: ...
def energies_of_states(
    q: np.ndarray, p: np.ndarray, problem: Given, scheme: Table, h: str, k: int
) -> tuple[list[int], list[float], list[float]]: ...
def momenta_of_half_steps(states: int, half_steps: np.ndarray) -> list[float]: ...
def momenta_with_forces(h: str, half_steps: np.ndarray, forces: np.ndarray) -> list[float]: ...
def unwrapped(q: np.ndarray, cell: list[list[float]], periodic: Sequence[bool]) -> list[float]: ...
