"""The options of an estimator of the modified energy, checked."""

from __future__ import annotations

from typing import Any

from .exact import Number, count, exact


def order_of(value: Any, what: str = "order") -> int:
    """The k or m of an estimator; its largest depends on the estimator."""
    return count(value, what, most=2**32 - 1)


def options(
    name: str, order: int | None, max_order: int | None, stop: str | None, rule: str | None, accuracy: Number | None
) -> dict[str, Any]:
    """What the module of Rust takes; what is not given has its default there."""
    for what, value in (("estimator", name), ("stop", stop), ("rule", rule)):
        if value is not None and not isinstance(value, str):
            raise TypeError(f"{what} must be a text, not {type(value).__name__}")
    return {
        "name": name,
        "order": None if order is None else order_of(order),
        "max_order": None if max_order is None else order_of(max_order, "max_order"),
        "stop": stop,
        "rule": rule,
        "accuracy": None if accuracy is None else exact(accuracy, "accuracy"),
    }
