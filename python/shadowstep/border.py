"""The border of the compiled module: a panic of Rust, which is no `Exception` of Python, becomes one, and a wrong type names its argument."""

from __future__ import annotations

import functools
import types
from collections.abc import Callable
from typing import Any

from . import _shadowstep


class InternalError(RuntimeError):
    """A fault of Shadowstep itself, with the sentence of the check that failed. Please report it with the call that leads to it."""


class WrongType(_shadowstep.InputError, TypeError):
    """An argument of a wrong type: an `InputError`, which is the `TypeError` of Python too."""


_PROCESSING = "while processing "


def ordinary(function: Callable[..., Any]) -> Callable[..., Any]:
    """The same function, with panics as `InternalError`, and the argument in the message of a wrong type."""

    @functools.wraps(function)
    def called(*arguments: Any, **named: Any) -> Any:
        try:
            return function(*arguments, **named)
        except (TypeError, ValueError, OverflowError) as raised:
            error: BaseException = raised
            # PyO3 notes it, where Python has notes
            notes = [note for note in getattr(error, "__notes__", ()) if note.startswith(_PROCESSING)]
            if not notes:
                raise
            argument = notes[0].removeprefix(_PROCESSING).strip("'")
            if argument in ("run", "wanted", "comparison") and error.__cause__ is not None:  # a field of it
                argument, error = str(error).rpartition(".")[2], error.__cause__
            wrong: Exception = WrongType(f"{argument}: {error}")
        except BaseException as panic:
            if type(panic).__name__ != "PanicException":
                raise
            wrong = InternalError(f"{panic} (a fault of shadowstep {_shadowstep.__version__}: please report it)")
        raise wrong

    return called


def close(module: types.ModuleType) -> None:
    """All functions of a module become `ordinary`, and all methods and properties of its classes."""
    for name, value in list(vars(module).items()):
        if isinstance(value, types.BuiltinFunctionType):
            setattr(module, name, ordinary(value))
        elif isinstance(value, type) and not issubclass(value, BaseException):
            for member, of in list(vars(value).items()):
                if isinstance(of, staticmethod):
                    setattr(value, member, staticmethod(ordinary(of.__func__)))
                elif isinstance(of, types.MethodDescriptorType):
                    setattr(value, member, ordinary(of))
                elif isinstance(of, types.GetSetDescriptorType):
                    setattr(value, member, property(ordinary(of.__get__), doc=of.__doc__))


close(_shadowstep)
