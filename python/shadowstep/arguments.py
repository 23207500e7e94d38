"""The types of arguments, by their annotations: a wrong one is told with the argument's name, before anything is computed."""

from __future__ import annotations

import operator
import os
import re
import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from decimal import Decimal
from fractions import Fraction
from functools import cache
from numbers import Real
from typing import Any, Union, get_args, get_origin, get_type_hints

import numpy as np

from ._shadowstep import InputError
from .border import WrongType


def check(function: Callable[..., Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Refuses values of other types than the annotations of a function have; what is given to it, which is returned, is ``locals()`` at its beginning.

    Raises
    ------
    WrongType
        With the name of the argument.
    """
    for name, kinds in _kinds_of(function).items():
        refuse_other(given[name], kinds, name)
    return dict(given)


def refuse_other(value: Any, kinds: tuple[Any, ...], name: str) -> None:
    """Refuses a value that is of none of the kinds."""
    if not any(_is_of(value, kind) for kind in kinds):
        words = " or ".join(dict.fromkeys(_word(kind) for kind in kinds if kind is not type(None)))
        shown = repr(value) if isinstance(value, (bool, int, float, str)) and len(repr(value)) < 40 else type(value).__name__
        raise WrongType(f"{name} must be {words}, not {shown}")


@contextmanager
def naming(name: str, where: str = "") -> Iterator[None]:
    """Puts the name of an argument before what is wrong with it, where that does not have it; only before messages with a pattern, if one is given."""
    try:
        yield
    except InputError as error:
        if re.search(where, str(error), re.MULTILINE) and not re.search(rf"\b{name}\b", str(error)):
            error.args = (f"{name}: {error}",)
        raise


@cache
def _kinds_of(function: Callable[..., Any]) -> dict[str, tuple[Any, ...]]:
    """The kinds of the arguments that are known by their types alone."""
    hints = {name: _flat(hint) for name, hint in get_type_hints(function).items() if name != "return"}
    return {name: kinds for name, kinds in hints.items() if all(_is_known(kind) for kind in kinds)}


def _flat(hint: Any) -> tuple[Any, ...]:
    if get_origin(hint) in (Union, types.UnionType):
        kinds = tuple(kind for part in get_args(hint) for kind in _flat(part))
        # an exact number has several types
        return tuple(kind for kind in kinds if kind not in (str, int, float, Decimal)) if Fraction in kinds else kinds
    return (hint,)


_WORDS: dict[Any, str] = {
    bool: "True or False",
    int: "a whole number",
    float: "a number",
    str: "a text",
    Fraction: "a number or a text such as '1/10'",
    os.PathLike: "a path",
    np.ndarray: "an array",
    Callable: "a function",
    Mapping: "a mapping of names to values",
    Iterable: "a list",
    type(None): "None",
}


def _kind(hint: Any) -> Any:
    """The entry of `_WORDS` for a type; None for another one."""
    origin = get_origin(hint) or hint
    if origin in _WORDS:
        return origin
    if origin is _CALLABLE:
        return Callable
    return next((kind for kind in (Mapping, Iterable) if isinstance(origin, type) and origin.__module__ == "collections.abc" and issubclass(origin, kind)), None)


_CALLABLE = get_origin(Callable[..., Any])


def _is_known(hint: Any) -> bool:
    kind = _kind(hint)
    # what lists of other things may be is known where they are read
    return kind is not None and (kind is not Iterable or all(_is_known(part) for of in get_args(hint) for part in _flat(of)))


def _word(hint: Any) -> str:
    kind = _kind(hint)
    return "a list of texts" if kind is Iterable and get_args(hint) == (str,) else _WORDS[kind]


def _is_of(value: Any, hint: Any) -> bool:
    kind = _kind(hint)
    if kind is bool:
        return isinstance(value, (bool, np.bool_))
    if kind in (int, float, Fraction) and isinstance(value, (bool, np.bool_)):
        return False
    if kind is int:
        try:
            operator.index(value)
        except TypeError:
            return False
        return True
    if kind is float:
        # a signalling NaN cannot be converted
        return isinstance(value, Real) or (isinstance(value, Decimal) and not value.is_snan())
    if kind is Fraction:
        return _is_text(value) or isinstance(value, (Real, Decimal)) or hasattr(type(value), "man_exp")
    if kind is np.ndarray:
        return hasattr(value, "__array__") or is_list(value)
    if kind is Iterable:
        texts = get_args(hint) == (str,) and isinstance(value, (list, tuple, set, np.ndarray))
        return is_list(value) and not (texts and not all(_is_text(item) for item in value))
    if kind is str:
        return _is_text(value)
    return callable(value) if kind is Callable else isinstance(value, kind)


def is_list(value: Any) -> bool:
    """Whether values are taken from it one by one."""
    return isinstance(value, Iterable) and not isinstance(value, (str, bytes, Mapping)) and not (isinstance(value, np.ndarray) and value.ndim == 0)


def _is_text(value: Any) -> bool:
    """Half of a character alone is no text."""
    return isinstance(value, str) and not any("\ud800" <= character <= "\udfff" for character in value)


def path_of(value: Any, name: str) -> str:
    """The path or the text of an argument.

    >>> path_of(3, "scene")
    Traceback (most recent call last):
    shadowstep.border.WrongType: scene must be a text or a path, not 3
    """
    refuse_other(value, (str, os.PathLike), name)
    path: Any = os.fspath(value)
    if not isinstance(path, str):
        path = os.fsdecode(path)
    if "\0" in path:
        raise WrongType(f"{name} has a NUL character, which no path has")
    return path


def numbers(value: Any, name: str) -> np.ndarray:
    """An array of doubles.

    >>> numbers([[1, 2], [3]], "q")
    Traceback (most recent call last):
    shadowstep.border.WrongType: q must be an array of numbers: it has rows of different lengths
    >>> numbers(["a"], "q")
    Traceback (most recent call last):
    shadowstep.border.WrongType: q must be an array of numbers, not list
    """
    try:
        array = np.asarray(value)
    except ValueError:
        raise WrongType(f"{name} must be an array of numbers: it has rows of different lengths") from None
    # None would become NaN, and a complex number its real part
    if array.dtype.kind in "biufO" and not (array.dtype.kind == "O" and any(item is None for item in array.flat)):
        try:
            return array.astype(np.float64)
        except (TypeError, ValueError, OverflowError, ArithmeticError):
            pass
    if array.dtype.kind in "US":
        try:
            return array.astype(np.float64)
        except ValueError:
            pass
    raise WrongType(f"{name} must be an array of numbers, not {type(value).__name__}")
