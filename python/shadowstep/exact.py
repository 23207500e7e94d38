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

from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Real
from typing import Any, Union

Number = Union[str, int, float, Fraction, Decimal]


def exact(value: Any, what: str = "the number") -> str:
    """The text of an exact number.

    >>> from fractions import Fraction
    >>> exact("1/3"), exact(0.1), exact(Fraction(1, 3)), exact(2)
    ('1/3', '0.1', '1/3', '2')
    >>> exact(float("nan"), "h")
    Traceback (most recent call last):
    ValueError: h must be finite, not nan
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise TypeError(f"{what} must be a number, not {value}")
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, (Fraction, Decimal)):
        return str(_finite(value, what))
    if hasattr(value, "man_exp"):  # mpmath
        mantissa, exponent = (int(part) for part in value.man_exp)
        return str(Fraction(mantissa) * Fraction(2) ** exponent)
    if isinstance(value, Real):
        return repr(_finite(float(value), what))
    raise TypeError(f"{what} must be a number or a text such as '1/10', not {type(value).__name__}")


def _finite(value: Any, what: str) -> Any:
    if value != value or value in (float("inf"), float("-inf")):
        raise ValueError(f"{what} must be finite, not {value}")
    return value
