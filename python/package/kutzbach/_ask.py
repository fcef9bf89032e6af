"""How questions are put to the compiled part, and how its numbers come back."""

from __future__ import annotations

import decimal
import json
import math
import numbers
from collections.abc import Iterable, Mapping
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
    scalar: Any = value
    if getattr(scalar, "shape", None) == () and hasattr(scalar, "item"):
        # Numbers of numpy, and arrays of one. Those of single precision are shown in digits of their own.
        is_decimal = getattr(scalar.dtype, "kind", "") == "f"
        value = decimal.Decimal(str(scalar)) if is_decimal else scalar.item()
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


REALS = frozenset({"budget", "closure_tolerance", "duration", "exact", "precision", "tolerance"})
"""What is answered by a number, zero or more; a gap up to which loops count as closed is more than zero."""

COUNTS = frozenset({"samples", "seed"})
"""What is answered by a whole number, zero or more."""

WORDS = frozenset({"branch", "configuration", "depth", "drive", "sample", "shard"})
"""What is answered by a word."""

FLAGS = frozenset({"evidence", "literal", "strict"})
"""What is answered by yes or no."""


def asked(**question: Any) -> str:
    """A question as JSON; what is ``None`` is not asked.

    >>> asked(samples=3, drive=None)
    '{"samples": 3}'
    """
    given = {name: _plain(name, value) for name, value in question.items() if value is not None}
    return json.dumps(given, allow_nan=False)


def _plain(name: str, value: Any) -> Any:
    """An answer as JSON has it; ``TypeError`` or ``ValueError`` where it is none, with its name."""
    if name in REALS:
        number = _finite(name, value)
        if number < 0 or number == 0 and name == "closure_tolerance":
            least = "more than 0" if name == "closure_tolerance" else "0 or more"
            raise ValueError(f"{name}: needed {least}, found {value!r}")
        return number
    if name in COUNTS:
        if isinstance(value, bool) or not isinstance(value, numbers.Integral):
            raise TypeError(f"{name}: needed a whole number, found {value!r}")
        if value < 0:
            raise ValueError(f"{name}: needed 0 or more, found {value!r}")
        return int(value)
    if name in WORDS | FLAGS and (name in WORDS) != isinstance(value, str):
        kind = "a text" if name in WORDS else "True or False"
        raise TypeError(f"{name}: needed {kind}, found {value!r}")
    return bool(value) if name in FLAGS else value


def _finite(name: str, value: Any) -> float:
    is_number = isinstance(value, numbers.Real | decimal.Decimal) and not isinstance(value, bool)
    if not is_number:
        raise TypeError(f"{name}: needed a number, found {value!r}")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name}: {value!r} is not finite")
    return number


def pair(name: str, value: Iterable[float] | None) -> list[float] | None:
    """Two ends of a range as plain numbers."""
    if value is None:
        return None
    ends = () if isinstance(value, str) else tuple(value)
    if len(ends) != 2:
        raise ValueError(f"{name}: needed two numbers, found {value!r}")
    return [_finite(name, end) for end in ends]


def names(value: str | Iterable[str]) -> list[str]:
    """Several names; a text is one.

    >>> names("main"), names(("main", "pivot"))
    (['main'], ['main', 'pivot'])
    """
    return [value] if isinstance(value, str) else list(value)


def table(name: str, value: Mapping[str, Any]) -> Mapping[str, Any]:
    """A mapping; ``TypeError`` where it is none."""
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: needed a mapping of names to values, found {value!r}")
    return value


def missing(kind: str, name: object, known: Iterable[str]) -> KeyError:
    """The error about a name that there is not.

    >>> missing("joint", "pivto", ["main", "pivot"])
    KeyError('there is no joint `pivto`; did you mean `pivot`?')
    >>> missing("joint", "x", ["main", "pivot"])
    KeyError('there is no joint `x`; there are `main`, `pivot`')
    """
    import difflib

    told = tuple(known)
    near = difflib.get_close_matches(name, told, n=1) if isinstance(name, str) else []
    if near:
        return KeyError(f"there is no {kind} `{name}`; did you mean `{near[0]}`?")
    if not told:
        return KeyError(f"there is no {kind} `{name}`, nor any other")
    shown = ", ".join(f"`{own}`" for own in told[:12]) + (", …" if len(told) > 12 else "")
    return KeyError(f"there is no {kind} `{name}`; there are {shown}")
