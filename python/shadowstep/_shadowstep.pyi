"""The compiled module: plain values in and out. The package's own classes and functions, which have the types, are what its users call."""

from typing import Any

__version__: str

class InputError(ValueError):
    hint: str | None
    faults: list[dict[str, Any]]

class RunError(ArithmeticError):
    hint: str | None

def __getattr__(name: str) -> Any: ...
