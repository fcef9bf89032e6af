"""Verdicts, counts, and the forms that they are shown in."""

import threading

import kutzbach
import pytest


def test_a_four_bar_is_told_whole(linkage: kutzbach.Mechanism) -> None:
    analysis = kutzbach.analyse(linkage)
    counts = (analysis.kutzbach, analysis.instantaneous, analysis.freedom, analysis.redundant, analysis.generic)
    assert counts == (-2, 1, 1, 3, 0)
    words = (analysis.status, analysis.verdict, analysis.pose, analysis.kind, analysis.mobility_class)
    assert words == ("analysed", "mobile", "regular", None, "trivial")
    assert (analysis.useful, analysis.idle, analysis.branch_count, analysis.locked) == (1, 0, 1, ())
    assert analysis.joint_freedoms == {"main": 1, "pivot": 1, "pin": 1, "end": 1}
    assert analysis.branches is not None
    (branch,) = analysis.branches
    assert (branch.name, branch.dimension, branch.locked, branch.idle) == ("A", 1, (), ())
    assert analysis.certificate
    assert analysis["four_bars"][0]["kind"] == "crank_rocker"
    assert analysis.to_dict()["schema"] == "kutzbach-report-2"


@pytest.mark.parametrize("depth", ["rank", "verdict", "motions"])
def test_lesser_depths_say_less_and_the_same(linkage: kutzbach.Mechanism, depth: kutzbach.Depth) -> None:
    whole, analysis = kutzbach.analyse(linkage), kutzbach.analyse(linkage, depth)
    assert analysis.instantaneous == whole.instantaneous
    assert analysis.margin == pytest.approx(whole.margin)
    assert analysis.freedom == (None if depth == "rank" else 1)
    assert analysis.branch_count == (1 if depth == "motions" else None)
    assert analysis.branches is None and analysis.idle is None and analysis.certificate is None


def test_a_loop_that_does_not_close_is_an_answer(linkage_text: str) -> None:
    apart = kutzbach.analyse(kutzbach.load(linkage_text, crank=20))
    assert (apart.status, apart.verdict, apart.freedom) == ("unassembled", "unassembled", None)
    assert apart.reason


def test_questions_that_have_no_answer_are_errors(linkage: kutzbach.Mechanism) -> None:
    with pytest.raises(kutzbach.MechanismError, match="nowhere") as caught:
        kutzbach.analyse(linkage, configuration="nowhere")
    assert caught.value.help and caught.value.line is None
    with pytest.raises(kutzbach.MechanismError, match="depth"):
        kutzbach.analyse(linkage, "all")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="everything"):
        kutzbach.analyse(linkage, "rank", evidence=True)


def test_it_is_shown(linkage: kutzbach.Mechanism) -> None:
    analysis = kutzbach.analyse(linkage)
    assert str(analysis).startswith("Mobile: 1 degree of freedom")
    assert len(analysis.text(verbose=True)) > len(str(analysis))
    frame = linkage._repr_html_()
    assert frame.startswith("<iframe srcdoc=") and frame.count("<iframe") == 1
    assert "<script" not in frame
    assert "<script" in linkage.page()


def test_words_are_explained() -> None:
    assert "subgroup" in (kutzbach.explain("trivial") or "")
    assert kutzbach.explain("no such word at all") is None


def test_several_threads_ask_at_once(linkage: kutzbach.Mechanism) -> None:
    answers: list[int | None] = []
    threads = [threading.Thread(target=lambda: answers.append(kutzbach.analyse(linkage).freedom)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [1] * 8


def test_a_graph_has_what_was_found(linkage: kutzbach.Mechanism) -> None:
    pytest.importorskip("networkx")
    for depth, locked in (("everything", False), ("motions", False), ("rank", None)):
        graph = kutzbach.analyse(linkage, depth).to_networkx()  # type: ignore[arg-type]
        assert graph.edges["coupler", "rocker", "end"]["locked"] is locked
