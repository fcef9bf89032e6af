"""What several tests need."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kutzbach
import pytest

PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def project() -> Path:
    """The folder of the project."""
    return PROJECT


@pytest.fixture(scope="session")
def program() -> Callable[..., Any]:
    """The command line, whose answer is read as JSON; ``KUTZBACH_PROGRAM`` says where it is."""
    path = os.environ.get("KUTZBACH_PROGRAM")
    if not path:
        pytest.skip("KUTZBACH_PROGRAM is not set to the program")

    def ask(*arguments: str) -> Any:
        run = subprocess.run([path, *arguments], capture_output=True, cwd=PROJECT, check=False)
        assert run.stdout, run.stderr.decode()
        return json.loads(run.stdout)

    return ask


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Paths are those of the project's folder, as the command line is given them."""
    monkeypatch.chdir(PROJECT)


def four_bar() -> kutzbach.Builder:
    """A crank and rocker of which two lengths are measures; not closed as drawn."""
    return (
        kutzbach.Builder("four_bar", ground="frame")
        .measure("crank", 1)
        .measure("coupler", "7/2")
        .joint("main", "revolute", "frame", "crank", axis=(0, 0, 1))
        .joint("pivot", "revolute", "frame", "rocker", at=(4, 0, 0), axis=(0, 0, 1))
        .joint("pin", "revolute", "crank", "coupler", at=(0, "crank", 0), axis=(0, 0, 1))
        .loop("end", "revolute", "coupler", "rocker", at=("coupler", 0, 0), successor_at=(0, 2, 0), axis=(0, 0, 1))
    )


@pytest.fixture
def linkage() -> kutzbach.Mechanism:
    """The four-bar as a mechanism."""
    return four_bar().build()


@pytest.fixture
def linkage_text() -> str:
    """The four-bar as a file."""
    return four_bar().text()
