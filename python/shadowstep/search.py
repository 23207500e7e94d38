"""Searches for schemes."""

from __future__ import annotations

import os
from typing import Union

from ._shadowstep import searched
from .arguments import check, path_of
from .exact import count
from .scheme import Scheme


def search(
    request: Union[str, os.PathLike[str]],
    *,
    starts: int | None = None,
    seed: int | None = None,
    digits: int | None = None,
) -> list[Scheme]:
    """Schemes that meet the order conditions and make an error, or another measure, least: the best first, at most as many as the request keeps.

    From random weights the way goes to the manifold on which the conditions hold, and on it to the least value. All cores are used.

    Parameters
    ----------
    request
        The path of the file of a search, or its text, which has line breaks: order, kinetic, stages, and minimise or front;
        ``shadowstep search --help`` has all keys.
    starts
        Random starts for each number of stages, in place of those of the request.
    seed
        The seed of the random numbers, in place of that of the request.
    digits
        Of the tables, at least 20 and at most 300; None for as many as can be.

    Raises
    ------
    InputError
        Faults of the request.

    Examples
    --------
    >>> found = search('''
    ... order = 2
    ... kinetic = "any"
    ... stages = 2
    ... minimise = "effective-error"
    ... ''', starts=4, digits=40)
    >>> found[0]
    Scheme('search-1': order 2, 2 forces a step)
    """
    check(search, locals())
    text = path_of(request, "request")
    path = "search"
    if "\n" not in text:
        path = text
        with open(path, encoding="utf-8") as file:
            text = file.read()
    numbers = [
        None if starts is None else count(starts, "starts", most=1_000_000),
        None if seed is None else count(seed, "seed", least=0),
        None if digits is None else count(digits, "digits", least=20, most=300),
    ]
    return [Scheme(table) for table in searched(text, path, *numbers)]
