"""Mechanisms from MuJoCo.

Where there is a file it is read from its text, whose decimals say how well they are known. A compiled model has doubles only,
in which rounding of a computation cannot be told from a measure: prefer the file.
"""

from __future__ import annotations

import os
import warnings
from typing import Any

from ._ask import Value
from ._errors import MechanismError
from ._mechanism import Mechanism, load
from .build import Builder, Frame


def from_mujoco(source: Any, **measures: Value) -> Mechanism:
    """A mechanism from an MJCF file (a path or its text), or from a compiled ``MjModel``.

    Of a model all bodies, joints, equalities and motors of joints are read, at the pose ``qpos0``. Equalities ``connect``, ``weld``
    and ``joint`` are joints and couplings; of a polynomial beyond its linear term the tangent is taken, with a warning.

    Raises :class:`MechanismError` for an equality of another kind that is active: it constrains.
    """
    if isinstance(source, (str, os.PathLike)):
        return load(source, measures=measures)
    if not hasattr(source, "nbody"):
        raise TypeError(f"needed an MJCF file, its text or an MjModel, found a value of type {type(source).__name__}")
    if measures:
        raise TypeError("a compiled model has no measures")
    return _Model(source).builder().build()


class _Model:
    def __init__(self, model: Any) -> None:
        import mujoco

        self.model = model
        self.of = mujoco
        self.kinds = {
            int(mujoco.mjtJoint.mjJNT_BALL): "spherical",
            int(mujoco.mjtJoint.mjJNT_SLIDE): "prismatic",
            int(mujoco.mjtJoint.mjJNT_HINGE): "revolute",
        }
        self.made = Builder(self._model_name(), ground=self.body(0))

    def _model_name(self) -> str:
        names: bytes = bytes(self.model.names)
        return names.split(b"\0", 1)[0].decode("utf-8", "replace") or "model"

    def named(self, kind: Any, index: int, word: str) -> str:
        name = self.of.mj_id2name(self.model, int(kind), int(index))
        return str(name) if name else f"{word}_{int(index)}"

    def body(self, index: int) -> str:
        return "world" if int(index) == 0 else self.named(self.of.mjtObj.mjOBJ_BODY, index, "body")

    def joint(self, index: int) -> str:
        return self.named(self.of.mjtObj.mjOBJ_JOINT, index, "joint")

    def builder(self) -> Builder:
        for body in range(1, int(self.model.nbody)):
            self._body(body)
        for equality in range(int(self.model.neq)):
            if self.model.eq_active0[equality]:
                self._equality(equality)
        for motor in range(int(self.model.nu)):
            if int(self.model.actuator_trntype[motor]) == int(self.of.mjtTrn.mjTRN_JOINT):
                self.made.motor(self.joint(self.model.actuator_trnid[motor][0]))
        return self.made

    def _body(self, body: int) -> None:
        model, link = self.model, self.body(body)
        parent = self.body(model.body_parentid[body])
        frame = Frame(_floats(model.body_pos[body]), quaternion=_xyzw(model.body_quat[body]))
        first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        joints = range(first, first + count)
        if count == 0:
            self.made.tree(f"{link}_fixed", "fixed", parent, link, frame, Frame())
            return
        if int(model.jnt_type[first]) == int(self.of.mjtJoint.mjJNT_FREE):
            self.made.floating(link, parent, frame)
            return
        if any(model.jnt_pos[joint].any() for joint in joints):
            # A frame beside the body's own in a turned body: the product of the two would be rounded.
            between = f"{link}_frame"
            self.made.tree(f"{between}_fixed", "fixed", parent, between, frame, Frame())
            parent, frame = between, Frame()
        for place, joint in enumerate(joints):
            last = place == count - 1
            child = link if last else f"{link}_{place + 1}"
            at = Frame(_floats(model.jnt_pos[joint]))
            # Without a place of its own the joint's frame is the body's.
            self.made.tree(
                self.joint(joint),
                self.kinds[int(model.jnt_type[joint])],
                parent,
                child,
                at if any(at.at) else frame,
                at,
                **self._numbers(joint),
            )
            parent, frame = child, Frame()

    def _numbers(self, joint: int) -> dict[str, Any]:
        model = self.model
        kind = int(model.jnt_type[joint])
        if self.kinds[kind] == "spherical":
            return {}
        numbers: dict[str, Any] = {"axis": _floats(model.jnt_axis[joint])}
        if model.jnt_limited[joint]:
            reference = float(model.qpos0[model.jnt_qposadr[joint]])
            lower, upper = _floats(model.jnt_range[joint])
            numbers["limit"] = (lower - reference, upper - reference)
        return numbers

    def _equality(self, equality: int) -> None:
        model = self.model
        name = self.named(self.of.mjtObj.mjOBJ_EQUALITY, equality, "equality")
        kind, kinds = int(model.eq_type[equality]), self.of.mjtEq
        data = _floats(model.eq_data[equality])
        first, second = int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality])
        if kind == int(kinds.mjEQ_JOINT):
            self._coupled(name, first, second, data)
        elif kind in (int(kinds.mjEQ_CONNECT), int(kinds.mjEQ_WELD)):
            welds = kind == int(kinds.mjEQ_WELD)
            self._joined(name, equality, welds, (first, second), data)
        else:
            what = "tendons" if kind == int(kinds.mjEQ_TENDON) else f"kind {kind}"
            raise MechanismError(
                f"equality `{name}` is of {what}, which is not read from a compiled model",
                "load the XML file, or switch the equality off",
            )

    def _joined(
        self, name: str, equality: int, welds: bool, objects: tuple[int, int], data: list[float]
    ) -> None:
        model = self.model
        # A weld without a scale for torques holds a point only.
        word = "fixed" if welds and data[10] != 0 else "spherical"
        if int(model.eq_objtype[equality]) == int(self.of.mjtObj.mjOBJ_SITE):
            bodies = [self.body(model.site_bodyid[site]) for site in objects]
            frames = [
                Frame(_floats(model.site_pos[site]), quaternion=_xyzw(model.site_quat[site])) for site in objects
            ]
        elif not welds:
            bodies = [self.body(body) for body in objects]
            frames = [Frame(data[0:3]), Frame(data[3:6])]
        else:
            bodies = [self.body(body) for body in objects]
            frames = [Frame(data[3:6], quaternion=_xyzw(data[6:10])), Frame(data[0:3])]
        if self._driven_by_a_user(equality, objects):
            warnings.warn(f"equality `{name}` is left out: a user moves one of its bodies", stacklevel=4)
            return
        self.made.closing(name, word, bodies[0], bodies[1], frames[0], frames[1])

    def _driven_by_a_user(self, equality: int, objects: tuple[int, int]) -> bool:
        model = self.model
        of_sites = int(model.eq_objtype[equality]) == int(self.of.mjtObj.mjOBJ_SITE)
        bodies = [model.site_bodyid[site] for site in objects] if of_sites else objects
        return any(int(model.body_mocapid[body]) >= 0 for body in bodies)

    def _coupled(self, name: str, first: int, second: int, data: list[float]) -> None:
        constant, linear = data[0], data[1]
        if any(data[2:5]):
            warnings.warn(f"equality `{name}`: its tangent at the pose drawn is taken", stacklevel=4)
        terms: dict[str, Value] = {self.joint(first): 1}
        if second >= 0 and linear != 0:
            terms[self.joint(second)] = -linear
        self.made.coupling(name, terms, constant)


def _floats(values: Any) -> list[float]:
    return [float(value) for value in values]


def _xyzw(quaternion: Any) -> list[float]:
    w, x, y, z = _floats(quaternion)
    return [x, y, z, w]
