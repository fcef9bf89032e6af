"""Measures kutzbach and its peers side by side. See README.md.

    python benches/peers/run.py --kutzbach target/release/kutzbach --timed target/release/examples/timed_answers \\
        --date 2026-01-31 --machine "2 cores of an ordinary machine"
"""

import argparse
import importlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
RECORD = ROOT / "benches" / "record" / "peers.json"
MARK = "<<answer>> "
PEERS = ("exudyn", "mujoco", "drake")
STAGES = (1, 3, 10, 30, 100, 300, 1000)
LIMIT = 60.0
TURNS = {
    "four-bar": {"file": "planar_four_bar", "crank": "crank_pivot", "flags": [1, 1, 0, 0, 0, 0]},
    "Bennett": {"file": "bennett", "crank": "hinge_1", "flags": [1, 0, 1, 0, 0, 0]},
}
SAMPLES = (12, 24, 60, 240, 1000, 4000)


def digits(value, n=4):
    return None if value is None else float(f"{value:.{n}g}")


def spread(seconds):
    """Median, least and greatest."""
    return {"median": digits(statistics.median(seconds)), "least": digits(min(seconds)), "greatest": digits(max(seconds))}


# What runs in a process of its own, one tool loaded.


def task_version(peer, _):
    return peer.VERSION


def task_zoo(peer, job):
    from mechanism import read

    answer = {}
    for file in sorted((ROOT / "tests" / "zoo").glob("*.urdf")):
        try:
            rounds = [peer.count(read(file)) for _ in range(job["rounds"] + 1)][1:]
        except Exception as problem:
            answer[file.stem] = {"why_not": str(problem)}
            continue
        answer[file.stem] = {
            "freedom": rounds[0][2], "build": spread([r[0] for r in rounds]), "count": spread([r[1] for r in rounds]),
        }
    return answer


def task_lift(peer, job):
    from mechanism import scissor_lift

    lift = scissor_lift(job["stages"])
    try:
        rounds = [peer.count(lift)]
    except Exception as problem:
        return {"why_not": str(problem).strip().splitlines()[0]}
    while len(rounds) < job["rounds"] and sum(r[0] + r[1] for r in rounds) < 5:
        rounds.append(peer.count(lift))
    return {"freedom": rounds[0][2], "rounds": len(rounds),
            "build": spread([r[0] for r in rounds]), "count": spread([r[1] for r in rounds])}


def task_turn(peer, job):
    import numpy as np
    from mechanism import closure_error, frame_along, rates_of_one_turn, read

    mechanism = read(ROOT / "mechanisms" / f"{job['file']}.urdf")
    rates = rates_of_one_turn(mechanism, job["crank"])
    crank = next(j for j in mechanism.joints if j.name == job["crank"])
    answer = []
    for setting in peer.turn_settings():
        row = dict(setting)
        try:
            run, look = peer.turn(mechanism, job["crank"], rates, {**setting, "flags": job["flags"]})
            runs = []
            while len(runs) < job["rounds"] and sum(r[0] for r in runs) < 5:
                runs.append(run())
            rotations, positions = look()
            row["time"] = spread([r[0] for r in runs])
            row["unconfirmed"] = runs[0][1]
            row["closure_error"] = digits(closure_error(mechanism, rotations, positions, job["length"]))
            across = frame_along(crank.axis)[:, 0]
            relative = np.einsum("nji,njk->nik", rotations[crank.a], rotations[crank.b]) @ across
            angles = np.unwrap(np.r_[0, np.arctan2(relative @ np.cross(crank.axis, across), relative @ across)])
            row["turned"] = digits(float(angles[-1]), 6)
        except Exception as problem:
            row["why_not"] = str(problem).strip().splitlines()[-1] or type(problem).__name__
        answer.append(row)
    return answer


def task_once(peer, job):
    """One answer and nothing else, for the time of a whole process."""
    from mechanism import rates_of_one_turn, read

    if job["what"] == "count":
        return peer.count(read(ROOT / "tests" / "zoo" / f"{job['file']}.urdf"))[2]
    mechanism = read(ROOT / "mechanisms" / f"{job['file']}.urdf")
    rates = rates_of_one_turn(mechanism, job["crank"])
    return peer.turn(mechanism, job["crank"], rates, {**job["setting"], "flags": job["flags"]})[0]()[1]


TASKS = {"version": task_version, "zoo": task_zoo, "lift": task_lift, "turn": task_turn, "once": task_once}


def in_own_process(peer, task, job=None, threads=1, limit=None):
    """The answer of a task and the seconds of its process; None where it took longer than the limit."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": str(threads)}
    row = [sys.executable, str(HERE / "run.py"), "--task", json.dumps([peer, task, job or {}])]
    t0 = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory() as empty:
            done = subprocess.run(row, capture_output=True, text=True, timeout=limit, env=environment, cwd=empty)
    except subprocess.TimeoutExpired:
        return None, None
    seconds = time.perf_counter() - t0
    found = [line for line in done.stdout.splitlines() if line.startswith(MARK)]
    if not found:
        raise RuntimeError(f"{peer} {task} {job}: {done.stdout[-500:]} {done.stderr[-500:]}")
    return json.loads(found[-1][len(MARK):]), seconds


def answer_task(text):
    name, task, job = json.loads(text)
    answer = TASKS[task](importlib.import_module(f"peer_{name}"), job)
    print()
    print(MARK + json.dumps(answer), flush=True)


# What the driver asks for.

QUESTIONS = ("read", "rank", "verdict", "motions", "everything")


def rounded(seconds):
    return {key: digits(value) for key, value in seconds.items()}


def measure_zoo(program, timed, rounds):
    import own

    expected = json.loads((ROOT / "tests" / "zoo" / "expected.json").read_text())
    answer = {name: {"finite": e["finite"], "instantaneous": e["instantaneous"]} for name, e in expected.items()}
    for name, row in answer.items():
        file = ROOT / "tests" / "zoo" / f"{name}.urdf"
        finite, instantaneous, whole = own.verdict(program, file, rounds)
        within = own.within(timed, file, rounds)
        if (within["finite"], within["instantaneous"]) != (finite, instantaneous):
            raise SystemExit(f"{name}: a report says otherwise than the depths that are timed")
        row["kutzbach"] = {"freedom": finite, "instantaneous_found": instantaneous, "process": spread(whole)} | {
            question: rounded(within[question]) for question in QUESTIONS}
    for peer in PEERS:
        for name, found in in_own_process(peer, "zoo", {"rounds": rounds})[0].items():
            answer[name][peer] = found
        print(f"zoo: {peer}", file=sys.stderr)
    return answer


def measure_lift(program, timed, rounds):
    import own
    from mechanism import scissor_lift, write_urdf

    answer = {"kutzbach": []} | {peer: [] for peer in PEERS}
    with tempfile.TemporaryDirectory() as folder:
        for stages in STAGES:
            file = Path(folder) / f"scissor_lift_{stages}.urdf"
            file.write_text(write_urdf(scissor_lift(stages)))
            finite, _, whole = own.verdict(program, file, rounds)
            within = own.within(timed, file, rounds)
            answer["kutzbach"].append({"stages": stages, "freedom": finite, "rounds": rounds, "process": spread(whole)} | {
                question: rounded(within[question]) for question in QUESTIONS})
    for peer in PEERS:
        for stages in STAGES:
            best = None
            for threads in (1, 2):
                found, _ = in_own_process(peer, "lift", {"stages": stages, "rounds": rounds}, threads, LIMIT * 1.5)
                if found is None or "why_not" in found:
                    best = best or (found and {"stages": stages, **found})
                    break
                if best is None or found["count"]["median"] < best["count"]["median"]:
                    best = {"stages": stages, "threads": threads, **found}
            if best and "why_not" in best:
                answer[peer].append(best)
                break
            if best is None or best["build"]["median"] + best["count"]["median"] > LIMIT:
                answer[peer].append({"stages": stages, "why_not": f"more than {LIMIT:.0f} s"})
                break
            answer[peer].append(best)
        print(f"lift: {peer}", file=sys.stderr)
    return answer


def measure_turn(program, timed, rounds):
    import own
    from mechanism import closure_error, read

    answer = {}
    for name, job in TURNS.items():
        file = ROOT / "mechanisms" / f"{job['file']}.urdf"
        length = own.length_unit(program, file)
        mechanism = read(file)
        rows = []
        for samples in SAMPLES:
            arguments = ("trace", file, "--format", "csv", "--samples", samples)
            times = [own.seconds_of(program, *arguments) for _ in range(3 * rounds + 1)][1:]
            error = closure_error(mechanism, *own.poses(program, file, samples), length)
            rows.append({"steps": samples, "time": spread(times), "closure_error": digits(error)})
        within = own.within(timed, file, 3 * rounds, "--turn", job["crank"])["turns"]
        for row in rows:
            found = next((turn for turn in within if turn["poses"] == row["steps"]), None)
            if found:
                row["within"] = rounded({key: found[key] for key in ("least", "median")})
        answer[name] = {"length": digits(length), "kutzbach": rows}
        for peer in PEERS:
            answer[name][peer] = in_own_process(peer, "turn", {**job, "length": length, "rounds": rounds})[0]
            print(f"turn: {name} {peer}", file=sys.stderr)
    return answer


def accepted(row, error, at_least=0):
    """Whether a turn came round, closed well enough, and with so many poses."""
    return "why_not" not in row and row["closure_error"] <= error and row["steps"] >= at_least \
        and abs(row.get("turned", 6.2832) - 6.2832) < 0.05


def quickest(rows, error, at_least=0):
    fit = [row for row in rows if accepted(row, error, at_least)]
    return min(fit, key=lambda row: row["time"]["median"], default=None)


def measure_processes(program, turns, rounds):
    """Whole processes of the peers: interpreter, import, model, one answer; and the start of kutzbach."""
    import own

    answer = {"kutzbach": spread([own.seconds_of(program, "--version") for _ in range(5 * rounds)])}
    for peer in PEERS:
        row = {"count": spread([
            in_own_process(peer, "once", {"what": "count", "file": "bennett_rational"})[1] for _ in range(rounds)])}
        for name, job in TURNS.items():
            best = quickest(turns[name][peer], 1e-6)
            if best:
                setting = {k: v for k, v in best.items() if k not in ("time", "closure_error", "turned", "unconfirmed")}
                row[name] = spread([
                    in_own_process(peer, "once", {"what": "turn", **job, "setting": setting})[1] for _ in range(rounds)])
        answer[peer] = row
    return answer


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--kutzbach", help="the program, built with --release")
    arguments.add_argument("--timed", help="its example timed_answers, built with --release")
    arguments.add_argument("--date", default="", help="the day, as the record and the page repeat it")
    arguments.add_argument("--machine", default="", help="the machine in words, such as '2 cores of an ordinary machine'")
    arguments.add_argument("--rounds", type=int, default=7)
    arguments.add_argument("--only", nargs="*", choices=["zoo", "lift", "turn"], help="measure these anew, keep the rest")
    arguments.add_argument("--page", action="store_true", help="measure nothing, write the page from the record")
    arguments.add_argument("--task", help=argparse.SUPPRESS)
    given = arguments.parse_args()
    if given.task:
        return answer_task(given.task)
    if not given.page:
        import own

        program, timed = (str(Path(given_path).resolve()) for given_path in (given.kutzbach, given.timed))
        record = json.loads(RECORD.read_text()) if given.only and RECORD.exists() else {}
        record |= {"date": given.date, "machine": given.machine, "rounds": given.rounds, "limit": LIMIT}
        record["versions"] = {"kutzbach": own.version(program), "python": sys.version.split()[0]} | {
            name: line.split("==")[1] for line in (HERE / "requirements.txt").read_text().split() for name in [line.split("==")[0]]}
        for peer in PEERS:
            found = in_own_process(peer, "version")[0]
            if not found.startswith(record["versions"][peer]):
                raise SystemExit(f"{peer} {found} is installed, requirements.txt says {record['versions'][peer]}")
        for name, measure in (("zoo", measure_zoo), ("lift", measure_lift), ("turn", measure_turn)):
            if not given.only or name in given.only:
                record[name] = measure(program, timed, given.rounds)
                RECORD.write_text(json.dumps(record, indent=1) + "\n")
        record["processes"] = measure_processes(program, record["turn"], given.rounds)
        RECORD.write_text(json.dumps(record, indent=1) + "\n")
    import page

    page.update(json.loads(RECORD.read_text()))


if __name__ == "__main__":
    main()
