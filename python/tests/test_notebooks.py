"""The notebooks in `examples/` run from the first cell to the last, without a notebook's program."""

import ast
import json
from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = sorted((Path(__file__).resolve().parents[2] / "examples").glob("**/*.ipynb"))


def test_there_are_some() -> None:
    assert NOTEBOOKS


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_all_cells_run(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(path.parent)
    notebook = json.loads(path.read_text(encoding="utf-8"))
    names: dict[str, Any] = {"__name__": "__main__"}
    ran = 0
    for number, cell in enumerate(notebook["cells"]):
        if cell["cell_type"] != "code":
            continue
        # Outputs are those of whoever runs it: none is kept that could have become wrong.
        assert cell["outputs"] == [] and cell["execution_count"] is None, f"cell {number}"
        tree = ast.parse("".join(cell["source"]), filename=f"{path.name}[{number}]")
        shown = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"{path.name}[{number}]", "exec"), names)
        if isinstance(shown, ast.Expr):
            value = eval(compile(ast.Expression(shown.value), f"{path.name}[{number}]", "eval"), names)
            # What a notebook would show of it.
            if hasattr(value, "_repr_html_"):
                assert "<iframe" in value._repr_html_()
        ran += 1
    assert ran >= 5
