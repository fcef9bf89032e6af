"""Mechanisms from Pinocchio."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from ._errors import MechanismError
from ._mechanism import Mechanism
from .build import Builder, Frame

# Kinds whose freedoms do not show in a constant motion subspace, by the name of the model.
_SPHERICAL = ("JointModelSpherical", "JointModelSphericalZYX")
_SMALL = 1e-12


def from_pinocchio(model: Any, constraint_models: Iterable[Any] = (), name: str | None = None) -> Mechanism:
    """A mechanism from a Pinocchio ``Model`` and the constraints that close its loops.

    Links are called as the joints that bear them, the ground ``universe``; each joint is in the frame that the model gives it, at its
    neutral configuration. Constraints of three dimensions are spherical joints, those of six are fixed. Numbers are doubles: what a
    file said of its decimals is gone, so that :func:`load` of the file tells more.

    Raises :class:`MechanismError` for a joint or a constraint of another kind.
    """
    made = Builder(name or str(model.name) or "model", ground="universe")
    names = ["universe", *(str(own) for own in list(model.names)[1:])]
    for index in range(1, int(model.njoints)):
        _joint(made, model, names, index)
    for number, constraint in enumerate(constraint_models):
        _constraint(made, names, number, constraint)
    return made.build()


def _joint(made: Builder, model: Any, names: list[str], index: int) -> None:
    joint, link = model.joints[index], names[index]
    parent = names[int(model.parents[index])]
    frame = _frame(model.jointPlacements[index])
    word = str(joint.shortname())
    if word == "JointModelFreeFlyer":
        made.floating(link, parent, frame)
        return
    kind, numbers = _kind(joint, word, link)
    made.tree(link, kind, parent, link, frame, Frame(), **numbers)


def _kind(joint: Any, word: str, name: str) -> tuple[str, dict[str, Any]]:
    if word in _SPHERICAL:
        return "spherical", {}
    if word == "JointModelTranslation":
        return "translational", {}
    if word == "JointModelPlanar":
        return "planar", {"axis": (0, 0, 1)}
    if int(joint.nv) == 1:
        return _of_one_freedom(joint, name)
    raise MechanismError(
        f"joint `{name}` is a {word}, which is not read",
        "joints of one freedom, spherical, planar, translational and free joints are",
    )


def _of_one_freedom(joint: Any, name: str) -> tuple[str, dict[str, Any]]:
    """What moves, from the motion subspace: a column of linear and angular velocity in the joint's frame."""
    import numpy

    data = joint.createData()
    # Neutral: zero, or for a joint that turns without bounds the cosine and the sine of zero.
    neutral = numpy.zeros(int(joint.nq))
    if int(joint.nq) == 2:
        neutral[0] = 1.0
    joint.calc(data, neutral)
    column = numpy.asarray(data.S, dtype=float).reshape(6)
    linear, angular = column[:3], column[3:]
    turns, slides = float(numpy.linalg.norm(angular)), float(numpy.linalg.norm(linear))
    if turns < _SMALL:
        return "prismatic", {"axis": _floats(linear)}
    if slides < _SMALL:
        return "revolute", {"axis": _floats(angular)}
    along = float(linear @ angular) / turns
    if abs(abs(along) - slides) > _SMALL * slides:
        raise MechanismError(f"joint `{name}` turns about an axis that is not in its frame", "place the joint on its axis")
    return "screw", {"axis": _floats(angular), "lead": 2 * math.pi * along / turns}


def _constraint(made: Builder, names: list[str], number: int, constraint: Any) -> None:
    name = str(getattr(constraint, "name", "")) or f"constraint_{number}"
    kind = str(getattr(constraint, "type", type(constraint).__name__))
    if "CONTACT_3D" in kind or "BilateralPoint" in kind:
        word = "spherical"
    elif "CONTACT_6D" in kind or "Weld" in kind:
        word = "fixed"
    else:
        raise MechanismError(
            f"constraint `{name}` is a {kind}, which is not read", "constraints of three and of six dimensions are"
        )
    if name in names:
        name = f"{name}_{number}"
    made.closing(
        name,
        word,
        names[int(constraint.joint1_id)],
        names[int(constraint.joint2_id)],
        _frame(constraint.joint1_placement),
        _frame(constraint.joint2_placement),
    )


def _frame(placement: Any) -> Frame:
    return Frame(_floats(placement.translation), quaternion=quaternion(placement.rotation))


def _floats(values: Any) -> list[float]:
    return [float(value) for value in values]


def quaternion(rotation: Any) -> list[float]:
    """The quaternion x y z w of a matrix, of any length: from its largest entry, so that nothing is divided by little.

    >>> quaternion([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    [0.0, 0.0, 2.0, 2.0]
    """
    r = [[float(rotation[row][column]) for column in range(3)] for row in range(3)]
    # Four times the products of each component with all four.
    rows = [
        [1 + r[0][0] - r[1][1] - r[2][2], r[0][1] + r[1][0], r[0][2] + r[2][0], r[2][1] - r[1][2]],
        [r[0][1] + r[1][0], 1 - r[0][0] + r[1][1] - r[2][2], r[1][2] + r[2][1], r[0][2] - r[2][0]],
        [r[0][2] + r[2][0], r[1][2] + r[2][1], 1 - r[0][0] - r[1][1] + r[2][2], r[1][0] - r[0][1]],
        [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1], 1 + r[0][0] + r[1][1] + r[2][2]],
    ]
    # Of equal ones the row of the scalar.
    return rows[max((3, 0, 1, 2), key=lambda row: rows[row][row])]
