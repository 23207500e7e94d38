"""Positions and momenta by names, in the order of the coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from . import _shadowstep


def in_order(values: Any, names: Sequence[str], argument: str) -> Any:
    """The numbers of a mapping in the order of the names; other values as they are.

    Raises
    ------
    InputError
        A name that is missing, or is none of them.
    """
    if not isinstance(values, Mapping):
        return values
    others = [name for name in values if name not in names]
    missing = [name for name in names if name not in values]
    if others or missing:
        fault = f"has {others[0]!r}, which is none of its names" if others else f"has no {missing[0]!r}"
        example = ", ".join(f'"{name}": …' for name in names)
        raise _shadowstep.InputError(f"{argument} {fault}; write {argument}={{{example}}}")
    return [values[name] for name in names]


def names_of(values: Any, *choices: Sequence[str]) -> Sequence[str]:
    """The names that a mapping means: those of the choices of which it has one, the first if it has none."""
    return next((names for names in choices if isinstance(values, Mapping) and any(name in names for name in values)), choices[0])
