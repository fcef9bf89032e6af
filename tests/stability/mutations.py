#!/usr/bin/env python3
"""Shows that the stability suite fails when a tolerance is loosened or a precision escalation is switched off.

    python3 tests/stability/mutations.py [--target FOLDER] [--only NAME] [--update DATE]

The committed tree is copied to a folder of the target folder. Each mutation is an exact replacement of a text that has to occur exactly once
in its file. All of them are built together, each behind a switch that an environment variable names, so that one build serves
all; the suite has to succeed with no switch thrown, and to fail with any of them. Printed, and with --update written to
benches/record/stability_mutations.json and docs/src/stability.md: mutation, what it was, the families that caught it.

The exit code is 0 if every mutation was caught but those that are listed as unobservable, with a reason.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SWITCH = "KUTZBACH_MUTANT"
MARKS = ["<!-- mutations: begin -->", "<!-- mutations: end -->"]

# Name, file, text, text instead. `{on}` is whether the switch is thrown, `{times}` is 100 then and 1 otherwise.
MUTATIONS = [
    ("rank tolerance × 100", "crates/math/src/matrix/rank.rs",
     "tolerance: accuracy.max(rounding * longer_side as f64),",
     "tolerance: {times} * accuracy.max(rounding * longer_side as f64),"),
    ("no 106 bits for ranks", "crates/mobility/src/pose_rank/readings.rs",
     "            suspicious = false;\n            let finer",
     "            if {on} && rung == 106 {{ continue; }}\n            suspicious = false;\n            let finer"),
    ("no more than 106 bits for ranks", "crates/mobility/src/pose_rank/readings.rs",
     "if (rung as usize) < needed.min(",
     "if {on} && rung > 106 {{ break; }}\n            if (rung as usize) < needed.min("),
    ("no more digits for charts", "crates/mobility/src/chart.rs",
     "let Some(next) = rungs.next() else { break };",
     "let Some(next) = rungs.next().filter(|_| !{on}) else {{ break }};"),
    ("chart noise × 100", "crates/mobility/src/chart.rs",
     "noise = noise.max(4.0 * rounding + stated);",
     "noise = noise.max({times} * (4.0 * rounding + stated));"),
    ("closing tolerance × 100", "crates/closure/src/assembly/descent.rs",
     "allowed(length, fixed).min(COARSEST_CLOSING);",
     "({times} * allowed(length, fixed)).min(COARSEST_CLOSING);"),
    ("germ noise × 100", "crates/mobility/src/germ/noise.rs",
     "*noise = noise.max((entries * squares.sum::<f64>()).sqrt());",
     "*noise = noise.max({times} * (entries * squares.sum::<f64>()).sqrt());"),
    ("stated precision × 100", "crates/model/src/mechanism/number_style.rs",
     "0.5 * match by_other_hand {",
     "{times} * 0.5 * match by_other_hand {{"),
    ("digits of exact numbers not counted", "crates/mobility/src/pose_rank/readings.rs",
     "if tall > TALL {\n                suspicious",
     "if tall > TALL && !{on} {{\n                suspicious"),
    ("clearance above the rank tolerance / 100", "crates/math/src/matrix/rank.rs",
     ".filter(|&&value| value >= CLEARANCE * self.tolerance)",
     ".filter(|&&value| value >= CLEARANCE / {times} * self.tolerance)"),
    ("stated precision / 100", "crates/model/src/mechanism/number_style.rs",
     "let by_decimals = power_of_ten(-i64::from(most));",
     "let by_decimals = power_of_ten(-i64::from(most));\n        if {on} {{ return 0.005 * by_decimals; }}"),
    ("axes too close to tell are one", "crates/mobility/src/question.rs",
     "let by_kind = self.is_tall();",
     "let by_kind = self.is_tall() && !{on};"),
    ("rounding of the closure equations × 100", "crates/closure/src/jacobian.rs",
     "let steps = 12.0 * walk.joints.len() as f64;",
     "let steps = {times} * 12.0 * walk.joints.len() as f64;"),
    ("chart sees leftovers 100 times smaller", "crates/mobility/src/chart.rs",
     "let visible = COEFFICIENT * radius.powi(orders) > noise;",
     "let visible = {times} * COEFFICIENT * radius.powi(orders) > noise;"),
    ("assembled poses ranked as if drawn", "crates/mobility/src/pose_rank/readings.rs",
     "let poorer = match standing.moved {",
     "let poorer = match standing.moved && !{on} {{"),
    ("coarsest stated precision × 100", "crates/mobility/src/pose_rank.rs",
     "(stated, rounding, stated > COARSEST_STATED)",
     "(stated, rounding, stated > {times} * COARSEST_STATED)"),
    ("rank tolerance of sparse matrices × 100", "crates/math/src/matrix/rank.rs",
     "decision.tolerance = accuracy.max(rounding);",
     "decision.tolerance = {times} * accuracy.max(rounding);"),
]

# Mutations that change no answer of the suite, and what notices them.
UNOBSERVABLE = {
    "assembled poses ranked as if drawn":
        "nothing, as all members are drawn closed; the unit test `a_singular_pose_found_by_iteration_is_no_regular_one` fails",
    "coarsest stated precision × 100":
        "nothing, as no member is written so coarsely; five unit tests fail, such as `coarse_numbers_are_taken_as_they_are`",
}

FUNCTION = '''
/// Whether a mutation is switched on.
pub(crate) fn mutant(name: &str) -> bool {
    static NAME: std::sync::OnceLock<Option<String>> = std::sync::OnceLock::new();
    NAME.get_or_init(|| std::env::var("%s").ok()).as_deref() == Some(name)
}
''' % SWITCH


def mutated(tree):
    for name, file, old, new in MUTATIONS:
        path = tree / file
        text = path.read_text()
        if text.count(old) != 1:
            sys.exit(f"{name}: the text occurs {text.count(old)} times in {file}")
        on = f'crate::mutant("{name}")'
        new = new.format(on=on, times=f"(if {on} {{ 100.0f64 }} else {{ 1.0 }})")
        path.write_text(text.replace(old, new))
    # Each crate asks a function of its own.
    for crate in sorted({file.split("/src/")[0] for _, file, *_ in MUTATIONS}):
        lib = tree / crate / "src/lib.rs"
        lib.write_text(lib.read_text() + FUNCTION)


def brought(fresh, tree):
    """Makes a tree like a fresh one, and leaves files alone that are the same, so that they are not compiled again."""
    for path in sorted(fresh.rglob("*")):
        other = tree / path.relative_to(fresh)
        if path.is_dir():
            other.mkdir(parents=True, exist_ok=True)
        elif not other.exists() or other.read_bytes() != path.read_bytes():
            other.write_bytes(path.read_bytes())
    for path in sorted(tree.rglob("*"), reverse=True):
        if path.is_file() and not (fresh / path.relative_to(tree)).exists():
            path.unlink()


def built(tree, target):
    """The test executable."""
    command = ["cargo", "test", "--locked", "--test", "it", "--no-run", "--message-format=json"]
    environment = {**os.environ, "CARGO_TARGET_DIR": str(target)}
    done = subprocess.run(command, cwd=tree, env=environment, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit("the mutated tree does not build")
    for line in done.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable") and message["target"]["name"] == "it":
            return message["executable"]
    sys.exit("there is no test executable")


def run(executable, tree, name=None, limit=None):
    """Whether the suite succeeds, the tests that fail and the families that are named by them. What takes longer than a limit
    (s) has lost the bound on its work, which no test could tell without a clock."""
    environment = {key: value for key, value in os.environ.items() if key != "KUTZBACH_UPDATE"}
    environment["RUST_BACKTRACE"] = "0"
    if name is not None:
        environment[SWITCH] = name
    try:
        done = subprocess.run([executable, "stability::"], cwd=tree, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return False, ["does not end"], []
    tests = sorted(set(re.findall(r"^test stability::([\w:]+) \.\.\. FAILED", done.stdout, re.M)))
    places = re.findall(r"^([a-z_]+) at ", done.stdout, re.M)
    rows = re.findall(r"^([A-Za-z][A-Za-z ]*): \|", done.stdout, re.M)
    families = {title(place) for place in places} | set(rows)
    return done.returncode == 0, tests, sorted(families, key=str.lower)


def title(name):
    for inventor in ["Bennett", "Goldberg", "Bricard", "Miura"]:
        name = name.replace(inventor.lower(), inventor)
    return name.replace("_", " ")


def table(results):
    lines = ["| mutation | fails | noticed in |", "|---|---|---|"]
    for result in results:
        families = result["families"]
        told = ", ".join(families[:4]) + (f" and {len(families) - 4} more" if len(families) > 4 else "")
        if not result["caught"]:
            told = UNOBSERVABLE.get(result["mutation"], "nothing")
        count = len(result["tests"])
        fails = "none" if count == 0 else f"{count} check" + ("s" if count > 1 else "")
        if "does not end" in result["tests"]:
            fails = "does not end"
        lines.append(f"| {result['mutation']} | {fails} | {told} |")
    return "\n".join(lines)


RECORD = ROOT / "benches/record/stability_mutations.json"


def recorded():
    """What the record says of mutations that there still are, by name."""
    results = json.loads(RECORD.read_text())["mutations"] if RECORD.exists() else []
    names = [name for name, *_ in MUTATIONS]
    return {result["mutation"]: result for result in results if result["mutation"] in names}


def kept(results, date):
    """Writes the record and the table; what was not run stays as it was."""
    known = recorded() | {result["mutation"]: result for result in results}
    results = [known[name] for name, *_ in MUTATIONS if name in known]
    record = {"measured": date, "without": "succeeds", "mutations": results}
    RECORD.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n")
    page = ROOT / "docs/src/stability.md"
    head, rest = page.read_text().split(MARKS[0])
    tail = rest.split(MARKS[1])[1]
    page.write_text(f"{head}{MARKS[0]}\n\n{table(results)}\n\n{MARKS[1]}{tail}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--target", default=str(ROOT / "target/mutations"))
    parser.add_argument("--only", action="append")
    parser.add_argument("--update", metavar="DATE")
    parser.add_argument("--limit", type=float, default=600, metavar="SECONDS")
    options = parser.parse_args()
    names = [name for name, *_ in MUTATIONS if not options.only or name in options.only]
    results = []
    target = pathlib.Path(options.target).resolve()
    tree = target / "tree"
    tree.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        archive = subprocess.run(["git", "archive", "HEAD"], cwd=ROOT, stdout=subprocess.PIPE, check=True)
        subprocess.run(["tar", "-x", "-C", folder], input=archive.stdout, check=True)
        mutated(pathlib.Path(folder))
        brought(pathlib.Path(folder), tree)
    executable = built(tree, target)
    ok, tests, families = run(executable, tree)
    if not ok:
        sys.exit(f"without a mutation the suite fails: {tests}, {families}")
    print("none: succeeds", flush=True)
    for name in names:
        ok, tests, families = run(executable, tree, name, options.limit)
        results.append({"mutation": name, "caught": not ok, "tests": tests, "families": families})
        print(f"{name}: {'NOT CAUGHT' if ok else tests} {families}", flush=True)
        if options.update:
            kept(results, options.update)
    print(table(results))
    missed = [r["mutation"] for r in results if not r["caught"] and r["mutation"] not in UNOBSERVABLE]
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
