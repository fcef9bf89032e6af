"""Mechanisms from other programs, where these are there."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import kutzbach
import numpy
import pytest

LOADER = "examples/first_robot/loader_mjcf.xml"


def counts(mechanism: kutzbach.Mechanism) -> tuple[Any, ...]:
    analysis = kutzbach.analyse(mechanism, "motions")
    return (analysis.verdict, analysis.freedom, analysis.instantaneous, analysis.redundant, analysis.kutzbach)


def test_mujoco_is_read_from_its_text(project: Path) -> None:
    path = project / LOADER
    assert counts(kutzbach.from_mujoco(path)) == counts(kutzbach.load(path))


def test_what_is_no_model_is_named() -> None:
    with pytest.raises(TypeError, match="MjModel, found a value of type int"):
        kutzbach.from_mujoco(3)


def test_mujoco_is_read_from_a_model(project: Path) -> None:
    mujoco = pytest.importorskip("mujoco")
    path = str(project / LOADER)
    model = mujoco.MjModel.from_xml_path(path)
    read = kutzbach.from_mujoco(model)
    assert counts(read) == counts(kutzbach.load(path))
    assert read.name == "loader" and "world" in read.links


def test_a_turned_body_with_a_joint_beside_its_frame() -> None:
    mujoco = pytest.importorskip("mujoco")
    text = """<mujoco><worldbody>
      <body name="a" pos="1 2 3" euler="30 40 50"><joint name="j" pos="0.1 0.2 0.3" axis="0 1 1"/>
        <joint name="k" type="slide" axis="1 0 0"/><geom size="0.1"/>
        <body name="b" pos="0 0 1"><joint name="l" type="ball"/><geom size="0.1"/></body></body>
      <body name="c" pos="0 0 5"><freejoint/><geom size="0.1"/></body>
    </worldbody><equality><weld body1="b" body2="c"/></equality></mujoco>"""
    read = kutzbach.from_mujoco(mujoco.MjModel.from_xml_string(text))
    assert counts(read) == counts(kutzbach.load(text))


class Joint:
    """A joint of Pinocchio, as far as it is looked at."""

    nq = nv = 1

    def __init__(self, word: str, subspace: list[float]) -> None:
        self._word, self._subspace = word, subspace

    def shortname(self) -> str:
        return self._word

    def createData(self) -> SimpleNamespace:
        return SimpleNamespace(S=None)

    def calc(self, data: SimpleNamespace, configuration: Any) -> None:
        assert len(configuration) == self.nq
        data.S = numpy.array(self._subspace).reshape(6, 1)


def placement(x: float = 0, y: float = 0, z: float = 0) -> SimpleNamespace:
    return SimpleNamespace(translation=[x, y, z], rotation=numpy.eye(3))


def test_pinocchio_is_read_joint_by_joint() -> None:
    about_z = Joint("JointModelRZ", [0, 0, 0, 0, 0, 1])
    model = SimpleNamespace(
        name="four_bar",
        names=["universe", "crank", "coupler", "rocker"],
        njoints=4,
        joints=[None, about_z, about_z, about_z],
        parents=[0, 0, 1, 0],
        jointPlacements=[placement(), placement(), placement(0, 2, 0), placement(4, 0, 0)],
    )
    loop = SimpleNamespace(
        name="end",
        type="ContactType.CONTACT_3D",
        joint1_id=2,
        joint2_id=3,
        joint1_placement=placement(4, 3, 0),
        joint2_placement=placement(0, 5, 0),
    )
    four_bar = kutzbach.from_pinocchio(model, [loop])
    assert counts(four_bar)[:3] == ("mobile", 1, 1)
    assert four_bar.joint("end").kind == "spherical"
    loop.type = "ContactType.SOMETHING_ELSE"
    with pytest.raises(kutzbach.MechanismError, match="SOMETHING_ELSE"):
        kutzbach.from_pinocchio(model, [loop])


@pytest.mark.parametrize(
    ("subspace", "kind"),
    [([0, 2, 0, 0, 0, 0], "prismatic"), ([0, 0, 0, 1, 0, 0], "revolute"), ([0, 0, 0.01, 0, 0, 1], "screw")],
)
def test_what_moves_is_read_from_the_motion_subspace(subspace: list[float], kind: str) -> None:
    model = SimpleNamespace(
        name="one",
        names=["universe", "only"],
        njoints=2,
        joints=[None, Joint("JointModelX", subspace)],
        parents=[0, 0],
        jointPlacements=[placement(), placement()],
    )
    joint = kutzbach.from_pinocchio(model).joint("only")
    assert joint.kind == kind
    assert (joint.lead is not None) == (kind == "screw")


USD = """#usda 1.0
(
    defaultPrim = "four_bar"
    metersPerUnit = 1
)
def Xform "four_bar" {
    def Xform "crank" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {}
    def Xform "coupler" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
        double3 xformOp:translate = (0, 2, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Xform "rocker" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
        double3 xformOp:translate = (4, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsRevoluteJoint "main" {
        rel physics:body1 = </four_bar/crank>
        uniform token physics:axis = "Z"
    }
    def PhysicsRevoluteJoint "pivot" {
        rel physics:body1 = </four_bar/rocker>
        point3f physics:localPos0 = (4, 0, 0)
        uniform token physics:axis = "Z"
        float physics:lowerLimit = -90
        float physics:upperLimit = 90
    }
    def PhysicsRevoluteJoint "pin" {
        rel physics:body0 = </four_bar/crank>
        rel physics:body1 = </four_bar/coupler>
        point3f physics:localPos0 = (0, 2, 0)
        uniform token physics:axis = "Z"
    }
    def PhysicsRevoluteJoint "end" {
        rel physics:body0 = </four_bar/coupler>
        rel physics:body1 = </four_bar/rocker>
        point3f physics:localPos0 = (4, 3, 0)
        point3f physics:localPos1 = (0, 5, 0)
        uniform token physics:axis = "Z"
    }
}
"""


def test_usd_is_read_by_its_joints(tmp_path: Path) -> None:
    pytest.importorskip("pxr")
    path = tmp_path / "four_bar.usda"
    path.write_text(USD)
    four_bar = kutzbach.from_usd(path)
    assert counts(four_bar) == ("mobile", 1, 1, 3, -2)
    lower, upper = four_bar.joint("four_bar/pivot").bounds or (None, None)
    assert (lower, upper) == (pytest.approx(-numpy.pi / 2), pytest.approx(numpy.pi / 2))
