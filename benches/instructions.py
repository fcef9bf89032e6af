"""Instructions per run of the cases of `--bench instructions`, counted by callgrind.

    python3 benches/instructions.py --date 2026-01-31 --machine "2 cores of an ordinary machine"

builds the cases as `cargo bench` does, counts, and writes the record benches/record/instructions.json and the table of
docs/src/speed.md. `--only WORD` counts the cases whose name contains the word anew and keeps the rest; `--page` counts
nothing and writes the table from the record; `--print` counts twice and writes nothing but the largest difference;
`--sweeps` counts rows of sweeps beside files by themselves, and prints the table of docs/src/speed.md that shows them.

A case is run without repetitions and with some. The difference is theirs alone: starting the program and making the case
ready are in both. Needed are cargo and valgrind, and nothing beyond Python's standard library.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RECORD = ROOT / "benches" / "record" / "instructions.json"
PAGE = ROOT / "docs" / "src" / "speed.md"
BEGIN, END = "<!-- instructions: begin -->", "<!-- instructions: end -->"
REPETITIONS = 4
# Every run of a sweep is of another member of the family.
MEMBERS = 20
# Hash tables are seeded at random, which is some dozen instructions up or down: small cases are averaged over more runs.
SMALL, MANY = 200_000, 100


def build():
    """The program that runs one case, from what cargo says of its artifacts."""
    command = ["cargo", "bench", "--package", "kutzbach-benches", "--locked", "--no-run", "--bench", "instructions", "--message-format=json"]
    lines = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    return executable(lines)


def executable(lines):
    """The path of the bench among cargo's messages, one JSON object a line."""
    for message in map(json.loads, lines):
        if message.get("executable") and message["target"]["name"] == "instructions":
            return message["executable"]
    raise SystemExit("cargo built no bench called instructions")


def cases(program, *which):
    return subprocess.run([program, *which], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()


def collected(said):
    """The instructions that callgrind says it has seen."""
    found = re.search(r"Collected : (\d+)", said)
    if not found:
        raise SystemExit("callgrind counted nothing:\n" + said)
    return int(found[1])


def count(program, case, repetitions):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, case, str(repetitions)]
    # Nothing of the surroundings, such as a longer path, may change what the program does.
    run = subprocess.run(command, env={"PATH": "/usr/bin:/bin"}, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if run.returncode != 0:
        raise SystemExit(f"{case}:\n{run.stderr}")
    return collected(run.stderr)


def per_run(program, case, repetitions=REPETITIONS):
    nothing = count(program, case, 0)
    found = (count(program, case, repetitions) - nothing) / repetitions
    if found < SMALL:
        found = (count(program, case, MANY) - nothing) / MANY
    return round(found)


def nested(counts):
    """{"rank/bennett": 1} to {"rank": {"bennett": 1}}."""
    stages = {}
    for name, value in counts.items():
        stage, case = name.split("/", 1)
        stages.setdefault(stage, {})[case] = value
    return stages


def version(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def shown(value):
    """Three digits: 12,300 and 4.56 million."""
    digits = float(f"{value:.2e}")
    if digits >= 1e6:
        million = digits / 1e6
        return f"{million:.3g} million" if million < 1000 else f"{million:,.0f} million"
    return f"{digits:,.0f}"


def table(record):
    """The measured part of the page."""
    lines = [
        f"Counted on {record['date']} on {record['machine']}, {record['rustc'].split(' (')[0]}, {record['valgrind']}.",
        "",
        "| stage | instructions per run |",
        "|---|---|",
    ]
    for stage, counts in record["instructions"].items():
        lines.append(f"| {stage} | " + ", ".join(f"{case} {shown(value)}" for case, value in counts.items()) + " |")
    return "\n".join(lines)


def sweeps(counts):
    """Thousands of instructions of a member, by family: a table from {"rank of a row/robot": 1}."""
    families = {}
    for name, value in counts.items():
        stage, family = name.split("/", 1)
        families.setdefault(family, {})[stage] = value
    stages = list(next(iter(families.values())))
    lines = ["| family | " + " | ".join(stages) + " |", "|---" * (len(stages) + 1) + "|"]
    for family, own in families.items():
        lines.append(f"| {family} | " + " | ".join(f"{own[stage] / 1e3:,.0f}" for stage in stages) + " |")
    return "\n".join(lines)


def replaced(page, record):
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise SystemExit(f"the page lacks the lines {BEGIN} and {END}")
    return f"{before}{BEGIN}\n\n{table(record)}\n\n{END}{after}"


def write_page(record):
    PAGE.write_text(replaced(PAGE.read_text(encoding="utf-8"), record), encoding="utf-8")


def kept():
    return json.loads(RECORD.read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--date", help="the day, for the record")
    parser.add_argument("--machine", help="words for the machine, for the record")
    parser.add_argument("--only", metavar="WORD", help="count only cases whose name contains this, keep the others")
    parser.add_argument("--page", action="store_true", help="write the page from the record")
    parser.add_argument("--print", action="store_true", help="count twice and print how far the counts differ")
    parser.add_argument("--sweeps", action="store_true", help="count rows of sweeps and files by themselves, and print their table")
    parser.add_argument("--program", help="a built bench, instead of building it")
    options = parser.parse_args()
    if options.page:
        write_page(kept())
        return
    if not options.print and not options.sweeps and not (options.date and options.machine):
        parser.error("--date and --machine are needed for the record")
    program = options.program or build()
    if options.sweeps:
        names = [name for name in cases(program, "sweeps") if (options.only or "") in name]
        print(sweeps({name: per_run(program, name, MEMBERS) for name in names}))
        return
    names = cases(program)
    wanted = [name for name in names if (options.only or "") in name]
    counts = {}
    for name in wanted:
        counts[name] = per_run(program, name)
        if options.print:
            again = per_run(program, name)
            print(f"{name}\t{counts[name]}\t{again}\t{abs(again / counts[name] - 1):.1e}", flush=True)
        else:
            print(f"{name}\t{counts[name]}", file=sys.stderr, flush=True)
    if options.print:
        return
    if options.only:
        old = kept()["instructions"]
        counts = {
            name: counts.get(name, old.get(name.split("/", 1)[0], {}).get(name.split("/", 1)[1]))
            for name in names
        }
    record = {
        "date": options.date,
        "machine": options.machine,
        "rustc": version("rustc", "--version"),
        "valgrind": version("valgrind", "--version"),
        "repetitions": REPETITIONS,
        "instructions": nested({name: value for name, value in counts.items() if value is not None}),
    }
    RECORD.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    write_page(record)


if __name__ == "__main__":
    main()
