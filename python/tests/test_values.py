"""What may be given, what is refused and in which words, and what comes out of other processes whole."""

import copy
import pickle
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import kutzbach
import numpy
import pytest


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (numpy.float64(0.1), Fraction(1, 10)),
        (numpy.float32(0.1), Fraction(1, 10)),
        (numpy.float32(1e-7), Fraction(1, 10**7)),
        (numpy.array(0.25), Fraction(1, 4)),
        (numpy.int64(3), Fraction(3)),
        (Decimal("0.30"), Fraction(3, 10)),
    ],
)
def test_numbers_of_numpy_are_the_decimals_that_are_shown(linkage_text: str, value: Any, expected: Fraction) -> None:
    pin = kutzbach.load(linkage_text, crank=value).joint("pin")
    assert pin.predecessor.position[1] == expected


def test_a_sweep_takes_whatever_has_values(linkage: kutzbach.Mechanism) -> None:
    for values in (numpy.linspace(1, 2, 3, dtype=numpy.float32), [1, Decimal("1.5"), 2], (own / 2 for own in (2, 3, 4)), "1..2:3"):
        assert kutzbach.sweep(linkage, {"crank": values}, depth="rank").column("crank") == [1, 1.5, 2]
    for single in (2, numpy.float64(2), numpy.array(2), "2"):
        assert kutzbach.sweep(linkage, {"crank": single, "coupler": [3, 4]}, depth="rank").column("crank") == [2, 2]
    rows = kutzbach.sweep(linkage, {"crank": "1..2:3"}, depth="rank")
    assert rows[-1] == rows.rows[2] and rows[:2] == rows.rows[:2]
    assert rows._repr_html_().count("<tr>") == 4 and "<th>crank</th>" in rows._repr_html_()
    assert len(repr(kutzbach.sweep(linkage, {"crank": numpy.linspace(1, 2, 30)}, depth="rank"))) < 100


ASKED: list[tuple[str, type[Exception], str, Callable[[Any], object]]] = [
    ("a path for a mechanism", TypeError, "kutzbach.load", lambda m: kutzbach.analyse("four_bar.urdf")),
    ("a path for a swept one", TypeError, "kutzbach.load", lambda m: kutzbach.sweep("a.urdf", {"crank": 1})),
    ("bytes", TypeError, "path or a text", lambda m: kutzbach.load(b"<robot/>")),
    ("a text for a number", TypeError, "closure_tolerance", lambda m: kutzbach.analyse(m, closure_tolerance="1e-3")),
    ("no gap", ValueError, "closure_tolerance", lambda m: kutzbach.analyse(m, closure_tolerance=0)),
    ("no number", ValueError, "budget", lambda m: kutzbach.exact(m, budget=float("nan"))),
    ("less than no work", ValueError, "exact", lambda m: kutzbach.analyse(m, exact=-1)),
    ("half a sample", TypeError, "samples", lambda m: kutzbach.trace(m, samples=2.5)),
    ("less than no samples", ValueError, "samples", lambda m: kutzbach.trace(m, samples=-1)),
    ("three ends", ValueError, "range", lambda m: kutzbach.trace(m, range=(0, 1, 2))),
    ("a number for a name", TypeError, "branch", lambda m: kutzbach.trace(m, branch=1)),
    ("names without values", TypeError, "hold", lambda m: kutzbach.assemble(m, hold=["main"])),
    ("measures without values", TypeError, "over", lambda m: kutzbach.sweep(m, ["crank"])),
    ("no values", ValueError, "crank", lambda m: kutzbach.sweep(m, {"crank": []})),
    ("a value that is none", TypeError, "crank", lambda m: kutzbach.sweep(m, {"crank": [1, None]})),
    ("another joint", KeyError, "did you mean `pin`", lambda m: m.joint("pim")),
    ("another field", KeyError, "did you mean `mobility`", lambda m: kutzbach.analyse(m)["mobilty"]),
    ("another column", KeyError, "did you mean `crank`", lambda m: kutzbach.sweep(m, {"crank": 1}).column("crnk")),
    ("another variable", KeyError, "did you mean `main`", lambda m: kutzbach.trace(m, samples=2).value("mian")),
    ("another link", KeyError, "did you mean `rocker`", lambda m: kutzbach.trace(m, samples=2).pose("rockr")),
    ("a text for three numbers", TypeError, "several numbers", lambda m: kutzbach.Builder("b").joint("j", "revolute", "ground", "a", at="abc")),
]


@pytest.mark.parametrize(("kind", "said", "ask"), [own[1:] for own in ASKED], ids=[own[0] for own in ASKED])
def test_what_is_wrong_is_named(
    linkage: kutzbach.Mechanism, kind: type[Exception], said: str, ask: Callable[[Any], object]
) -> None:
    with pytest.raises(kind, match=said):
        ask(linkage)


def test_a_name_alone_is_one_name(linkage: kutzbach.Mechanism) -> None:
    with pytest.raises(kutzbach.MechanismError, match="`pivot`"):
        kutzbach.trace(linkage, drive="main", hold="pivot")
    assert kutzbach.analyse(linkage, inputs="main").to_dict() == kutzbach.analyse(linkage, inputs=["main"]).to_dict()


def test_a_kind_of_joint_is_a_word() -> None:
    with pytest.raises(kutzbach.MechanismError) as caught:
        kutzbach.Builder("b").joint("j", 'revolute" x="', "ground", "a").build()
    assert "revolute" in caught.value.message


@pytest.mark.parametrize("depth", ["rank", "verdict", "motions", "everything"])
@pytest.mark.parametrize("moved", [copy.deepcopy, lambda own: pickle.loads(pickle.dumps(own))], ids=["copied", "pickled"])
def test_analyses_can_be_pickled(linkage: kutzbach.Mechanism, depth: kutzbach.Depth, moved: Callable[[Any], Any]) -> None:
    analysis = kutzbach.analyse(linkage, depth)
    again = moved(analysis)
    assert again.to_dict() == analysis.to_dict()
    assert (repr(again), again.text(), again.certificate) == (repr(analysis), analysis.text(), analysis.certificate)
    assert again.branches == analysis.branches
    assert again.to_networkx().edges == analysis.to_networkx().edges


def test_other_answers_can_be_pickled(linkage: kutzbach.Mechanism) -> None:
    rigid = kutzbach.load("""<robot name="r"><link name="a"/><link name="b"/>
        <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>""")
    for trace in (kutzbach.trace(linkage, drive="main", samples=5), kutzbach.trace(rigid)):
        again = pickle.loads(pickle.dumps(trace))
        assert again.to_dict() == trace.to_dict() and repr(again) == repr(trace)
        assert numpy.array_equal(again.poses, trace.poses) and again.values.shape == trace.values.shape
    for answer in (kutzbach.assemble(linkage), kutzbach.exact(linkage)):
        assert pickle.loads(pickle.dumps(answer)).to_dict() == answer.to_dict()
    rows = kutzbach.sweep(linkage, {"crank": "1..2:3"})
    interrupted = pickle.loads(pickle.dumps(kutzbach.Interrupted(rows)))
    assert interrupted.done.rows == rows.rows and interrupted.done.head == rows.head


def test_answers_are_gone_through(linkage: kutzbach.Mechanism) -> None:
    analysis = kutzbach.analyse(linkage)
    assert "mobility" in analysis and "mobilty" not in analysis
    assert list(analysis) == list(analysis.keys()) == list(analysis.to_dict())
    closed = kutzbach.assemble(linkage, hold={"main": 0})
    assert [set(own) for own in closed] == [{"main", "pivot", "pin", "end"}] * len(closed)
