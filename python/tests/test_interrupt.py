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

    def press() -> None:
        time.sleep(after)
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    try:
        with pytest.raises(KeyboardInterrupt) as caught:
            work()
            # What ends before it is pressed would show nothing.
            time.sleep(10)
        ended = time.monotonic()
    finally:
        thread.join()
    return ended - pressed[0], caught.value


def test_a_proof_ends(project: Path) -> None:
    platform = kutzbach.load(project / "mechanisms" / "stewart.urdf")
    seconds, _ = seconds_after_ctrl_c(lambda: kutzbach.exact(platform, budget=1000), 0.5)
    assert seconds < SOON


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
