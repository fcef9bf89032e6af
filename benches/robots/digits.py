"""Does a verdict survive the rewriting of a file's numbers?

Every number of `xyz`, `rpy` and axis attributes, expressions evaluated, is rounded to 6, 7, 9, 12 and 17 significant digits and to 6, 7, 9 and 12
decimals, and given the noise of 1e-16 that converters leave; and lengths and axes are rounded and then
rescaled, so that 17 digits hide the rounding. Each copy is reported on. Against the file as it is, an answer
is *same*; *open* where the program says itself that it hangs on the digits (undecided, or a nominal answer); *unassembled*
where only one of the two closes; *different* where both are confident and differ, which must not happen.

    python3 benches/robots/digits.py target/debug/kutzbach FILE... [--list] [--seconds 60] [--jobs 2]
"""

import argparse
import concurrent.futures
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile

PROPERTY = re.compile(r'<xacro:(?:property|arg)\s+name="(\w+)"\s+(?:value|default)="([^"]*)"')
MARKS = re.compile(r"\$\{([^{}]*)\}|\$\(arg\s+(\w+)\s*\)")
WORDS = re.compile(r"(?:\$\{[^{}]*\}|\$\([^)]*\)|[^\s$])+")


def significant(digits):
    return lambda x, _: f"{x:.{digits}g}"


def decimals(digits):
    return lambda x, _: f"{x:.{digits}f}"


def rescaled(digits):
    """Rounded, then multiplied as if by a unit that hides the rounding: lengths, and every axis as a whole."""
    return lambda x, _: f"{float(f'{x:.{digits}f}') * 0.7310585786300049:.17g}"


def noisy(x, noise):
    return f"{x + noise.uniform(-1e-16, 1e-16):.17g}"


WAYS = {f"{d} digits": significant(d) for d in (6, 7, 9, 12, 17)}
WAYS |= {f"{d} decimals": decimals(d) for d in (6, 7, 9, 12)}
WAYS["noise 1e-16"] = noisy
HIDDEN = {f"{d} decimals, hidden": rescaled(d) for d in (7, 9, 12)}
WAYS |= HIDDEN


def evaluator(text):
    """Words to floats; names are the properties of the file. `None` for what is no number."""
    names = {n: getattr(math, n) for n in ("pi", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "radians")}
    names["abs"] = abs
    pending = dict(PROPERTY.findall(text))

    def evaluate(word):
        plain = MARKS.sub(lambda m: f"({m[1] or m[2]})", word)
        try:
            return float(eval(plain, {"__builtins__": {}}, names))  # files of one's own
        except (NameError, SyntaxError, TypeError, ValueError, ZeroDivisionError, OverflowError):
            return None

    for _ in range(len(pending) + 1):
        for name, value in list(pending.items()):
            found = evaluate(value)
            if found is not None:
                names[name] = found
                del pending[name]
    return evaluate


# Lengths that are not attributes of origins, and would stay as they are where those are rescaled.
ELSEWHERE = re.compile(r"<(?:pose|anchorOffset|thread_pitch|screw|distance)\b")


def rewritten(text, name):
    if name in HIDDEN and ELSEWHERE.search(text):
        return text
    way = WAYS[name]
    noise = random.Random(1)
    evaluate = evaluator(text)

    def one(word, attribute):
        value = evaluate(word)
        if attribute == "rpy" and name in HIDDEN:
            # Angles have no unit.
            return word if value is None else f"{value:.17g}"
        return word if value is None else way(value, noise)

    def attributes(tag):
        # An element may hold both attributes.
        return re.sub(
            r'\b(xyz|rpy)="([^"]*)"',
            lambda m: f'{m[1]}="' + " ".join(one(w, m[1]) for w in WORDS.findall(m[2])) + '"',
            tag[0],
        )

    return re.sub(r"<(?:origin|axis2?)\b[^>]*>", attributes, text)


def answer(binary, path, seconds, options):
    try:
        done = subprocess.run(
            [binary, "report", "--format", "json", *options, path],
            capture_output=True, text=True, timeout=seconds, check=False,
        )
    except subprocess.TimeoutExpired:
        return ("no answer in time",)
    if not done.stdout.startswith("{"):
        return ("refused", done.stderr.strip()[:200])
    report = json.loads(done.stdout)
    mobility, home = report["mobility"], report.get("home") or {}
    locked = tuple(joint.get("locked") for joint in report["joints"])
    return (
        mobility["verdict"],
        mobility.get("finite"),
        home.get("instantaneous"),
        home.get("as_written"),
        mobility.get("nominal") is not None,
        locked,
    )


def compare(before, after):
    """`same`, `open` or `different`."""
    if before[0] in ("refused", "no answer in time") or after[0] in ("refused", "no answer in time"):
        return "same" if before[0] == after[0] else after[0]
    # The verdict, the freedom, and which joints are locked; an open role contradicts nothing.
    roles = all(a is None or b is None or a == b for a, b in zip(before[5], after[5]))
    if before[:2] == after[:2] and roles:
        return "same"
    if "unassembled" in (before[0], after[0]):
        return "unassembled"
    for one in (before, after):
        if one[0] == "undecided" or one[4] or one[3] is not None:
            return "open"
    return "different"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binary")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--list", action="store_true", help="name every file that is not the same")
    parser.add_argument("--option", action="append", default=[], help="given to the report")
    arguments = parser.parse_args()
    counts = {name: {} for name in WAYS}

    def judge(path):
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read()
        before = answer(arguments.binary, path, arguments.seconds, arguments.option)
        found = {}
        for name in WAYS:
            copy = rewritten(text, name)
            if copy == text:
                found[name] = (before, before)
                continue
            with tempfile.TemporaryDirectory() as folder:
                place = os.path.join(folder, os.path.basename(path))
                with open(place, "w", encoding="utf-8") as file:
                    file.write(copy)
                after = answer(arguments.binary, place, arguments.seconds, arguments.option)
            found[name] = (before, after)
        return path, found

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for path, found in pool.map(judge, arguments.files):
            for name, (before, after) in found.items():
                kind = compare(before, after)
                counts[name][kind] = counts[name].get(kind, 0) + 1
                if arguments.list and kind != "same" or kind == "different":
                    print(f"{kind}: {os.path.basename(path)}, {name}: {before[:5]} -> {after[:5]}", flush=True)
    kinds = sorted({kind for row in counts.values() for kind in row})
    print("| numbers | " + " | ".join(kinds) + " |")
    print("|---" * (len(kinds) + 1) + "|")
    for name, row in counts.items():
        print(f"| {name} | " + " | ".join(str(row.get(kind, 0)) for kind in kinds) + " |")
    return 1 if any("different" in row for row in counts.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
