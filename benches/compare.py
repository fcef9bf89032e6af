"""Ratios new/old of two records of the same kind, the largest changes first.

    python3 benches/compare.py OLD NEW
    python3 benches/compare.py OLD NEW --only rank --fail-above 1.05

Any two JSON files with numbers under the same names can be compared: instructions.json, stages.json, peers.json,
work_precision.json, long_runs.json. In lists, objects are known by their words and whole numbers (mechanism, solver, substeps)
where these tell them apart, else by their place. Names that are in one of them only are listed.

The exit code is 0, whatever the ratios, unless `--fail-above` is given: then 1 where a ratio is larger, and 2 where there is
nothing to compare.
"""

import argparse
import json
import math
import sys
from pathlib import Path


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def labels(rows):
    """A name for each object of a list that no other has; None where their words do not tell them apart."""
    if not rows or not all(isinstance(row, dict) for row in rows):
        return None
    words = [[str(v) for v in row.values() if isinstance(v, str)] for row in rows]
    whole = [[f"{k} {v}" for k, v in row.items() if isinstance(v, int) and not isinstance(v, bool)] for row in rows]
    for names in ([", ".join(w) for w in words], [", ".join(w + n) for w, n in zip(words, whole)]):
        if all(names) and len(set(names)) == len(names):
            return names
    return None


def numbers(value, path=()):
    """All numbers by their path."""
    found = {}
    if is_number(value):
        found[" / ".join(path)] = float(value)
    elif isinstance(value, dict):
        for key, inner in value.items():
            found.update(numbers(inner, (*path, key)))
    elif isinstance(value, list):
        names = labels(value) or [str(index) for index in range(len(value))]
        for name, inner in zip(names, value):
            found.update(numbers(inner, (*path, name)))
    return found


def ratio(old, new):
    if old == new:
        return 1.0
    return new / old if old != 0 else math.copysign(math.inf, new)


def change(value):
    """How far a ratio is from one: twice and half are as far; what is not positive is farthest."""
    return abs(math.log(value)) if 0 < value < math.inf else math.inf


def compared(old, new, only=""):
    """Rows (path, old, new, ratio) by falling change, then by name; and what is in one only."""
    old, new = numbers(old), numbers(new)
    wanted = lambda names: sorted(name for name in names if only in name)
    rows = [(name, old[name], new[name], ratio(old[name], new[name])) for name in wanted(old.keys() & new.keys())]
    rows.sort(key=lambda row: -change(row[3]))
    return rows, wanted(old.keys() - new.keys()), wanted(new.keys() - old.keys())


def printed(rows, gone, added):
    width = max((len(row[0]) for row in rows), default=4)
    lines = [f"{'name':{width}}  {'old':>12}  {'new':>12}  {'new/old':>8}"]
    lines += [f"{name:{width}}  {old:12.6g}  {new:12.6g}  {r:8.3f}" for name, old, new, r in rows]
    finite = [math.log(row[3]) for row in rows if change(row[3]) < math.inf]
    if finite:
        lines.append(f"{len(rows)} numbers; geometric mean of the ratios {math.exp(sum(finite) / len(finite)):.3f}")
    for words, names in (("only in the old record", gone), ("only in the new record", added)):
        lines += [f"{words}: {name}" for name in names]
    return "\n".join(lines)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--only", default="", metavar="WORD", help="only names that contain this")
    parser.add_argument("--fail-above", type=float, metavar="RATIO", help="exit code 1 where a ratio is larger")
    options = parser.parse_args(arguments)
    old, new = (json.loads(path.read_text(encoding="utf-8")) for path in (options.old, options.new))
    rows, gone, added = compared(old, new, options.only)
    print(printed(rows, gone, added))
    if options.fail_above is None:
        return 0
    if not rows:
        return 2
    return 1 if any(row[3] > options.fail_above for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
