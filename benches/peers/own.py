"""kutzbach, as its users start it, one process for every answer; and as a library, within a program that has asked before."""

import csv
import io
import json
import os
import subprocess
import time

import numpy as np

from mechanism import rotations_of


def seconds_of(program, *arguments):
    """Wall time of one process whose output nobody reads."""
    nothing = os.open(os.devnull, os.O_WRONLY)
    row = [program, *map(str, arguments)]
    t0 = time.perf_counter()
    child = os.posix_spawn(program, row, os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, nothing, 1)])
    _, status = os.waitpid(child, 0)
    seconds = time.perf_counter() - t0
    os.close(nothing)
    if status:
        raise RuntimeError(f"{row[1:]} ended with {status}")
    return seconds


def output(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=True).stdout


def version(program):
    return output(program, "--version").split()[-1]


def verdict(program, file, rounds):
    """What a report says, and the seconds of processes that write one."""
    report = json.loads(output(program, "report", file, "--format", "json"))
    whole = [seconds_of(program, "report", file) for _ in range(rounds)]
    return report["mobility"]["finite"], report["home"]["instantaneous"], whole


def within(timed, file, rounds, *arguments):
    """Answers of the example `timed_answers` about a file: calls within a running program, as of a library."""
    return json.loads(output(timed, "--rounds", rounds, *arguments, file))


def poses(program, file, samples):
    """Rotations and positions of all links over the turn, from the table that a trace writes."""
    table = list(csv.reader(io.StringIO(output(program, "trace", file, "--format", "csv", "--samples", samples))))
    head, rows = table[0], np.array(table[1:], float)
    column = {name: i for i, name in enumerate(head)}
    links = [name[:-2] for name in head if name.endswith(".x")]
    positions = {l: rows[:, [column[f"{l}.{c}"] for c in "xyz"]] for l in links}
    rotations = {l: rotations_of(rows[:, [column[f"{l}.q{c}"] for c in "wxyz"]]) for l in links}
    return rotations, positions


def length_unit(program, file):
    return json.loads(output(program, "trace", file, "--format", "json", "--samples", 2))["length_unit"]
