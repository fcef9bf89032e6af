"""What is told as plain data equals what the command line writes."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import kutzbach
import pytest

PROJECT = Path(__file__).resolve().parents[2]
ZOO = sorted(str(path.relative_to(PROJECT)) for path in (PROJECT / "tests" / "zoo").glob("*.urdf"))
SOME = ["mechanisms/bennett.urdf", "mechanisms/planar_four_bar.urdf", "mechanisms/bennett_spoiled.urdf"]

pytestmark = pytest.mark.usefixtures("here")


def test_the_zoo_is_there() -> None:
    assert len(ZOO) > 100


@pytest.mark.parametrize("file", ZOO + SOME)
def test_reports_are_equal(program: Callable[..., Any], file: str) -> None:
    assert kutzbach.analyse(kutzbach.load(file)).to_dict() == program("report", file, "--format", "json")


@pytest.mark.parametrize("file", SOME)
def test_other_answers_are_equal(program: Callable[..., Any], file: str) -> None:
    mechanism = kutzbach.load(file)
    form = ("--format", "json")
    assert kutzbach.trace(mechanism, samples=20).to_dict() == program("trace", file, "--samples", "20", *form)
    assert kutzbach.assemble(mechanism).to_dict() == program("assemble", file, *form)
    assert kutzbach.exact(mechanism).to_dict() == program("exact", file, *form)
    assert kutzbach.simulate(mechanism).to_dict() == program("simulate", file, *form)


def test_measures_and_questions_are_passed_on(program: Callable[..., Any]) -> None:
    file = "mechanisms/bennett_spoiled.urdf"
    mechanism = kutzbach.load(file, off=0.25)
    told = kutzbach.analyse(mechanism, between=[("crank", "rocker")], inputs=["hinge_1"]).to_dict()
    options = ["--set", "off=0.25", "--between", "crank", "rocker", "--inputs", "hinge_1"]
    assert told == program("report", file, "--format", "json", *options)
