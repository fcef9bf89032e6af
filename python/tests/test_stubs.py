"""The stub of the compiled part says what its Rust code says: names, arguments and types, read from both."""

import ast
import re
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]

PLAIN = {
    "str": "str",
    "String": "str",
    "PathBuf": "str",
    "bool": "bool",
    "f64": "float",
    "u64": "int",
    "usize": "int",
    "PyBytes": "bytes",
}
"""Types of Rust and those of Python that they become or come from; a path is given as text."""

Signature = tuple[list[tuple[str, str]], str]


def split(text: str) -> list[str]:
    """What stands between commas outside of all brackets."""
    pieces, depth = [""], 0
    for character in text:
        depth += (character in "<([") - (character in ">)]")
        if character == "," and depth == 0:
            pieces.append("")
        else:
            pieces[-1] += character
    return [piece.strip() for piece in pieces if piece.strip()]


def python_type(rust: str) -> str:
    """A type of Rust as the stub writes it; ``KeyError`` for one that is not known here."""
    rust = re.sub(r"^&('\w+ )?", "", rust.strip())
    if rust.startswith("("):
        return f"tuple[{', '.join(python_type(own) for own in split(rust[1:-1]))}]"
    if found := re.fullmatch(r"(\w+)<(.*)>", rust):
        outer, inner = found[1], split(found[2])[-1]
        if outer in ("PyResult", "Bound"):
            return python_type(inner)
        if outer == "Option":
            return f"{python_type(inner)} | None"
        if outer == "Vec":
            return f"list[{python_type(inner)}]"
    if rust in ("Reading", "Analysed", "Traced", "Sweep"):
        return rust
    return PLAIN[rust]


def of_rust(text: str) -> dict[str, Signature]:
    """Methods as ``Class.name`` and functions that a source hands to Python."""
    found: dict[str, Signature] = {}
    exposed = [
        *((own[1], own[2]) for own in re.finditer(r"#\[pymethods\]\nimpl (\w+) \{\n(.*?)\n\}", text, re.DOTALL)),
        *(("", own[1]) for own in re.finditer(r"#\[pyfunction\]\n(.*?\{\n)", text, re.DOTALL)),
    ]
    for owner, body in exposed:
        for own in re.finditer(r"fn (\w+)(?:<[^>]*>)?\((.*?)\)(?: -> ([^{]*?))? \{\n", body, re.DOTALL):
            arguments = [argument.split(":", 1) for argument in split(own[2]) if argument != "&self"]
            stated = [(name.strip(), python_type(kind)) for name, kind in arguments if not kind.strip().startswith("Python<")]
            found[f"{owner}.{own[1]}" if owner else own[1]] = (stated, python_type(own[3]) if own[3] else "None")
    return found


def of_stub(text: str) -> dict[str, Signature]:
    """The same of the stub."""
    found: dict[str, Signature] = {}

    def add(owner: str, item: ast.FunctionDef) -> None:
        stated = [(own.arg, ast.unparse(own.annotation)) for own in item.args.args if own.annotation]
        assert item.returns is not None
        found[f"{owner}{item.name}"] = (stated, ast.unparse(item.returns))

    for item in ast.parse(text).body:
        if isinstance(item, ast.FunctionDef):
            add("", item)
        if isinstance(item, ast.ClassDef):
            for method in item.body:
                assert isinstance(method, ast.FunctionDef)
                add(f"{item.name}.", method)
    return found


def test_the_stub_says_what_the_sources_say() -> None:
    sources = sorted((PROJECT / "python" / "src").glob("*.rs"))
    if not sources:
        pytest.skip("the sources are not here")
    rust: dict[str, Signature] = {}
    for source in sources:
        rust |= of_rust(source.read_text())
    stub = of_stub((PROJECT / "python" / "package" / "kutzbach" / "_kutzbach.pyi").read_text())
    assert len(rust) >= 20
    assert stub == rust


def test_what_is_registered_is_in_the_stub() -> None:
    text = (PROJECT / "python" / "src" / "lib.rs").read_text()
    classes = re.findall(r"add_class::<(?:\w+::)*(\w+)>", text)
    functions = re.findall(r"wrap_pyfunction!\((?:\w+::)*(\w+),", text)
    body = ast.parse((PROJECT / "python" / "package" / "kutzbach" / "_kutzbach.pyi").read_text()).body
    named = [item.name for item in body if isinstance(item, ast.ClassDef | ast.FunctionDef)]
    assert sorted(named) == sorted(classes + functions)


def test_a_difference_is_found() -> None:
    source = "#[pyfunction]\n#[pyo3(signature = (path))]\npub fn read(py: Python<'_>, path: PathBuf) -> PyResult<Reading> {\n"
    assert of_rust(source) == of_stub("def read(path: str) -> Reading: ...")
    assert of_rust(source) != of_stub("def read(path: int) -> Reading: ...")
    assert of_rust(source) != of_stub("def read(path: str, more: str) -> Reading: ...")
