"""The stub of the compiled part, and the questions put to it, say what its Rust code says: read from both."""

import ast
import inspect
import re
from collections.abc import Callable
from pathlib import Path

import kutzbach
import pytest
from kutzbach import _ask
from kutzbach.sweeps import planned

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


QUESTIONS = {
    kutzbach.load: "Read",
    kutzbach.analyse: "Analyse",
    kutzbach.trace: "Follow",
    kutzbach.assemble: "Assemble",
    kutzbach.exact: "Prove",
    kutzbach.simulate: "Simulate",
    planned: "Vary",
}
"""Functions that ask, and what the compiled part reads of the question."""


def questions() -> dict[str, dict[str, str]]:
    """Fields and their types of all questions that the compiled part reads."""
    path = PROJECT / "python" / "src" / "asked.rs"
    if not path.exists():
        pytest.skip("the sources are not here")
    structures = re.finditer(r"pub struct (\w+) \{\n(.*?)\n\}", path.read_text(), re.DOTALL)
    return {own[1]: dict(re.findall(r"pub (\w+): (.*),", own[2])) for own in structures}


@pytest.mark.parametrize("function", QUESTIONS, ids=lambda function: function.__name__)
def test_what_is_asked_is_what_is_read(function: Callable[..., object]) -> None:
    body = ast.parse(inspect.getsource(function))
    calls = [own for own in ast.walk(body) if isinstance(own, ast.Call) and ast.unparse(own.func) == "asked"]
    assert [{keyword.arg for keyword in call.keywords} for call in calls] == [set(questions()[QUESTIONS[function]])]


def test_answers_are_checked_by_their_types() -> None:
    kinds = {"f64": _ask.REALS, "u64": _ask.COUNTS, "usize": _ask.COUNTS, "String": _ask.WORDS, "bool": _ask.FLAGS}
    seen = set()
    for fields in questions().values():
        for name, rust in fields.items():
            plain = re.sub(r"^Option<(\w+)>$", r"\1", rust)
            listed = [kind for kind in set(kinds.values()) if name in kind]
            assert listed == ([kinds[plain]] if plain in kinds else []), f"{name}: {rust}"
            seen.add(name)
    assert frozenset(seen) >= _ask.REALS | _ask.COUNTS | _ask.WORDS | _ask.FLAGS


def test_defaults_are_those_of_the_compiled_part() -> None:
    written = (PROJECT / "python" / "src" / "asked.rs").read_text()
    default = re.search(r"impl Default for Follow \{.*?Self \{(.*?)\}", written, re.DOTALL)
    assert default is not None
    stated = dict(re.findall(r"(\w+): (.*),", default[1]))
    known = {"None": None, "Vec::new()": ()}
    for name, parameter in inspect.signature(kutzbach.trace).parameters.items():
        if name != "mechanism":
            assert parameter.default == (known[stated[name]] if stated[name] in known else float(stated[name])), name
