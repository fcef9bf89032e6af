"""What a user waits for, whole commands, beside other programs: CPU seconds and instructions.

    python3 benches/waits.py --kutzbach target/release/kutzbach --date 2026-01-31 --machine "2 cores of an ordinary machine"
    python3 benches/waits.py --kutzbach before=/tmp/kutzbach --kutzbach now=target/release/kutzbach --print

Two tables: `exact` on mechanisms whose equations msolve and Singular get from `exact --format msolve` and `--format singular`, and the
verdict at singular and shaky poses, which no other program gives. msolve and Singular are asked where they are installed; both give
a basis only, where the command gives it checked over the rationals, with dimension, free unknowns and components. `--also FOLDER`
adds the mechanisms of a folder to the second table.

All programs take turns on a case, `--rounds` times, so that what else the machine does falls on all alike; of each the median, the
least and the greatest CPU seconds (user and system) are kept, with the last line of what it said, since a fast wrong answer is none.
Where `--limit` seconds of CPU are used up a program is stopped, and that is kept. `--instructions` counts them with callgrind (valgrind
has to be installed), fifty times slower, for cases of at most `--count-below` seconds. The record is benches/record/waits.json;
`compare.py` reads it. Needed is nothing beyond Python's standard library.
"""

import argparse
import json
import os
import re
import resource
import shutil
import signal
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RECORD = ROOT / "benches" / "record" / "waits.json"

EXACT = {
    "Bennett": "mechanisms/bennett.urdf",
    "Goldberg six-bar": "mechanisms/goldberg_six_bar.urdf",
    "Bricard threefold": "mechanisms/bricard_threefold.urdf",
    "Bricard orthogonal": "mechanisms/bricard_orthogonal.urdf",
    "RSSR": "mechanisms/rssr.urdf",
    "six hinges, rigid": "mechanisms/six_hinge_rigid.urdf",
    "Watt": "tests/zoo/watt_I.urdf",
    "Peaucellier": "mechanisms/peaucellier.urdf",
    "hexapod on a conic": "mechanisms/hexapod_on_conic.urdf",
    "3-RRR": "mechanisms/planar_3rrr.urdf",
    "3-RPR": "tests/zoo/planar_3RPR.urdf",
}
VERDICTS = {
    "Wren platform": "mechanisms/wren_platform.urdf",
    "Tripteron": "mechanisms/tripteron.urdf",
    "Tripteron, 3-PRRR": "tests/zoo/tripteron_3PRRR.urdf",
    "6-UPS": "mechanisms/stewart.urdf",
    "6-UPS, printed decimals": "tests/zoo/stewart_6UPS.urdf",
    "hexagon with triangle": "tests/zoo2/hexagon_with_triangle_a.urdf",
    "K3,3 on a conic": "tests/zoo/k33_on_conic_shaky.urdf",
    "tensegrity prism": "tests/zoo/tensegrity_prism_shaky.urdf",
    "double Watt": "mechanisms/double_watt_cusp.urdf",
}


def commands(table, file, programs, folder):
    """Name and command of everything that is asked of a file; other programs get its equations."""
    if table == "verdict":
        return {name: [program, "report", str(file), "--format", "json"] for name, program in programs.items()}
    asked = {name: [program, "exact", str(file)] for name, program in programs.items()}
    export = list(programs.values())[-1]
    for peer in ("msolve", "Singular"):
        if shutil.which(peer) is None:
            continue
        equations = Path(folder) / f"{file.stem}.{peer.lower()}"
        written = subprocess.run([export, "exact", str(file), "--format", peer.lower()], capture_output=True, text=True)
        if written.returncode != 0:
            continue
        equations.write_text(written.stdout)
        asked[peer] = {
            "msolve": ["msolve", "-g", "2", "-f", str(equations), "-o", os.devnull],
            "Singular": ["Singular", "-q", str(equations)],
        }[peer]
    return asked


def once(command, limit):
    """CPU seconds, the last line that was said, and whether the program ended by itself."""
    def bounded():
        whole = max(1, int(limit))
        resource.setrlimit(resource.RLIMIT_CPU, (whole, whole + 5))

    with tempfile.TemporaryFile("w+", errors="replace") as said:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.DEVNULL, preexec_fn=bounded)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        lines = said.read().split("\n")
    stopped = process.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    last = next((line.strip() for line in reversed(lines) if line.strip()), "")
    return used.ru_utime + used.ru_stime, answer_of(lines, last), stopped


def answer_of(lines, last):
    """Of a report in JSON its verdict and bounds; otherwise the last line."""
    try:
        mobility = json.loads("\n".join(lines))["mobility"]
        return f"{mobility['verdict']}, {mobility['bounds'][0]} to {mobility['bounds'][1]}"
    except (ValueError, KeyError, TypeError, IndexError):
        return last[:200]


def digits(value, n=4):
    return float(f"{value:.{n}g}")


def summary(runs):
    seconds = [run[0] for run in runs]
    row = {"median": digits(statistics.median(seconds)), "least": digits(min(seconds)), "greatest": digits(max(seconds))}
    row["answer"] = runs[-1][1]
    if any(run[2] for run in runs):
        row["stopped"] = True
    return row


def instructions(command):
    """Counted by callgrind; None where it counts nothing."""
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command],
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace")
    found = re.search(r"Collected : (\d+)", run.stderr)
    return int(found[1]) if found else None


def measured(table, files, programs, arguments):
    answer = {}
    for case, file in files.items():
        if arguments.only not in f"{table} / {case}":
            continue
        with tempfile.TemporaryDirectory() as folder:
            asked = commands(table, file, programs, folder)
            runs = {name: [] for name in asked}
            for _ in range(arguments.rounds):
                for name, command in asked.items():
                    # One that was stopped would be again.
                    if not (runs[name] and runs[name][-1][2]):
                        runs[name].append(once(command, arguments.limit))
            answer[case] = {name: summary(found) for name, found in runs.items()}
            for name, row in answer[case].items():
                if arguments.instructions and "stopped" not in row and row["median"] <= arguments.count_below:
                    row["instructions"] = instructions(asked[name])
        print_row(table, case, answer[case])
    return answer


def print_row(table, case, row):
    def cell(name, found):
        more = "> " if found.get("stopped") else ""
        counted = f", {found['instructions'] / 1e6:.1f} M" if found.get("instructions") else ""
        return f"{name} {more}{found['median']:.4g} s{counted}"

    print(f"{table} / {case}: " + "; ".join(cell(*item) for item in row.items()), flush=True)


def named(texts):
    """{"now": path} of `now=path` or of a path alone, which is `kutzbach`."""
    pairs = [text.split("=", 1) if "=" in text else ["kutzbach", text] for text in texts]
    if len({name for name, _ in pairs}) != len(pairs):
        raise SystemExit("two programs need two names: --kutzbach before=PATH --kutzbach now=PATH")
    return dict(pairs)


def versions():
    """What the other programs say they are."""
    found = {}
    for peer, command in (("msolve", ["msolve", "-V"]), ("Singular", ["Singular", "--version"])):
        if shutil.which(peer):
            run = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
            said = (run.stdout or run.stderr).strip()
            found[peer] = said.splitlines()[0] if said else "no version told"
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kutzbach", action="append", required=True, metavar="[NAME=]PROGRAM")
    parser.add_argument("--also", type=Path, help="a folder whose mechanisms are added to the verdicts")
    parser.add_argument("--only", default="", help="cases whose name contains this")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--limit", type=float, default=60.0, help="CPU seconds for one run")
    parser.add_argument("--instructions", action="store_true")
    parser.add_argument("--count-below", type=float, default=1.0)
    parser.add_argument("--date", default="")
    parser.add_argument("--machine", default="")
    parser.add_argument("--print", action="store_true", help="keep no record")
    arguments = parser.parse_args()
    if not arguments.print and not (arguments.date and arguments.machine):
        parser.error("a record needs --date and --machine")
    programs = named(arguments.kutzbach)
    verdicts = {case: ROOT / file for case, file in VERDICTS.items()}
    if arguments.also:
        verdicts |= {file.stem: file for file in sorted(arguments.also.glob("*.urdf"))}
    record = {"date": arguments.date, "machine": arguments.machine, "rounds": arguments.rounds, "limit": arguments.limit,
              "versions": versions()}
    record["exact"] = measured("exact", {case: ROOT / file for case, file in EXACT.items()}, programs, arguments)
    record["verdict"] = measured("verdict", verdicts, programs, arguments)
    if not arguments.print:
        RECORD.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
