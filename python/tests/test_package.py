"""The package itself: its examples, its stubs, and what importing it costs."""

import ast
import doctest
import importlib
import pkgutil
import subprocess
import sys
from pathlib import Path

import kutzbach
import pytest
from kutzbach import _kutzbach

MODULES = ["kutzbach", *(f"kutzbach.{own.name}" for own in pkgutil.iter_modules(kutzbach.__path__))]


@pytest.mark.parametrize("name", [name for name in MODULES if name != "kutzbach._kutzbach"])
def test_examples_of_docstrings(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.usefixtures("here")
def test_examples_of_the_book(project: Path) -> None:
    page = project / "docs" / "src" / "python.md"
    result = doctest.testfile(str(page), module_relative=False)
    assert result.failed == 0 and result.attempted > 15


def test_stubs_name_what_there_is() -> None:
    stubs = ast.parse(Path(kutzbach.__file__).with_name("_kutzbach.pyi").read_text())
    seen = 0
    for item in stubs.body:
        if isinstance(item, ast.FunctionDef):
            assert callable(getattr(_kutzbach, item.name))
            seen += 1
        if isinstance(item, ast.ClassDef):
            own = getattr(_kutzbach, item.name)
            stated = {method.name for method in item.body if isinstance(method, ast.FunctionDef)}
            assert stated == {name for name in vars(own) if not name.startswith("_")}
            seen += 1
    assert seen >= 7


def test_types_are_checked(project: Path) -> None:
    pytest.importorskip("mypy")
    checked = subprocess.run([sys.executable, "-m", "mypy"], cwd=project, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout


def test_nothing_is_imported_before_it_is_asked_for() -> None:
    code = "import kutzbach, sys; print(*sorted({name.split('.')[0] for name in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    for dear in ("numpy", "networkx", "pyarrow", "mujoco", "pinocchio", "pxr", "dask", "distributed"):
        assert dear not in loaded


def test_questions_leak_nothing(linkage: kutzbach.Mechanism, linkage_text: str) -> None:
    resource = pytest.importorskip("resource")

    def ask(times: int) -> int:
        for _ in range(times):
            kutzbach.analyse(kutzbach.load(linkage_text), "rank")
        return int(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)

    before = ask(500)
    # In kilobytes; in bytes on macOS, where the bound is none.
    assert ask(2000) - before < 20_000 or sys.platform == "darwin"
