#!/usr/bin/env python3
"""Makes everything that is measured on docs/src/accuracy.md, accuracy_by_mechanism.md and stability.md anew, with its records and figures.

    python3 benches/accuracy.py [--quick] [--date DATE] [--machine MACHINE]

Three programs one after the other: the accuracy of eight mechanisms (some minutes, on a machine with nothing else to do), the
break points of the stability suite (some minutes), and the mutations that show that the suite can fail (half an hour; --quick
leaves them as they are).
"""

import argparse
import datetime
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def steps(date, machine, quick):
    """What is done, in order: words, command, variables of the environment."""
    cargo = ["cargo", "run", "--locked", "--release", "--example", "accuracy_page", "--"]
    found = [
        ("eight mechanisms", [*cargo, "--update", date, machine], {}),
        ("break points", ["cargo", "test", "--locked", "--test", "it", "stability::"], {"KUTZBACH_UPDATE": "1"}),
    ]
    if not quick:
        found.append(("mutations", [sys.executable, "tests/stability/mutations.py", "--update", date], {}))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--date", default=str(datetime.date.today()), help="the day, for the records [default: today]")
    machine = f"{os.cpu_count()} cores of an ordinary machine"
    parser.add_argument("--machine", default=machine, help="words for the machine, for the records [default: %(default)s]")
    parser.add_argument("--quick", action="store_true", help="leave the mutations as they are")
    options = parser.parse_args()
    for words, command, variables in steps(options.date, options.machine, options.quick):
        print(f"== {words}", flush=True)
        done = subprocess.run(command, cwd=ROOT, env={**os.environ, **variables})
        if done.returncode != 0:
            sys.exit(f"{words}: exit code {done.returncode}")


if __name__ == "__main__":
    main()
