"""Mechanisms from USD: the joints of its physics schema.

Lengths stay in the stage's own unit, which counts do not depend on: a factor would hide how well single precision knows them.
"""

from __future__ import annotations

import math
import os
import warnings
from typing import Any

from ._errors import MechanismError
from ._mechanism import Mechanism
from .build import Builder, Frame

_AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}
_WORLD = "world"

# What is free of a joint whose axes are locked one by one, translations before rotations, and the kind that it is.
_BY_AXES: dict[frozenset[str], tuple[str, str | None]] = {
    frozenset(): ("fixed", None),
    frozenset(("rotX", "rotY", "rotZ")): ("spherical", None),
    frozenset(("transX", "transY", "transZ")): ("translational", None),
    **{
        frozenset(free): (kind, axis)
        for axis in "XYZ"
        for others in [[other for other in "XYZ" if other != axis]]
        for kind, free in (
            ("revolute", [f"rot{axis}"]),
            ("prismatic", [f"trans{axis}"]),
            ("cylindrical", [f"rot{axis}", f"trans{axis}"]),
            ("planar_translation", [f"trans{other}" for other in others]),
            ("planar", [f"rot{axis}", *(f"trans{other}" for other in others)]),
            ("schoenflies", [f"rot{axis}", "transX", "transY", "transZ"]),
        )
    },
}

# Prims and schemas of PhysX that couple joints.
_COUPLING = ("Gear", "RackAndPinion", "MimicJoint")


def from_usd(stage: Any) -> Mechanism:
    """A mechanism from a USD stage, or from the path of one.

    Bodies are prims with ``PhysicsRigidBodyAPI``, drawn where they stand; joints of the physics schema close between them (fixed,
    revolute, prismatic, spherical, distance, and the general joint by its locked axes). Positions of joints are in single precision,
    and are read as that. Joints that are switched off, and bodies that no joint names, are left out.

    Raises :class:`MechanismError` for what constrains and is not read, such as gears of PhysX.
    """
    if isinstance(stage, (str, os.PathLike)):
        from pxr import Usd

        stage = Usd.Stage.Open(os.fspath(stage))
    return _Stage(stage).builder().build()


class _Stage:
    def __init__(self, stage: Any) -> None:
        from pxr import Gf, Usd, UsdGeom, UsdPhysics

        self.stage, self.gf, self.physics = stage, Gf, UsdPhysics
        self.poses = UsdGeom.XformCache(Usd.TimeCode.Default())
        root = stage.GetDefaultPrim()
        self.made = Builder(root.GetName() if root else "stage", ground=_WORLD)
        self.placed: set[str] = set()

    def builder(self) -> Builder:
        joints = []
        for prim in self.stage.Traverse():
            self._refuse_coupling(prim)
            if prim.IsA(self.physics.Joint):
                joints.append(self.physics.Joint(prim))
        for joint in joints:
            if joint.GetJointEnabledAttr().Get() is not False:
                self._joint(joint)
        return self.made

    def _refuse_coupling(self, prim: Any) -> None:
        words = [str(prim.GetTypeName()), *(str(own) for own in prim.GetAppliedSchemas())]
        coupling = [word for word in words if any(known in word for known in _COUPLING)]
        if coupling:
            raise self._error(prim, f"`{coupling[0]}` couples joints and is not read", "couple them in a file of kutzbach's own")

    def _error(self, prim: Any, message: str, help: str) -> MechanismError:
        file = self.stage.GetRootLayer().identifier
        return MechanismError(f"{file}, {prim.GetPath()}: {message}", help)

    def _joint(self, joint: Any) -> None:
        prim = joint.GetPrim()
        kind, numbers = self._kind(prim)
        if kind is None:
            return
        first = self._side(joint.GetBody0Rel(), joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr())
        second = self._side(joint.GetBody1Rel(), joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr())
        if first[0] == second[0]:
            raise self._error(prim, f"both its bodies are `{first[0]}`", "join two bodies")
        self.made.closing(_name(prim), kind, first[0], second[0], first[1], second[1], **numbers)

    def _side(self, target: Any, position: Any, rotation: Any) -> tuple[str, Frame]:
        """The link on a side of a joint, and the joint's frame in it."""
        at = self.gf.Vec3d(position.Get() or self.gf.Vec3f(0))
        turned = rotation.Get() or self.gf.Quatf(1)
        paths = target.GetTargets()
        prim = self.stage.GetPrimAtPath(paths[0]) if paths else None
        if not prim:
            return _WORLD, Frame(list(at), quaternion=_xyzw(turned))
        body = prim
        while body and not body.HasAPI(self.physics.RigidBodyAPI):
            body = body.GetParent()
        of_target = self.poses.GetLocalToWorldTransform(prim)
        # A joint's place is in the body's own space, which may be scaled.
        here = of_target.Transform(at)
        if not body:
            return _WORLD, self._frame(here, turned, of_target)
        link = _name(body)
        of_body = self.poses.GetLocalToWorldTransform(body)
        if link not in self.placed:
            self.placed.add(link)
            drawn = Frame(list(of_body.ExtractTranslation()), quaternion=_xyzw(_turn(of_body)))
            self.made.floating(link, _WORLD, drawn)
        if body == prim and _unscaled(of_body):
            # Nothing is computed: the numbers are the file's.
            return link, Frame(list(at), quaternion=_xyzw(turned))
        back = _rigid(of_body, self.gf).GetInverse()
        return link, self._frame(back.Transform(here), turned, of_target * of_body.GetInverse())

    def _frame(self, at: Any, turned: Any, by: Any) -> Frame:
        whole = _turn(by) * self.gf.Quatd(turned)
        return Frame(list(at), quaternion=_xyzw(whole))

    def _kind(self, prim: Any) -> tuple[str | None, dict[str, Any]]:
        physics = self.physics
        if prim.IsA(physics.FixedJoint):
            return "fixed", {}
        if prim.IsA(physics.SphericalJoint):
            return "spherical", {}
        if prim.IsA(physics.RevoluteJoint):
            own = physics.RevoluteJoint(prim)
            return "revolute", _along(own, math.pi / 180)
        if prim.IsA(physics.PrismaticJoint):
            own = physics.PrismaticJoint(prim)
            return "prismatic", _along(own, 1.0)
        if prim.IsA(physics.DistanceJoint):
            return self._distance(prim)
        return self._by_axes(prim)

    def _distance(self, prim: Any) -> tuple[str | None, dict[str, Any]]:
        own = self.physics.DistanceJoint(prim)
        least, most = own.GetMinDistanceAttr().Get(), own.GetMaxDistanceAttr().Get()
        if least == most and least is not None and least > 0:
            return "distance", {"distance": float(least)}
        warnings.warn(f"{prim.GetPath()}: a range of distances is no constraint of motion, and is left out", stacklevel=5)
        return None, {}

    def _by_axes(self, prim: Any) -> tuple[str | None, dict[str, Any]]:
        """The general joint: an axis whose lower limit is above its upper one is locked."""
        names = [f"{what}{axis}" for what in ("trans", "rot") for axis in "XYZ"]
        free = set(names)
        if prim.HasAPI(self.physics.LimitAPI, "distance"):
            raise self._error(prim, "a limit of distance is not read here", "use a distance joint")
        for name in names:
            if prim.HasAPI(self.physics.LimitAPI, name):
                limit = self.physics.LimitAPI(prim, name)
                low, high = limit.GetLowAttr().Get(), limit.GetHighAttr().Get()
                if low is not None and high is not None and low > high:
                    free.discard(name)
        if len(free) == len(names):
            return None, {}
        found = _BY_AXES.get(frozenset(free))
        if found is None:
            raise self._error(
                prim, f"a joint that leaves {', '.join(sorted(free))} free is not read", "write it as joints in series"
            )
        kind, axis = found
        return kind, {} if axis is None else {"axis": _AXES[axis]}


def _along(joint: Any, unit: float) -> dict[str, Any]:
    """The axis and the limits of a joint of one freedom."""
    numbers: dict[str, Any] = {"axis": _AXES[str(joint.GetAxisAttr().Get() or "X")]}
    ends = [joint.GetLowerLimitAttr().Get(), joint.GetUpperLimitAttr().Get()]
    known = [None if end is None or not math.isfinite(end) else float(end) * unit for end in ends]
    if known != [None, None]:
        numbers["limit"] = (known[0], known[1])
    return numbers


def _name(prim: Any) -> str:
    """Its path without the slash before it: names alone need not be unique."""
    return str(prim.GetPath()).lstrip("/")


def _xyzw(quaternion: Any) -> list[float]:
    x, y, z = (float(own) for own in quaternion.GetImaginary())
    return [x, y, z, float(quaternion.GetReal())]


def _turn(matrix: Any) -> Any:
    """The rotation of a matrix, without scale."""
    return matrix.RemoveScaleShear().ExtractRotationQuat()


def _rigid(matrix: Any, gf: Any) -> Any:
    """A matrix without its scale, at the same place."""
    rigid = gf.Matrix4d(1)
    rigid.SetRotateOnly(_turn(matrix))
    rigid.SetTranslateOnly(matrix.ExtractTranslation())
    return rigid


def _unscaled(matrix: Any) -> bool:
    """Whether a body's axes have the length of the world's, but for rounding."""
    return all(abs(matrix.GetRow3(row).GetLength() - 1) < 1e-6 for row in range(3))
