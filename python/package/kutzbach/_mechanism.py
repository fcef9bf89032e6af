"""A mechanism that was read, and how one is read."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _kutzbach
from ._ask import Exact, Value, asked, exact, missing, table, value_text

if TYPE_CHECKING:
    import networkx


@dataclass(frozen=True)
class Side:
    """One side of a joint: the link, and the joint's frame in it (metres, radians; fixed axes x, y, z)."""

    link: str
    position: tuple[Exact, ...]
    roll_pitch_yaw: tuple[Exact, ...]


@dataclass(frozen=True)
class Joint:
    """A joint of a mechanism, those that close loops too. Numbers are exact: fractions, or expressions as strings."""

    name: str
    kind: str
    """The word in a file, such as ``"revolute"``."""
    letters: str
    """The short name of its class, such as ``"R"``."""
    freedom: int
    variables: tuple[str, ...]
    """Names of its variables, such as ``"slider.rot"``."""
    closes_loop: bool
    predecessor: Side
    successor: Side
    axis: tuple[Exact, ...] | None
    """In the predecessor's frame; any length but zero. ``None`` where the kind has none."""
    axis2: tuple[Exact, ...] | None
    """In the successor's frame."""
    lead: Exact | None
    """Metres per turn."""
    distance: Exact | None
    bounds: tuple[float | None, float | None] | None
    """Least and greatest value (rad, m) of a joint of one freedom; ``None`` where the file states none."""

    @property
    def links(self) -> tuple[str, str]:
        """The two links."""
        return (self.predecessor.link, self.successor.link)


def _numbers(numbers: list[Mapping[str, Any]] | None) -> tuple[Exact, ...] | None:
    return None if numbers is None else tuple(exact(number) for number in numbers)


def _side(told: Mapping[str, Any]) -> Side:
    return Side(
        told["link"],
        _numbers(told["position"]) or (),
        _numbers(told["roll_pitch_yaw"]) or (),
    )


def _joint(told: Mapping[str, Any]) -> Joint:
    lead, distance, bounds = told["lead"], told["distance"], told["bounds"]
    return Joint(
        name=told["name"],
        kind=told["kind"],
        letters=told["class"],
        freedom=told["freedom"],
        variables=tuple(told["variables"]),
        closes_loop=told["closes_loop"],
        predecessor=_side(told["predecessor"]),
        successor=_side(told["successor"]),
        axis=_numbers(told["axis"]),
        axis2=_numbers(told["axis2"]),
        lead=None if lead is None else exact(lead),
        distance=None if distance is None else exact(distance),
        bounds=None if bounds is None else (bounds[0], bounds[1]),
    )


class Mechanism:
    """A mechanism: links and joints with exact numbers. It is valid, and it does not change. :func:`load` makes one."""

    def __init__(self, reading: _kutzbach.Reading, again: tuple[Any, ...]) -> None:
        self._reading = reading
        # How it was read: what another process needs to read it as well.
        self._again = again

    def __reduce__(self) -> tuple[Any, ...]:
        return (_read, self._again)

    @cached_property
    def _told(self) -> dict[str, Any]:
        told: dict[str, Any] = json.loads(self._reading.description())
        return told

    @property
    def name(self) -> str:
        """Its name."""
        return str(self._told["name"])

    @property
    def file(self) -> str:
        """The file, or the name of the text."""
        return str(self._told["file"])

    @property
    def format(self) -> str:
        """The file's format, such as ``"urdf"`` or ``"mjcf"``."""
        return str(self._told["format"])

    @property
    def ground(self) -> str:
        """The link that counts as standing still."""
        return str(self._told["ground"])

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links."""
        return tuple(self._told["links"])

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """The joints, those that close loops too."""
        return tuple(_joint(told) for told in self._told["joints"])

    @property
    def couplings(self) -> tuple[str, ...]:
        """Names of the couplings."""
        return tuple(coupling["name"] for coupling in self._told["couplings"])

    @property
    def configurations(self) -> tuple[str, ...]:
        """Names of the configurations beside the pose drawn."""
        return tuple(self._told["configurations"])

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the measures that its file defines, which :func:`load` and :func:`sweep` can give values."""
        return tuple(self._told["measures"])

    @property
    def freedom(self) -> int:
        """Freedoms of all its joints together."""
        return int(self._told["freedom"])

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was read otherwise than it may have been meant, each with line and column."""
        told = self._told["warnings"]
        return tuple(f"{own['line']}:{own['column']}: {own['message']}" for own in told)

    def joint(self, name: str) -> Joint:
        """A joint by its name; ``KeyError`` where there is none."""
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise missing("joint", name, (joint.name for joint in self.joints))

    def native(self) -> str:
        """The mechanism in kutzbach's own format, numbers as they were written."""
        return self._reading.native()

    def page(self, configuration: str | None = None) -> str:
        """The report as one HTML page that moves, for any browser."""
        return self._reading.page(asked(configuration=configuration))

    def to_dict(self) -> dict[str, Any]:
        """Links, joints, couplings and configurations as plain data; exact numbers as ``fraction`` and ``source``."""
        told: dict[str, Any] = json.loads(self._reading.description())
        return told

    def to_networkx(self) -> networkx.MultiGraph[str]:
        """Links as nodes and joints as edges between them, with ``kind``, ``freedom`` and ``closes_loop``."""
        from ._graph import graph

        return graph(self.links, self.ground, [_edge(joint) for joint in self.joints])

    def __repr__(self) -> str:
        links, joints = len(self.links), len(self.joints)
        plural = "" if joints == 1 else "s"
        return f"<Mechanism {self.name!r}: {links} links, {joints} joint{plural}>"

    def _repr_html_(self) -> str:
        return framed(self.page())


def compiled(mechanism: Mechanism) -> _kutzbach.Reading:
    """The compiled part of a mechanism; ``TypeError`` where it is none."""
    if not isinstance(mechanism, Mechanism):
        found = type(mechanism).__name__
        raise TypeError(f"needed a Mechanism, found a value of type {found}: kutzbach.load reads a file or a text")
    return mechanism._reading


def _edge(joint: Joint) -> dict[str, Any]:
    return {
        "name": joint.name,
        "links": joint.links,
        "kind": joint.kind,
        "freedom": joint.freedom,
        "closes_loop": joint.closes_loop,
    }


def framed(page: str) -> str:
    """A page in a frame of its own, so that neither it nor the notebook around it changes the other."""
    return (
        f'<iframe srcdoc="{html.escape(page, quote=True)}" sandbox="allow-scripts" '
        'style="width:100%;height:640px;border:0"></iframe>'
    )


def load(
    source: str | os.PathLike[str],
    *,
    name: str = "text",
    measures: Mapping[str, Value] | None = None,
    literal: bool = False,
    precision: float | None = None,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
    strict: bool = False,
    **more: Value,
) -> Mechanism:
    """Reads a mechanism from a file, or from a text, in any format that kutzbach reads.

    A string with a ``<`` or a line break in it is a text, which errors call `name`; any other is a path. Further arguments are
    values for the file's measures (``<xacro:property>``, ``<xacro:arg>``): numbers, fractions, or expressions such as ``"pi/4"``.
    `measures` has those whose names are arguments of this function.

    `literal` takes decimals as they are written, so that ``1.5707963267948966`` is not read as π/2; `precision` states how well
    they are known (m, rad); `packages` says where ROS packages are; if `strict`, what would be skipped is an error.

    Raises :class:`MechanismError` with file, line and column.

    >>> import kutzbach
    >>> arm = kutzbach.load('''
    ... <robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
    ...   <xacro:property name="length" value="1/2"/>
    ...   <link name="base"/> <link name="upper"/>
    ...   <joint name="shoulder" type="revolute">
    ...     <parent link="base"/> <child link="upper"/> <origin xyz="${length} 0 0"/> <axis xyz="0 0 1"/>
    ...   </joint>
    ... </robot>''', length="sqrt(2)")
    >>> arm
    <Mechanism 'arm': 2 links, 1 joint>
    >>> arm.joint("shoulder").predecessor.position[0]
    'sqrt(2)'
    """
    if not isinstance(source, str | os.PathLike):
        raise TypeError(f"needed a path or a text, found a value of type {type(source).__name__}")
    values = {**table("measures", measures or {}), **more}
    question = asked(
        settings=[[own, value_text(value)] for own, value in values.items()],
        literal=literal,
        precision=precision,
        packages=[[own, os.fspath(path)] for own, path in table("packages", packages or {}).items()],
        strict=strict,
    )
    text = isinstance(source, str) and ("<" in source or "\n" in source)
    return _read(text, os.fspath(source), name, question)


def _read(text: bool, source: str, name: str, question: str) -> Mechanism:
    if text:
        reading = _kutzbach.read_text(source, name, question)
    else:
        reading = _kutzbach.read_file(source, question)
    return Mechanism(reading, (text, source, name, question))
