"""Mechanisms made in code.

>>> import kutzbach
>>> four_bar = (
...     kutzbach.Builder("four_bar", ground="frame")
...     .measure("crank", "3/10")
...     .joint("main", "revolute", "frame", "crank", axis=(0, 0, 1))
...     .joint("pivot", "revolute", "frame", "rocker", at=(1, 0, 0), axis=(0, 0, 1))
...     .joint("pin", "revolute", "crank", "coupler", at=(0, "crank", 0), axis=(0, 0, 1))
...     .loop("end", "revolute", "coupler", "rocker", at=(1, 0, 0), successor_at=(0, "crank", 0), axis=(0, 0, 1))
... )
>>> kutzbach.analyse(four_bar.build(), "verdict").freedom
1
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any
from xml.sax.saxutils import quoteattr

from ._ask import Value, value_text
from ._mechanism import Mechanism, load

_DECIMAL = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")

Numbers = Sequence[Value]


def number(value: Value) -> str:
    """A number as an attribute has it: decimals as they are, which states how well they are known; all else as an exact expression.

    >>> from fractions import Fraction
    >>> number(0.25), number("0.866"), number(Fraction(1, 3)), number("sqrt(3)/2")
    ('0.25', '0.866', '${1/3}', '${sqrt(3)/2}')
    """
    text = value_text(value)
    return text if _DECIMAL.fullmatch(text) else f"${{{text}}}"


def numbers(values: Numbers, count: int = 3) -> str:
    """Several numbers as an attribute has them."""
    if len(values) != count:
        raise ValueError(f"needed {count} numbers, found {len(values)}")
    return " ".join(number(value) for value in values)


def attribute(text: str) -> str:
    """A name as a quoted attribute."""
    if "$" in text:
        raise ValueError(f"a name with `$` in it would be an expression: {text!r}")
    return quoteattr(text)


class Frame:
    """A pose: a position (m), and roll, pitch and yaw (rad) or a quaternion x y z w, of any length but zero."""

    def __init__(
        self, at: Numbers = (0, 0, 0), rpy: Numbers | None = None, quaternion: Numbers | None = None
    ) -> None:
        if rpy is not None and quaternion is not None:
            raise ValueError("a frame is turned by `rpy` or by `quaternion`, not by both")
        for own in (at, rpy, quaternion):
            if isinstance(own, str):
                raise TypeError(f"needed several numbers, such as (1, 0, 0), found {own!r}")
        self.at = tuple(at)
        self.rpy = None if rpy is None else tuple(rpy)
        self.quaternion = None if quaternion is None else tuple(quaternion)

    def element(self) -> str:
        """The element ``<origin>``; nothing where there is nothing to say."""
        parts = []
        if any(value != 0 for value in self.at):
            parts.append(f'xyz="{numbers(self.at)}"')
        if self.rpy is not None and any(value != 0 for value in self.rpy):
            parts.append(f'rpy="{numbers(self.rpy)}"')
        if self.quaternion is not None and any(value != 0 for value in self.quaternion[:3]):
            parts.append(f'quat_xyzw="{numbers(self.quaternion, 4)}"')
        return f"<origin {' '.join(parts)}/>" if parts else ""


class Builder:
    """Collects links, joints and loops, and makes a mechanism of them.

    Numbers are as for :func:`load`: floats and decimals state by their digits how well they are known, fractions and
    expressions are exact. A name that a call is the first to use is a new link. Methods return the builder.
    """

    def __init__(self, name: str, ground: str = "ground") -> None:
        self.name = name
        self._measures: list[tuple[str, str]] = []
        self._links: dict[str, None] = {}
        self._elements: list[str] = []
        self.link(ground)
        self._ground = ground

    def link(self, name: str) -> Builder:
        """A link."""
        self._links.setdefault(name)
        return self

    def measure(self, name: str, value: Value) -> Builder:
        """A measure that expressions name, and that :func:`load` and sweeps may give other values."""
        self._measures.append((name, value_text(value)))
        return self

    def joint(
        self,
        name: str,
        kind: str,
        parent: str,
        child: str,
        *,
        at: Numbers = (0, 0, 0),
        rpy: Numbers | None = None,
        child_at: Numbers = (0, 0, 0),
        child_rpy: Numbers | None = None,
        **more: Any,
    ) -> Builder:
        """A joint of the tree, which places its child: `kind` is the word of a file, `at` and `rpy` the joint's frame in the parent,
        `child_at` and `child_rpy` that in the child. Further arguments are those of :meth:`loop`."""
        return self.tree(name, kind, parent, child, Frame(at, rpy), Frame(child_at, child_rpy), **more)

    def tree(
        self, name: str, kind: str, parent: str, child: str, frame: Frame, in_child: Frame, **more: Any
    ) -> Builder:
        """The same with frames."""
        self.link(parent).link(child)
        inner = in_child.element()
        ends = f"<parent link={attribute(parent)}/>"
        ends += f"<child link={attribute(child)}>{inner}</child>" if inner else f"<child link={attribute(child)}/>"
        return self._joint("joint", name, kind, ends + frame.element(), **more)

    def loop(
        self,
        name: str,
        kind: str,
        predecessor: str,
        successor: str,
        *,
        at: Numbers = (0, 0, 0),
        rpy: Numbers | None = None,
        successor_at: Numbers = (0, 0, 0),
        successor_rpy: Numbers | None = None,
        **more: Any,
    ) -> Builder:
        """A joint that closes a loop between two links that are placed already, with its frame in each of them. `axis` is in the
        predecessor's frame, `axis2` in the successor's; `lead` is in metres per turn, `distance` in metres, `limit` has the least
        and the greatest value (rad, m)."""
        frames = (Frame(at, rpy), Frame(successor_at, successor_rpy))
        return self.closing(name, kind, predecessor, successor, *frames, **more)

    def closing(
        self, name: str, kind: str, predecessor: str, successor: str, frame: Frame, in_successor: Frame, **more: Any
    ) -> Builder:
        """The same with frames."""
        self.link(predecessor).link(successor)
        ends = f"<predecessor link={attribute(predecessor)}>{frame.element()}</predecessor>"
        ends += f"<successor link={attribute(successor)}>{in_successor.element()}</successor>"
        return self._joint("loop", name, kind, ends, **more)

    def floating(self, link: str, parent: str, frame: Frame) -> Builder:
        """A link that no joint of the tree places: it is drawn at a pose in another one, which constrains nothing."""
        return self.tree(f"{link}_floats", "floating", parent, link, frame, Frame())

    def coupling(self, name: str, terms: Mapping[str, Value], offset: Value = 0) -> Builder:
        """Holds a sum of joint variables, each times a factor, at an offset (rad, m)."""
        inner = "".join(
            f'<term joint={attribute(joint)} coefficient="{number(factor)}"/>' for joint, factor in terms.items()
        )
        self._elements.append(f'<coupling name={attribute(name)} offset="{number(offset)}">{inner}</coupling>')
        return self

    def configuration(self, name: str, values: Mapping[str, Value | Numbers]) -> Builder:
        """A pose by the values of joints (rad, m); those that are not named follow."""
        inner = ""
        for joint, value in values.items():
            own = [value] if isinstance(value, str) or not isinstance(value, Sequence) else list(value)
            inner += f'<position joint={attribute(joint)} value="{numbers(own, len(own))}"/>'
        self._elements.append(f"<configuration name={attribute(name)}>{inner}</configuration>")
        return self

    def motor(self, joint: str) -> Builder:
        """Says that a motor drives a joint."""
        self._elements.append(
            f"<transmission name={attribute(joint + '_motor')}><joint name={attribute(joint)}/></transmission>"
        )
        return self

    def text(self) -> str:
        """The file."""
        measures = (f"<xacro:property name={attribute(name)} value={quoteattr(value)}/>" for name, value in self._measures)
        links = (f"<link name={attribute(link)}/>" for link in self._links)
        ground = f"<ground link={attribute(self._ground)}/>"
        lines = [
            '<?xml version="1.0"?>',
            f'<robot name={attribute(self.name)} version="1.1" xmlns:xacro="http://www.ros.org/wiki/xacro">',
            *(f"  {line}" for line in (*measures, *links, ground, *self._elements)),
            "</robot>",
        ]
        return "\n".join(lines) + "\n"

    def build(self, **options: Any) -> Mechanism:
        """The mechanism; arguments are those of :func:`load`."""
        return load(self.text(), **{"name": self.name, **options})

    def _joint(
        self,
        element: str,
        name: str,
        kind: str,
        ends: str,
        *,
        axis: Numbers | None = None,
        axis2: Numbers | None = None,
        lead: Value | None = None,
        distance: Value | None = None,
        limit: tuple[Value | None, Value | None] | None = None,
    ) -> Builder:
        inner = ends
        if axis is not None:
            inner += f'<axis xyz="{numbers(axis)}"/>'
        if axis2 is not None:
            inner += f'<axis2 xyz="{numbers(axis2)}"/>'
        if lead is not None:
            inner += f'<screw lead="{number(lead)}"/>'
        if distance is not None:
            inner += f'<distance value="{number(distance)}"/>'
        if limit is not None:
            ends_of_range = zip(("lower", "upper"), limit, strict=True)
            sides = [f'{side}="{number(value)}"' for side, value in ends_of_range if value is not None]
            inner += f"<limit {' '.join(sides)}/>" if sides else ""
        self._elements.append(f'<{element} name={attribute(name)} type={attribute(kind)}>{inner}</{element}>')
        return self
