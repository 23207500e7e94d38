"""Sections of a scene as TOML."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

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
        return "\n".join(f"[{_section_of_list(name, item)}" for item in content)
    return f"[{name}]\n{_lines(content)}"


def _section_of_list(name: str, content: Mapping[str, Any]) -> str:
    return f"[{name}]]\n{_lines(content)}"


def _lines(content: Mapping[str, Any]) -> str:
    return "".join(f"{key} = {_value(value, key)}\n" for key, value in content.items() if value is not None)


def _value(value: Any, what: str) -> str:
    if hasattr(value, "tolist"):  # NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_text(key)} = {_value(item, key)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item, what) for item in value) + "]"
    return _text(exact(value, what))


def _text(value: Any) -> str:
    # a string of JSON is one of TOML
    return json.dumps(str(value), ensure_ascii=False)
