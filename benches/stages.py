"""The record benches/record/stages.json, from what `cargo bench -p kutzbach-benches --bench stages` prints.

    cargo bench -p kutzbach-benches --bench stages | python3 benches/stages.py --date 2026-01-31 --machine "2 cores of an ordinary machine"

`--output FILE` writes another file. Seconds: the fastest sample and the median, by stage, function and case.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RECORD = ROOT / "benches" / "record" / "stages.json"
UNITS = {"ns": 1e-9, "µs": 1e-6, "us": 1e-6, "ms": 1e-3, "s": 1.0}
# A row of the tree: its guides, three columns for each level; a name; and the cells, divided by bars.
ROW = re.compile(r"^((?:│  |   )*)(?:├─|╰─) (.*)$")
TIME = re.compile(r"([0-9.]+) (ns|µs|us|ms|s)$")


def seconds(cell):
    """A cell such as `1.234 ms` in seconds; None where it is no time."""
    found = TIME.search(cell.strip())
    return float(f"{float(found[1]) * UNITS[found[2]]:.4g}") if found else None


def parsed(lines):
    """Nested dictionaries by the names of the tree; leaves have `fastest` and `median`."""
    tree, path = {}, []
    for line in lines:
        row = ROW.match(line.rstrip())
        if not row:
            continue
        cells = row[2].split("│")
        depth = len(row[1]) // 3
        fastest = seconds(cells[0]) if len(cells) >= 4 else None
        name = cells[0] if fastest is None else TIME.sub("", cells[0].rstrip())
        path = path[:depth] + [name.strip()]
        if fastest is None:
            continue
        here = tree
        for step in path[:-1]:
            here = here.setdefault(step, {})
        here[path[-1]] = {"fastest": fastest, "median": seconds(cells[2])}
    return tree


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--date", required=True, help="the day, for the record")
    parser.add_argument("--machine", required=True, help="words for the machine, for the record")
    parser.add_argument("--output", type=Path, default=RECORD, help="where the record is written")
    options = parser.parse_args()
    stages = parsed(sys.stdin)
    if not stages:
        raise SystemExit("there is no table in what was read; the benches print it to standard output")
    rustc = subprocess.run(["rustc", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    record = {"date": options.date, "machine": options.machine, "rustc": rustc, "stages": stages}
    options.output.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
