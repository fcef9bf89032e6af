"""The same question of many variants of a mechanism."""

from __future__ import annotations

import html
import json
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from typing import IO, TYPE_CHECKING, Any, overload

from . import _kutzbach
from ._answers import Depth
from ._ask import Value, asked, missing, table, value_text
from ._errors import Interrupted
from ._mechanism import Mechanism, compiled

if TYPE_CHECKING:
    import numpy
    import pyarrow
    from numpy.typing import NDArray

Values = Value | Iterable[Value]
"""``"0..2:401"`` for 401 values from 0 to 2, ``"0.1,pi/4"``, or any values; a number is one value."""

Progress = Callable[[int, int], None]
"""Is told how many rows are done, and how many there are."""

_FIRST = 64
_SECONDS = 0.5
_MOST = 1 << 16
_SHOWN = 40


def over_text(name: str, values: Values) -> str:
    """A measure and its values as the command line has them.

    >>> over_text("a", "0..2:401"), over_text("b", [0.5, Fraction(1, 3), "pi/4"])
    ('a=0..2:401', 'b=0.5,1/3,pi/4')
    """
    if isinstance(values, str):
        return f"{name}={values}"
    try:
        several: Any = values
        each = several if isinstance(several, Iterable) and getattr(several, "shape", None) != () else [several]
        texts = [value_text(value) for value in each]
    except (TypeError, ValueError) as error:
        raise type(error)(f"{name}: {error}") from None
    if not texts:
        raise ValueError(f"{name}: there are no values")
    return f"{name}={','.join(texts)}"


class Sweep:
    """Rows, one for each variant: what was found, or the reason why nothing was.

    A row is a mapping of plain data: the measures by their names, then ``status``, ``kutzbach``, ``instantaneous``, ``redundant``,
    ``margin``, and what the depth adds (``verdict``, ``finite``, …). What is not decided is ``None``. A measure that is called like
    one of these has `` (measure)`` behind its name.
    """

    def __init__(self, head: str, lines: Iterable[str]) -> None:
        self.head: dict[str, Any] = json.loads(head)
        """What rows depend on: file, ranges, depth, share."""
        self._head = head
        self.rows: list[dict[str, Any]] = [_row(json.loads(line)) for line in lines]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self.rows[0]) if self.rows else ()

    def column(self, name: str) -> list[Any]:
        """One column as a list; ``KeyError`` where there is none."""
        if self.rows and name not in self.rows[0]:
            raise missing("column", name, self.columns)
        return [row[name] for row in self.rows]

    def numbers(self, name: str) -> NDArray[numpy.float64]:
        """One column as an array of doubles: NaN where nothing is known, expressions evaluated where they are fractions."""
        import numpy

        return numpy.array([_double(value) for value in self.column(name)], dtype=numpy.float64)

    def grid(self, x: str, y: str, value: str) -> tuple[list[float], list[float], NDArray[numpy.float64]]:
        """Values over two measures, for a map: those of `x` and of `y`, rising, and an array of `value` with a row for each of `y`.
        NaN where there is no row or nothing is known; of rows with the same `x` and `y` the last one counts."""
        import numpy

        across, up, values = self.numbers(x), self.numbers(y), self.numbers(value)
        xs, columns = numpy.unique(across, return_inverse=True)
        ys, rows = numpy.unique(up, return_inverse=True)
        table = numpy.full((len(ys), len(xs)), numpy.nan)
        table[rows, columns] = values
        return xs.tolist(), ys.tolist(), table

    def to_arrow(self) -> pyarrow.Table:
        """The rows as a table of Arrow, with what they depend on as its metadata; measures that are no plain numbers stay texts."""
        import pyarrow

        columns = {name: _array(name, self.column(name)) for name in self.columns}
        return pyarrow.table(columns).replace_schema_metadata({"kutzbach": self._head.strip()})

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Writes the rows as Parquet: beside the file first, so that nobody reads half of it."""
        import pyarrow.parquet

        whole = os.fspath(path)
        draft = f"{whole}.{os.getpid()}.part"
        try:
            pyarrow.parquet.write_table(self.to_arrow(), draft)
            os.replace(draft, whole)
        finally:
            if os.path.exists(draft):
                os.unlink(draft)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    @overload
    def __getitem__(self, place: int) -> dict[str, Any]: ...
    @overload
    def __getitem__(self, place: slice) -> list[dict[str, Any]]: ...
    def __getitem__(self, place: int | slice) -> dict[str, Any] | list[dict[str, Any]]:
        """A row by its place among these, or several."""
        return self.rows[place]

    def __repr__(self) -> str:
        over = ", ".join(own if len(own) <= _SHOWN else f"{own[:_SHOWN]}…" for own in self.head["over"])
        plural = "" if len(self) == 1 else "s"
        return f"<Sweep over {over}: {len(self)} row{plural}>"

    def _repr_html_(self) -> str:
        def cells(tag: str, values: Iterable[Any]) -> str:
            shown = ("" if value is None else html.escape(str(value)) for value in values)
            return "<tr>" + "".join(f"<{tag}>{value}</{tag}>" for value in shown) + "</tr>"

        rows = [cells("th", self.columns), *(cells("td", row.values()) for row in self.rows[:_FIRST])]
        return f"<p>{html.escape(repr(self))}</p><table>{''.join(rows)}</table>"


def _row(told: Mapping[str, Any]) -> dict[str, Any]:
    """A line of JSON as a flat row."""
    found = {key: value for key, value in told.items() if key != "measures"}
    row: dict[str, Any] = {"variant": found.pop("variant")}
    for name, value in told["measures"].items():
        own = name in found or name == "variant"
        row[f"{name} (measure)" if own else name] = value
    return {**row, **found}


def _double(value: Any) -> float:
    if value is None:
        return float("nan")
    try:
        return float(Fraction(value)) if isinstance(value, str) else float(value)
    except (TypeError, ValueError, ZeroDivisionError):
        return float("nan")


_TYPES = {
    "variant": "int64",
    "status": "string",
    "kutzbach": "int64",
    "instantaneous": "int64",
    "redundant": "int64",
    "margin": "float64",
    "finite": "int64",
    "generic": "int64",
    "verdict": "string",
    "pose": "string",
    "kind": "string",
    "class": "string",
    "branches": "int64",
    "reason": "string",
}
"""Types of columns that may be empty; those of measures are those of their values."""


def _array(name: str, values: list[Any]) -> pyarrow.Array:
    """A column of one type, the same for every share of a sweep, except of measures."""
    import pyarrow

    if name == "locked":
        return pyarrow.array(values, pyarrow.list_(pyarrow.string()))
    if name in _TYPES:
        return pyarrow.array(values, pyarrow.type_for_alias(_TYPES[name]))
    return pyarrow.array(_uniform(values))


def _uniform(values: list[Any]) -> list[Any]:
    """A column of one type: whole numbers beside decimals are doubles, numbers beside expressions are texts."""
    kinds = {type(value) for value in values if value is not None}
    if kinds == {int, float}:
        return [None if value is None else float(value) for value in values]
    if str in kinds and len(kinds) > 1:
        return [None if value is None else _written(value) for value in values]
    return values


def _written(value: Any) -> str:
    """A number as a row has it: whole ones that became doubles beside decimals without a point."""
    whole = isinstance(value, float) and value.is_integer() and abs(value) < 1e15
    return str(int(value)) if whole else str(value)


def joined(tables: list[pyarrow.Table]) -> pyarrow.Table:
    """Tables of the shares of one sweep as that of the whole, rows in the order of their numbers."""
    import pyarrow

    # A share of few variants may have none.
    tables = [own for own in tables if own.num_rows]
    if not tables:
        return pyarrow.table({})
    columns: dict[str, list[Any]] = {name: [] for name in tables[0].column_names}
    for own in tables:
        for name, values in columns.items():
            values.extend(own.column(name).to_pylist())
    whole = pyarrow.table({name: _array(name, values) for name, values in columns.items()})
    head = json.loads(tables[0].schema.metadata[b"kutzbach"])
    # What rows depend on but for the share.
    told = json.dumps({**head, "shard": "1/1"}, separators=(",", ":"), ensure_ascii=False)
    return whole.sort_by("variant").replace_schema_metadata({"kutzbach": told})


def planned(
    mechanism: Mechanism,
    over: Mapping[str, Values],
    *,
    sample: str | None = None,
    shard: tuple[int, int] | None = None,
    depth: Depth = "verdict",
    configuration: str | None = None,
    closure_tolerance: float | None = None,
) -> _kutzbach.Sweep:
    """What :func:`sweep` will do: how many rows there are, and what stands before them."""
    question = asked(
        over=[over_text(name, values) for name, values in table("over", over).items()],
        sample=sample,
        shard=shard if shard is None or isinstance(shard, str) else "/".join(str(number) for number in shard),
        depth=depth,
        configuration=configuration,
        closure_tolerance=closure_tolerance,
    )
    return compiled(mechanism).sweep(question)


def sweep(
    mechanism: Mechanism,
    over: Mapping[str, Values],
    *,
    sample: str | None = None,
    depth: Depth = "verdict",
    shard: tuple[int, int] | None = None,
    output: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
    configuration: str | None = None,
    closure_tolerance: float | None = None,
) -> Sweep:
    """Asks the same of many variants of a mechanism, on all processors: ``kutzbach sweep``.

    `over` has the measures and their values: ``{"a": "0..2:401", "b": [0.1, 0.2]}`` for all combinations, the last one changing
    first. `sample` takes points instead, ``"sobol:1000"`` or ``"random:1000"``. `shard` is one share of the work, ``(2, 5)`` the
    second of five. `output` is a file that gets the rows too, as CSV, or as JSON lines where its name ends in ``.jsonl``; it is
    written anew. A sweep that is to be continued where it was cut off is the command line's.

    Ctrl-C raises :class:`Interrupted`, whose ``done`` is the :class:`Sweep` of the rows so far.

    >>> import kutzbach
    >>> door = kutzbach.Builder("door").measure("w", 1).joint("turn", "revolute", "ground", "door", at=("w", 0, 0), axis=(0, 0, 1))
    >>> kutzbach.sweep(door.build(), {"w": "0..1:3"}).column("finite")
    [1, 1, 1]
    """
    plan = planned(
        mechanism,
        over,
        sample=sample,
        shard=shard,
        depth=depth,
        configuration=configuration,
        closure_tolerance=closure_tolerance,
    )
    count, head = plan.count(), plan.head(False)
    csv = output is not None and not os.fspath(output).endswith(".jsonl")
    lines: list[str] = []
    file: IO[str] | None = None
    try:
        if output is not None:
            file = open(output, "w", encoding="utf-8", newline="")
            file.write(plan.head(csv))
        for jsonl, rows in _chunks(plan, count):
            # Names may hold line breaks of Unicode, which end no row.
            lines.extend(jsonl.split("\n")[:-1])
            if file is not None:
                file.write(rows if csv else jsonl)
            if progress is not None:
                progress(len(lines), count)
    except KeyboardInterrupt:
        raise Interrupted(Sweep(head, lines)) from None
    finally:
        if file is not None:
            file.close()
    return Sweep(head, lines)


def _chunks(plan: _kutzbach.Sweep, count: int) -> Iterator[tuple[str, str]]:
    """All rows, in pieces that take about half a second each, so that little is lost at Ctrl-C."""
    start, size = 0, _FIRST
    while start < count:
        began = time.monotonic()
        yield plan.rows(start, size)
        start += size
        seconds = max(time.monotonic() - began, 1e-6)
        size = int(min(max(size * _SECONDS / seconds, 1), 4 * size, _MOST))
