"""A branch followed, as arrays."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _kutzbach
from ._ask import asked, missing, names, pair
from ._mechanism import Mechanism, compiled

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray

    Array = NDArray[numpy.float64]


ARRAYS = ("values", "poses", "drive", "arclength", "closure")


class Trace:
    """A branch followed: arrays with a row for each sample."""

    def __init__(self, traced: _kutzbach.Traced) -> None:
        self._traced: _kutzbach.Traced | None = traced
        self._text = traced.json()
        self._told: dict[str, Any] = json.loads(self._text)
        self._shape = traced.shape()

    def __getstate__(self) -> dict[str, Any]:
        # The compiled part stays where it was made; what it has besides these is in the text.
        arrays = {name: getattr(self, name) for name in ARRAYS}
        return {**self.__dict__, **arrays, "_traced": None}

    @property
    def moves(self) -> bool:
        """Whether anything moves; if not, :attr:`reason` says why, and arrays are empty."""
        return bool(self._told["moves"])

    @property
    def reason(self) -> str | None:
        """Why nothing moves."""
        reason = self._told.get("reason")
        return None if reason is None else str(reason)

    @property
    def branch(self) -> str | None:
        """Name of the branch."""
        branch = self._told["branch"]
        return None if branch is None else str(branch)

    @property
    def driven(self) -> str | None:
        """Name of the joint variable that is driven."""
        driven = self._told.get("driven")
        return None if driven is None else str(driven["joint"])

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the columns of :attr:`values`."""
        return tuple(column["joint"] for column in self._told.get("columns", ()))

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links, in the order of :attr:`poses`."""
        return tuple(self._told.get("links", ()))

    @property
    def ranges(self) -> list[dict[str, Any]]:
        """How far each variable goes: ``joint``, ``unit``, ``min``, ``max``, ``travel``, ``turns``, ``moves``, ``dead_centres``."""
        return [dict(row) for row in self._told.get("ranges", ())]

    @property
    def events(self) -> list[dict[str, Any]]:
        """What is met on the way: extreme positions, limits, singular poses."""
        return [dict(row) for row in self._told.get("events", ())]

    @cached_property
    def values(self) -> Array:
        """Joint variables (rad, m): samples × variables."""
        samples, variables, _ = self._shape
        return self._array("values").reshape(samples, variables)

    @cached_property
    def poses(self) -> Array:
        """Poses of the links in the world: samples × links × 7, x y z (m) and the unit quaternion w x y z."""
        samples, _, links = self._shape
        return self._array("poses").reshape(samples, links, 7)

    @cached_property
    def drive(self) -> Array:
        """The driven variable (rad, m)."""
        return self._array("drive")

    @cached_property
    def arclength(self) -> Array:
        """Arclength from the start of the curve."""
        return self._array("arclength")

    @cached_property
    def closure(self) -> Array:
        """The largest loop equation left (rad, loop lengths)."""
        return self._array("closure")

    def value(self, variable: str) -> Array:
        """The column of one joint variable; ``KeyError`` where there is none."""
        try:
            column = self.variables.index(variable)
        except ValueError:
            raise missing("joint variable", variable, self.variables) from None
        return self.values[:, column]

    def pose(self, link: str) -> Array:
        """The poses of one link: samples × 7; ``KeyError`` where there is none."""
        try:
            index = self.links.index(link)
        except ValueError:
            raise missing("link", link, self.links) from None
        return self.poses[:, index]

    def to_dict(self) -> dict[str, Any]:
        """Everything, equal to the JSON of ``kutzbach trace``."""
        told: dict[str, Any] = json.loads(self._text)
        if not self.moves:
            return told
        rows = zip(
            self.drive.tolist(),
            self.arclength.tolist(),
            self.closure.tolist(),
            self.values.tolist(),
            self.poses.tolist(),
            strict=True,
        )
        told["samples"] = [
            {
                "drive": drive,
                "arclength": arclength,
                "closure": closure,
                "values": values,
                "links": [{"position": pose[:3], "quaternion": pose[3:]} for pose in poses],
            }
            for drive, arclength, closure, values, poses in rows
        ]
        return told

    def __len__(self) -> int:
        return self._shape[0]

    def __repr__(self) -> str:
        name = self._told["mechanism"]
        if not self.moves:
            return f"<Trace of {name!r}: {self.reason}>"
        return f"<Trace of {name!r}: branch {self.branch}, {len(self)} samples, driven {self.driven}>"

    def _array(self, name: str) -> Array:
        import numpy

        array = None if self._traced is None else self._traced.array(name)
        return numpy.frombuffer(array or b"", dtype="<f8").astype(numpy.float64)


def trace(
    mechanism: Mechanism,
    *,
    branch: str | None = None,
    drive: str | None = None,
    range: tuple[float, float] | None = None,
    hold: Sequence[str] = (),
    samples: int = 100,
    tolerance: float = 0.0,
    configuration: str | None = None,
    closure_tolerance: float | None = None,
) -> Trace:
    """Follows a branch: what ``kutzbach trace`` tells, as arrays.

    `branch` is the first if not given, `drive` a joint variable that serves; `range` are the values wanted of it (rad, m); `hold`
    are variables that rest, where the branch has more than one degree of freedom.
    """
    question = asked(
        branch=branch,
        drive=drive,
        range=pair("range", range),
        hold=names(hold),
        samples=samples,
        tolerance=tolerance,
        configuration=configuration,
        closure_tolerance=closure_tolerance,
    )
    return Trace(compiled(mechanism).trace(question))
