"""Reading, exact numbers, errors with their places."""

import pickle
from fractions import Fraction
from pathlib import Path

import kutzbach
import pytest

ARM = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="length" value="1/3"/>
  <link name="base"/> <link name="upper"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/> <child link="upper"/> <origin xyz="${length} 0.25 ${sqrt(3)/2}"/> <axis xyz="0 0 1"/>
    <limit lower="-1" upper="2"/>
  </joint>
</robot>"""


def test_a_text_and_a_path_are_told_apart(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM)
    by_text = kutzbach.load(ARM, name="an arm")
    assert (by_text.file, by_text.name) == ("an arm", "arm")
    for source in (path, str(path)):
        assert kutzbach.load(source).file == str(path)
        assert kutzbach.load(source).links == by_text.links == ("base", "upper")


def test_numbers_are_exact() -> None:
    joint = kutzbach.load(ARM).joint("shoulder")
    assert joint.predecessor.position == (Fraction(1, 3), Fraction(1, 4), joint.predecessor.position[2])
    irrational = joint.predecessor.position[2]
    assert isinstance(irrational, str) and "sqrt(3)" in irrational
    assert joint.axis == (Fraction(0), Fraction(0), Fraction(1))
    assert joint.bounds == (-1.0, 2.0)
    assert (joint.kind, joint.letters, joint.freedom, joint.links) == ("revolute", "R", 1, ("base", "upper"))


@pytest.mark.parametrize(
    ("value", "expected"),
    [(2, Fraction(2)), (0.125, Fraction(1, 8)), (Fraction(2, 7), Fraction(2, 7)), ("3/8", Fraction(3, 8)), (-1, Fraction(-1))],
)
def test_measures_take_values(value: kutzbach.Value, expected: Fraction) -> None:
    arm = kutzbach.load(ARM, length=value)
    assert arm.measures == ("length",)
    assert arm.joint("shoulder").predecessor.position[0] == expected
    again = kutzbach.load(ARM, measures={"length": value})
    assert again.joint("shoulder") == arm.joint("shoulder")


def test_values_that_are_none_are_refused() -> None:
    for value in (float("nan"), float("inf")):
        with pytest.raises(ValueError, match="finite"):
            kutzbach.load(ARM, length=value)
    with pytest.raises(TypeError):
        kutzbach.load(ARM, length=True)


def test_errors_have_their_place() -> None:
    with pytest.raises(kutzbach.MechanismError) as caught:
        kutzbach.load(ARM.replace("revolute", "revolut"), name="arm.urdf")
    error = caught.value
    assert (error.file, error.line, error.column) == ("arm.urdf", 4, 32)
    assert error.help == "did you mean `revolute`?"
    assert str(error).startswith("arm.urdf:4:32: ")
    again = pickle.loads(pickle.dumps(error))
    assert (again.line, str(again)) == (4, str(error))


def test_further_faults_are_told_together() -> None:
    wrong = ARM.replace("revolute", "revolut").replace('<link name="base"/>', '<link name="base"/><link/>')
    with pytest.raises(kutzbach.MechanismError) as caught:
        kutzbach.load(wrong)
    assert len(caught.value.others) >= 1
    assert all(other.line for other in caught.value.others)


def test_what_is_not_there_is_an_error() -> None:
    with pytest.raises(kutzbach.MechanismError, match=r"^no/such/file\.urdf: cannot be read") as caught:
        kutzbach.load("no/such/file.urdf")
    assert (caught.value.line, caught.value.column) == (None, None)
    with pytest.raises(kutzbach.MechanismError, match="widt"):
        kutzbach.load(ARM, widt=1)
    with pytest.raises(KeyError):
        kutzbach.load(ARM).joint("elbow")


def test_a_mechanism_can_be_pickled_and_written() -> None:
    arm = kutzbach.load(ARM, length="sqrt(2)")
    again = pickle.loads(pickle.dumps(arm))
    assert again.to_dict() == arm.to_dict()
    native = kutzbach.load(arm.native())
    assert native.joint("shoulder").predecessor.position == arm.joint("shoulder").predecessor.position


def test_a_graph_has_links_and_joints(linkage: kutzbach.Mechanism) -> None:
    pytest.importorskip("networkx")
    graph = linkage.to_networkx()
    assert set(graph.nodes) == set(linkage.links)
    assert graph.number_of_edges() == 4
    assert graph.nodes["frame"]["ground"]
    assert graph.edges["coupler", "rocker", "end"]["closes_loop"]
