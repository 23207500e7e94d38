"""Numbers of Python as exact numbers.

| given | means |
| --- | --- |
| ``"1/3"``, ``"sqrt(2)/20"`` | the value of the formula |
| ``1``, ``Fraction(1, 3)``, ``Decimal("0.1")`` | itself |
| ``0.1`` | the decimal that Python prints for it, 1/10 |
| ``numpy.float64(0.1)`` | the same |
| ``mpmath.mpf("0.1")`` | its binary value |
"""

from __future__ import annotations

import operator
from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Real
from typing import Any, Union

from . import _shadowstep
from .border import WrongType

Number = Union[str, int, float, Fraction, Decimal]


def exact(value: Any, what: str = "the number") -> str:
    """The text of an exact number.

    >>> from fractions import Fraction
    >>> exact("1/3"), exact(0.1), exact(Fraction(1, 3)), exact(2)
    ('1/3', '0.1', '1/3', '2')
    >>> exact(float("nan"), "h")
    Traceback (most recent call last):
    shadowstep.InputError: h must be finite, not nan
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise WrongType(f"{what} must be a number, not {value}")
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Decimal) and value.is_nan():  # a signalling one cannot be compared
        raise _shadowstep.InputError(f"{what} must be finite, not {value}")
    if isinstance(value, (Fraction, Decimal)):
        return str(_finite(value, what))
    if hasattr(type(value), "man_exp"):  # mpmath
        try:
            mantissa, exponent = (int(part) for part in value.man_exp)
        except ValueError:
            raise _shadowstep.InputError(f"{what} must be finite, not {value}") from None
        return str(Fraction(mantissa) * Fraction(2) ** exponent)
    if isinstance(value, Real):
        return repr(_finite(float(value), what))
    raise WrongType(f"{what} must be a number or a text such as '1/10', not {type(value).__name__}")


def count(value: Any, what: str, least: int = 1, most: int = 2**63 - 1) -> int:
    """A number of steps, states or the like.

    >>> count(7, "every")
    7
    >>> count(0, "every")
    Traceback (most recent call last):
    shadowstep.InputError: every = 0 is too small: give 1 or more
    >>> count(0.5, "every")
    Traceback (most recent call last):
    shadowstep.border.WrongType: every must be a whole number, not 0.5
    """
    try:
        found = operator.index(value)
    except TypeError:
        raise WrongType(f"{what} must be a whole number, not {value!r}") from None
    if found < least:
        raise _shadowstep.InputError(f"{what} = {found} is too small: give {least} or more")
    if found > most:
        raise _shadowstep.InputError(f"{what} = {found} is too large: give {most} or less")
    return found


def _finite(value: Any, what: str) -> Any:
    if value != value or value in (float("inf"), float("-inf")):
        raise _shadowstep.InputError(f"{what} must be finite, not {value}")
    return value
