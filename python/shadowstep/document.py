"""Sections of a scene as TOML."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from .arguments import refuse_other
from .border import WrongType
from .exact import exact


def document(sections: Mapping[str, Any]) -> str:
    """The text of a scene's sections; those that are None or empty are left out.

    >>> print(document({"problem": {"name": "kepler", "parameters": {"eccentricity": 0.3}}}), end="")
    [problem]
    name = "kepler"
    parameters = {"eccentricity" = "0.3"}
    """
    return "\n".join(_section(name, content) for name, content in sections.items() if content)


def _section(name: str, content: Any) -> str:
    if isinstance(content, (list, tuple)):
        return "\n".join(f"[[{name}]]\n{_lines(item, f'{name}[{i}]')}" for i, item in enumerate(content))
    return f"[{name}]\n{_lines(content, name)}"


def _lines(content: Any, name: str) -> str:
    if not isinstance(content, Mapping):
        raise WrongType(f"{name} must be a mapping of keys to values, or a list of such, not {type(content).__name__}")
    # the keys of some sections are arguments by themselves
    of = "" if name in ("problem", "initial") else f"{name}."
    return "".join(f"{key} = {_value(value, f'{of}{key}')}\n" for key, value in content.items() if value is not None)


def _value(value: Any, what: str) -> str:
    if hasattr(value, "tolist"):  # NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_text(key)} = {_value(item, f'{what}.{key}')}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item, what) for item in value) + "]"
    refuse_other(value, (Fraction,), what)
    return _text(exact(value, what))


def _text(value: Any) -> str:
    # a string of JSON is one of TOML
    return json.dumps(str(value), ensure_ascii=False)
