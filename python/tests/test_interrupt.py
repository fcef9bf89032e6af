"""Ctrl-C is answered at once, whatever is being done."""

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import kutzbach
import pytest

# The second half is what a machine with much to do may add.
SOON = 0.2 + 0.3


def seconds_after_ctrl_c(work: Callable[[], object], after: float) -> tuple[float, BaseException]:
    """Presses Ctrl-C some time after the work began, and says how long it took to end."""
    pressed: list[float] = []
    begun = threading.Event()

    def press() -> None:
        begun.wait()
        time.sleep(after)
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    try:
        with pytest.raises(KeyboardInterrupt) as caught:
            begun.set()
            work()
            # What ends before it is pressed would show nothing.
            time.sleep(10)
        ended = time.monotonic()
    finally:
        thread.join()
    return ended - pressed[0], caught.value


QUESTIONS: dict[str, tuple[str, Callable[[kutzbach.Mechanism], object]]] = {
    "analyse": ("tests/zoo/wren_platform_6US.urdf", kutzbach.analyse),
    "verdict": ("tests/zoo/wren_platform_6US.urdf", lambda platform: kutzbach.analyse(platform, "verdict")),
    "trace": ("mechanisms/bennett.urdf", lambda loop: kutzbach.trace(loop, samples=10_000_000)),
    "assemble": ("tests/zoo/general_6r_rigid.urdf", lambda loop: kutzbach.assemble(loop, budget=1000)),
    "exact": ("mechanisms/stewart.urdf", lambda platform: kutzbach.exact(platform, budget=1000)),
    "simulate": ("mechanisms/slider_hitting_stop.urdf", lambda slider: kutzbach.simulate(slider, duration=36000)),
}
"""Questions that take longer than anybody waits, and what they are asked of."""


@pytest.mark.parametrize("name", QUESTIONS)
def test_it_ends_and_so_does_the_work(project: Path, name: str) -> None:
    file, ask = QUESTIONS[name]
    mechanism = kutzbach.load(project / file)
    seconds, _ = seconds_after_ctrl_c(lambda: ask(mechanism), 0.3)
    assert seconds < SOON
    # Nothing is computed in the background that nobody waits for.
    time.sleep(SOON)
    before = time.process_time()
    time.sleep(0.5)
    assert time.process_time() - before < 0.1


def test_what_was_interrupted_can_be_asked_again(project: Path) -> None:
    bennett = kutzbach.load(project / "mechanisms" / "bennett.urdf")
    whole = kutzbach.analyse(bennett).to_dict()
    for after in (0.0, 0.002, 0.01):
        seconds_after_ctrl_c(lambda: [kutzbach.analyse(bennett) for _ in range(100_000)], after)
        assert kutzbach.analyse(bennett).to_dict() == whole


def test_a_sweep_gives_what_is_done(linkage: kutzbach.Mechanism) -> None:
    over = {"crank": "1..2:1000000"}
    seconds, raised = seconds_after_ctrl_c(lambda: kutzbach.sweep(linkage, over, depth="everything"), 2.0)
    assert seconds < SOON
    assert isinstance(raised, kutzbach.Interrupted)
    assert 0 < len(raised.done) < 1_000_000
    assert [row["variant"] for row in raised.done] == list(range(len(raised.done)))


def test_other_threads_go_on_meanwhile(project: Path) -> None:
    platform = kutzbach.load(project / "mechanisms" / "stewart.urdf")
    ticks: list[float] = []
    going = threading.Event()

    def tick() -> None:
        while not going.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        kutzbach.exact(platform, budget=0.5)
    finally:
        going.set()
        thread.join()
    assert len(ticks) > 10
