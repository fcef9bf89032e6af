"""How questions are put to the compiled part, and how its numbers come back."""

from __future__ import annotations

import decimal
import json
import math
import numbers
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, TypeAlias, Union

Exact: TypeAlias = Union[Fraction, str]
"""An exact number: a fraction, or the expression of a number that is none, such as ``"sqrt(3)/2"``."""

Value: TypeAlias = Union[int, float, Fraction, decimal.Decimal, str]
"""A value to give: numbers as they are shown, expressions such as ``"pi/4"`` as strings."""


def value_text(value: Value) -> str:
    """A value as a file would have it.

    >>> value_text(Fraction(1, 3)), value_text(0.5), value_text("pi/4")
    ('1/3', '0.5', 'pi/4')
    """
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, decimal.Decimal):
        if not value.is_finite():
            raise ValueError(f"{value} is not finite")
        return str(value)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"needed a number or an expression, found {value!r}")
    if isinstance(value, numbers.Rational):
        if value.denominator == 1:
            return str(int(value))
        return f"{int(value.numerator)}/{int(value.denominator)}"
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{number} is not finite")
    return repr(number)


def exact(number: Mapping[str, Any]) -> Exact:
    """An exact number from its text.

    >>> exact({"fraction": "1/2", "source": "0.5"}), exact({"fraction": None, "source": "${sqrt(2)}"})
    (Fraction(1, 2), 'sqrt(2)')
    """
    fraction = number["fraction"]
    if fraction is not None:
        return Fraction(fraction)
    source: str = number["source"]
    if source.startswith("${") and source.endswith("}"):
        return source[2:-1]
    return source


def asked(**question: Any) -> str:
    """A question as JSON; what is ``None`` is not asked."""
    given = {name: value for name, value in question.items() if value is not None}
    return json.dumps(given, allow_nan=False)


def pair(value: tuple[float, float] | None) -> list[float] | None:
    """Two ends of a range as plain numbers."""
    if value is None:
        return None
    low, high = value
    return [float(low), float(high)]
