"""The options of an estimator of the modified energy, checked."""

from __future__ import annotations

from typing import Any

from ._shadowstep import InputError
from .exact import Number, count, exact


def order_of(value: Any, what: str = "order") -> int:
    """The k or m of an estimator; its largest depends on the estimator."""
    return count(value, what, most=2**32 - 1)


def options_if_any(name: str | None, **others: Any) -> dict[str, Any] | None:
    """The same where an estimator may be left out, with all its options."""
    given = next((f"{option}={value!r}" for option, value in others.items() if value is not None), None)
    if name is None and given is not None:
        raise InputError(f'{given} is an option of an estimator: give one, such as estimator="bilinear"')
    return None if name is None else options(name, **others)


def options(
    name: str, order: int | None, max_order: int | None, stop: str | None, rule: str | None, accuracy: Number | None
) -> dict[str, Any]:
    """What the module of Rust takes; what is not given has its default there."""
    return {
        "name": name,
        "order": None if order is None else order_of(order),
        "max_order": None if max_order is None else order_of(max_order, "max_order"),
        "stop": stop,
        "rule": rule,
        "accuracy": None if accuracy is None else exact(accuracy, "accuracy"),
    }
