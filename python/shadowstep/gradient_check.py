"""Whether the gradient that own forces return is that of their U."""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

# Differences are taken over these parts of the largest coordinate: round-off of U spoils the near ones, its curvature the far ones.
_DISTANCES = (1e-3, 1e-5, 1e-7)
# A slope may be off by this part of the gradient, and by ten times what the differences differ among themselves; where U is in single precision or has noise,
# by the larger part.
_ALLOWED_ERROR = 1e-3
_LARGEST_ERROR = 0.03
# A gradient of fewer roundings of U than this is that of a state at rest, such as a lattice: the check is made beside it, at this part of the largest coordinate.
_ROUNDINGS = 1e4
_BESIDE = 1e-3

_POINTER = ctypes.POINTER(ctypes.c_double)


def warn_of_gradient(forces: Any, q: np.ndarray) -> None:
    """Compares the gradient with differences of U at one state, along the gradient and along one direction that is drawn; warns where they differ.

    At a state at rest, whose forces are round-off, a state beside it is taken. That takes 13 or 14 calls. What a call raises is left to the run.
    """
    evaluate = _of_address(int(forces)) if not callable(forces) else forces
    try:
        found = _difference(evaluate, q)
    except Exception:  # noqa: BLE001, as it comes again
        return
    if found is not None:
        slope, difference = found
        warnings.warn(
            f"the gradient is not that of U: at t = 0 it says that U changes by {slope:.4g} a unit along a direction, and differences of U say {difference:.4g}; "
            "check the sign, the terms and the constants of both",
            stacklevel=3,
        )


def _difference(evaluate: Callable[[np.ndarray], Any], q: np.ndarray) -> tuple[float, float] | None:
    scale = float(np.abs(q).max()) or 1.0
    drawn = np.random.default_rng(1).standard_normal(q.size)
    energy, gradient = evaluate(q.copy())
    gradient = np.array(gradient, dtype=float)
    # a difference of U over the largest of the distances may be off by this
    rounding = np.finfo(float).eps * abs(float(energy)) / (_DISTANCES[0] * scale)
    if gradient.shape == q.shape and float(np.linalg.norm(gradient)) <= _ROUNDINGS * rounding:
        q = q + _BESIDE * scale * drawn
        gradient = np.array(evaluate(q.copy())[1], dtype=float)
    size = float(np.linalg.norm(gradient))
    if not 0 < size < np.inf or gradient.shape != q.shape:
        return None
    for direction in (gradient / size, drawn / np.linalg.norm(drawn)):
        slope = float(gradient @ direction)
        steps = [distance * scale * direction for distance in _DISTANCES]
        rises = [float(evaluate(q + step)[0]) - float(evaluate(q - step)[0]) for step in steps]
        found = [rise / (2 * distance * scale) for rise, distance in zip(rises, _DISTANCES)]
        nearest = min(found, key=lambda difference: abs(difference - slope))
        if abs(nearest - slope) > _allowed(found, size) + 10 * rounding:
            return slope, nearest
    return None


def _allowed(found: list[float], size: float) -> float:
    far, middle, near = found
    if middle == near:  # both are 0 where q is rounded to single precision
        return _LARGEST_ERROR * size
    uncertainty = min(abs(far - middle), abs(middle - near))
    return min(_LARGEST_ERROR * size, _ALLOWED_ERROR * size + 10 * uncertainty)


def _of_address(address: int) -> Callable[[np.ndarray], Any]:
    function = ctypes.CFUNCTYPE(ctypes.c_double, _POINTER, _POINTER)(address)

    def evaluate(q: np.ndarray) -> tuple[float, np.ndarray]:
        q, gradient = np.ascontiguousarray(q), np.zeros_like(q)
        return function(q.ctypes.data_as(_POINTER), gradient.ctypes.data_as(_POINTER)), gradient

    return evaluate
