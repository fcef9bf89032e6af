"""The program on real robots, beside an independent computation.

    python3 benches/robots/run.py --program target/release/kutzbach FOLDER...

Each folder is a repository with robots in it. Every robot that ROS's own parser accepts has to be read, and its freedoms are
compared with `freedoms.py`. `--commands N` runs every command on N of them. Exit code 1 where something is wrong; what is
open is counted.
"""

import argparse
import collections
import json
import subprocess
import sys
import time
from pathlib import Path

from collection import robots
from description import read
from freedoms import freedoms

COMMANDS = [
    ["report"],
    ["graph"],
    ["graph", "--format", "dot"],
    ["graph", "--format", "svg"],
    ["report", "--format", "html"],
    ["trace"],
    ["simulate"],
    ["exact"],
]
# Columns more than this are left to the program: the dense decomposition here takes too long.
MOST_VARIABLES = 250


def report(program, path):
    found = subprocess.run([program, "report", str(path), "--format", "json"], capture_output=True, text=True, timeout=300)
    return (json.loads(found.stdout), "") if found.returncode == 0 else (None, found.stderr.strip())


def said(found):
    return found["mobility"]["verdict"], found["mobility"]["finite"], found["home"]["instantaneous"]


def compare(found, robot):
    """What the two disagree about, or `None` where they do not; `open` where one of them has no answer."""
    try:
        description = read(robot.text)
        if sum(len(joint.freedoms) for joint in description.tree) > MOST_VARIABLES:
            return "not compared", "large"
        own = freedoms(description)
    except (ValueError, KeyError, AttributeError, SyntaxError) as error:
        return "not compared", f"own reader: {error!r}"
    if not own["closed"] or own["here"] is None:
        return "not compared", f"own computation: {own}"
    _, finite, here = said(found)
    differ = [
        f"{what}: {told}, but {computed}"
        for what, told, computed in [
            ("at the pose", here, own["here"]),
            ("finite", finite, own["nearby"]),
            ("redundant", found["home"]["redundant"], own["redundant"]),
        ]
        if told is not None and told != computed
    ]
    if differ:
        return "different", "; ".join(differ)
    return ("same", "") if finite is not None else ("open", "")


def commands(program, paths):
    """Seconds and exit code of each command on each robot."""
    rows = []
    for path in paths:
        row = {"robot": path.name}
        for command in COMMANDS:
            start = time.perf_counter()
            try:
                code = subprocess.run([program, command[0], str(path), *command[1:]], capture_output=True, timeout=120).returncode
            except subprocess.TimeoutExpired:
                code = "no end"
            row[" ".join(command)] = [code, round(time.perf_counter() - start, 2)]
        rows.append(row)
        print(row, flush=True)
    return rows


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("folders", nargs="+")
    options.add_argument("--program", required=True)
    options.add_argument("--every", type=int, default=1, help="take every Nth robot only")
    options.add_argument("--commands", type=int, default=0, metavar="N")
    options.add_argument("--output")
    asked = options.parse_args()
    outcomes, refused, different, paths = collections.Counter(), {}, {}, []
    for number, robot in enumerate(robots(asked.folders)):
        if number % asked.every:
            continue
        found, why = report(asked.program, robot.path)
        if found is None:
            outcomes["refused"] += 1
            refused[str(robot.path)] = why.splitlines()[0] if why else ""
            continue
        outcome, reason = compare(found, robot)
        outcomes[outcome] += 1
        paths.append(robot.path)
        if outcome in ("different", "not compared"):
            different[str(robot.path)] = reason
    record = {
        "robots": sum(outcomes.values()),
        "outcomes": dict(outcomes),
        "refused": refused,
        "to look at": different,
    }
    if asked.commands:
        step = max(1, len(paths) // asked.commands)
        record["commands"] = commands(asked.program, paths[::step][: asked.commands])
    text = json.dumps(record, indent=1)
    print(text)
    if asked.output:
        Path(asked.output).write_text(text + "\n")
    sys.exit(1 if outcomes["different"] else 0)


if __name__ == "__main__":
    main()
